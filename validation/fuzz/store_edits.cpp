// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fuzz/scratch_file.hpp"
#include "validation/fuzz/targets.hpp"
#include "validation/results/files.hpp"
#include "validation/results/store.hpp"
#include "validation/results/tests/edited_store.hpp"
#include "validation/results/tests/sample_run.hpp"

namespace rigor::fuzz {
namespace {

namespace fs = std::filesystem;

/// Content of the sample, made once.
const std::string& sampleStore() {
    static const std::string bytes = [] {
        const ScratchFolder folder("sample");
        {
            results::RunWriter writer(folder.path(), false);
            writer.writeHeader(results::sample::header());
            writer.writeCase(results::sample::caseRow("a", 0));
            writer.writeCase(results::sample::caseRow("b", 1));
        }
        results::sample::removeChecksums(folder.path() / "results.sqlite");
        return results::readFile(folder.path() / "results.sqlite");
    }();
    return bytes;
}

}  // namespace

void readStore(const std::string& bytes) {
    const fs::path file = scratchFile(sampleStore(), "results.sqlite");
    results::sample::changeStore(file, bytes);
    try {
        (void)results::readRun(file.parent_path());
    } catch (const results::EnvironmentError&) {
        // The store was refused.
    }
}

}  // namespace rigor::fuzz
