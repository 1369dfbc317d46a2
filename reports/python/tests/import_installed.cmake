# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Installs the component `python` of BUILD and imports it from there, away from the sources.
set(prefix ${BUILD}/tests/tmp/python_install_test)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component python --prefix ${prefix} RESULT_VARIABLE failed
                OUTPUT_QUIET)
if(failed)
    message(FATAL_ERROR "cmake --install failed")
endif()
set(program "import rigor
world = rigor.World(dimension=2)
world.add_body(mass=1, inertia=1)
world.step(60)
assert abs(world.states[0, 4] + 9.81) < 1e-9
assert rigor.__file__.startswith('${prefix}'), rigor.__file__
assert rigor.World('free_flight').bodies
")
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${prefix}/${FOLDER} PYTHONDONTWRITEBYTECODE=1 ${PYTHON} -c
                        "${program}" WORKING_DIRECTORY ${prefix} RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "the installed package cannot be imported or does not step")
endif()
