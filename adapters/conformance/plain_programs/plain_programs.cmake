# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# rigor_plain_programs(engine library...): the scenes of plain_programs/<engine>/*.cpp as one test,
# plain_programs_<engine>, that loads the engine's module as the harness does. Called by the adapter's folder, so that
# an engine without its library has none.
function(rigor_plain_programs engine)
    file(GLOB programs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/adapters/conformance/plain_programs/${engine}/*.cpp)
    if(NOT RIGOR_TESTS OR NOT programs)
        return()
    endif()
    rigor_test(plain_programs_${engine} SOURCES ${programs} LIBS rigor_adapter_interface rigor_scenarios ${ARGN})
    # Their scenes free nothing, as the programs of the manuals do not.
    set_tests_properties(plain_programs_${engine} PROPERTIES
        ENVIRONMENT "RIGOR_ADAPTER_PATH=${PROJECT_BINARY_DIR}/bin/adapters;ASAN_OPTIONS=detect_leaks=0" LABELS conformance)
    add_dependencies(plain_programs_${engine} rigor_adapter_${engine})
endfunction()
