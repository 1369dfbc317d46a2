// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The `rigor` command: one file per sub-command, each adds itself to the parser. Argument parsing and output,
// nothing else.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "validation/runner/reference_guard.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI
namespace rigor::results {
struct CaseRow;
struct Run;
}  // namespace rigor::results
namespace rigor::scenario {
class LoadError;
struct LoadedScenario;
struct Problem;
}  // namespace rigor::scenario

namespace rigor::cli {

/// Exit codes, documented in `rigor --help` and the README.
enum ExitCode : int {
    kOk =
        0,  ///< done; for `validate`: the conditions of runIsGreen() (runner.hpp) hold, and a case was judged
    kRed = 1,       ///< the run finished and something in it is red
    kBadInput = 2,  ///< command line, scenario file or engine spec
    kInternal = 3,  ///< the environment or Rigor itself failed
    kUnsupported =
        4,  ///< the engine lacks what the scenario needs; `validate`, `merge`: every case is unsupported
    kCrashed = 5,      ///< `run`: the engine crashed
    kNoReference = 6,  ///< nothing is red, but a reference did not finish, ran out of memory or crashed
    kEnvironment =
        7,  ///< no space, no permission, killed from outside, damaged files: nothing is said of an engine
    kInterrupted = 130  ///< Ctrl-C; `validate --resume` goes on
};

/// Work of a sub-command after its arguments are parsed; returns the exit code.
using Action = std::function<int()>;

void addValidate(CLI::App& app, Action& action);
void addMerge(CLI::App& app, Action& action);
void addSweep(CLI::App& app, Action& action);
void addPieces(CLI::App& app, Action& action);
void addRun(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);
void addList(CLI::App& app, Action& action);
void addStudy(CLI::App& app, Action& action);
void addCollide(CLI::App& app, Action& action);
void addFreeze(CLI::App& app, Action& action);
void addSolve(CLI::App& app, Action& action);
void addCheck(CLI::App& app, Action& action);
void addReport(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addHistory(CLI::App& app, Action& action);
void addRecord(CLI::App& app, Action& action);
void addImport(CLI::App& app, Action& action);
void addExport(CLI::App& app, Action& action);
void addDraw(CLI::App& app, Action& action);
void addFit(CLI::App& app, Action& action);
void addView(CLI::App& app, Action& action);
void addConform(CLI::App& app, Action& action);
void addNew(CLI::App& app, Action& action);
void addNewScenario(CLI::App& command, Action& action);  ///< `scenario`, of the command `new`
void addCompletion(CLI::App& app, Action& action);
void addManual(CLI::App& app, Action& action);

/// This program's own file.
std::filesystem::path ownBinary();
/// Command line of this program, as one would type it: "./rigor validate smoke -j 2".
std::string ownCommandLine();

/// Properties of the output: whether it is a terminal, whether it can take back a line (TERM=dumb can not),
/// and whether it wants colours (NO_COLOR is respected).
bool isTerminal(int fileDescriptor);
bool canRewriteLines(int fileDescriptor);
bool wantsColour(int fileDescriptor);
int terminalColumns(int fileDescriptor);

/// "0.004", "1/240": a time step in seconds. Throws std::invalid_argument.
double parseTimeStep(const std::string& text);

/// A scenario of the library or a file, and what became of its reference, which is computed in a child with
/// limits. Throws LoadError for an unknown reference and wrong parameters. Values for which the reference
/// does not hold, and a reference that breaks down, are reported on stderr; with `mustHold` they are
/// LoadErrors, of which `isBrokenReference` recognises the second kind.
scenario::LoadedScenario loadWithReference(const std::string& nameOrFile,
                                           const std::vector<std::string>& overrides,
                                           const validation::ReferenceLimits& limits, bool mustHold = false,
                                           validation::ReferenceCheck* found = nullptr);
bool isBrokenReference(const scenario::Problem& problem);

/// True if a name is that of a suite of the library, or a file that is one.
bool isSuite(const std::string& name);
/// The scenarios of `given`, in which suites stand for theirs.
std::vector<std::string> scenarioNames(const std::vector<std::string>& given);

/// Completion offers names of one kind as a value of `option`. Every other value stays allowed. Returns `option`.
inline constexpr const char *kEngineNames = "engine names", *kScenarioNames = "scenario names",
                            *kSuiteNames = "suite names", *kStudyNames = "study names",
                            *kCollisionNames = "collision names";
CLI::Option* offerNames(CLI::Option* option, const char* kind);

/// --engines SPECS, or other flags; an empty list is an error.
void addEngines(CLI::App& command, std::string& engines, const std::string& help,
                const std::string& flags = "--engines");

/// Type of options whose texts may be empty, as the word is that a command line ends with before it is begun.
inline constexpr const char* kMayBeEmpty = "WORD";

/// Exit code of a finished run of `validate` or `merge`. Says on standard error that nothing was judged where every case
/// is unsupported.
int endOfRun(const results::Run& run);
/// Says on standard error which of the engines have no case that they support, in a run in which others have.
void sayIdleEngines(const results::Run& run);

/// --reference-limit SECONDS
void addReferenceLimit(CLI::App& command, validation::ReferenceLimits& limits);

/// True if an error against the exact solution misses its bound and `--set` changed more than bounds. Such errors
/// grow with the values, while the bound belongs to those of the file; that a body rests holds for any.
bool missesByOtherValues(const results::CaseRow& row, const std::vector<std::string>& overrides);

inline constexpr const char* kBoundsNote =
    "the bounds were set at the file's own values; for other values judge the errors and their order, or "
    "give bounds: --set accept.rigor.METRIC=VALUE";

/// Says on stderr what became better or worse in a run since `baseline`: run folders with commas between, or
/// "recorded". Throws std::invalid_argument where there is no such run.
bool becameWorseThan(const std::string& baseline, const std::filesystem::path& run);
/// Folder in which the library keeps the recorded results of each engine version.
std::filesystem::path recordedFolder();
/// Throws std::invalid_argument when `baseline` names no run; empty is fine.
void checkBaseline(const std::string& baseline);

/// Prints "rigor: MESSAGE" to stderr. Control characters, which may come from a file or a module, are escaped.
void say(const std::string& message);

/// `code`, or kEnvironment with a message if the standard output could not be written to its end.
int withOutputWritten(int code);

/// Prints every problem of a LoadError to stderr, as text or as a JSON array on stdout.
void printProblems(const scenario::LoadError& error, bool json);

}  // namespace rigor::cli
