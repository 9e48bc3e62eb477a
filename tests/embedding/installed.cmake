# Installs the components core, mesh, scenes and c, moves the installation, and builds and runs a program that uses it from outside of the sources.
#   cmake -DBUILD=<build folder> -DFOLDER=<folder to use> -DWAY=<cmake | pkg_config> -P installed.cmake
# with the variables of steps.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
file(REMOVE_RECURSE ${FOLDER})
install_moved(${BUILD} ${FOLDER}/prefix core mesh scenes c)
foreach(header mesh/to_scene.hpp scenes/load.hpp sinew.h) # programs of a component that is missing are not built
    if(NOT EXISTS ${FOLDER}/prefix/include/sinew/${header})
        message(FATAL_ERROR "${header} is not installed")
    endif()
endforeach()
cmake_language(CALL use_by_${WAY} ${FOLDER}/prefix ${FOLDER}/${WAY})
