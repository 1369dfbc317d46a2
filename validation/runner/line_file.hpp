// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// JSON values one to a line, each on the disk before the next is begun: the results of a child with many
// queries that one of them has ended.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rigor::validation {

class LineWriter {
  public:
    /// A new file, or with `append` the end of one. Throws results::EnvironmentError.
    explicit LineWriter(const std::string& file, bool append = false);
    ~LineWriter();
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    void add(const nlohmann::json& value);

  private:
    [[noreturn]] void refuse() const;
    int file_;
    std::string name_;
};

/// The lines up to the first that is not whole; none where there is no file.
std::vector<nlohmann::json> readJsonLines(const std::filesystem::path& file);

/// SIGALRM after so many seconds, 0: never. It ends a child whose query hangs.
void setAlarm(double seconds);

}  // namespace rigor::validation
