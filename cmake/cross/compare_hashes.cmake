# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Builds the program of the golden scenes for another processor, runs it, and compares its state hashes with the host's:
#     cmake -DTARGET=arm64 -DHOST=build/release/bin/engine_print_golden_hashes -DBUILD=build/cross-arm64
#           -P cmake/cross/compare_hashes.cmake
# TARGET is i386, arm64 or armhf. differences.txt lists the scenes that are known to differ, and any other difference is an
# error; so is a scene that is listed and does not differ. Without compiler, libraries or emulator the first line begins
# with SKIPPED.
cmake_minimum_required(VERSION 3.25)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
if("${TARGET}" STREQUAL "i386")
    set(tools i686-linux-gnu)
    set(triplet i386-linux-gnu)
    set(emulators qemu-i386-static qemu-i386)
elseif("${TARGET}" STREQUAL "arm64")
    set(tools aarch64-linux-gnu)
    set(triplet aarch64-linux-gnu)
    set(emulators qemu-aarch64-static qemu-aarch64)
elseif("${TARGET}" STREQUAL "armhf")
    set(tools arm-linux-gnueabihf)
    set(triplet arm-linux-gnueabihf)
    set(emulators qemu-arm-static qemu-arm)
else()
    message(FATAL_ERROR "TARGET is '${TARGET}': it must be i386, arm64 or armhf")
endif()

find_program(compiler ${tools}-g++)
if(NOT compiler)
    message("SKIPPED: no ${tools}-g++ (Debian: g++-${tools})")
    return()
endif()
set(root $ENV{RIGOR_CROSS_ROOT})
if(root)
    set(libraries ${root}/${TARGET}/usr/lib/${triplet})
else()
    set(libraries /usr/lib/${triplet})
endif()
if(NOT EXISTS ${libraries}/cmake/TBB OR NOT EXISTS ${libraries}/cmake/hwy)
    message("SKIPPED: no oneTBB and Highway of ${TARGET} in ${libraries}. `cmake/cross/get_libraries.sh DIR ${TARGET}` unpacks "
            "them; then set RIGOR_CROSS_ROOT=DIR")
    return()
endif()

file(WRITE ${BUILD}/word.cpp "int main() {}\n")
execute_process(COMMAND ${compiler} ${BUILD}/word.cpp -o ${BUILD}/word COMMAND_ERROR_IS_FATAL ANY)
find_program(emulator ${emulators})
set(run ${emulator} -L /usr/${tools})
if("${TARGET}" STREQUAL "i386")
    # Most x86-64 systems run these programs as they are.
    execute_process(COMMAND ${BUILD}/word RESULT_VARIABLE native)
    if(native EQUAL 0)
        set(run)
    endif()
endif()
if(run AND NOT emulator)
    message("SKIPPED: neither of ${emulators} (Debian: qemu-user-static)")
    return()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${BUILD} -DCMAKE_TOOLCHAIN_FILE=${CMAKE_CURRENT_LIST_DIR}/toolchain.cmake
                        -DRIGOR_CROSS=${TARGET} -DRIGOR_CROSS_ROOT=${root} -DRIGOR_ENGINE_ONLY=ON -DRIGOR_TESTS=OFF
                        -DCMAKE_BUILD_TYPE=Release COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target engine_print_golden_hashes COMMAND_ERROR_IS_FATAL ANY)
# Threads change no bit, and emulated ones that spin may wait for each other for minutes.
execute_process(COMMAND ${run} ${BUILD}/bin/engine_print_golden_hashes one-thread OUTPUT_VARIABLE theirs
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${HOST} one-thread OUTPUT_VARIABLE ours COMMAND_ERROR_IS_FATAL ANY)

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/differences.txt known REGEX "^${TARGET} ")
list(TRANSFORM known REPLACE "^${TARGET} " "")
string(REPLACE "\n" ";" ours "${ours}")
string(REPLACE "\n" ";" theirs "${theirs}")
set(failed)
set(equal 0)
foreach(line ${ours})
    string(REGEX MATCH "^[^ ]+" scene "${line}")
    if(line IN_LIST theirs)
        math(EXPR equal "${equal} + 1")
        if(scene IN_LIST known)
            list(APPEND failed "${scene} is listed in differences.txt and has the same bits")
        endif()
    elseif(NOT scene IN_LIST known)
        list(APPEND failed "${scene} has other bits")
    endif()
endforeach()
list(LENGTH known differences)
message("${TARGET}: ${equal} scenes have the bits of this machine, ${differences} are known to differ")
if(failed)
    string(REPLACE ";" "\n" failed "${failed}")
    message(FATAL_ERROR "${failed}")
endif()
