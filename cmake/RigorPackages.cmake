# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Debian packages: `cmake --build BUILD --target rigor_packages` (or `./rigor package`) writes them to BUILD/packages, one
# for each component of RigorInstall.cmake that was built:
#
#     rigor  rigor-adapters-<engine>  rigor-readers  rigor-engine-dev  rigor-dev  rigor-doc  python3-rigor
#
# Whoever hands packages to others is their maintainer: -DRIGOR_MAINTAINER="Name <address>", or DEBFULLNAME and DEBEMAIL as
# for Debian's own tools. The default is an address that cannot be reached (RFC 2606).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rigor)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(maintainer "The Rigor authors <no-reply@rigor.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
    set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(RIGOR_MAINTAINER "${maintainer}" CACHE STRING "Maintainer of the Debian packages: Name <address>")
set(CPACK_PACKAGE_CONTACT "${RIGOR_MAINTAINER}")
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/packages/components.cmake)
set(CPACK_RIGOR_HANDBOOK ${PROJECT_BINARY_DIR}/handbook)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/packages/debian_tree.cmake)
set(RIGOR_PACKAGE_FILES ${CMAKE_CURRENT_BINARY_DIR}/package_files)

# rigor_package(<component> <package> SECTION <section> SUMMARY <text> DESCRIPTION <text> [DEPENDS ...] [RECOMMENDS ...]
# [SUGGESTS ...] [SHLIBDEPS] [ALL] [CONTROL files]): SHLIBDEPS adds the libraries that its programs and modules load; ALL: the
# same for all architectures.
function(rigor_package component package)
    cmake_parse_arguments(ARG "SHLIBDEPS;ALL" "SECTION;SUMMARY;DESCRIPTION" "DEPENDS;RECOMMENDS;SUGGESTS;CONTROL" ${ARGN})
    string(TOUPPER ${component} id)
    set(prefix CPACK_DEBIAN_${id}_PACKAGE)
    foreach(list DEPENDS RECOMMENDS SUGGESTS)
        string(JOIN ", " text ${ARG_${list}})
        set(${prefix}_${list} "${text}" PARENT_SCOPE)
    endforeach()
    set(${prefix}_NAME ${package} PARENT_SCOPE)
    set(${prefix}_SECTION ${ARG_SECTION} PARENT_SCOPE)
    set(${prefix}_SHLIBDEPS ${ARG_SHLIBDEPS} PARENT_SCOPE)
    if(ARG_ALL)
        set(CPACK_DEBIAN_${id}_PACKAGE_ARCHITECTURE all PARENT_SCOPE)
    endif()
    set(${prefix}_CONTROL_EXTRA "${ARG_CONTROL}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${id}_DESCRIPTION "${ARG_SUMMARY}\n${ARG_DESCRIPTION}" PARENT_SCOPE)
    set(RIGOR_PACKAGE_COMPONENTS ${RIGOR_PACKAGE_COMPONENTS} ${component} PARENT_SCOPE)
    # Every package has the licence and a changelog.
    install(FILES ${RIGOR_PACKAGE_FILES}/copyright DESTINATION share/doc/${package} COMPONENT ${component}
            EXCLUDE_FROM_ALL)
    set(RIGOR_PACKAGE ${package})
    configure_file(${PROJECT_SOURCE_DIR}/cmake/packages/changelog.in ${RIGOR_PACKAGE_FILES}/${package}.changelog @ONLY)
    install(FILES ${RIGOR_PACKAGE_FILES}/${package}.changelog DESTINATION share/doc/${package} RENAME changelog
            COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

string(TIMESTAMP RIGOR_YEAR "%Y")
execute_process(COMMAND date -u -R -d "${RIGOR_RELEASED}" OUTPUT_VARIABLE RIGOR_RELEASED_LONG OUTPUT_STRIP_TRAILING_WHITESPACE)
file(READ LICENSES/MIT.txt licence)
string(REGEX MATCH "Permission is hereby.*" licence "${licence}")
string(STRIP "${licence}" licence)
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n" "\n " RIGOR_LICENCE "${licence}")
configure_file(cmake/packages/copyright.in ${RIGOR_PACKAGE_FILES}/copyright @ONLY)

set(about "Rigor runs the same scenarios on several rigid-body physics engines and\nholds the motions to reference solutions and to each other.\n.")
set(same "rigor (= ${PROJECT_VERSION})")
foreach(engine ${RIGOR_OTHER_ENGINES})
    string(REPLACE "_" "-" package rigor-adapters-${engine})
    list(APPEND adapters ${package})
    rigor_package(adapters-${engine} ${package} SECTION science SHLIBDEPS DEPENDS ${same}
                  SUMMARY "engine ${engine} for the physics testbed Rigor"
                  DESCRIPTION "${about}\nThis package holds the module through which Rigor runs the engine\n${engine}.")
endforeach()
if(readers)
    rigor_package(readers rigor-readers SECTION science SHLIBDEPS DEPENDS ${same}
                  SUMMARY "readers of model files for the physics testbed Rigor"
                  DESCRIPTION "${about}\nThis package holds the readers of models of other simulators, and of\nmeshes.")
    set(suggested rigor-readers)
endif()
rigor_package(program rigor SECTION science SHLIBDEPS RECOMMENDS ${adapters} SUGGESTS ${suggested} rigor-doc python3-rigor nodejs npm python3
              SUMMARY "reference-validated testbed for rigid-body physics engines"
              DESCRIPTION "${about}\nThis package holds the programs, the library of scenarios, and the\nin-house engine.")
rigor_package(engine rigor-engine-dev SECTION libdevel DEPENDS libeigen3-dev libtbb-dev libhwy-dev SUGGESTS cmake
              SUMMARY "rigid-body engine of Rigor, library and headers"
              DESCRIPTION "${about}\nThis package holds the in-house engine, in 2D and 3D, for programs of\none's own.")
rigor_package(development rigor-dev SECTION libdevel
              DEPENDS "rigor-engine-dev (= ${PROJECT_VERSION})" nlohmann-json3-dev libsqlitecpp-dev libhdf5-dev zlib1g-dev pkg-config
              SUGGESTS cmake
              SUMMARY "adapter interface and results reader of Rigor"
              DESCRIPTION "${about}\nThis package holds what modules of further engines are linked with,\nand the reader of stored runs.")
install(DIRECTORY ${PROJECT_BINARY_DIR}/handbook DESTINATION share/doc/rigor COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL)
install(FILES cmake/packages/doc-base DESTINATION share/doc-base RENAME rigor-doc.rigor-handbook COMPONENT documentation
        EXCLUDE_FROM_ALL)
rigor_package(documentation rigor-doc SECTION doc ALL
              SUMMARY "handbook of Rigor, a testbed for rigid-body physics engines"
              DESCRIPTION "${about}\nThis package holds the handbook in English and Chinese: how a physics\nengine is built, tutorials, the reference, and a gallery.")
if(TARGET rigor_python_module AND RIGOR_PYTHON_RESULTS)
    execute_process(COMMAND ${RIGOR_PYTHON} -c "import sys; v = sys.version_info; print('python3 (>= %d.%d~), python3 (<< %d.%d)' % (v[0], v[1], v[0], v[1] + 1))"
                    OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(scripts ${PROJECT_SOURCE_DIR}/cmake/packages/postinst ${PROJECT_SOURCE_DIR}/cmake/packages/prerm)
    rigor_package(python-package python3-rigor SECTION python SHLIBDEPS CONTROL ${scripts}
                  DEPENDS ${python} python3-numpy python3-pandas python3-h5py ${same}
                  SUMMARY "results and engine of Rigor in Python"
                  DESCRIPTION "${about}\nThis package opens stored runs as data frames and arrays, starts the\nprogram, and steps the in-house engine.")
    set(python_targets rigor_python_module)
endif()
set(CPACK_COMPONENTS_ALL ${RIGOR_PACKAGE_COMPONENTS})
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(CPack)

# What is packed is built first, without the tests.
set(kit)
if(TARGET conformance_test)
    set(kit conformance_test)
endif()
add_custom_target(
    rigor_packages
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${CPACK_PACKAGE_DIRECTORY}
    COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
    DEPENDS rigor_program rigor_validate_program rigor_manual rigor_engine rigor_results ${python_targets} ${readers} ${kit}
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
    COMMENT "Packing"
    VERBATIM)
