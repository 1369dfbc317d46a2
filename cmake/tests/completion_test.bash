# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# bash completion_test.bash RIGOR RIGOR_VALIDATE: runs the completion function as bash would.
set -u
rigor=$1
failed=0

# completes FUNCTION PROGRAM WORD... : what the function offers for the last word, a name a line.
completes() {
    local program=$1
    shift
    COMP_WORDS=("$program" "$@")
    COMP_CWORD=$#
    COMPREPLY=()
    _rigor "$program" "${COMP_WORDS[$COMP_CWORD]}" "${COMP_WORDS[$((COMP_CWORD - 1))]}"
    printf '%s\n' "${COMPREPLY[@]}"
}
# offers NAME... -- WORD... : every NAME is among what completes the WORDs.
offers() {
    local names=() offered name
    while [[ $1 != -- ]]; do
        names+=("$1")
        shift
    done
    shift
    offered=$(completes "$rigor" "$@")
    for name in "${names[@]}"; do
        grep -qxF -e "$name" <<<"$offered" && continue
        echo "'rigor $*<TAB>' lacks '$name', it offers: ${offered//$'\n'/ }"
        failed=1
    done
}
# offers_only NAMES WORD... : the NAMES, with blanks between, and nothing else.
offers_only() {
    local names=$1 offered
    shift
    offered=$(completes "$rigor" "$@")
    [[ ${offered//$'\n'/ } == "$names" ]] && return
    echo "'rigor $*<TAB>' offers '${offered//$'\n'/ }', expected '$names'"
    failed=1
}

eval "$("$rigor" completion)" || exit 1
complete -p rigor rigor-validate >/dev/null || exit 1

offers validate view list -- ''
offers_only validate vali
offers_only 'engines' list eng
offers --engines --resume --out -- validate --
offers_only '--resume' validate --res
offers smoke standard -- validate ''
offers_only smoke validate smo
offers free_flight box_stack -- run ''
offers_only free_flight_2d run free_flight_2d
offers free_flight -- validate smoke --out folder free_fl
offers rigor -- run box_stack --engine ''
offers rigor -- run box_stack -e ''
offers_only rigor validate smoke --engines = rigo
offers_only ode,rigor validate --engines ode,rigo
offers_only 'auto cpu wall' bench --clock ''
offers iterations symptoms -- study ''
offers_only '' run box_stack --csv free
offers_only '' nothing ''

rigor=$2
offers validate compare -- ''
offers_only '' vie
exit $failed
