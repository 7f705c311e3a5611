# Installing: `cmake --install build --prefix P`, then in another project
#   find_package(lorentz REQUIRED COMPONENTS engine batch oracle certified_batch itinerary exchange c)
#   target_link_libraries(.. lorentz::engine lorentz::batch lorentz::oracle lorentz::certified lorentz::walk lorentz::exchange)
# One export set a component, because they differ in what they need: `engine` the standard library, `batch` Highway,
# `oracle` GMP (linked; Boost's and CGAL's headers only to build it), `certified_batch` those two, `itinerary` Arb besides,
# `exchange` simdjson and toml++, `c` nothing to link. What is installed is in three parts (--component): `program`, `development`, and `python`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(LORENTZ_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/lorentz)

set(LORENTZ_ENGINE_TARGETS lorentz_problem lorentz_engine_base lorentz_classical lorentz_published lorentz_reduction
  lorentz_engine lorentz_trajectory)
set(LORENTZ_ENGINE_HEADERS version problem vec scene obstacle query answer geometry errors pimpl environment engine engine_base
  collision flight reduction trajectory rational claim)
set(LORENTZ_BATCH_TARGETS lorentz_batch lorentz_trajectory_batch)
set(LORENTZ_BATCH_HEADERS batch trajectory_batch)
set(LORENTZ_EXCHANGE_TARGETS lorentz_exchange)
set(LORENTZ_EXCHANGE_HEADERS exchange line_reader)
set(LORENTZ_ORACLE_TARGETS lorentz_integers lorentz_exact lorentz_first_hit lorentz_contacts lorentz_horizon
  lorentz_margin lorentz_surroundings lorentz_certificate_check lorentz_certificate lorentz_oracle lorentz_walk lorentz_certified)
set(LORENTZ_ORACLE_HEADERS oracle walk certified verdict margin surroundings horizon scene_check continued_fraction certificate
  certificate_check prover)
set(LORENTZ_CERTIFIED_BATCH_TARGETS lorentz_certified_batch)
set(LORENTZ_CERTIFIED_BATCH_HEADERS certified_batch)
set(LORENTZ_ITINERARY_TARGETS lorentz_itinerary)
set(LORENTZ_ITINERARY_HEADERS itinerary)
set(LORENTZ_C_TARGETS lorentz_c)
set(LORENTZ_C_HEADERS "")

function(lorentz_install_component component)
  string(TOUPPER ${component} upper)
  install(TARGETS ${LORENTZ_${upper}_TARGETS} EXPORT lorentz-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT lorentz-${component} NAMESPACE lorentz:: DESTINATION ${LORENTZ_CMAKE_DIR} COMPONENT development)
  list(TRANSFORM LORENTZ_${upper}_HEADERS REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/include/lorentz/\\1.hpp")
  install(FILES ${LORENTZ_${upper}_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lorentz COMPONENT development)
endfunction()

# lorentz-COMPONENT.pc, for projects without CMake. Archives in the order in which a linker wants them; the prefix is where
# the file itself is, so that the tree can be moved.
file(RELATIVE_PATH LORENTZ_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" LORENTZ_PC_PREFIX "${LORENTZ_PC_PREFIX}")
function(lorentz_install_pkg_config component requires)  # and linker options for what has no .pc
  string(TOUPPER ${component} upper)
  set(libs "")
  set(targets ${LORENTZ_${upper}_TARGETS})
  list(REVERSE targets)
  foreach(target ${targets})
    get_target_property(name ${target} OUTPUT_NAME)
    if(NOT name)
      set(name ${target})
    endif()
    string(APPEND libs " -l${name}")
  endforeach()
  set(LORENTZ_PC_NAME lorentz-${component})
  set(LORENTZ_PC_LIBS "${libs} ${ARGN}")
  set(LORENTZ_PC_REQUIRES "${requires}")
  configure_file(${PROJECT_SOURCE_DIR}/packaging/cmake/lorentz.pc.in ${PROJECT_BINARY_DIR}/lorentz-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/lorentz-${component}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT development)
endfunction()

lorentz_install_component(engine)
lorentz_install_pkg_config(engine "")
if(TARGET lorentz_batch)
  lorentz_install_component(batch)
  lorentz_install_pkg_config(batch "lorentz-engine libhwy" -pthread)
endif()
if(TARGET lorentz_exchange)
  lorentz_install_component(exchange)
  lorentz_install_pkg_config(exchange "lorentz-engine simdjson tomlplusplus")
endif()
if(TARGET lorentz_oracle)
  lorentz_install_component(oracle)
  lorentz_install_pkg_config(oracle "lorentz-engine gmpxx gmp")
  lorentz_install_component(itinerary)
  list(TRANSFORM LORENTZ_ARB PREPEND -l OUTPUT_VARIABLE arb)
  list(JOIN arb " " arb)
  lorentz_install_pkg_config(itinerary "lorentz-oracle gmp" "${arb}")
endif()
if(TARGET lorentz_certified_batch)
  lorentz_install_component(certified_batch)
  lorentz_install_pkg_config(certified_batch "lorentz-batch lorentz-oracle")
endif()
if(TARGET lorentz_c)
  lorentz_install_component(c)
  lorentz_install_pkg_config(c "")
endif()
# For authors of `lib:` engines: plain C, by itself. The library for C takes its columns from there.
install(FILES ${PROJECT_SOURCE_DIR}/include/lorentz/engine.h ${PROJECT_SOURCE_DIR}/include/lorentz/lorentz.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lorentz
  COMPONENT development)
if(TARGET lorentz)
  install(TARGETS lorentz RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/scenes ${PROJECT_SOURCE_DIR}/data/golden
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lorentz COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
    FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/packaging/cmake/lorentz-config.cmake.in lorentz-config.cmake
  INSTALL_DESTINATION ${LORENTZ_CMAKE_DIR})
# Before 1.0 each minor version may change the interface.
write_basic_package_version_file(lorentz-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lorentz-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/lorentz-config-version.cmake
  DESTINATION ${LORENTZ_CMAKE_DIR} COMPONENT development)

# What `cmake --install` noted that it had written: cmake --build build --target uninstall
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt -P ${PROJECT_SOURCE_DIR}/packaging/cmake/uninstall.cmake)
