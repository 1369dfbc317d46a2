# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Included by adapters/guest/CMakeLists.txt: the manifests of this folder's guests, written beside the modules with the
# folder of their sources. Their libraries come from npm (package-lock.json, `./rigor --with guests`); a guest without its
# library is listed as not installed, and its conformance test is skipped.
file(GLOB guest_manifests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*/rigor_adapter_*.json)
foreach(manifest IN LISTS guest_manifests)
    get_filename_component(name ${manifest} NAME_WE)
    get_filename_component(folder ${manifest} DIRECTORY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${manifest})
    file(READ ${manifest} text)
    string(JSON text SET "${text}" folder "\"${folder}\"")
    file(WRITE ${PROJECT_BINARY_DIR}/bin/adapters/${name}.json "${text}\n")
    string(REGEX REPLACE "^rigor_adapter_" "" engine ${name})
    set_property(GLOBAL APPEND PROPERTY RIGOR_GUEST_ENGINES ${engine})
endforeach()
