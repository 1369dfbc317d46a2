// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// `rigor import mjcf|urdf|sdf|mesh FILE`: beside the data sets of measurements.
#pragma once

#include <string>
#include <vector>

#include "scenarios/exchange/common/options.hpp"

namespace CLI {
class App;
}

namespace rigor::cli {

struct ModelArguments {
    models::ReadOptions options;
    std::vector<std::string> without, assets;
    std::string floor, dt;
    double timeLimit = 300.0;  ///< [s] of the reader
    bool json = false;
};

/// Adds the options that only models have.
void addModelOptions(CLI::App& command, ModelArguments& arguments);
/// True for "mjcf", "urdf", ...
bool isModelFormat(const std::string& word);
/// Reads the model in a child process and writes the scenario to `out` ("": standard output). Returns the exit code.
int importModel(const std::string& format, const std::string& file, const std::string& out,
                ModelArguments arguments);

}  // namespace rigor::cli
