# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Installs the engine into an empty folder, builds the program beside this file against that alone, in a
# temporary folder outside source and build trees, and runs it.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT code EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nended with ${code}:\n${out}")
    endif()
    set(output "${out}" PARENT_SCOPE)
endfunction()

execute_process(COMMAND mktemp -d OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE)
run(${CMAKE_COMMAND} --install ${BUILD} --component engine --prefix ${folder}/prefix)
file(COPY ${PROGRAM} DESTINATION ${folder})
run(${CMAKE_COMMAND} -S ${folder}/program -B ${folder}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${folder}/prefix)
run(${CMAKE_COMMAND} --build ${folder}/build)
run(${folder}/build/drop)
if(NOT output MATCHES "height 0\\.5000")
    message(FATAL_ERROR "the ball did not come to rest on the ground:\n${output}")
endif()
run(${folder}/build/inspect)
foreach(part "broad_phase" "box of body_1: " "pair body_1 body_2" "point of body_2 and body_3, separation "
        "iteration 1, residual [0-9.e-]+, normal impulses( [0-9.]+)+" "contact a=body_1 b=body_2 n=\\(0,1,0\\) depth="
        " jn=0\\.[0-9]+" "island body_2 body_3" "last residual ")
    if(NOT output MATCHES "${part}")
        message(FATAL_ERROR "nothing like '${part}' in what the step says of itself:\n${output}")
    endif()
endforeach()
file(REMOVE_RECURSE ${folder})
