// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/report.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "cli/command.hpp"
#include "validation/results/files.hpp"

namespace rigor::cli {

void addReport(CLI::App& app, Action& action) {
    auto directory = std::make_shared<std::string>();
    auto* command = app.add_subcommand("report", "Write the reports of a stored run again");
    command->add_option("RUN", *directory, "Run folder (as written by validate)")
        ->required()
        ->check(CLI::ExistingDirectory);
    command->callback([directory, &action] {
        action = [directory] {
            try {
                std::vector<std::string> problems;
                for (const auto& file : report::writeReports(*directory, &problems))
                    std::printf("%s\n", file.string().c_str());
                for (const auto& problem : problems) say(problem);
                if (!problems.empty()) return static_cast<int>(kEnvironment);
            } catch (const results::EnvironmentError&) {
                throw;
            } catch (const std::runtime_error& error) {  // no run, a broken one, or a folder we may not write
                say(error.what());
                return static_cast<int>(kBadInput);
            }
            return static_cast<int>(kOk);
        };
    });
}

}  // namespace rigor::cli
