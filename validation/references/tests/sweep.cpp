// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random parameters over every scenario of the library that has a reference:
//   references_sweep [--sets N] [--seed N] [--only TEXT] [--seconds N] [--verbose] [--refusals]
//   references_sweep --only NAME --seed N --write SET      the scenario of one set, as JSON
// Each set changes the values of the scene (random_change.hpp) and is computed in a child of its own under a
// limit of time and memory. A set is refused by the reference, or its results must pass the tests that hold
// for every reference:
//   time       making the reference, its last state and its quantities take less than the limit;
//   finite     no state and no quantity is infinite or undefined;
//   start      exact(0) is the start of the scenario;
//   rate       away from events the velocity is the rate of change of the centre of mass (central differences
//              of order h^4 at random times; a quarter of the times may fall on events);
//   energy     kinetic and potential energy never grow where nothing drives the bodies (all of them known to
//              the reference, no springs, motors, forces or events, no moving supports);
//   units      in units of length, time and mass that are powers of two, up to six decades off, the same
//              scene gives the same results (rounding is the same, so only absolute thresholds differ).
// Prints counts and every set that failed with what makes it again; with --refusals for each scenario how
// many sets were refused, why, and the longest time. Exit code 1 where a set failed.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>

#include "scenarios/loader/loader.hpp"
#include "scenarios/loader/write.hpp"
#include "validation/references/parts.hpp"
#include "validation/references/tests/random_change.hpp"

