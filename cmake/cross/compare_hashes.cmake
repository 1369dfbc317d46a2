# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Builds the program of the golden scenes for another processor or by another compiler, runs it, and compares its state
# hashes with those of this build:
#     cmake -DTARGET=arm64 -DHOST=build/release/bin/engine_print_golden_hashes -DBUILD=build/cross-arm64
#           -P cmake/cross/compare_hashes.cmake
# TARGET is i386, arm64 or armhf, or clang: Clang without optimisation, on this machine. Without compiler, libraries or
# emulator the first line begins with SKIPPED.
cmake_minimum_required(VERSION 3.25)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
set(run)
if("${TARGET}" STREQUAL "clang")
    find_program(compiler clang++)
    if(NOT compiler)
        message("SKIPPED: no clang++ (Debian: clang)")
        return()
    endif()
    set(kind -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_BUILD_TYPE=Debug -DRIGOR_PRECOMPILE=OFF)
else()
    include(${CMAKE_CURRENT_LIST_DIR}/other_processor.cmake)
    if(NOT kind)
        return()
    endif()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${BUILD} ${kind} -DRIGOR_ENGINE_ONLY=ON -DRIGOR_TESTS=OFF
                        COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --parallel 2 --target engine_print_golden_hashes
                COMMAND_ERROR_IS_FATAL ANY)
# Threads change no bit, and emulated ones that spin may wait for each other for minutes.
execute_process(COMMAND ${run} ${BUILD}/bin/engine_print_golden_hashes one-thread OUTPUT_VARIABLE theirs
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${HOST} one-thread OUTPUT_VARIABLE ours COMMAND_ERROR_IS_FATAL ANY)

string(REPLACE "\n" ";" ours "${ours}")
string(REPLACE "\n" ";" theirs "${theirs}")
set(failed)
set(equal 0)
foreach(line ${ours})
    if(line IN_LIST theirs)
        math(EXPR equal "${equal} + 1")
    else()
        string(REGEX MATCH "^[^ ]+" scene "${line}")
        list(APPEND failed "${scene} has other bits")
    endif()
endforeach()
message("${TARGET}: ${equal} scenes have the bits of this build")
if(failed)
    string(REPLACE ";" "\n" failed "${failed}")
    message(FATAL_ERROR "${failed}")
endif()
if(equal EQUAL 0)
    message(FATAL_ERROR "no scene was compared")
endif()
