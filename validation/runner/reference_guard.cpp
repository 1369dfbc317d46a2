// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/runner/reference_guard.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "scenarios/loader/loader.hpp"
#include "validation/references/reference.hpp"
#include "validation/runner/answer.hpp"
#include "validation/runner/child.hpp"
#include "validation/runner/describe.hpp"
#include "validation/runner/process_pool.hpp"
#include "validation/runner/start_program.hpp"

namespace rigor::validation {
namespace {

constexpr const char* kNames[] = {"none",
                                  "holds",
                                  "reference_assumption",
                                  "reference_invalid",
                                  "reference_timeout",
                                  "reference_out_of_memory",
                                  "reference_crashed"};

std::string shownSeconds(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%g s", seconds);
    return text;
}

/// A reference may do its work only when the metrics evaluate it, so its end is evaluated here. An exception
/// here is left to the metric that meets it.
void evaluateItsEnd(const scenario::Scenario& s, const Reference& reference) {
    const double end = std::min(s.duration, reference.validUntil());
    try {
        for (const int body : reference.bodies()) (void)reference.exact(body, end);
        (void)reference.quantities(s.timeSteps.front(), adapter::Scheme::Unknown);
    } catch (const std::exception&) {
    }
}

ReferenceCheck computed(const scenario::Scenario& s, const ReferenceMaker& make) {
    try {
        const auto reference = make(s);
        if (!reference) return {ReferenceOutcome::None, ""};
        evaluateItsEnd(s, *reference);
        return {ReferenceOutcome::Holds, ""};
    } catch (const AssumptionViolated& violated) {
        return {ReferenceOutcome::Assumption, violated.what()};
    } catch (const std::invalid_argument& wrong) {
        return {ReferenceOutcome::Invalid, wrong.what()};
    }
}

ReferenceCheck answered(const std::filesystem::path& answer, const ProcessResult& result,
                        const ReferenceLimits& limits) {
    const auto reply = result.exitedWith(0) ? readJsonFile(answer) : std::nullopt;
    if (reply) return {parseReferenceOutcome(reply->at("outcome")), reply->at("problem")};
    ReferenceCheck failure = referenceFailure(result.timedOut, result.status, limits);
    if (const std::string said = lastLine(result.outputTail);
        failure.outcome == ReferenceOutcome::Crashed && !said.empty())
        failure.problem += "; it said: " + said;
    return failure;
}

}  // namespace

const char* referenceOutcomeName(ReferenceOutcome outcome) {
    return kNames[static_cast<std::size_t>(outcome)];
}

ReferenceOutcome parseReferenceOutcome(const std::string& name) {
    const auto it = std::find(std::begin(kNames), std::end(kNames), name);
    if (it == std::end(kNames)) throw std::runtime_error("found outcome of a reference '" + name + "'");
    return static_cast<ReferenceOutcome>(it - std::begin(kNames));
}

bool ReferenceCheck::brokeDown() const {
    return outcome == ReferenceOutcome::Timeout || outcome == ReferenceOutcome::OutOfMemory ||
           outcome == ReferenceOutcome::Crashed;
}

std::string ReferenceCheck::text() const {
    return std::string(referenceOutcomeName(outcome)) + ": " + problem;
}

ReferenceCheck referenceFailure(bool timedOut, int status, const ReferenceLimits& limits) {
    if (timedOut || (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM))
        return {ReferenceOutcome::Timeout,
                "the reference did not finish within " + shownSeconds(limits.seconds)};
    if (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory)
        return {ReferenceOutcome::OutOfMemory,
                "the reference needed more memory than " + std::to_string(limits.memoryMiB) + " MiB"};
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return {ReferenceOutcome::OutOfMemory,
                "the system ran out of memory each time the reference was computed"};
    return {ReferenceOutcome::Crashed, "the reference crashed: " + endingOf(status)};
}

std::vector<ReferenceCheck> checkReferences(const std::vector<ReferenceQuestion>& queries,
                                            const ReferenceLimits& limits,
                                            const std::filesystem::path& binary, int jobs) {
    const ScratchFolder scratch;
    ProcessPool pool(jobs);
    std::vector<ReferenceCheck> checks(queries.size());
    // A server for one reference would cost more than the start of the program that it saves.
    const bool isServed =
        std::count_if(queries.begin(), queries.end(), [](const auto& q) { return q.hasReference; }) > 1;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        if (!queries[i].hasReference) continue;
        const auto request = scratch.path() / (std::to_string(i) + ".json"),
                   answer = scratch.path() / (std::to_string(i) + ".answer.json");
        writeJsonFile(request,
                      {{"text", queries[i].text}, {"name", queries[i].name}, {"answer", answer.string()}});
        ProcessTask task{{binary.string(), "__reference", request.string()},
                         {limits.seconds, limits.memoryMiB},
                         queries[i].name,
                         [&checks, &limits, i, answer](const ProcessResult& result) {
                             checks[i] = answered(answer, result, limits);
                         }};
        if (isServed) task.module = kNoModule;
        pool.add(std::move(task));
    }
    const std::atomic<bool> never{false};
    pool.run(never, [](const std::string&) {});
    return checks;
}

ReferenceCheck checkReference(const ReferenceQuestion& query, const ReferenceLimits& limits,
                              const std::filesystem::path& binary) {
    return checkReferences({query}, limits, binary, 1).front();
}

int referenceChild(const std::filesystem::path& requestFile, const ReferenceMaker& make) {
    const auto request = readJsonFile(requestFile);
    if (!request) throw std::runtime_error(requestFile.string() + ": no request");
    const auto s = scenario::loadScenarioText(request->at("text").get<std::string>(),
                                              request->at("name").get<std::string>())
                       .scenario;
    const ReferenceCheck check = computed(s, make);
    writeJsonFile(request->at("answer").get<std::string>(),
                  {{"outcome", referenceOutcomeName(check.outcome)}, {"problem", check.problem}});
    return 0;
}

}  // namespace rigor::validation
