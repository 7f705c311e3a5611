# cmake -DBUILD=.. -DSOURCE=.. -DSCRATCH=.. -DGENERATOR=.. -P install_test.cmake: installs this build, builds the consumer
# project against what was installed (by CMake and by pkg-config), and the engine alone as a subproject. Fails at the
# first thing that does not work.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}: ${status}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(prints expected)
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "expected ${expected}, got:\n${output}")
  endif()
endfunction()

unset(ENV{CMAKE_CXX_COMPILER_LAUNCHER})  # of the build that is installed, if it had one
file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/installed)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/docs/examples/consumer -B ${SCRATCH}/consumer -DCMAKE_PREFIX_PATH=${prefix}
  "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
run(${CMAKE_COMMAND} --build ${SCRATCH}/consumer)
run(${SCRATCH}/consumer/library)
prints("certified +hits the disc of cell")
run(${SCRATCH}/consumer/engine_only)
prints("cell \\(27, 1\\) at 26.95085432627853")
run(${SCRATCH}/consumer/all_headers)
run(${SCRATCH}/consumer/ask)
prints("hit, cell \\(27, 1\\), time 26.950854326278535")
run(${prefix}/bin/lorentz scene show)
prints("cubic")
# A library of an author's, by the installed header alone.
run(${COMPILER} -x c -std=c99 -Wall -Wextra -Wpedantic -Werror -O1 -shared -fPIC -I ${prefix}/include
  ${SOURCE}/docs/examples/library_engine.c -o ${SCRATCH}/mine.so -lm)
run(${prefix}/bin/lorentz compare --scene cubic --count 20 --engine lib:${SCRATCH}/mine.so)
prints("no wrong answer in 19")
run(${CMAKE_COMMAND} -E chdir ${prefix}/share/lorentz/golden sha256sum --quiet -c SHA256SUMS)
foreach(page man/man1/lorentz.1 man/man1/lorentz-scene-draw.1)
  if(NOT EXISTS ${prefix}/share/${page})
    message(FATAL_ERROR "share/${page} was not installed")
  endif()
endforeach()

# A component may have the name of a target; a wrong one gets a list.
file(WRITE ${SCRATCH}/names/CMakeLists.txt "cmake_minimum_required(VERSION 3.23)
project(names CXX)
find_package(lorentz REQUIRED COMPONENTS \${WANTED})
if(NOT TARGET lorentz::\${WANTED})
  message(FATAL_ERROR \"no target\")
endif()
")
foreach(name walk certified trajectory trajectory_batch engine c)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SCRATCH}/names -B ${SCRATCH}/names/${name} -DCMAKE_PREFIX_PATH=${prefix}
    -DWANTED=${name})
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SCRATCH}/names -B ${SCRATCH}/names/orcale
  -DCMAKE_PREFIX_PATH=${prefix} -DWANTED=orcale RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0)
  message(FATAL_ERROR "there is a component orcale")
endif()
prints("no component orcale; lorentz has")

# By pkg-config, the engine alone.
set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
run(pkg-config --define-prefix --cflags --libs lorentz-engine)
separate_arguments(flags UNIX_COMMAND "${output}")
run(${COMPILER} -std=c++20 ${SOURCE}/docs/examples/engine_only.cpp -o ${SCRATCH}/by_pkg_config ${flags})
run(${SCRATCH}/by_pkg_config)
prints("cell \\(27, 1\\)")

# And the library for C, from C.
run(pkg-config --define-prefix --cflags --libs lorentz-c)
separate_arguments(c_flags UNIX_COMMAND "${output}")
run(${COMPILER} -x c -std=c99 ${SOURCE}/docs/examples/ask.c -o ${SCRATCH}/ask -x none ${c_flags} -Wl,-rpath,${prefix}/${LIBDIR})
run(${SCRATCH}/ask)
prints("hit, cell \\(27, 1\\), time 26.950854326278535")

run(${COMPILER} -std=c++20 -O1 ${SOURCE}/tests/house/hostile_consumer.cpp -o ${SCRATCH}/peaceful_consumer ${flags})
run(${SCRATCH}/peaceful_consumer)
string(REGEX MATCH "numbers [0-9a-f]+" numbers "${output}")

# As a subproject, without the headers of any library, and whatever the parent's flags.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/tests/house/subproject -B ${SCRATCH}/subproject
  -DLORENTZ_SOURCE_DIR=${SOURCE} "-DCMAKE_CXX_FLAGS=-O0 -ffast-math")
run(${CMAKE_COMMAND} --build ${SCRATCH}/subproject --target engine_only hostile_consumer)
run(${SCRATCH}/subproject/engine_only)
prints("cell \\(27, 1\\) at 26.95085432627853")
run(${SCRATCH}/subproject/hostile_consumer)
prints("${numbers}\n")
