# mingw-w64 with POSIX threads, and the headers that tools/platforms.sh gathers. Programs need no library beside them.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_CXX_FLAGS_INIT -Wa,-mbig-obj) # groups of files that are compiled together have many sections
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
get_filename_component(SINEW_ROOT ${CMAKE_CURRENT_LIST_DIR}/../../build/windows-root ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${SINEW_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
