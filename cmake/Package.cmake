# The libraries as hosts use them, and their installation as a CMake package (docs/packages.md, "Install").
#
#   sinew_package(<component> <name> [STATIC] OUTPUT <file name> [MAP <symbols>] OBJECTS <targets...> [LINKS <targets...>])
#
# makes the library sinew::<name> of the objects of other targets, which are compiled once for it, for the
# programs and for the tests. BUILD_SHARED_LIBS is its kind, unless STATIC is given. A shared one exports the symbols of a
# version script, by default those of the C++ interface. With SINEW_INSTALL the component installs it.
option(SINEW_INSTALL "Make install rules" ${PROJECT_IS_TOP_LEVEL})
set(SINEW_ABI ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}) # before 1.0 a minor version may change interfaces
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/sinew.map @ONLY CONTENT
"SINEW_@SINEW_ABI@ {
    global: _ZN5sinew*; _ZNK5sinew*; _ZTIN5sinew*; _ZTSN5sinew*; _ZTVN5sinew*;
    local: *;
};
")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/sinew_c.map @ONLY CONTENT
"SINEW_C_@SINEW_ABI@ {
    global: sinew*;
    local: *;
};
")
set(SINEW_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)

function(sinew_package component name)
    cmake_parse_arguments(PARSE_ARGV 2 ARG "STATIC" "OUTPUT;MAP" "OBJECTS;LINKS")
    set(target sinew_package_${name})
    list(TRANSFORM ARG_OBJECTS REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
    set(kind STATIC)
    set(map ${PROJECT_BINARY_DIR}/sinew.map)
    if(ARG_MAP)
        set(map ${ARG_MAP})
    endif()
    if(BUILD_SHARED_LIBS AND NOT ARG_STATIC)
        set(kind SHARED)
    endif()
    add_library(${target} ${kind} ${ARG_OBJECTS})
    if(NOT TARGET sinew::${name}) # for our own programs that is a static library of the same objects
        add_library(sinew::${name} ALIAS ${target})
    endif()
    target_link_libraries(${target} PUBLIC ${ARG_LINKS})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${ARG_OUTPUT} EXPORT_NAME ${name} LINKER_LANGUAGE CXX
        ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/package LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/package)
    if(kind STREQUAL "SHARED")
        if(NOT ARG_MAP)
            target_compile_definitions(${target} INTERFACE SINEW_SHARED)
        endif()
        set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${SINEW_ABI})
        # Symbols get a version. Instances of the standard library's templates are not exported.
        target_link_options(${target} PRIVATE -Wl,--version-script=${map})
        set_target_properties(${target} PROPERTIES LINK_DEPENDS ${map})
    endif()
    if(NOT PROJECT_IS_TOP_LEVEL AND NOT SINEW_INSTALL) # an installed target must be built
        set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
    if(SINEW_INSTALL)
        install(TARGETS ${target} EXPORT sinew_${component} COMPONENT ${component})
    endif()
endfunction()

# Installs the export set of a component. The file that declares its targets is sinew_<component>.cmake.
function(sinew_install_component component)
    install(EXPORT sinew_${component} NAMESPACE sinew:: DESTINATION ${SINEW_PACKAGE_FOLDER} COMPONENT ${component})
endfunction()

# sinew_copy_headers(<to> <folder of sources> <names...>): copies of headers that include each other as hosts do, with
# `sinew` in front of such a folder.
function(sinew_copy_headers to folder)
    foreach(name IN LISTS ARGN)
        set(header ${PROJECT_SOURCE_DIR}/src/${folder}/${name}.hpp)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
        file(READ ${header} text)
        string(REGEX REPLACE "#include \"(mesh|scenes)/" "#include \"sinew/\\1/" text "${text}")
        file(GENERATE OUTPUT ${to}/sinew/${folder}/${name}.hpp CONTENT "${text}")
    endforeach()
endfunction()

# core: what an engine embeds, and `standalone`: the loader and the queue of programs without an engine.
sinew_package(core core OUTPUT sinew OBJECTS sinew_vk sinew_sim LINKS sinew_headers)
target_link_libraries(sinew_package_core PRIVATE Threads::Threads)
sinew_package(core standalone OUTPUT sinew_standalone OBJECTS sinew_standalone LINKS sinew_package_core)
target_link_libraries(sinew_package_standalone PRIVATE ${CMAKE_DL_LIBS})

if(SINEW_INSTALL)
    include(CMakePackageConfigHelpers)
    set_target_properties(sinew_headers PROPERTIES EXPORT_NAME headers)
    install(TARGETS sinew_headers EXPORT sinew_core COMPONENT core)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/sinew DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT core
        PATTERN sinew.h EXCLUDE PATTERN sinew_world.h EXCLUDE PATTERN sinew_query.h EXCLUDE PATTERN sinew_events.h EXCLUDE PATTERN sinew_motions.h EXCLUDE) # of the component c
    sinew_install_component(core)
    set(SINEW_SCENES_FOLDER ${CMAKE_INSTALL_DATADIR}/sinew/scenes)
    configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/sinewConfig.cmake.in ${PROJECT_BINARY_DIR}/sinewConfig.cmake
        INSTALL_DESTINATION ${SINEW_PACKAGE_FOLDER} PATH_VARS SINEW_SCENES_FOLDER NO_SET_AND_CHECK_MACRO)
    write_basic_package_version_file(${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake COMPATIBILITY SameMinorVersion)
    # Paths in the files of pkg-config are relative to these files.
    foreach(folder LIB INCLUDE) # a host may ask for absolute folders
        set(SINEW_PC_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}DIR}")
        if(IS_ABSOLUTE "${CMAKE_INSTALL_${folder}DIR}")
            set(SINEW_PC_${folder} "${CMAKE_INSTALL_${folder}DIR}")
        endif()
    endforeach()
    file(RELATIVE_PATH SINEW_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
    set(SINEW_CFLAGS "")
    if(BUILD_SHARED_LIBS)
        set(SINEW_CFLAGS " -DSINEW_SHARED")
    endif()
    foreach(name sinew sinew-standalone)
        configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
        install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT core)
    endforeach()
    install(FILES ${PROJECT_BINARY_DIR}/sinewConfig.cmake ${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake
        DESTINATION ${SINEW_PACKAGE_FOLDER} COMPONENT core)
endif()
