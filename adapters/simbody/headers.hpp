// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Simbody's headers for C++20. Simbody 3.7 compares its index types by member functions that take integers; C++20 looks at
// the reversed order too and finds each comparison of two indices ambiguous. Every index type gets a comparison of its own.
//
// Debian's library is built with its checks, and classes of its headers have members that are only there with them
// (SimTKcommon/internal/StateImpl.h): what includes these headers must be built so as well.
#pragma once

#undef NDEBUG
#include <cassert>

#include <SimTKcommon/internal/common.h>

#undef SimTK_DEFINE_UNIQUE_INDEX_TYPE
#undef SimTK_DEFINE_AND_EXPORT_UNIQUE_INDEX_TYPE
#undef SimTK_DEFINE_UNIQUE_LOCAL_INDEX_TYPE

#define RIGOR_COMPARES_INDEX(NAME)                  \
    bool operator==(const NAME& a, const NAME& b) { \
        return int(a) == int(b);                    \
    }
#define SimTK_DEFINE_AND_EXPORT_UNIQUE_INDEX_TYPE(EXPORT, NAME)                                        \
    SimTK_DEFINE_AND_EXPORT_UNIQUE_LOCAL_INDEX_TYPE(EXPORT, , , NAME) static const NAME Invalid##NAME; \
    inline RIGOR_COMPARES_INDEX(NAME)
#define SimTK_DEFINE_UNIQUE_INDEX_TYPE(NAME) SimTK_DEFINE_AND_EXPORT_UNIQUE_INDEX_TYPE(, NAME)
#define SimTK_DEFINE_UNIQUE_LOCAL_INDEX_TYPE(PARENT, NAME) \
    SimTK_DEFINE_AND_EXPORT_UNIQUE_LOCAL_INDEX_TYPE(, PARENT, ::, NAME) friend RIGOR_COMPARES_INDEX(NAME)

#include <Simbody.h>
