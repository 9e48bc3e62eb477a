# Configures Sinew as a part of another build with strict flags, and checks for things that it must not need.
# With BUILDS, compiles the host, a library of Sinew, and what reads scene files.
#   cmake -DHOST_CMAKE=<cmake of the host> -DFOLDER=<build folder> -DPART=<host's sources> -DFETCHES=<by FetchContent>
#       -DSINEW_FOLDER=<sources> -DCOMPILER=<c++> -DVULKAN=<folder of vulkan/> [-DBUILDS=ON] -P as_a_part.cmake
file(REMOVE_RECURSE ${FOLDER})
# The Vulkan headers lie in a folder that no compiler searches by default.
set(headers ${FOLDER}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(folder vulkan vk_video)
    file(CREATE_LINK ${VULKAN}/${folder} ${headers}/${folder} SYMBOLIC)
endforeach()
execute_process(
    COMMAND ${HOST_CMAKE} -S ${PART} -B ${FOLDER} -G Ninja -DFETCHES=${FETCHES} -DSINEW_FOLDER=${SINEW_FOLDER}
            -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug -DVULKAN_HEADERS=${headers} -DSINEW_BUILD_SCENES=${BUILDS} "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Werror"
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
file(STRINGS ${FOLDER}/build.ninja included REGEX "INCLUDES = .*${headers}")
list(LENGTH included count)
if(count LESS 10)
    message(FATAL_ERROR "VULKAN_HEADERS reaches ${count} files")
endif()
file(STRINGS ${FOLDER}/build.ninja together REGEX "unity_[0-9a-z_]+cxx.cxx.o: CXX_COMPILER" LIMIT_COUNT 1)
if(NOT together)
    message(FATAL_ERROR "sources are not compiled together, which doubles the time of a host's build")
endif()
if(checked)
    message(FATAL_ERROR "kernels are checked with spirv-val, which a host need not have: ${checked}")
endif()
if(BUILDS)
    execute_process(
        COMMAND ${HOST_CMAKE} --build ${FOLDER} --target host sinew_vk reader sinew_scenes
        RESULT_VARIABLE result
        OUTPUT_VARIABLE output
        ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "a host that has Sinew as a part cannot be built with its own flags:\n${output}")
    endif()
endif()
