// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The program runs itself again for everything that touches an engine or computes a reference: `__case`,
// `__audit`, `__describe`, `__reference`, and what other folders of validation/ add.
#include "validation/runner/child.hpp"

#include <unistd.h>

#include <fcntl.h>
#include <cerrno>
#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>

#include "adapters/interface/engine_failure.hpp"
#include "scenarios/loader/loader.hpp"
#include "validation/results/files.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/audit.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/judge.hpp"
#include "validation/runner/line_file.hpp"
#include "validation/runner/live.hpp"
#include "validation/runner/pieces.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/refusal.hpp"
#include "validation/runner/serve.hpp"
#include "validation/symmetry/listing.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;
using results::CaseRow;
using results::Outcome;

[[noreturn]] void onOutOfMemory() {
    _exit(kExitOutOfMemory);
}

CaseRow failedRow(const json& request, const adapter::EngineSpec& spec, Outcome outcome, const char* reason) {
    CaseRow row = rowWithout(request.at("scenario"), spec, numberFromJson(request.at("dt")));
    row.outcome = outcome;
    row.reason = reason;
    return row;
}

Outcome outcomeOf(const adapter::EngineFailure& failure) {
    switch (failure.kind()) {
        case adapter::EngineFailure::Kind::Died:
            return Outcome::Crashed;
        case adapter::EngineFailure::Kind::Silent:
            return Outcome::Timeout;
        case adapter::EngineFailure::Kind::Memory:
            return Outcome::OutOfMemory;
        case adapter::EngineFailure::Kind::Protocol:
        case adapter::EngineFailure::Kind::Threw:
        case adapter::EngineFailure::Kind::Answer:
            break;
    }
    return Outcome::Error;
}

/// Options of a run. After the mark, the end of this process is due to the reference, which has a time limit
/// of its own.
LiveOptions optionsOf(const json& request, const ReferenceMaker& make) {
    LiveOptions options;
    options.makeReference = make;
    if (request.contains("without_reference")) {
        const json& why = request.at("without_reference");
        options.withoutReference =
            ReferenceCheck{parseReferenceOutcome(why.at("outcome")), why.at("problem").get<std::string>()};
        return options;
    }
    options.onSimulated = [mark = request.at("simulated").get<std::string>(),
                           seconds = numberFromJson(request.at("reference_seconds"))] {
        results::replaceScratchFile(mark, "\n");
        setAlarm(seconds * timeLimitFactor());
    };
    return options;
}

std::vector<results::MetricRow> piecesOf(const scenario::Scenario& s, const adapter::EngineSpec& spec,
                                         double dt, const std::vector<int>& every,
                                         const Reference* reference) {
    const adapter::LoadedEngine engine = adapter::loadEngine(spec);
    const adapter::Settings settings = adapter::resolveSettings(spec, *engine);
    return measurePieces(
        s, dt, every, [&](double step) { return engine.build(s, step, settings); }, reference);
}

void removeMark(const json& request) {
    std::error_code ignored;
    if (request.contains("simulated"))
        std::filesystem::remove(request.at("simulated").get<std::string>(), ignored);
}

/// The reference has been evaluated completely: its time and its mark end.
void endReference(const json& request) {
    setAlarm(0.0);
    removeMark(request);
}

/// A library that finds no file handle reports it in words of its own. Throws EnvironmentError if there is none.
void checkHandles() {
    const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (file < 0) throw results::EnvironmentError("/dev/null", "cannot be opened", errno);
    close(file);
}

CaseRow runRequested(const json& request, const scenario::Scenario& s, const adapter::EngineSpec& spec,
                     const ReferenceMaker& make) {
    const double dt = numberFromJson(request.at("dt"));
    LiveOptions options = optionsOf(request, make);
    if (const int order = request.value("order", 0); order > 0)
        options.given = listed(s, otherListings(s, order).back());
    WholeCase whole = runWholeCase(s, spec, dt, options);
    CaseRow& row = whole.live.row;
    row.id = request.at("id");
    if (options.given) {
        endReference(request);
        return std::move(row);
    }
    const auto file = request.at("trajectory").get<std::string>();
    results::writeTrajectory(
        file, trajectoryFile({s, whole.live.trajectory, whole.reference.get(), whole.scheme}, row));
    endReference(request);
    if (const auto every = request.value("pieces", std::vector<int>{}); !every.empty())
        for (auto& piece : piecesOf(s, spec, dt, every, whole.reference.get())) row.metrics.push_back(piece);
    return std::move(row);
}

int caseChild(const std::filesystem::path& requestFile, const ReferenceMaker& make) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    const scenario::Scenario s = scenario::loadScenarioText(request->at("text").get<std::string>(),
                                                            request->at("scenario").get<std::string>())
                                     .scenario;
    const adapter::EngineSpec spec = adapter::parseSpec(request->at("spec").get<std::string>());
    removeMark(*request);  // An attempt that was killed from outside may have left it.
    CaseRow row;
    bool ran = false;
    try {
        row = runRequested(*request, s, spec, make);
        ran = true;
    } catch (const adapter::Unsupported& error) {
        row = refusedRow(s.name, spec, numberFromJson(request->at("dt")), error);
    } catch (const adapter::EngineFailure& failure) {
        row = failedRow(*request, spec, outcomeOf(failure), failure.what());
    } catch (const results::EnvironmentError&) {
        throw;
    } catch (const std::exception& error) {
        checkHandles();
        row = failedRow(*request, spec, Outcome::Error, error.what());
    }
    if (!ran) judgeCase(row, s);
    writeJsonFile(request->at("answer").get<std::string>(), caseToJson(row));
    return 0;
}

int dispatch(const std::vector<std::string>& arguments, const ChildEntries& more,
             const ReferenceMaker& make) {
    const std::string what = arguments.empty() ? "" : arguments[0];
    if (const auto it = more.find(what); it != more.end() && arguments.size() == 2)
        return it->second(arguments[1]);
    if (what == "__case" && arguments.size() == 2) return caseChild(arguments[1], make);
    if (what == "__reference" && arguments.size() == 2) return referenceChild(arguments[1], make);
    if (what == "__audit" && arguments.size() == 2) return auditChild(arguments[1]);
    if (what == "__describe" && arguments.size() == 3) return describeChild(arguments[1], arguments[2]);
    constexpr std::size_t kServeArguments = 4;  // the last one is room
    if (what == kServeCommand && arguments.size() == kServeArguments)
        return dispatch(serveRequests(arguments[1], std::stoi(arguments[2])), more, make);
    std::fprintf(stderr, "rigor: '%s' is not for people\n", what.c_str());
    return 2;
}

}  // namespace

int childMain(const std::vector<std::string>& arguments, const ChildEntries& more,
              const ReferenceMaker& make) {
    std::set_new_handler(onOutOfMemory);
    int code = 1;
    try {
        try {
            code = dispatch(arguments, more, make ? make : ReferenceMaker(makeReference));
        } catch (const results::EnvironmentError&) {
            throw;
        } catch (const std::filesystem::filesystem_error& error) {
            throw results::EnvironmentError(error.path1(), error.what(), error.code().value());
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            checkHandles();
        }
    } catch (const results::EnvironmentError& error) {
        std::fprintf(stderr, "\n%s%s\n", kEnvironmentMark, error.what());
        code = kExitEnvironment;
    }
    // The result is on the disk: what a library does while it is taken down is no part of it.
    std::fflush(nullptr);
    _exit(code);
}

}  // namespace rigor::validation
