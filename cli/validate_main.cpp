// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program `rigor-validate`: the commands that run scenarios and report. The launcher knows them by name.
#include "cli/program.hpp"

int main(int argc, char** argv) {
    using namespace rigor::cli;
    return runProgram(argc, argv,
                      {{addValidate, addRun, addList, addCheck, addCompare, addReport, addRecord, addMerge,
                        addCompletion}});
}
