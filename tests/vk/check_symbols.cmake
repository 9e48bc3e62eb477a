# Checks that the core calls Vulkan only through its tables: an undefined vk* symbol would make it need a
# loader.
execute_process(COMMAND ${NM} --undefined-only ${LIBRARY} OUTPUT_VARIABLE symbols RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT symbols MATCHES "U memcpy")
    message(FATAL_ERROR "cannot list the symbols of ${LIBRARY}")
endif()
if(symbols MATCHES " U (vk[A-Z][A-Za-z0-9]*)")
    message(FATAL_ERROR "${LIBRARY} needs ${CMAKE_MATCH_1} from a loader")
endif()
