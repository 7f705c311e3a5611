# CPack runs this over what it is about to put into packages: Debian wants manual pages compressed.
file(GLOB_RECURSE manuals ${CPACK_TEMPORARY_DIRECTORY}/*.1)
list(FILTER manuals INCLUDE REGEX "/man1/[^/]*$")
if(manuals)
  execute_process(COMMAND gzip -9 -n ${manuals} COMMAND_ERROR_IS_FATAL ANY)
endif()
