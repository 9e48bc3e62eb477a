# Configures Sinew as a part of another build with strict flags, and looks for what that must not need. Where BUILDS is set, a
# file of the host and of Sinew are compiled with them.
#   cmake -DHOST_CMAKE=<cmake of the host> -DFOLDER=<build folder> -DPART=<host's sources> -DFETCHES=<by FetchContent>
#       -DSINEW_FOLDER=<sources> -DCOMPILER=<c++> [-DBUILDS=ON] -P as_a_part.cmake
file(REMOVE_RECURSE ${FOLDER})
execute_process(
    COMMAND ${HOST_CMAKE} -S ${PART} -B ${FOLDER} -G Ninja -DFETCHES=${FETCHES} -DSINEW_FOLDER=${SINEW_FOLDER}
            -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Werror"
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
if(BUILDS)
    execute_process(
        COMMAND ${HOST_CMAKE} --build ${FOLDER} --target host sinew_vk
        RESULT_VARIABLE result
        OUTPUT_VARIABLE output
        ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "a host that has Sinew as a part cannot be built with its own flags:\n${output}")
    endif()
endif()
