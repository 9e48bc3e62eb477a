# Headers of libraries, parsed once for each target in place of once for each source file. Ours are not among them: a
# source file still includes what it uses, which a build with SINEW_PRECOMPILE off proves.
option(SINEW_PRECOMPILE "Precompile the headers of libraries" ${PROJECT_IS_TOP_LEVEL})

# What GCC 12 says of the inside of std::string (its bugs 105329, 105651) once it no longer counts as a system header.
set(SINEW_PRECOMPILED_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow>)

# sinew_precompile(<target> <header>...)
function(sinew_precompile target)
    if(SINEW_PRECOMPILE)
        list(TRANSFORM ARGN REPLACE "(.+)" "<\\1>")
        target_precompile_headers(${target} PRIVATE ${ARGN})
        target_compile_options(${target} PRIVATE ${SINEW_PRECOMPILED_OPTIONS})
    endif()
endfunction()

# sinew_precompile_as(<target> <other target, of the same flags>)
function(sinew_precompile_as target other)
    if(SINEW_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM ${other})
        target_compile_options(${target} PRIVATE ${SINEW_PRECOMPILED_OPTIONS})
    endif()
endfunction()

# Files that use the same templates of libraries, compiled as one: what each would instantiate and optimise for itself (JSON
# above all) is done once, and headers are parsed once. An edit then costs its group. Off, every file stands alone.
option(SINEW_TOGETHER "Compile groups of files together" ON)

# sinew_compile_together(<target> <group> <files, of which no two define one name for themselves>...)
function(sinew_compile_together target group)
    if(SINEW_TOGETHER)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
        set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
    endif()
endfunction()
