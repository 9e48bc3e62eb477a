# Functions of the scripts that test packages. They use the variables of these scripts: HOST_CMAKE (cmake of the host),
# COMPILER (c++), SINEW_FOLDER (sources), VULKAN (folder of vulkan/) and VERSION (of the package).
set(flags -fno-rtti -Wall -Wextra -Wconversion -Werror)

# step(<complaint> <command>...): runs a command, whose output becomes step_output, and fails with the complaint and the
# output if the command fails.
function(step complaint)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${complaint} (${result}):\n${output}")
    endif()
    set(step_output "${output}" PARENT_SCOPE)
endfunction()

# install_moved(<build folder> <folder> <component>...): installs into a folder, which is moved afterwards to <folder>:
# no file of the package may name the place where it was installed.
function(install_moved build folder)
    foreach(component IN LISTS ARGN)
        step("the component ${component} cannot be installed"
            ${CMAKE_COMMAND} --install ${build} --prefix ${folder}.first --component ${component})
    endforeach()
    file(RENAME ${folder}.first ${folder})
endfunction()

# copy_consumer(<folder>): the sources of a program that uses the package, with the example of the README.
function(copy_consumer folder)
    set(tests ${SINEW_FOLDER}/tests/embedding)
    file(COPY ${tests}/installed/ ${tests}/soft_bodies.hpp ${tests}/x11_macros.hpp ${tests}/part/host.cpp ${SINEW_FOLDER}/tests/capi/headless.c ${SINEW_FOLDER}/tests/capi/world.c DESTINATION ${folder})
endfunction()

# use_by_cmake(<prefix> <folder>): builds and runs a program with strict flags that finds the package by CMake.
function(use_by_cmake prefix folder)
    copy_consumer(${folder}/consumer)
    list(JOIN flags " " all)
    step("a program cannot be configured with the package"
        ${HOST_CMAKE} -S ${folder}/consumer -B ${folder}/build -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DVERSION=${VERSION}
        -DVULKAN_HEADERS=${VULKAN} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=${all}")
    step("a program cannot be built with the package" ${HOST_CMAKE} --build ${folder}/build)
    step("the program fails" ${folder}/build/consumer)
    message(STATUS "${step_output}")
    if(EXISTS ${prefix}/include/sinew/mesh)
        step("the program with a mesh fails" ${folder}/build/mesh)
        message(STATUS "${step_output}")
    endif()
    if(EXISTS ${prefix}/include/sinew/scenes)
        step("the program with scene files fails" ${folder}/build/scenes)
        message(STATUS "${step_output}")
    endif()
    if(EXISTS ${prefix}/include/sinew/sinew.h)
        foreach(program headless world)
            step("the program in C fails" ${folder}/build/${program})
            message(STATUS "${step_output}")
        endforeach()
    endif()
endfunction()

# use_by_pkg_config(<prefix> <folder>): the same by pkg-config and one call of the compiler.
function(use_by_pkg_config prefix folder)
    copy_consumer(${folder})
    file(GLOB_RECURSE description ${prefix}/sinew.pc)
    cmake_path(GET description PARENT_PATH descriptions)
    set(ENV{PKG_CONFIG_LIBDIR} ${descriptions})
    step("pkg-config knows another version" pkg-config --exact-version=${VERSION} sinew)
    step("pkg-config does not know the package" pkg-config --cflags --libs --static sinew-standalone)
    separate_arguments(found UNIX_COMMAND "${step_output}")
    cmake_path(GET descriptions PARENT_PATH libraries)
    step("a program cannot be built by pkg-config" ${COMPILER} -std=c++20 ${flags} -idirafter ${VULKAN}
        ${folder}/main.cpp ${folder}/host.cpp -o ${folder}/program ${found} -Wl,-rpath,${libraries})
    step("the program fails" ${folder}/program)
    message(STATUS "${step_output}")
    if(EXISTS ${prefix}/include/sinew/sinew.h)
        step("pkg-config does not know the C interface" pkg-config --cflags --libs --static sinew-c)
        separate_arguments(found UNIX_COMMAND "${step_output}")
        step("a program in C cannot be built by pkg-config" cc -std=c11 -Wall -Wextra -Wpedantic -Werror -idirafter ${VULKAN}
            ${folder}/headless.c -o ${folder}/headless ${found} -Wl,-rpath,${libraries})
        step("the program in C fails" ${folder}/headless)
        message(STATUS "${step_output}")
    endif()
endfunction()
