# The target `archive` makes sinew-<version>.tar.gz: all sources, those of tests and examples included, with the compiled
# kernels. With its defaults it builds without glslang: it leaves out tests and examples, whose own kernels need it.
get_property(targets GLOBAL PROPERTY SINEW_KERNEL_TARGETS)
set(lines "")
set(kernels "")
foreach(target IN LISTS targets)
    get_target_property(folder ${target}_kernels SINEW_FOLDER)
    get_target_property(list ${target}_kernels SINEW_LIST)
    string(APPEND lines "${target} ${list} ${folder}\n")
    list(APPEND kernels ${target}_kernels)
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/archive/kernels.txt CONTENT "${lines}" @ONLY)

set(CPACK_PACKAGE_VENDOR "Sinew")
set(CPACK_GENERATOR TGZ)
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Position based dynamics of soft bodies as Vulkan compute")
set(CPACK_SOURCE_PACKAGE_FILE_NAME sinew-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES "/__pycache__/")
set(CPACK_SOURCE_INSTALLED_DIRECTORIES ${PROJECT_BINARY_DIR}/archive/top .)
foreach(folder .ci apps cmake debian docs examples include packaging python scenes shaders src tests tools)
    list(APPEND CPACK_SOURCE_INSTALLED_DIRECTORIES ${PROJECT_SOURCE_DIR}/${folder} ${folder})
endforeach()
include(CPack)

add_custom_target(archive
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DLIST=${PROJECT_BINARY_DIR}/archive/kernels.txt
            -DOUTPUT=${PROJECT_BINARY_DIR}/archive/top -P ${CMAKE_CURRENT_LIST_DIR}/StageArchive.cmake
    COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackSourceConfig.cmake -B ${PROJECT_BINARY_DIR}/archive
    COMMENT "Release archive"
    VERBATIM)
add_dependencies(archive ${kernels})
