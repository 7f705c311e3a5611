# Debian packages: `cpack --config build/CPackConfig.cmake` makes lorentz, liblorentz-dev and, if it was built,
# python3-lorentz, of the three parts that LorentzInstall.cmake and python/ install. `./run packages` makes and tries them
# (docs/packages.md).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lorentz)
set(CPACK_PACKAGE_VENDOR "The lorentz developers")
set(CPACK_PACKAGE_CONTACT "The lorentz developers <lorentz@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact first hits in periodic Lorentz gases")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/cmake/compress_manuals.cmake)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the tests are not part of a package

get_cmake_property(installed COMPONENTS)
set(CPACK_COMPONENTS_ALL "")
foreach(part program development python)
  if(part IN_LIST installed)
    list(APPEND CPACK_COMPONENTS_ALL ${part})
  endif()
endforeach()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
file(STRINGS ${PROJECT_SOURCE_DIR}/packaging/address address REGEX "^https:")
if(address)
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${address})
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lorentz)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Which obstacle does a point particle hit first, among discs or spheres on a
lattice? Exact answers with proofs, golden sets of hard cases, and campaigns
that show where other programs answer wrongly.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblorentz-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# The archives are static: what they call has to be there to link with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libstdc++-12-dev | libstdc++-dev, libhwy-dev, libgmp-dev, libflint-arb-dev, libsimdjson-dev, libtomlplusplus-dev, pkgconf")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS ON)  # of the library for C
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and static libraries for C++: a fast engine that knows when it does
not know, batches in vectors, an oracle in exact arithmetic, certified
trajectories. One shared library for C, and for languages that call C.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lorentz)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(TARGET lorentz_python)  # a module for one version of Python; scenes and golden sets are those of the program
  math(EXPR next_minor "${LORENTZ_PYTHON_MINOR}+1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${LORENTZ_PYTHON_MINOR}), python3 (<< 3.${next_minor}), \
python3-numpy, lorentz (= ${PROJECT_VERSION})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Engines, oracle, certificates and trajectories as functions of NumPy arrays.")

# What Debian's policy wants in each package's folder of documents: the licence, and when it was made.
string(TIMESTAMP made "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, where that is set
foreach(part ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${part} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(folder ${PROJECT_BINARY_DIR}/debian/${name})
  file(WRITE ${folder}/changelog "lorentz (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * CHANGELOG.md of the sources "
    "says what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${made}\n")
  execute_process(COMMAND gzip -9 -n -f ${folder}/changelog)
  install(FILES ${folder}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${part} OPTIONAL)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
    COMPONENT ${part})
endforeach()
include(CPack)
