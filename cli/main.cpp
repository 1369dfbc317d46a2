// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program `rigor`: every command.
#include "cli/program.hpp"
#include "validation/bench/exchange.hpp"
#include "validation/collide/exchange.hpp"
#include "validation/contact_problems/export_step.hpp"
#include "validation/contact_problems/solve.hpp"
#include "validation/fit/fit.hpp"
#include "validation/live/instance_child.hpp"

int main(int argc, char** argv) {
    using namespace rigor::cli;
    using namespace rigor::validation;
    return runProgram(argc, argv,
                      {{addValidate, addRun,    addBench,  addList,      addStudy, addPieces, addCollide,
                        addFreeze,   addSolve,  addCheck,  addCompare,   addMerge, addSweep,  addHistory,
                        addReport,   addRecord, addImport, addExport,    addFit,   addView,   addDraw,
                        addConform,  addNew,    addManual, addCompletion},
                       {{"__bench", benchChild},
                        {"__collide", collideChild},
                        {"__fit", fitChild},
                        {"__export", exportChild},
                        {"__instance", instanceChild},
                        {"__solve", solveChild}}});
}
