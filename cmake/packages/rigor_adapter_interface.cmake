# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Component adapter_interface of find_package(rigor): what a module of an engine is linked with.
include("${CMAKE_CURRENT_LIST_DIR}/rigor_adapter_interface_targets.cmake")
set(rigor_adapter_interface_FOUND TRUE)
