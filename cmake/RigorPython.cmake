# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# What the Python package finds on this machine; all of it is optional.
#     RIGOR_PYTHON           the interpreter (the system's, whose packages are those of the distribution)
#     RIGOR_PYTHON_RESULTS   it has numpy, pandas and h5py: the package is tested and installed
#     RIGOR_PYTHON_ENGINE    it has numpy, and pybind11 and the headers are there: the engine's module is built
#     RIGOR_PYTHON_MODULES   the folder of the build in which the package can be imported
find_program(RIGOR_PYTHON python3 HINTS /usr/bin DOC "Interpreter of the Python package")
set(RIGOR_PYTHON_MODULES ${PROJECT_BINARY_DIR}/python)

function(rigor_python_has result)
    set(${result} OFF PARENT_SCOPE)
    if(NOT RIGOR_PYTHON)
        return()
    endif()
    string(JOIN "," modules ${ARGN})
    execute_process(COMMAND ${RIGOR_PYTHON} -c "import ${modules}" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
        set(${result} ON PARENT_SCOPE)
    endif()
endfunction()

rigor_python_has(RIGOR_PYTHON_RESULTS numpy pandas h5py)
if(NOT RIGOR_PYTHON_RESULTS)
    message(STATUS "Python package: needs python3 with numpy, pandas and h5py (./rigor --with python), skipped")
endif()

rigor_python_has(RIGOR_PYTHON_NUMPY numpy)
set(RIGOR_PYTHON_ENGINE OFF)
if(RIGOR_PYTHON_NUMPY)
    set(Python_EXECUTABLE ${RIGOR_PYTHON})
    set(PYBIND11_FINDPYTHON ON)
    find_package(Python QUIET COMPONENTS Interpreter Development.Module)
    find_package(pybind11 2.10 QUIET CONFIG)
    if(Python_Development.Module_FOUND AND pybind11_FOUND)
        set(RIGOR_PYTHON_ENGINE ON)
    endif()
endif()
if(NOT RIGOR_PYTHON_ENGINE)
    message(STATUS "Engine from Python: needs pybind11 and the headers of python3 (./rigor --with python), skipped")
endif()
