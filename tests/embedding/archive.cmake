# Makes a release archive, configures it with its defaults, and builds the core of it as a shared library, while no program
# named like those of glslang or of SPIRV-Tools can be found. Its kernels must be those of this build, and its symbols those
# of the public headers. With glslang it is also configured with tests and examples.
#   cmake -DBUILD=<build folder> -DFOLDER=<folder to use> -DTYPE=<CMAKE_BUILD_TYPE> -DLAUNCHER=<CMAKE_CXX_COMPILER_LAUNCHER>
#       -DPYTHON=<python3> -P archive.cmake
# with the variables of steps.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
file(REMOVE_RECURSE ${FOLDER})
step("the archive cannot be made" ${CMAKE_COMMAND} --build ${BUILD} --target archive)
set(archive ${BUILD}/archive/sinew-${VERSION}.tar.gz)
file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${FOLDER})
set(sources ${FOLDER}/sinew-${VERSION})

# PATH becomes a folder with links to all other programs.
set(programs ${FOLDER}/programs)
file(MAKE_DIRECTORY ${programs})
string(REPLACE ":" ";" folders "$ENV{PATH}")
foreach(folder IN LISTS folders)
    file(GLOB files ${folder}/[A-Za-z0-9]*)
    list(FILTER files EXCLUDE REGEX "/(glslang|spirv-)[^/]*$")
    foreach(file IN LISTS files)
        cmake_path(GET file FILENAME name)
        if(NOT EXISTS ${programs}/${name})
            file(CREATE_LINK ${file} ${programs}/${name} SYMBOLIC)
        endif()
    endforeach()
endforeach()
set(all_programs $ENV{PATH})
set(ENV{PATH} ${programs})
set(hidden -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF) # else CMake also looks into /usr/bin
set(machine -G Ninja -DCMAKE_MAKE_PROGRAM=${programs}/ninja -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_BUILD_TYPE=${TYPE} -DVULKAN_HEADERS=${VULKAN})
set(options ${hidden} ${machine} -DSINEW_BUILD_APPS=OFF)

step("the archive cannot be configured without glslang"
    ${HOST_CMAKE} -S ${sources} -B ${FOLDER}/build ${options} -DBUILD_SHARED_LIBS=ON)
step("the archive cannot be built without glslang" ${HOST_CMAKE} --build ${FOLDER}/build -j2)

# The defaults, with the programs. Libraries are found in the folders of the system, and no program in them.
file(WRITE ${FOLDER}/hidden.cmake "set(CMAKE_IGNORE_PATH \"${folders}\" CACHE STRING \"\")\n")
step("the archive cannot be configured with its defaults, without glslang"
    ${HOST_CMAKE} -C ${FOLDER}/hidden.cmake -S ${sources} -B ${FOLDER}/defaults ${machine})
step("the targets of the archive cannot be listed" ${HOST_CMAKE} --build ${FOLDER}/defaults --target help)
file(STRINGS ${FOLDER}/defaults/CMakeCache.txt looked REGEX "^GLSLANG:")
if(NOT step_output MATCHES "sinew-viewer: phony" OR looked)
    message(FATAL_ERROR "by default the archive must build the programs, from its kernels:\n${step_output}")
endif()
set(ENV{PATH} ${all_programs})
step("the archive cannot be configured with its tests" ${HOST_CMAKE} -S ${sources} -B ${FOLDER}/tests ${machine} -DSINEW_BUILD_TESTS=ON)
step("the targets of the archive cannot be listed" ${HOST_CMAKE} --build ${FOLDER}/tests --target help)
if(NOT step_output MATCHES "test_vk: phony" OR NOT step_output MATCHES "example_game: phony")
    message(FATAL_ERROR "the archive must hold tests and examples:\n${step_output}")
endif()
set(ENV{PATH} ${programs})

# A changed shader is not taken from the archive: without glslang there is no way to build it.
file(APPEND ${sources}/shaders/glsl/solvers/predict.comp "// changed\n")
execute_process(COMMAND ${HOST_CMAKE} -S ${sources} -B ${FOLDER}/changed ${options} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(result EQUAL 0 OR NOT output MATCHES "kernels are compiled anew" OR NOT output MATCHES "GLSLANG")
    message(FATAL_ERROR "a changed shader must need glslang:\n${output}")
endif()
set(ENV{PATH} ${all_programs})

# The same kernels, as compiled and as embedded.
file(GLOB expected RELATIVE ${BUILD}/src/sim/sinew_sim_kernels ${BUILD}/src/sim/sinew_sim_kernels/*.spv)
file(GLOB shipped RELATIVE ${sources}/kernels/sinew_sim ${sources}/kernels/sinew_sim/*.spv)
list(LENGTH expected count)
if(count LESS 100 OR NOT expected STREQUAL shipped)
    message(FATAL_ERROR "the archive has other kernels than the ${count} of this build")
endif()
foreach(name IN LISTS expected)
    string(REGEX REPLACE "spv$" "cpp" source ${name})
    foreach(pair "${BUILD}/src/sim/sinew_sim_kernels/${name};${sources}/kernels/sinew_sim/${name}"
                 "${BUILD}/src/sim/sinew_sim_kernels/${source};${FOLDER}/build/src/sim/sinew_sim_kernels/${source}")
        list(GET pair 0 first)
        list(GET pair 1 second)
        file(SHA256 ${first} one)
        file(SHA256 ${second} other)
        if(NOT one STREQUAL other)
            message(FATAL_ERROR "${second} is not ${first}")
        endif()
    endforeach()
endforeach()
message(STATUS "${count} kernels are those of this build")

# The shared libraries: their symbols, their names, and programs that use them.
install_moved(${FOLDER}/build ${FOLDER}/prefix core)
file(GLOB_RECURSE libraries ${FOLDER}/prefix/libsinew*.so)
step("the symbols are not those of the public headers" ${PYTHON} ${SINEW_FOLDER}/tests/embedding/check_symbols.py
    ${FOLDER}/prefix/include ${libraries})
message(STATUS "${step_output}")
use_by_cmake(${FOLDER}/prefix ${FOLDER}/cmake)
use_by_pkg_config(${FOLDER}/prefix ${FOLDER}/pkg_config)
string(REGEX REPLACE "[.][0-9]+$" "" abi ${VERSION})
foreach(program cmake/build/consumer pkg_config/program)
    step("the program has no dynamic section" readelf -d ${FOLDER}/${program})
    if(NOT step_output MATCHES "NEEDED[^\n]*libsinew[.]so[.]${abi}\\]" OR step_output MATCHES "libvulkan")
        message(FATAL_ERROR "${program} must need libsinew.so.${abi} and no Vulkan loader:\n${step_output}")
    endif()
endforeach()
