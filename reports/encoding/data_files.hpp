// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Data beside the page, read on demand: a page opened from disk may run scripts beside it, but not fetch
// files. `data/<name>.js` calls rigorData(name, base64 of gzip); web/src/common/data_files.ts loads it.
#pragma once

#include <string>
#include <string_view>

namespace rigor::report {

std::string base64(std::string_view bytes);
/// `level`: zlib's, 1 (fast) to 9 (small). Throws std::runtime_error.
std::string gzip(std::string_view bytes, int level = 6);
/// The text of data/<name>.js. `name`: letters, digits, '-' and '_' alone. Throws std::invalid_argument for
/// others.
std::string dataFile(std::string_view name, std::string_view content);

}  // namespace rigor::report
