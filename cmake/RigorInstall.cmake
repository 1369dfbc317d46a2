# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# What `cmake --install BUILD` puts where, by component:
#
#     program          bin/, lib/rigor/, share/rigor/, man pages, completion, documents
#     adapters-<name>  lib/rigor/adapters/rigor_adapter_<name>*.so, one component for each other engine that was built
#     readers          lib/rigor/readers/rigor-read-<format>, the readers of model files that were built
#     engine           library and headers of the in-house engine (engine/package)
#     development      the adapter interface and the reader of results
#     python           the Python package (reports/python)
#     documentation    the handbook, where it has been written
#
# Nothing that is installed names a folder of this machine: programs find lib/ and share/ beside their own bin/, so an
# installation may be moved. The build folder has the same share/rigor, of links into the source tree.
include(GNUInstallDirs)
set(data share/rigor)

# The folders below share/rigor, and where they are in the source tree. Templates keep their paths in it.
set(build_data ${PROJECT_BINARY_DIR}/${data})
file(MAKE_DIRECTORY ${build_data})
foreach(link scenarios=scenarios/library schema=scenarios/schema templates=.)
    string(REPLACE "=" ";" link ${link})
    list(GET link 0 name)
    list(GET link 1 source)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
    string(REGEX REPLACE "/$" "" source ${source})
    if(NOT EXISTS ${build_data}/${name})
        file(CREATE_LINK ${source} ${build_data}/${name} SYMBOLIC)
    endif()
endforeach()

set(program COMPONENT program)
install(TARGETS rigor rigor-validate RUNTIME DESTINATION bin ${program})
install(DIRECTORY scenarios/library/ DESTINATION ${data}/scenarios ${program} FILES_MATCHING PATTERN "*.json" PATTERN "*.csv")
install(DIRECTORY scenarios/schema/ DESTINATION ${data}/schema ${program})
install(DIRECTORY adapters/guest/sdk adapters/guest/examples DESTINATION ${data}/templates/adapters/guest ${program}
        PATTERN __pycache__ EXCLUDE)
install(FILES adapters/conformance/examples/free_flight.cpp adapters/conformance/examples/CMakeLists.txt.in
        DESTINATION ${data}/templates/adapters/conformance/examples ${program})

# The in-house engine and the modules that belong to no engine come with the program.
get_property(modules GLOBAL PROPERTY RIGOR_ADAPTER_TARGETS)
set(RIGOR_OTHER_ENGINES)
foreach(module ${modules} rigor_guest_host)
    set(component program)
    if(module MATCHES "^rigor_adapter_([a-z0-9_]+)$" AND NOT CMAKE_MATCH_1 STREQUAL rigor)
        # Another precision, as of bullet_f32, belongs to its engine.
        string(REGEX REPLACE "_(f32|f64)$" "" engine ${CMAKE_MATCH_1})
        list(APPEND RIGOR_OTHER_ENGINES ${engine})
        set(component adapters-${engine})
    endif()
    install(TARGETS ${module} LIBRARY DESTINATION lib/rigor/adapters COMPONENT ${component})
endforeach()
list(REMOVE_DUPLICATES RIGOR_OTHER_ENGINES)
if(TARGET conformance_test)
    install(TARGETS conformance_test RUNTIME DESTINATION lib/rigor ${program})
endif()

get_property(readers GLOBAL PROPERTY RIGOR_READERS)
if(readers)
    install(TARGETS ${readers} RUNTIME DESTINATION lib/rigor/readers COMPONENT readers)
endif()

# Guests of npm: their sources, and manifests beside the modules. Their libraries are not ours to install.
install(DIRECTORY adapters/guest/engines DESTINATION ${data}/templates/adapters/guest ${program} PATTERN node_modules EXCLUDE
        PATTERN "rigor_adapter_*.json" EXCLUDE PATTERN "*.cmake" EXCLUDE)
file(GLOB manifests CONFIGURE_DEPENDS adapters/guest/engines/*/rigor_adapter_*.json)
foreach(manifest ${manifests})
    cmake_path(GET manifest PARENT_PATH folder)
    cmake_path(GET folder FILENAME guest)
    cmake_path(GET manifest FILENAME file)
    file(READ ${manifest} text)
    string(JSON text SET "${text}" folder "\"../../../${data}/templates/adapters/guest/engines/${guest}\"")
    string(JSON text SET "${text}" install "\"npm ci --ignore-scripts, in share/rigor/templates/adapters/guest/engines\"")
    file(CONFIGURE OUTPUT installed_manifests/${file} CONTENT "${text}\n" @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/installed_manifests/${file} DESTINATION lib/rigor/adapters ${program})
endforeach()

# Manual pages and completion, written by the program itself from the definitions of its commands.
file(STRINGS CITATION.cff released REGEX "^date-released: ")
string(REGEX REPLACE "^[^ ]* " "" RIGOR_RELEASED "${released}")
set(manual ${CMAKE_CURRENT_BINARY_DIR}/manual)
add_custom_command(
    OUTPUT ${manual}/rigor.1 ${manual}/completion
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}
    COMMAND rigor manual --out ${manual} --date ${RIGOR_RELEASED}
    COMMAND rigor completion > ${manual}/completion
    DEPENDS rigor
    COMMENT "Writing the manual pages"
    VERBATIM)
add_custom_target(rigor_manual ALL DEPENDS ${manual}/rigor.1 ${manual}/completion)
install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 ${program} FILES_MATCHING PATTERN "*.1")
foreach(name rigor rigor-validate)
    install(FILES ${manual}/completion DESTINATION share/bash-completion/completions RENAME ${name} ${program})
endforeach()

install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} ${program})
install(FILES adapters/guest/PROTOCOL.md DESTINATION ${CMAKE_INSTALL_DOCDIR} ${program})
install(FILES engine/references.bib DESTINATION ${CMAKE_INSTALL_DOCDIR} ${program})
install(FILES scenarios/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME scenarios.md ${program})
install(FILES validation/results/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME results.md ${program})
install(FILES LICENSES/MIT.txt DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME LICENSE ${program})

# find_package(rigor COMPONENTS adapter_interface results)
set(development COMPONENT development)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rigor)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/rigor)
function(rigor_install_library name)
    install(TARGETS ${ARGN} EXPORT rigor_${name}_targets COMPONENT development ARCHIVE
            DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${headers})
    install(EXPORT rigor_${name}_targets NAMESPACE rigor:: DESTINATION ${package_dir} COMPONENT development)
    install(FILES cmake/packages/rigor_${name}.cmake DESTINATION ${package_dir} COMPONENT development)
endfunction()
set_target_properties(rigor_scenario_model PROPERTIES EXPORT_NAME scenario_model)
set_target_properties(rigor_adapter_interface PROPERTIES EXPORT_NAME adapter_interface)
set_target_properties(rigor_results PROPERTIES EXPORT_NAME results)
rigor_install_library(adapter_interface rigor_scenario_model rigor_adapter_interface)
rigor_install_library(results rigor_results)
foreach(folder adapters/interface scenarios/model validation/results)
    install(DIRECTORY ${folder}/ DESTINATION ${headers}/${folder} ${development} FILES_MATCHING PATTERN "*.hpp" PATTERN
            tests EXCLUDE)
endforeach()

include(RigorPackages)
if(RIGOR_TESTS)
    add_subdirectory(cmake/tests)
endif()
