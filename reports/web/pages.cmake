# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Included by reports/CMakeLists.txt: TypeScript to the bundles that are embedded in the program, and the tests of its parts.
find_program(RIGOR_NODE NAMES node nodejs REQUIRED DOC "Node.js, 18 or newer")
find_program(RIGOR_NPM npm REQUIRED DOC "npm, for the libraries of package-lock.json")

set(web ${CMAKE_CURRENT_LIST_DIR})
set(bundles ${CMAKE_CURRENT_BINARY_DIR}/web/bundles)
set(RIGOR_WEB_BUNDLES ${bundles}/report.js ${bundles}/report.css ${bundles}/live.js ${bundles}/live.css ${bundles}/history.js
                      ${bundles}/history.css ${bundles}/collide.js ${bundles}/collide.css
                      ${bundles}/solve.js ${bundles}/solve.css)

# All build folders share the libraries: installed once for each lock file, by one build at a time.
set(installed ${web}/node_modules/.package-lock.json)
add_custom_command(
    OUTPUT ${installed}
    COMMAND flock ${web}/package.json sh ${web}/install.sh ${RIGOR_NPM} ${installed}
    DEPENDS ${web}/package.json ${web}/package-lock.json ${web}/install.sh
    WORKING_DIRECTORY ${web}
    COMMENT "Installing the libraries of the pages"
    VERBATIM)

set(metrics ${PROJECT_SOURCE_DIR}/validation/metrics/metrics.def)  # titles and formulas of the glossary
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${web}/src/*.ts ${web}/src/*.css)
add_custom_command(
    OUTPUT ${RIGOR_WEB_BUNDLES}
    COMMAND ${RIGOR_NODE} build.mjs ${bundles}
    DEPENDS ${installed} ${sources} ${metrics} ${web}/build.mjs
    WORKING_DIRECTORY ${web}
    COMMENT "Bundling the pages"
    VERBATIM)

# The handbook (reports/handbook), by `./rigor docs`: not part of a build.
add_custom_target(
    docs
    COMMAND ${RIGOR_NODE} handbook.mjs ${PROJECT_BINARY_DIR}/handbook $<TARGET_FILE:rigor>
    DEPENDS ${installed}
    WORKING_DIRECTORY ${web}
    COMMENT "Writing the handbook"
    USES_TERMINAL
    VERBATIM)
add_dependencies(docs rigor_program)

if(NOT RIGOR_TESTS)
    return()
endif()

file(GLOB unit_tests CONFIGURE_DEPENDS RELATIVE ${web}/tests ${web}/tests/unit/*.test.ts)
file(GLOB browser_tests CONFIGURE_DEPENDS RELATIVE ${web}/tests ${web}/tests/browser/*.test.ts)
file(GLOB test_sources CONFIGURE_DEPENDS ${web}/tests/*.ts ${web}/tests/unit/*.ts ${web}/tests/browser/*.ts)
set(bundled_tests ${CMAKE_CURRENT_BINARY_DIR}/web/tests)
set(bundled_list)
foreach(test IN LISTS unit_tests browser_tests)
    string(REGEX REPLACE "\\.ts$" ".cjs" bundled ${bundled_tests}/${test})
    list(APPEND bundled_list ${bundled})
endforeach()
set(bundled_browser ${bundled_tests}/browser.cjs)  # all tests in the browser as one program
add_custom_command(
    OUTPUT ${bundled_list} ${bundled_browser}
    COMMAND ${RIGOR_NODE} build.mjs ${bundled_tests} --tests
    DEPENDS ${installed} ${sources} ${test_sources} ${web}/build.mjs
    WORKING_DIRECTORY ${web}
    COMMENT "Bundling the tests of the pages"
    VERBATIM)
add_custom_target(web_tests ALL DEPENDS ${bundled_list} ${bundled_browser})

# web_test(<name> <timeout> <labels> <file>...): the tests of bundled files.
function(web_test name timeout labels)
    add_test(NAME ${name} COMMAND ${RIGOR_NODE} --test ${ARGN} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${timeout} LABELS "${labels}" ENVIRONMENT
        "NODE_PATH=${web}/node_modules;RIGOR_BINARY_DIR=${PROJECT_BINARY_DIR};RIGOR_SOURCE_DIR=${PROJECT_SOURCE_DIR}")
endfunction()
set(bundled_unit ${bundled_list})
list(FILTER bundled_unit INCLUDE REGEX "/unit/[^/]*$")
web_test(web_unit_test 120 web ${bundled_unit})
web_test(web_browser_test 1500 "web;slow" ${bundled_browser})
set_tests_properties(web_browser_test PROPERTIES COST 400)
add_test(NAME web_types_test COMMAND ${RIGOR_NPM} exec -- tsc --noEmit WORKING_DIRECTORY ${web})
add_test(NAME web_lint_test COMMAND ${RIGOR_NPM} exec -- biome ci . WORKING_DIRECTORY ${web})
set_tests_properties(web_types_test web_lint_test PROPERTIES TIMEOUT 120 LABELS web)
