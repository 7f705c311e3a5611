# How every target here is compiled, and the form of a library: one folder, one target, one prefix of includes.

# Floating point, pinned. The binary64 engines are specified operation by operation: if the compiler fuses a*b + c on its
# own, or reorders sums, the same source gives other bits on another machine, and an error bound derived for two
# roundings no longer describes the program. So: no contraction (an fma is written where one is meant), no fast-math,
# SSE arithmetic on x86 (the default there), and no -march=native. docs/determinism.md tells how each was found:
#  - after -fno-fast-math, for clang's takes the contraction that was asked for back;
#  - GCC's vectorizer fuses pairs of a difference and a sum whatever -ffp-contract says (x86 with FMA), so none of it. What
#    vectors are worth it for is written in vectors (src/engines/batch, question/starts); the searches of `reduction` were a
#    fifth slower with it, for numbers that are stored and loaded at different widths wait for each other.
# PRIVATE, all of it: users of the library choose their own compiler flags, and the public headers' arithmetic is not the
# library's.
function(lorentz_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -fno-fast-math -ffp-contract=off -Wall -Wextra -Wpedantic
    # GCC 12 sees overlaps in std::string operator+ that are not there (GCC bug 105651), and, where headers are precompiled,
    # overflows.
    "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize;-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>"
    # GCC frees its own memory from half a GiB on: a tenth of the time.
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
  # Headers are named by their path from the root: "oracle/exact/quadratic.hpp"; public ones <lorentz/oracle.hpp>.
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
endfunction()

# The standard headers that most sources here include, read once for all of them, and the same with fmt: half of the time
# to compile a small source. Any level of optimisation but none may use them.
set(LORENTZ_STANDARD_HEADERS <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <optional> <set> <sstream> <string> <string_view> <utility> <variant> <vector>)
file(WRITE ${PROJECT_BINARY_DIR}/headers.cpp "")
function(lorentz_headers name)  # and headers besides; what it links has to be added
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/headers.cpp)
  lorentz_settings(${name})
  target_precompile_headers(${name} PRIVATE ${LORENTZ_STANDARD_HEADERS} ${ARGN})
endfunction()
lorentz_headers(lorentz_headers)
function(lorentz_headers_with_fmt)
  lorentz_headers(lorentz_headers_of_fmt <fmt/format.h>)
  target_link_libraries(lorentz_headers_of_fmt PRIVATE fmt::fmt)
endfunction()

# lorentz_library(NAME SOURCES .. [PUBLIC targets] [PRIVATE targets] [SYSTEM folders of header-only libraries]
#   [FAST] engines, the oracle's searches, readers: each source by itself, optimised as far as it goes
#   [PLAIN] commands, reports, families of cases: hardly optimised, because others take their time)
# The sources of the others are compiled several at a time, which takes half of the time: most of that goes into headers and
# the templates that they have in common. An unnamed namespace of one source is seen by the next:
# tests/house/together_test.py refuses what could mean something else there. -DLORENTZ_UNITY=OFF compiles each by itself; CI
# does so with clang, so that each includes what it uses.
option(LORENTZ_UNITY "compile several sources of a library at once" ON)
option(LORENTZ_HASTY "compile in half of the time, for a program that takes a tenth more" OFF)
function(lorentz_library name)
  cmake_parse_arguments(PARSE_ARGV 1 its "FAST;PLAIN" "" "SOURCES;PUBLIC;PRIVATE;SYSTEM")
  set(kind STATIC)
  if(LORENTZ_SHARED)
    set(kind SHARED)
  endif()
  add_library(${name} ${kind} ${its_SOURCES})
  lorentz_settings(${name})
  if(LORENTZ_HASTY)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O$<IF:$<BOOL:${its_FAST}>,1,g>>)
  elseif(NOT its_FAST)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O$<IF:$<BOOL:${its_PLAIN}>,1,2>>)
  endif()
  if(LORENTZ_UNITY AND NOT its_FAST)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    # GCC takes what is included for a header, whose unnamed namespace would be another one in each source.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  set(headers lorentz_headers)
  if("fmt::fmt" IN_LIST its_PUBLIC OR "fmt::fmt" IN_LIST its_PRIVATE)
    set(headers lorentz_headers_of_fmt)
  endif()
  target_include_directories(${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_include_directories(${name} SYSTEM PRIVATE ${its_SYSTEM})
  target_link_libraries(${name} PUBLIC ${its_PUBLIC} PRIVATE ${its_PRIVATE})
  string(REPLACE "lorentz_" "" short ${name})
  # Before 1.0 a minor version may change the interface (docs/packages.md).
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${short} PRECOMPILE_HEADERS_REUSE_FROM ${headers})
  add_library(lorentz::${short} ALIAS ${name})
endfunction()

# What arranges work and does none itself.
function(lorentz_arranges target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O$<IF:$<BOOL:${LORENTZ_HASTY}>,g,1>>)
endfunction()

# A library of which one source, STEM_mpi.cpp, uses MPI, or is STEM_none.cpp in a program without it.
macro(lorentz_mpi_sources target stem)
  if(LORENTZ_MPI)
    find_package(MPI REQUIRED COMPONENTS CXX)
    find_package(Boost 1.74 REQUIRED COMPONENTS mpi serialization)
    target_sources(${target} PRIVATE ${stem}_mpi.cpp)
    target_link_libraries(${target} PRIVATE Boost::mpi Boost::serialization MPI::MPI_CXX)
  else()
    target_sources(${target} PRIVATE ${stem}_none.cpp)
  endif()
endmacro()
