# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Foreign headers that many files include (the standard library, Eigen, JSON, GoogleTest) are parsed once per set of
# flags. rigor_precompile(<target> <kind>) lets a target use them; <kind> is one of
#
#     hot     libraries and adapters with the build type's own optimisation
#     cold    position-independent code that is not timed: RIGOR_COLD_OPTIONS
#     test    tests: RIGOR_COLD_OPTIONS, and GoogleTest besides
#
# Every file includes what it uses all the same: RIGOR_PRECOMPILE=OFF (the debug preset) shows what is forgotten.
option(RIGOR_PRECOMPILE "Parse foreign headers once for many files" ON)

# Code in which no engine spends its time is compiled in half the time at -O1.
set(RIGOR_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)

set(rigor_precompiled_std
    <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
    <mutex> <numeric> <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple>
    <unordered_map> <utility> <variant> <vector>)

function(rigor_precompiled_kind kind)
    cmake_parse_arguments(ARG "POSITION_INDEPENDENT" "" "HEADERS;OPTIONS;LIBS" ${ARGN})
    set(target rigor_precompiled_${kind})
    add_library(${target} OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
    target_link_libraries(${target} PRIVATE rigor_flags Eigen3::Eigen ${ARG_LIBS})
    target_compile_options(${target} PRIVATE ${ARG_OPTIONS})
    target_precompile_headers(${target} PRIVATE ${rigor_precompiled_std} <Eigen/Dense> ${ARG_HEADERS})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ${ARG_POSITION_INDEPENDENT})
endfunction()

if(RIGOR_PRECOMPILE)
    rigor_precompiled_kind(hot POSITION_INDEPENDENT)
    if(NOT RIGOR_ENGINE_ONLY)
        rigor_precompiled_kind(cold POSITION_INDEPENDENT HEADERS <nlohmann/json.hpp> OPTIONS ${RIGOR_COLD_OPTIONS})
    endif()
    if(RIGOR_TESTS)
        rigor_precompiled_kind(test HEADERS <gtest/gtest.h> <gmock/gmock.h> OPTIONS ${RIGOR_COLD_OPTIONS}
                               LIBS GTest::gtest_main GTest::gmock)
    endif()
endif()

function(rigor_precompile target kind)
    if(NOT kind STREQUAL hot)
        target_compile_options(${target} PRIVATE ${RIGOR_COLD_OPTIONS})
    endif()
    if(TARGET rigor_precompiled_${kind})
        target_precompile_headers(${target} REUSE_FROM rigor_precompiled_${kind})
    endif()
endfunction()
