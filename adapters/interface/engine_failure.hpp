// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The end of an engine that runs in a process of its own, as the process that uses it sees it.
#pragma once

#include <stdexcept>
#include <string>

namespace rigor::adapter {

class EngineFailure : public std::runtime_error {
  public:
    enum class Kind {
        Died,      ///< its process ended
        Silent,    ///< no answer within its time
        Memory,    ///< more memory than it may have
        Protocol,  ///< an answer that is none
    };
    EngineFailure(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

}  // namespace rigor::adapter
