# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Component results of find_package(rigor): the reader and writer of run folders.
find_dependency(nlohmann_json 3.11)
find_dependency(SQLiteCpp)
find_dependency(ZLIB)
find_dependency(PkgConfig)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5)
include("${CMAKE_CURRENT_LIST_DIR}/rigor_results_targets.cmake")
set(rigor_results_FOUND TRUE)
