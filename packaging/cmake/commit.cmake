# Writes OUTPUT, the commit of the sources in SOURCE as a line of C++; leaves it alone if it says that already.
cmake_minimum_required(VERSION 3.23)
execute_process(COMMAND git describe --always --dirty --abbrev=12 "--exclude=*" WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(commit unknown)  # no git, or an archive of the sources
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "inline constexpr char kCommit[] = \"@commit@\";\n" @ONLY)
