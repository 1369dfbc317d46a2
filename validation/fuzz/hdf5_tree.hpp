// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// HDF5 files written out as text. Changed bytes of an HDF5 file end in the library, which is not ours; changed lines of
// this text make a file that the library accepts and our readers have to judge. A line is one of
//     group PATH
//     doubles PATH COLUMNS VALUE...
//     integers PATH COLUMNS VALUE...
//     string PATH TEXT              a dataset
//     text PATH NAME TEXT           the others are attributes
//     integer PATH NAME VALUE
//     number PATH NAME VALUE
// What cannot be written is left out.
#pragma once

#include <string>

namespace rigor::fuzz {

/// Bytes of the file.
std::string hdf5From(const std::string& text);

}  // namespace rigor::fuzz
