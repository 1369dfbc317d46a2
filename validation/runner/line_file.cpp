// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/line_file.hpp"

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "validation/results/files.hpp"

namespace rigor::validation {

using nlohmann::json;

LineWriter::LineWriter(const std::string& file, bool append)
    : file_(open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (append ? O_APPEND : O_TRUNC), 0644)),
      name_(file) {
    if (file_ < 0) refuse();
}

LineWriter::~LineWriter() {
    close(file_);
}

void LineWriter::add(const json& value) {
    const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t n = write(file_, text.data() + at, text.size() - at);
        if (n > 0)
            at += n;
        else if (errno != EINTR)
            refuse();
    }
}

void LineWriter::refuse() const {
    throw results::EnvironmentError(name_, "cannot be written", errno);
}

std::vector<json> readJsonLines(const std::filesystem::path& file) {
    std::vector<json> values;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        json value = json::parse(line, nullptr, false);
        if (value.is_discarded()) break;
        values.push_back(std::move(value));
    }
    return values;
}

void setAlarm(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
    setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace rigor::validation
