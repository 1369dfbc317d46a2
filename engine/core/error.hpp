// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bad input to the engine: an exception with a stable id that a caller can test for.
#pragma once

#include <stdexcept>
#include <string>

namespace rigor::engine {

/// id() is a stable snake_case name ("body_mass", "unknown_algorithm", ...); what() describes the error.
class EngineError : public std::invalid_argument {
  public:
    EngineError(std::string id, const std::string& message)
        : std::invalid_argument(id + ": " + message), id_(std::move(id)) {}
    const std::string& id() const { return id_; }

  private:
    std::string id_;
};

}  // namespace rigor::engine