namespace rigor::validation {
namespace {

using adapter::Scheme;
using scenario::BodyType;
using testing::inUnits;
using testing::Units;

struct Options {
    int sets = 1, seed = 1, seconds = 10, write = -1;
    std::string only;
    bool verbose = false, refusals = false;
};

// ------------------------------------------------------------------------------------------------- checks
double lengthOf(const Scenario& s) {
    double most = 0.0;
    for (const auto& b : s.bodies)
        if (b.type == BodyType::Dynamic) most = std::max({most, norm(b.pose.position), sizeOf(b)});
    return most;
}
bool finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
std::string at(const char* what, int body, double t) {
    char text[160];
    std::snprintf(text, sizeof text, "%s: body %d at t = %.9g", what, body, t);
    return text;
}

std::string checkFinite(const Scenario& s, const Reference& r, double end) {
    for (const auto& q : r.quantities(s.timeSteps.empty() ? 0.01 : s.timeSteps[0], Scheme::Unknown))
        if (!std::isfinite(q.exact) || !std::isfinite(q.scale)) return "finite: quantity " + q.name;
    for (const int body : r.bodies())
        for (int k = 0; k <= 40; ++k) {
            const double t = end * k / 40;
            const PartialState x = r.exact(body, t);
            if ((x.position && !finite(*x.position)) || (x.velocity && !finite(*x.velocity)) ||
                (x.angularVelocity && !finite(*x.angularVelocity)) ||
                (x.orientation &&
                 !std::isfinite(x.orientation->w + x.orientation->x + x.orientation->y + x.orientation->z)))
                return at("finite", body, t);
        }
    return "";
}

std::string checkStart(const Scenario& s, const Reference& r) {
    for (const int body : r.bodies()) {
        const Body& b = s.bodies[body];
        const PartialState x = r.exact(body, 0.0);
        if (x.position && norm(*x.position - b.pose.position) > 1e-4 * (sizeOf(b) + lengthOf(s)))
            return at("start: position", body, 0);
        const double fast = norm(b.velocity) + norm(b.angularVelocity) * sizeOf(b);
        // A start in contact may be one whose impact is over.
        if (x.velocity && norm(*x.velocity) > 2.1 * fast + 1e-6 * std::sqrt(norm(s.gravity) * sizeOf(b)) &&
            r.bodies().size() == 1 && b.type == BodyType::Dynamic)
            return at("start: velocity", body, 0);
    }
    return "";
}

/// Position of the centre of mass, if the reference determines it.
std::optional<Vec3> centerAt(const Scenario& s, const Reference& r, int body, double t) {
    const Body& b = s.bodies[body];
    const PartialState x = r.exact(body, t);
    if (!x.position) return std::nullopt;
    if (b.massProperties.centerOfMass == Vec3{}) return x.position;
    if (!x.orientation) return std::nullopt;
    return *x.position + rotate(*x.orientation, b.massProperties.centerOfMass);
}

/// Deviation of the velocity from the rate of change of the position, by differences h apart; zero within the
/// error of rounding and differences, empty if the reference does not determine them.
std::optional<double> rateMiss(const Scenario& s, const Reference& r, int body, double t, double end,
                               double h) {
    const auto v = r.exact(body, t).velocity;
    const auto a = centerAt(s, r, body, t - h), b = centerAt(s, r, body, t + h),
               a2 = centerAt(s, r, body, t - 2 * h), b2 = centerAt(s, r, body, t + 2 * h);
    if (!v || !a || !b || !a2 || !b2) return std::nullopt;
    const Vec3 rate = (8.0 / (12 * h)) * (*b - *a) - (1.0 / (12 * h)) * (*b2 - *a2);
    const double rounding = 1e-14 * (norm(*a) + norm(*b)) / h;
    const double miss = norm(rate - *v);
    const double open =
        1e-5 * norm(*v) + 1e-7 * norm(*b - *a) / h + 10 * rounding + 1e-12 * lengthOf(s) / end;
    return miss <= open ? 0.0 : miss;
}

std::string checkRate(const Scenario& s, const Reference& r, double end, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.02, 0.98);
    constexpr int kTimes = 24;
    for (const int body : r.bodies()) {
        int off = 0, determined = 0;
        double worst = 0.0;
        for (int k = 0; k < kTimes; ++k) {
            const double t = share(random) * end;
            const auto coarse = rateMiss(s, r, body, t, end, 2e-5 * end);
            if (!coarse) continue;
            ++determined;
            if (*coarse <= 0.0) continue;
            // The wide difference itself is too coarse for hundreds of swings in the run.
            const auto fine = rateMiss(s, r, body, t, end, 2e-6 * end);
            if (fine && *fine <= 0.0) continue;
            worst = std::max(worst, *coarse);
            ++off;
        }
        if (determined >= 8 && 4 * off > determined) return at("rate", body, worst);
    }
    return "";
}

/// Kinetic and potential energy of the bodies and the scale of their changes; empty where something drives
/// them or a state is not known in full.
std::optional<double> energyAt(const Scenario& s, const Reference& r, double t) {
    for (const Body& body : s.bodies)
        for (const scenario::Shape& shape : body.shapes)
            if (shape.surfaceVelocity.moves()) return std::nullopt;
    double sum = 0.0;
    for (const int body : r.bodies()) {
        const Body& b = s.bodies[body];
        const PartialState x = r.exact(body, t);
        const auto center = centerAt(s, r, body, t);
        if (!center || !x.velocity || !x.angularVelocity || !x.orientation) return std::nullopt;
        const Vec3 w = rotateInverse(*x.orientation, *x.angularVelocity);
        const double spin = s.dimension == 2 ? b.massProperties.inertia(2, 2) * w.z * w.z
                                             : dot(w, b.massProperties.inertia * w);
        sum += 0.5 * b.massProperties.mass * dot(*x.velocity, *x.velocity) + 0.5 * spin -
               b.massProperties.mass * b.gravityScale * dot(s.gravity, *center);
    }
    return sum;
}
bool nothingDrives(const Scenario& s, const Reference& r) {
    if (!s.forces.empty() || !s.events.empty()) return false;
    std::size_t dynamic = 0;
    for (const Body& b : s.bodies) {
        if (b.type == BodyType::Dynamic) ++dynamic;
        if (b.type != BodyType::Dynamic && (b.velocity != Vec3{} || b.angularVelocity != Vec3{}))
            return false;
    }
    for (const auto& joint : s.joints)
        for (const auto& axis : joint.axes)
            if (axis.hasMotor() || axis.hasSpring()) return false;
    return r.bodies().size() == dynamic;
}
std::string checkEnergy(const Scenario& s, const Reference& r, double end) {
    if (!nothingDrives(s, r)) return "";
    double weight = 0.0, least = 1e300, most = -1e300;
    for (const int body : r.bodies()) {
        const Body& b = s.bodies[body];
        weight += b.massProperties.mass * norm(s.gravity) * (sizeOf(b) + lengthOf(s)) +
                  0.5 * b.massProperties.mass * dot(b.velocity, b.velocity);
    }
    std::vector<double> energy;
    for (int k = 0; k <= 40; ++k) {
        const auto e = energyAt(s, r, end * k / 40);
        if (!e) return "";
        energy.push_back(*e);
        least = std::min(least, *e);
        most = std::max(most, *e);
    }
    // Tolerance relative to the energies of the bodies: falls and drops that are long compared to the scene
    // count as well.
    const double tolerance = 1e-7 * (weight + std::abs(least) + std::abs(most));
    for (std::size_t k = 1; k < energy.size(); ++k)
        if (energy[k] > energy[k - 1] + tolerance) return at("energy", r.bodies()[0], end * k / 40);
    return "";
}

std::string checkUnits(const Scenario& s, const Reference& r, double end) {
    const double big = std::ldexp(1.0, 20), small = std::ldexp(1.0, -20);
    const Units units[] = {{big, 1024, 1}, {small, 1, small}, {1, 1.0 / 32, 64}};
    for (const Units& u : units) {
        Scenario other = s;
        if (!inUnits(other, u)) return "";
        std::unique_ptr<Reference> same;
        try {
            same = makeReference(other);
        } catch (const AssumptionViolated& e) {
            return std::string("units: refused: ") + e.what();
        }
        const double scale = lengthOf(s), until = std::min(other.duration, same->validUntil()) / u.time;
        if (std::abs(until - end) > 1e-6 * s.duration) return at("units: valid until", 0, until);
        for (const int body : r.bodies())
            for (int k = 0; k <= 16; ++k) {
                const double t = end * k / 16;
                const auto a = r.exact(body, t).position, b = same->exact(body, t * u.time).position;
                if (!a || !b) continue;
                const double way = norm(*a - s.bodies[body].pose.position);
                if (norm(*b / u.length - *a) > 1e-6 * (scale + way)) return at("units", body, t);
            }
    }
    return "";
}

/// Result of a set: "" if all holds, "refused: ..." or what failed.
struct Judged {
    std::string text;
    double seconds = 0.0;  ///< processor time of making the reference, its last state and its quantities
};

Judged judge(Scenario s, unsigned seed, double longest) {
    testing::Change(seed).apply(s);
    std::unique_ptr<Reference> r;
    const std::clock_t start = std::clock();
    Judged judged;
    const auto stop = [&] {
        judged.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        if (judged.seconds > longest) judged.text = "time: " + std::to_string(judged.seconds) + " s";
    };
    try {
        r = makeReference(s);
        for (const int body : r->bodies()) (void)r->exact(body, std::min(s.duration, r->validUntil()));
        (void)r->quantities(s.timeSteps.empty() ? 0.01 : s.timeSteps[0], Scheme::Unknown);
    } catch (const AssumptionViolated& e) {
        judged.text = std::string("refused: ") + e.what();
    } catch (const std::invalid_argument& e) {
        judged.text = std::string("refused: ") + e.what();
    }
    stop();
    if (!judged.text.empty()) return judged;
    if (!r->bodies().empty() && r->measured(r->bodies()[0], 0.0)) {
        judged.text = "refused: a measurement";
        return judged;
    }
    const double end = std::min(s.duration, r->validUntil());
    if (!(end >= 0.0)) {
        judged.text = "finite: valid until " + std::to_string(end);
        return judged;
    }
    std::string& wrong = judged.text;
    wrong = checkFinite(s, *r, end);
    if (wrong.empty()) wrong = checkStart(s, *r);
    if (wrong.empty() && end > 0.0) wrong = checkRate(s, *r, end, seed);
    if (wrong.empty() && end > 0.0) wrong = checkEnergy(s, *r, end);
    if (wrong.empty()) wrong = checkUnits(s, *r, end);
    return judged;
}

/// The same in a child; "hangs", "dies" besides.
Judged judgeInChild(const Scenario& s, unsigned seed, const Options& options) {
    int ends[2];
    if (pipe(ends) != 0) return {"no pipe", 0};
    const pid_t child = fork();
    if (child < 0) return {"no child", 0};
    if (child == 0) {
        close(ends[0]);
        // The checks make the reference three times more.
        const auto limit = static_cast<rlim_t>(5 * options.seconds);
        const rlimit time{limit, limit}, memory{rlim_t{2} << 30, rlim_t{2} << 30};
        setrlimit(RLIMIT_CPU, &time);
        setrlimit(RLIMIT_AS, &memory);
        Judged judged;
        try {
            judged = judge(s, seed, options.seconds);
        } catch (const std::exception& e) {
            judged.text = std::string("throws: ") + e.what();
        }
        const std::string result = std::to_string(judged.seconds) + " " + judged.text.substr(0, 400);
        const auto written = write(ends[1], result.data(), result.size());
        _exit(written == static_cast<ssize_t>(result.size()) ? 0 : 3);
    }
    close(ends[1]);
    std::string result;
    char buffer[512];
    for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
        result.append(buffer, static_cast<std::size_t>(n));
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        return {WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? "hangs" : "dies", 0};
    const auto space = result.find(' ');
    if (WEXITSTATUS(status) != 0 || space == std::string::npos) return {"dies", 0};
    return {result.substr(space + 1), std::atof(result.c_str())};
}

// ---------------------------------------------------------------------------------------------- the sweep
unsigned seedOf(const Options& options, int set, int place) {
    return options.seed * 1000003 + set * 7919 + place;
}

void writeSet(const std::filesystem::path& file, Scenario s, unsigned seed) {
    testing::Change(seed).apply(s);
    auto json = nlohmann::ordered_json::parse(scenario::scenarioText(s));
    std::ifstream original(file);
    json["reference"] = nlohmann::ordered_json::parse(original).at("reference");
    std::printf("%s\n", json.dump(1).c_str());
}

struct Counts {
    int checked = 0, refused = 0, failed = 0, late = 0;
};

/// The sets of one scenario.
void sweep(const Scenario& s, const Options& options, int place, Counts& all) {
    double longest = 0.0;
    std::map<std::string, int> reasons;
    int refused = 0;
    for (int set = 0; set < options.sets; ++set) {
        const Judged judged = judgeInChild(s, seedOf(options, set, place), options);
        longest = std::max(longest, judged.seconds);
        ++all.checked;
        if (judged.text.rfind("refused: ", 0) == 0) {
            ++refused;
            ++reasons[judged.text.substr(9)];
            if (options.verbose) std::printf("%s set %d: %s\n", s.name.c_str(), set, judged.text.c_str());
        } else if (!judged.text.empty()) {
            ++(judged.text == "hangs" ? all.late : all.failed);
            std::printf("%s (%s) --seed %d set %d: %s\n", s.name.c_str(), s.reference->name.c_str(),
                        options.seed, set, judged.text.c_str());
            std::fflush(stdout);
        }
    }
    all.refused += refused;
    if (!options.refusals) return;
    std::printf("%-28s %4d of %4d refused, longest %.2f s\n", s.name.c_str(), refused, options.sets, longest);
    for (const auto& [reason, count] : reasons) std::printf("    %4d  %s\n", count, reason.c_str());
}

int run(const Options& options) {
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"2d", "3d"})
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::string(RIGOR_SOURCE_DIR "/scenarios/library/") + folder))
            if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    Counts all;
    int scenes = 0, place = 0;
    for (const auto& file : files) {
        const Scenario s = scenario::loadScenario(file).scenario;
        if (!s.reference) continue;
        ++place;
        if (options.write >= 0 ? s.name != options.only : s.name.find(options.only) == std::string::npos)
            continue;
        ++scenes;
        if (options.write >= 0)
            writeSet(file, s, seedOf(options, options.write, place));
        else
            sweep(s, options, place, all);
    }
    if (options.write >= 0) return scenes == 1 ? 0 : 1;
    std::printf("%d scenarios, %d sets: %d agree, %d refused, %d failed, %d not finished in time\n", scenes,
                all.checked, all.checked - all.refused - all.failed - all.late, all.refused, all.failed,
                all.late);
    return all.failed + all.late == 0 && all.checked > 0 ? 0 : 1;
}

}  // namespace
}  // namespace rigor::validation

int main(int count, char** arguments) {
    rigor::validation::Options options;
    for (int i = 1; i < count; ++i) {
        const auto is = [&](const char* name) { return std::strcmp(arguments[i], name) == 0; };
        if (is("--verbose")) {
            options.verbose = true;
        } else if (is("--refusals")) {
            options.refusals = true;
        } else if (i + 1 < count && is("--only")) {
            options.only = arguments[++i];
        } else if (i + 1 < count && is("--sets")) {
            options.sets = std::atoi(arguments[++i]);
        } else if (i + 1 < count && is("--seed")) {
            options.seed = std::atoi(arguments[++i]);
        } else if (i + 1 < count && is("--seconds")) {
            options.seconds = std::atoi(arguments[++i]);
        } else if (i + 1 < count && is("--write")) {
            options.write = std::atoi(arguments[++i]);
        } else {
            std::fprintf(stderr,
                         "usage: references_sweep [--sets N] [--seed N] [--only TEXT] [--seconds N] "
                         "[--verbose] [--refusals] [--write SET]\n");
            return 2;
        }
    }
    return rigor::validation::run(options);
}
