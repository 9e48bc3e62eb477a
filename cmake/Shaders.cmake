# Compiles GLSL to SPIR-V 1.5 and embeds it as arrays in a library.
#
#   add_kernels(<target> NAMESPACE <c++ namespace> HEADER <name.hpp> SOURCES <files...> [VARIANTS <lines...>])
#
# compiles every file for Vulkan 1.2, runs spirv-val on it (SINEW_CHECK_KERNELS) and adds one `const
# vk::ShaderCode` for each file to <target>: solve_distance.comp becomes <namespace>::solveDistance, skin.vert
# becomes <namespace>::skinVert.
#
# A release archive has the compiled kernels in kernels/<target> (cmake/Archive.cmake). They are used, and glslang is not
# needed, unless shader files or the list of kernels have changed since.
option(SINEW_CHECK_KERNELS "Run spirv-val on every kernel that is compiled" ${PROJECT_IS_TOP_LEVEL})
set(SINEW_SHIPPED_KERNELS ${PROJECT_SOURCE_DIR}/kernels)
include(${CMAKE_CURRENT_LIST_DIR}/HashShaders.cmake)
if(EXISTS ${SINEW_SHIPPED_KERNELS}/sources.sha256)
    file(STRINGS ${SINEW_SHIPPED_KERNELS}/sources.sha256 shipped)
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/glsl/*)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shaders})
    sinew_hash_shaders(hash ${PROJECT_SOURCE_DIR}/shaders/glsl)
    if(NOT shipped STREQUAL hash)
        message(STATUS "Shader files differ from those of the compiled kernels in ${SINEW_SHIPPED_KERNELS}: kernels are compiled anew")
        unset(SINEW_SHIPPED_KERNELS)
    endif()
else()
    unset(SINEW_SHIPPED_KERNELS)
endif()
set(SINEW_SHADER_INCLUDE ${PROJECT_SOURCE_DIR}/shaders/glsl)
set(SINEW_EMBED ${CMAKE_CURRENT_LIST_DIR}/EmbedShader.cmake)

function(sinew_camel_case out text)
    string(REPLACE "_" ";" words ${text})
    list(POP_FRONT words result)
    foreach(word IN LISTS words)
        string(SUBSTRING ${word} 0 1 head)
        string(SUBSTRING ${word} 1 -1 tail)
        string(TOUPPER ${head} head)
        string(APPEND result ${head}${tail})
    endforeach()
    set(${out} ${result} PARENT_SCOPE)
endfunction()

# A variant is one line, "name: file [MACRO...]": the file compiled under this name with these macros defined.
# A second header, all_<name.hpp>, lists all kernels as <namespace>::all.
function(add_kernels target)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "" "NAMESPACE;HEADER" "SOURCES;VARIANTS")
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernels)
    file(MAKE_DIRECTORY ${folder})
    string(REPLACE "${PROJECT_SOURCE_DIR}/" "" list "${ARG_SOURCES};${ARG_VARIANTS}")
    string(SHA256 list "${list}")
    set(shipped "")
    if(SINEW_SHIPPED_KERNELS AND EXISTS ${SINEW_SHIPPED_KERNELS}/${target}/list.sha256)
        file(STRINGS ${SINEW_SHIPPED_KERNELS}/${target}/list.sha256 shipped)
    endif()
    if(NOT shipped STREQUAL list)
        find_program(GLSLANG glslangValidator REQUIRED)
        if(SINEW_CHECK_KERNELS)
            find_program(SPIRV_VAL spirv-val REQUIRED)
        endif()
    endif()
    set(declarations "")
    set(all "")
    set(embeddings "")
    set(modules "")
    foreach(entry IN LISTS ARG_SOURCES ARG_VARIANTS)
        if(entry MATCHES "^([a-z0-9_]+): +([^ ]+) *(.*)$")
            set(source ${CMAKE_MATCH_2})
            set(stem ${CMAKE_MATCH_1})
            string(REGEX REPLACE "([^ ]+)" "-D\\1" macros "${CMAKE_MATCH_3}")
            separate_arguments(macros)
        else()
            set(source ${entry})
            cmake_path(GET source STEM stem)
            set(macros "")
        endif()
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
        cmake_path(GET source EXTENSION stage)
        sinew_camel_case(identifier ${stem})
        if(stage STREQUAL ".vert")
            string(APPEND identifier Vert)
        elseif(stage STREQUAL ".frag")
            string(APPEND identifier Frag)
        endif()
        set(spirv ${folder}/${stem}${stage}.spv)
        if(shipped STREQUAL list)
            set(spirv ${SINEW_SHIPPED_KERNELS}/${target}/${stem}${stage}.spv)
        endif()
        list(APPEND modules ${spirv})
        set(embedded ${folder}/${stem}${stage}.cpp)
        if(NOT shipped STREQUAL list)
            set(check "")
            if(SINEW_CHECK_KERNELS)
                set(check COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${spirv})
            endif()
            add_custom_command(
                OUTPUT ${spirv}
                COMMAND ${GLSLANG} --quiet -V --target-env vulkan1.2 ${macros} -I${SINEW_SHADER_INCLUDE} --depfile ${spirv}.d -o ${spirv} ${source}
                ${check}
                DEPENDS ${source}
                DEPFILE ${spirv}.d
                COMMENT "Kernel ${stem}${stage}"
                VERBATIM)
        endif()
        add_custom_command(
            OUTPUT ${embedded}
            COMMAND ${CMAKE_COMMAND} -DSPIRV=${spirv} -DOUTPUT=${embedded} -DNAMESPACE=${ARG_NAMESPACE}
                    -DIDENTIFIER=${identifier} -DNAME=${stem} -P ${SINEW_EMBED}
            DEPENDS ${spirv} ${SINEW_EMBED}
            VERBATIM)
        target_sources(${target} PRIVATE ${embedded})
        list(LENGTH embeddings count)
        list(APPEND embeddings ${embedded})
        math(EXPR group "${count} / 16")
        sinew_compile_together(${target} kernels_${group} ${embedded})
        string(APPEND declarations "extern const vk::ShaderCode ${identifier};\n")
        string(APPEND all "    &${identifier},\n")
    endforeach()
    if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests") # for a release archive
        add_custom_target(${target}_kernels DEPENDS ${modules})
        set_property(GLOBAL APPEND PROPERTY SINEW_KERNEL_TARGETS ${target})
        list(GET modules 0 module)
        cmake_path(GET module PARENT_PATH module_folder)
        set_target_properties(${target}_kernels PROPERTIES SINEW_FOLDER ${module_folder} SINEW_LIST ${list})
    endif()
    # Files of kernels that no longer exist are deleted: a test reads the whole folder.
    file(GLOB files ${folder}/*.spv ${folder}/*.spv.d ${folder}/*.comp.cpp)
    foreach(file IN LISTS files)
        string(REGEX REPLACE "([.]spv|[.]spv[.]d|[.]cpp)$" ".cpp" embedded ${file})
        if(NOT embedded IN_LIST embeddings)
            file(REMOVE ${file})
        endif()
    endforeach()
    file(CONFIGURE OUTPUT ${folder}/${ARG_HEADER} @ONLY CONTENT
"// Generated from the shader files by cmake/Shaders.cmake.
#pragma once

#include \"sinew/vk/shader_code.hpp\"

namespace @ARG_NAMESPACE@ {
namespace vk = ::sinew::vk;
@declarations@} // namespace @ARG_NAMESPACE@
")
    file(CONFIGURE OUTPUT ${folder}/all_${ARG_HEADER} @ONLY CONTENT
"// Generated from the shader files by cmake/Shaders.cmake.
#pragma once

#include \"@ARG_HEADER@\"

namespace @ARG_NAMESPACE@ {
inline constexpr const vk::ShaderCode* all[] = {
@all@};
} // namespace @ARG_NAMESPACE@
")
    if(PROJECT_IS_TOP_LEVEL) # tests read kernels, a host does not
        target_include_directories(${target} PUBLIC ${folder})
    else()
        target_include_directories(${target} PRIVATE ${folder})
    endif()
endfunction()
