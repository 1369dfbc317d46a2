# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Toolchain for Debian's cross compilers: RIGOR_CROSS is i386, arm64 or armhf. The foreign libraries, oneTBB and Highway, are
# those of the target: installed beside the host's (Debian's multiarch), or unpacked below RIGOR_CROSS_ROOT/<target>.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES RIGOR_CROSS RIGOR_CROSS_ROOT)
if(RIGOR_CROSS STREQUAL i386)
    set(CMAKE_SYSTEM_PROCESSOR i686)
    set(tools i686-linux-gnu)
    set(triplet i386-linux-gnu)
    # Arithmetic of the x87 unit rounds to other numbers.
    set(CMAKE_CXX_FLAGS_INIT "-msse2 -mfpmath=sse")
elseif(RIGOR_CROSS STREQUAL arm64)
    set(CMAKE_SYSTEM_PROCESSOR aarch64)
    set(tools aarch64-linux-gnu)
    set(triplet aarch64-linux-gnu)
elseif(RIGOR_CROSS STREQUAL armhf)
    set(CMAKE_SYSTEM_PROCESSOR armv7l)
    set(tools arm-linux-gnueabihf)
    set(triplet arm-linux-gnueabihf)
else()
    message(FATAL_ERROR "RIGOR_CROSS is '${RIGOR_CROSS}': it must be i386, arm64 or armhf")
endif()
set(CMAKE_CXX_COMPILER ${tools}-g++)
set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG" CACHE STRING "Quick to compile; the bits do not depend on it")
if(RIGOR_CROSS_ROOT)
    set(libraries ${RIGOR_CROSS_ROOT}/${RIGOR_CROSS}/usr/lib/${triplet})
else()
    set(libraries /usr/lib/${triplet})
endif()
set(TBB_DIR ${libraries}/cmake/TBB)
set(hwy_DIR ${libraries}/cmake/hwy)
