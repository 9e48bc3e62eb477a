# Configures Sinew as a part of another build, and looks for what that must not need.
#   cmake -DHOST_CMAKE=<cmake of the host> -DFOLDER=<build folder> -DPART=<host's sources> -DFETCHES=<by FetchContent>
#       -DSINEW_FOLDER=<sources> -DCOMPILER=<c++> -P as_a_part.cmake
file(REMOVE_RECURSE ${FOLDER})
execute_process(
    COMMAND ${HOST_CMAKE} -S ${PART} -B ${FOLDER} -G Ninja -DFETCHES=${FETCHES} -DSINEW_FOLDER=${SINEW_FOLDER}
            -DCMAKE_CXX_COMPILER=${COMPILER}
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "a build that has Sinew as a part cannot be configured:\n${output}")
endif()
file(STRINGS ${FOLDER}/build.ninja compiled REGEX "glslangValidator" LIMIT_COUNT 1)
file(STRINGS ${FOLDER}/build.ninja checked REGEX "spirv-val" LIMIT_COUNT 1)
if(NOT compiled)
    message(FATAL_ERROR "no kernel is compiled")
endif()
if(checked)
    message(FATAL_ERROR "kernels are checked with spirv-val, which a host need not have: ${checked}")
endif()
