# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Component engine of find_package(rigor): the in-house engine.
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(TBB 2021)
find_dependency(hwy 1.0.3)
include("${CMAKE_CURRENT_LIST_DIR}/rigorTargets.cmake")
set(rigor_engine_FOUND TRUE)
