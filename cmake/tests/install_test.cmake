# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Installs into a stage, moves the installation elsewhere, and uses it from there: the program, a module of an engine, a
# reader of results, a program with the in-house engine, the Python package.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
execute_process(COMMAND mktemp -d OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE)
foreach(name RIGOR_ADAPTER_PATH RIGOR_SCENARIOS RIGOR_PROGRAM)
    unset(ENV{${name}})
endforeach()

set(ENV{DESTDIR} ${folder}/stage)
file(GLOB modules ${BUILD}/bin/adapters/rigor_adapter_*.so)
set(components program engine development)
foreach(module ${modules})
    string(REGEX REPLACE ".*/rigor_adapter_([a-z0-9_]+).*" "\\1" engine ${module})
    list(APPEND components adapters-${engine})
endforeach()
list(REMOVE_ITEM components adapters-rigor)
if(PYTHON)
    list(APPEND components python)
endif()
list(REMOVE_DUPLICATES components)
foreach(component ${components})
    run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix /opt/rigor)
endforeach()
unset(ENV{DESTDIR})
set(prefix ${folder}/moved)
file(RENAME ${folder}/stage/opt/rigor ${prefix})

# No file names a folder of the build or of the sources. A library may name the header in which a check has failed, but no
# folder in which programs look for files.
execute_process(COMMAND grep -rlIF -e ${BUILD} -e ${SOURCE} ${prefix} OUTPUT_VARIABLE named)
execute_process(
    COMMAND grep -rlF -e ${BUILD} -e ${SOURCE}/scenarios -e ${SOURCE}/adapters -e ${SOURCE}/reports -e ${SOURCE}/validation
            ${prefix}
    OUTPUT_VARIABLE looked)
string(APPEND named "${looked}")
if(named)
    message(FATAL_ERROR "these files name folders of the build or of the sources:\n${named}")
endif()

foreach(name scenario suite study collision)
    file(READ ${prefix}/share/rigor/schema/${name}.schema.json schema)
    string(JSON id GET "${schema}" $id)
    if(NOT id MATCHES "^urn:rigor:schema:${name}:[0-9]+$")
        message(FATAL_ERROR "the schema of ${name} has the $id '${id}'")
    endif()
endforeach()

set(rigor ${prefix}/bin/rigor)
run(${rigor} list scenarios)
expect("free_flight_2d" "list scenarios")
run(${rigor} list engines)
foreach(module ${modules})
    string(REGEX REPLACE ".*/rigor_adapter_([a-z0-9_]+).*" "\\1" engine ${module})
    expect("\n${engine} " "list engines")
endforeach()
run(${rigor} validate smoke --no-audit -j 2 --out ${folder}/run)
expect("Replay: rigor view" "the report of an installed program")
run(${prefix}/bin/rigor-validate check free_flight)

# An engine of one's own, as `rigor new engine` writes it, against the installed interface; then the kit.
run(${rigor} new engine mine --language cpp --folder ${folder}/mine)
set(outside -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} -S ${folder}/mine -B ${folder}/mine/build ${outside})
run(${CMAKE_COMMAND} --build ${folder}/mine/build)
set(ENV{RIGOR_ADAPTER_PATH} ${folder}/mine/build)
file(WRITE ${folder}/flight.json [[{"rigor": 1, "name": "flight", "title": "A thrown ball", "dimension": 3,
  "isolates": ["integrator"], "source": "Galilei 1638", "gravity": [0, -9.81, 0], "duration": 0.5, "dt": [0.0078125],
  "materials": {"steel": {"friction": 0.1, "restitution": 0.5}},
  "bodies": [{"name": "ball", "mass": 2, "position": [1, 2, 3], "velocity": [4, 5, -6], "collides": false,
    "shapes": [{"sphere": {"radius": 0.1}}]}],
  "observe": ["ball"], "reference": {"free_flight": {"body": "ball"}}, "metrics": ["scheme_position_max"],
  "accept": {"*": {"scheme_position_max": 1e-11}}}]])
run(${rigor} run ${folder}/flight.json --engine mine)
if(EXISTS ${prefix}/lib/rigor/conformance_test)
    run(${rigor} conform mine --only description,motion)
endif()
unset(ENV{RIGOR_ADAPTER_PATH})

# The reader of results, on the run above: as many cases as its table of results has rows.
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/results_reader -B ${folder}/reader ${outside})
run(${CMAKE_COMMAND} --build ${folder}/reader)
run(${folder}/reader/results_reader ${folder}/run)
string(STRIP "${output}" cases)
if(NOT cases MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "the reader printed '${cases}', expected a number of cases")
endif()

run(${CMAKE_COMMAND} -S ${SOURCE}/engine/package/tests/program -B ${folder}/drop ${outside})
run(${CMAKE_COMMAND} --build ${folder}/drop)
run(${folder}/drop/drop)
expect("height 0\\.5000" "a program with the engine")

if(PYTHON)
    file(GLOB packages ${prefix}/lib/python3*/dist-packages)
    set(ENV{PYTHONPATH} ${packages})
    set(ENV{PATH} ${prefix}/bin:$ENV{PATH})
    run(${PYTHON} -c "import rigor\nprint(len(rigor.open('${folder}/run').cases), rigor.find_program())")
    expect("^${cases} ${rigor}" "the Python package")
endif()
file(REMOVE_RECURSE ${folder})
