# Installs the module by pip into a virtual environment, from the build folder of the tests, and runs tests of the module there.
#   cmake -DPYTHON=<python3> -DSINEW_FOLDER=<sources> -DBUILD=<build folder> -DFOLDER=<folder to use> -P pip.cmake
function(step complaint)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output WORKING_DIRECTORY ${FOLDER})
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${complaint} (${result}):\n${output}")
    endif()
endfunction()
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
step("there can be no virtual environment: install python3-venv" ${PYTHON} -m venv --system-site-packages ${FOLDER}/environment)
step("pip cannot install the module" ${FOLDER}/environment/bin/python -m pip install --no-index --no-build-isolation --no-deps
    --config-settings=build=${BUILD} ${SINEW_FOLDER})
step("the installed module fails" ${FOLDER}/environment/bin/python ${SINEW_FOLDER}/tests/python/test_sinew.py
    Module.test_links_hold_a_pendulum Module.test_files_and_descriptions Module.test_the_program_gives_reports)
