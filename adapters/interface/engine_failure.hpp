// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Failures of an engine as the process that uses it sees them: the end of a process of its own, an exception, an answer
// that is none.
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
        Threw,     ///< an exception out of its code
        Answer,    ///< an answer that does not fit the scenario
    };
    EngineFailure(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

}  // namespace rigor::adapter
