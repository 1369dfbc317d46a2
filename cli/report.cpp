// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/report.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.hpp"

namespace rigor::cli {

void addReport(CLI::App& app, Action& action) {
    auto directory = std::make_shared<std::string>();
    auto* command = app.add_subcommand("report", "Write the reports of a stored run again");
    command->add_option("RUN", *directory, "Run folder (as written by validate)")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->callback([directory, &action] {
        action = [directory] {
            for (const auto& file : report::writeReports(*directory))
                std::printf("%s\n", file.string().c_str());
            return static_cast<int>(kOk);
        };
    });
}

}  // namespace rigor::cli
