# Fails if the text of a library is larger than a limit.
#   cmake -DSIZE=<size> -DLIBRARY=<library> -DMOST=<bytes> -P text_size.cmake
execute_process(COMMAND ${SIZE} -B ${LIBRARY} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0 OR NOT output MATCHES "\n *([0-9]+)")
    message(FATAL_ERROR "the size of ${LIBRARY} cannot be read:\n${output}")
endif()
if(CMAKE_MATCH_1 GREATER MOST)
    message(FATAL_ERROR "${LIBRARY} has ${CMAKE_MATCH_1} bytes of text, ${MOST} are allowed")
endif()
message(STATUS "${CMAKE_MATCH_1} bytes of text of ${MOST}")
