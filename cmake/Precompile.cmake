# Precompiled headers of libraries, which are then parsed once for each target and not for each source file.
# Headers of this project are excluded. A source file must still include what it uses; a build with
# SINEW_PRECOMPILE off proves this.
option(SINEW_PRECOMPILE "Precompile the headers of libraries" ${PROJECT_IS_TOP_LEVEL})

# Warnings of GCC 12 about the inside of std::string (its bugs 105329, 105651), once it no longer counts as a
# system header.
set(SINEW_PRECOMPILED_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow>)

# sinew_precompile(<target> <header>...): precompiles these headers for a target.
function(sinew_precompile target)
    if(SINEW_PRECOMPILE)
        list(TRANSFORM ARGN REPLACE "(.+)" "<\\1>")
        target_precompile_headers(${target} PRIVATE ${ARGN})
        target_compile_options(${target} PRIVATE ${SINEW_PRECOMPILED_OPTIONS})
    endif()
endfunction()

# sinew_precompile_as(<target> <other>): reuses the precompiled headers of a target with equal flags.
function(sinew_precompile_as target other)
    if(SINEW_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM ${other})
        target_compile_options(${target} PRIVATE ${SINEW_PRECOMPILED_OPTIONS})
    endif()
endfunction()

# Groups of files that use the same library templates are compiled as one. Their template code (mainly JSON)
# is instantiated and optimised once, and headers are parsed once. An edit then recompiles its group. Off
# compiles every file alone.
option(SINEW_TOGETHER "Compile groups of files together" ON)

# sinew_compile_together(<target> <group> <files>...): no two files of a group may define the same file-local
# name.
function(sinew_compile_together target group)
    if(SINEW_TOGETHER)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
        set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
    endif()
endfunction()
