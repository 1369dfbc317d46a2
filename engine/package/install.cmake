# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# `cmake --install BUILD --component engine` gives a package: find_package(rigor), target rigor::engine. Headers
# keep their place in the tree under include/rigor/, so that `#include "engine/engine.hpp"` means the same inside
# and outside.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rigor)

set_target_properties(rigor_engine PROPERTIES EXPORT_NAME engine)
install(TARGETS rigor_engine EXPORT rigorTargets COMPONENT engine ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rigor)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rigor COMPONENT engine
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" PATTERN tests EXCLUDE PATTERN benchmarks EXCLUDE
        PATTERN package EXCLUDE PATTERN python EXCLUDE)
install(EXPORT rigorTargets NAMESPACE rigor:: DESTINATION ${package_dir} COMPONENT engine)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rigorConfig.cmake.in rigorConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(rigorConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/rigorConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/rigorConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/rigor_engine.cmake
        DESTINATION ${package_dir} COMPONENT engine)

if(RIGOR_TESTS)
    # A program outside the tree: install, configure, build, run.
    add_test(NAME engine_package_test
             COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DGENERATOR=${CMAKE_GENERATOR}
                     -DPROGRAM=${CMAKE_CURRENT_LIST_DIR}/tests/program
                     -P ${CMAKE_CURRENT_LIST_DIR}/tests/build_outside.cmake)
    set_tests_properties(engine_package_test PROPERTIES TIMEOUT 300)
endif()
