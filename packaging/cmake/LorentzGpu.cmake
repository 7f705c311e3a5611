# Which clang makes the kernels for graphics cards (docs/gpu.md), if any does: LORENTZ_GPU_COMPILER, LORENTZ_GPU_FLAGS.

# LORENTZ_GPU: AUTO looks for a clang that makes kernels, ON requires one, OFF builds none. Anything else is the compiler.
set(LORENTZ_GPU AUTO CACHE STRING "kernels for graphics cards, made by clang: AUTO, ON, OFF, or which clang")
set(LORENTZ_GPU_FLAGS -x cuda --cuda-device-only -nocudainc -nocudalib --cuda-gpu-arch=sm_70 -Xclang -target-feature
  -Xclang +ptx63 -Xclang -fcuda-allow-variadic-functions -Wno-unknown-cuda-version -std=c++20 -O3 -ffp-contract=off
  -fno-math-errno -mllvm -inline-threshold=20000 -I${PROJECT_SOURCE_DIR} -I${PROJECT_SOURCE_DIR}/include
  CACHE INTERNAL "")
function(lorentz_find_gpu_compiler)
  if(LORENTZ_GPU STREQUAL "OFF")
    return()
  endif()
  set(names ${LORENTZ_GPU})
  if(LORENTZ_GPU MATCHES "^(AUTO|ON)$")
    set(names clang-14 clang-16 clang-19 clang)
  endif()
  file(WRITE ${PROJECT_BINARY_DIR}/gpu_try.cpp "#include \"src/engines/gpu/device.hpp\"\n"
    "LORENTZ_KERNEL(attempt)(std::uint64_t* to) { lorentz::device::add(to, lorentz::device::thread()); }\n")
  foreach(name ${names})
    find_program(clang_here NAMES ${name} NO_CACHE)
    if(clang_here)
      execute_process(COMMAND ${clang_here} ${LORENTZ_GPU_FLAGS} -S -o ${PROJECT_BINARY_DIR}/gpu_try.ptx
        ${PROJECT_BINARY_DIR}/gpu_try.cpp RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
      if(NOT failed)
        set(LORENTZ_GPU_COMPILER ${clang_here} CACHE INTERNAL "")
        return()
      endif()
    endif()
    unset(clang_here)
  endforeach()
  if(NOT LORENTZ_GPU STREQUAL "AUTO")
    message(FATAL_ERROR "LORENTZ_GPU=${LORENTZ_GPU}: no clang here makes kernels; on Debian: apt install clang-14")
  endif()
endfunction()
if(NOT LORENTZ_GPU_COMPILER)
  lorentz_find_gpu_compiler()
endif()

# lorentz_kernels(TARGET FAMILY kernels.cpp): gives the target the function `gpu::FAMILY()`, the texts of the kernels in this
# source, a PTX file for each kind of scene. Unrolled loops pay where they keep objects in registers (docs/gpu.md).
function(lorentz_kernels target family source)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${family})
  file(MAKE_DIRECTORY ${folder})
  file(STRINGS ${PROJECT_SOURCE_DIR}/src/engines/gpu/kinds.inc kinds REGEX "^LORENTZ_KIND")
  set(texts "")
  set(files "")
  if(LORENTZ_GPU_COMPILER)
    foreach(kind ${kinds})
      string(REGEX REPLACE "^LORENTZ_KIND.([a-z_]+),.*" "\\1" name "${kind}")
      set(unroll 600)
      if(name MATCHES "_unit$")
        set(unroll 300)
      endif()
      set(file ${folder}/${name}.ptx)
      add_custom_command(OUTPUT ${file} DEPFILE ${file}.d
        COMMAND ${LORENTZ_GPU_COMPILER} ${LORENTZ_GPU_FLAGS} -mllvm -unroll-threshold=${unroll} "-DLORENTZ_ONE_KIND=${kind}"
          -MD -MF ${file}.d -MT ${file} -S -o ${file} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
        COMMENT "Kernel ${family} ${name}" VERBATIM)
      list(APPEND files ${file})
      string(APPEND texts "LORENTZ_TEXT(${name})\n")
    endforeach()
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/packaging/cmake/kernel_texts.cpp.in ${folder}.cpp @ONLY)
  set_source_files_properties(${folder}.cpp PROPERTIES OBJECT_DEPENDS "${files}" SKIP_UNITY_BUILD_INCLUSION ON
    SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${folder}.cpp)
endfunction()
