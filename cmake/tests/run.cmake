# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# run(<command>...) runs a command, which must end with 0, and puts what it prints into `output`.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE error)
    if(NOT code EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nended with ${code}:\n${out}\n${error}")
    endif()
    set(output "${out}" PARENT_SCOPE)
endfunction()

# expect(<regular expression> <what it is of>): `output` must match.
function(expect pattern what)
    if(NOT output MATCHES "${pattern}")
        message(FATAL_ERROR "${what}: nothing like '${pattern}' in\n${output}")
    endif()
endfunction()
