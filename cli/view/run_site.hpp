// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A recorded run: the files of its report, and the frames of its trajectories at full resolution.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "cli/view/site.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::view {

/// GET /                  index.html
/// GET /<file>            a file of the report: no hidden ones, none that lead out of the folder
/// GET /trajectory/<case id>?from=N&count=M   frames N .. N + M - 1 as a bundle of arrays; README.md
class RunSite final : public Site {
  public:
    /// Throws std::invalid_argument when the folder holds no run with a report.
    explicit RunSite(const std::filesystem::path& folder);
    Reply answer(const Request& request) override;
    std::string contentSecurityPolicy() const override;

  private:
    Reply file(const std::string& path) const;
    Reply trajectory(const std::string& id, const Request& request);
    std::shared_ptr<const results::TrajectoryFile> read(const std::string& id);

    std::filesystem::path folder_;  ///< canonical
    std::mutex reading_;
    std::string lastId_;
    std::shared_ptr<const results::TrajectoryFile> last_;
};

}  // namespace rigor::view
