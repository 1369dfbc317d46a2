# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# rigor_library(<target> [COLD] [LIBS ...] SOURCES ...), rigor_adapter(<name> [PRECISION f32] SOURCES ... LIBS
# ...), rigor_test(<name> SOURCES ... LIBS ... [LABELS ...] [COST seconds]), rigor_benchmark(<name> SOURCES
# ... LIBS ...): the project's targets, with its warnings and flags. COLD: nothing in it is timed
# (RigorPrecompiled.cmake). COST: about how long a long test takes. Several files of a target are compiled at
# once (RigorUnity.cmake).

add_library(rigor_flags INTERFACE)
target_include_directories(rigor_flags INTERFACE ${PROJECT_SOURCE_DIR})
# The same bits everywhere: no contraction into fused multiply-adds, no fast-math.
target_compile_options(rigor_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
                                             -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
    # Eigen would fuse multiply-adds by intrinsics, which the option above does not reach.
    target_compile_options(rigor_flags INTERFACE -U__ARM_FEATURE_FMA)
endif()
# GCC 12 reports false positives of these from inside Eigen and the standard library when it inlines.
target_compile_options(rigor_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized
                                             -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict>)
# What is inlined must not depend on which files are compiled at once: no limit to the growth of a translation unit.
target_compile_options(rigor_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=large-unit-insns=1000000>)
if(RIGOR_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
        message(FATAL_ERROR "RIGOR_FUZZ needs libFuzzer: found ${CMAKE_CXX_COMPILER_ID}, expected -DCMAKE_CXX_COMPILER=clang++")
    endif()
    set(fuzz_flags -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_compile_options(rigor_flags INTERFACE ${fuzz_flags})
    target_link_options(rigor_flags INTERFACE -fsanitize=address,undefined)
elseif(RIGOR_SANITIZE STREQUAL thread)
    # GCC 12 reports another false positive inside std::string with this sanitizer.
    target_compile_options(rigor_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer
                                                 $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>)
    target_link_options(rigor_flags INTERFACE -fsanitize=thread)
elseif(RIGOR_SANITIZE)
    target_compile_options(rigor_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=undefined)
    target_link_options(rigor_flags INTERFACE -fsanitize=address,undefined)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
include(RigorPrecompiled)
include(RigorUnity)

function(rigor_library target)
    cmake_parse_arguments(ARG "COLD" "" "SOURCES;LIBS" ${ARGN})
    add_library(${target} STATIC ${ARG_SOURCES})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PUBLIC ${ARG_LIBS} PRIVATE $<BUILD_INTERFACE:rigor_flags>)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    rigor_unity(${target})
    if(ARG_COLD)
        rigor_precompile(${target} cold)
    else()
        rigor_precompile(${target} hot)
    endif()
endfunction()

# A module bin/adapters/rigor_adapter_<name>[.<precision>].so
function(rigor_adapter name)
    cmake_parse_arguments(ARG "" "PRECISION" "SOURCES;LIBS" ${ARGN})
    set(target rigor_adapter_${name})
    set(file rigor_adapter_${name})
    if(ARG_PRECISION)
        string(APPEND target _${ARG_PRECISION})
        string(APPEND file .${ARG_PRECISION})
    endif()
    add_library(${target} MODULE ${ARG_SOURCES})
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${file} CXX_VISIBILITY_PRESET hidden
                                               LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin/adapters)
    target_link_libraries(${target} PRIVATE rigor_flags rigor_adapter_interface ${ARG_LIBS})
    rigor_precompile(${target} hot)
    rigor_unity(${target} 0)
    set_property(GLOBAL APPEND PROPERTY RIGOR_ADAPTER_TARGETS ${target})
endfunction()

# rigor_adapter_test(<test> <module>): the tests of an adapter, tests/*_test.cpp of its folder, with one of its modules.
function(rigor_adapter_test name module)
    file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/*_test.cpp)
    if(RIGOR_TESTS AND tests)
        rigor_test(${name} SOURCES ${tests} LIBS rigor_adapter_interface)
        target_compile_definitions(${name} PRIVATE RIGOR_MODULE="$<TARGET_FILE:${module}>")
        add_dependencies(${name} ${module})
    endif()
endfunction()

# rigor_optional_adapter(<name> <title> <licence> <found>): an engine whose package is optional. Where it was not found, a
# manifest that is never complete says how to get it (`rigor list engines`).
function(rigor_optional_adapter name title licence found)
    set(manifest ${PROJECT_BINARY_DIR}/bin/adapters/rigor_adapter_${name}.json)
    if(found)
        file(REMOVE ${manifest})
        return()
    endif()
    message(STATUS "${title}: not found, module skipped")
    file(REMOVE ${PROJECT_BINARY_DIR}/bin/adapters/rigor_adapter_${name}.so)
    file(WRITE ${manifest} "{\"rigor_guest\": 1, \"protocol\": 1, \"name\": \"${name}\", \"title\": \"${title}\",
 \"command\": [\"sh\"], \"needs\": [\"rigor_adapter_${name}.so\"], \"precision\": \"f64\",
 \"licence\": \"${licence}\", \"install\": \"./rigor --with ${name}\"}\n")
endfunction()

function(rigor_test name)
    if(NOT RIGOR_TESTS)
        return()
    endif()
    cmake_parse_arguments(ARG "" "TIMEOUT;COST" "SOURCES;LIBS;LABELS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE rigor_flags ${ARG_LIBS} GTest::gtest_main GTest::gmock)
    rigor_precompile(${name} test)
    rigor_unity(${name})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    target_compile_definitions(${name} PRIVATE RIGOR_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                               RIGOR_BINARY_DIR="${PROJECT_BINARY_DIR}")
    add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 120)
    endif()
    if(RIGOR_SANITIZE)  # sanitizers make tests 3 to 10 times slower
        math(EXPR ARG_TIMEOUT "4 * ${ARG_TIMEOUT}")
    endif()
    # Two builds on one machine may run the same test at once: each has temporary files of its own.
    set(temporary ${PROJECT_BINARY_DIR}/tests/tmp/${name})
    file(MAKE_DIRECTORY ${temporary})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT_MODIFICATION
                                                                   "TEST_TMPDIR=set:${temporary}/")
    if(ARG_COST)  # the longest tests start first, so that none of them runs alone at the end
        set_tests_properties(${name} PROPERTIES COST ${ARG_COST})
    endif()
    if(ARG_LABELS)
        set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}")
        if("slow" IN_LIST ARG_LABELS)
            set_target_properties(${name} PROPERTIES RIGOR_SLOW TRUE)
        endif()
    endif()
endfunction()

# rigor_quick_target(): the target `rigor_quick`, all that `all` builds but the programs of slow tests (RIGOR_SLOW). Must
# be called after all targets are there.
function(rigor_targets_below directory result)
    get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
    get_property(folders DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
    foreach(folder ${folders})
        rigor_targets_below(${folder} below)
        list(APPEND targets ${below})
    endforeach()
    set(${result} ${targets} PARENT_SCOPE)
endfunction()
function(rigor_quick_target)
    rigor_targets_below(${PROJECT_SOURCE_DIR} targets)
    set(quick)
    foreach(target ${targets})
        get_target_property(type ${target} TYPE)
        get_target_property(slow ${target} RIGOR_SLOW)
        get_target_property(excluded ${target} EXCLUDE_FROM_ALL)
        if(type MATCHES "EXECUTABLE|MODULE_LIBRARY|UTILITY" AND NOT slow AND NOT excluded)
            list(APPEND quick ${target})
        endif()
    endforeach()
    add_custom_target(rigor_quick DEPENDS ${quick})
endfunction()

# bin/benchmarks/<name>, by Google Benchmark; not part of `all`: `cmake --build BUILD --target rigor_benchmarks` builds
# all of them.
find_package(benchmark 1.7 QUIET)
function(rigor_benchmark name)
    if(NOT benchmark_FOUND)
        message(STATUS "Google Benchmark: not found, ${name} skipped")
        return()
    endif()
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE rigor_flags ${ARG_LIBS} benchmark::benchmark)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin/benchmarks)
    if(NOT TARGET rigor_benchmarks)
        add_custom_target(rigor_benchmarks)
    endif()
    add_dependencies(rigor_benchmarks ${name})
endfunction()
