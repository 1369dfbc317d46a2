// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <functional>
#include <string>

#include "validation/runner/runner.hpp"

namespace rigor::cli {

/// A live line with counts and ETA on a terminal, one plain line per finished case, with the ETA, elsewhere;
/// both on stderr.
class ProgressLine {
  public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine();
    void update(const validation::Progress& progress);
    /// Clears the live line, so that other text may follow.
    void finish();

  private:
    std::string liveText(const validation::Progress& progress) const;
    bool quiet_, live_, shown_ = false;
};

/// Runs `work` and clears the line. If the environment fails, the message gets the command that goes on with the run:
/// `again` makes it then.
results::Run orStopped(ProgressLine& line, const std::function<std::string()>& again,
                       const std::function<results::Run()>& work);

}  // namespace rigor::cli
