// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Random parameters over every scenario of the library that has a reference:
//   references_sweep [--sets N] [--seed N] [--only TEXT] [--seconds N] [--verbose]
// Each set changes the size of the scene, friction of both kinds, restitution, masses, moments of inertia,
// velocities, spins, strength and direction of gravity, duration and steps over wide ranges, zero included,
// and is computed in a child of its own under a limit of time and memory. A set is refused by the reference,
// or its answers must pass what holds for every reference:
//   finite     no state and no quantity is infinite or undefined;
//   start      exact(0) is the start of the scenario;
//   rate       away from events the velocity is the rate of change of the centre of mass (central differences
//              of order h^4 at random times; a quarter of the times may fall on events);
//   energy     kinetic and potential energy never grow where nothing drives the bodies (all of them known to
//   the
//              reference, no springs, motors, forces or events, no moving supports);
//   units      in units of length, time and mass that are powers of two, up to six decades off, the same
//   scene
//              gives the same answers (rounding is the same, so only absolute thresholds differ).
// Prints counts and every set that failed with what makes it again; exit code 1 where one did.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "scenarios/loader/loader.hpp"
#include "validation/references/parts.hpp"
#include "validation/references/tests/other_units.hpp"

namespace rigor::validation {
namespace {

using adapter::Scheme;
using scenario::BodyType;
using testing::inUnits;
using testing::Units;

struct Options {
    int sets = 1, seed = 1, seconds = 10;
    std::string only;
    bool verbose = false;
};

class Change {
  public:
    explicit Change(unsigned seed) : random_(seed) {}
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    bool chance(double share) { return uniform(0, 1) < share; }
    double decades(double reach) { return std::pow(10.0, uniform(-reach, reach)); }

    void apply(Scenario& s) {
        const bool many = chance(0.5);  // else one thing at a time
        const int one = static_cast<int>(uniform(0, 9));
        const auto picks = [&](int which) { return many ? chance(0.3) : one == which; };
        if (picks(0)) changeFriction(s);
        if (picks(1)) {
            for (auto& m : s.materials) m.restitution = coefficient(1.0);
            for (auto& p : s.pairs) p.restitution = coefficient(1.0);
        }
        if (picks(2)) forEachMass(s, 3, true);
        if (picks(3)) {
            const double factor = chance(0.3) ? 0.0 : decades(2), turn = chance(0.7) ? factor : decades(2);
            for (auto& b : s.bodies)
                b.velocity = factor * b.velocity, b.angularVelocity = turn * b.angularVelocity;
        }
        if (picks(4)) s.gravity = (chance(0.2) ? 0.0 : decades(2)) * s.gravity;
        if (picks(5)) s.duration *= decades(1.5);
        if (picks(6)) {
            const double factor = decades(1.5);
            for (double& dt : s.timeSteps) dt = std::min(factor * dt, s.duration);
        }
        if (picks(7)) {
            // Larger or smaller under the same gravity: in its own time, or in the time that it had.
            const double length = decades(3), time = chance(0.5) ? std::sqrt(length) : 1.0;
            const Vec3 gravity = s.gravity;
            Scenario other = s;
            if (inUnits(other, {length, time, chance(0.5) ? length * length * length : 1.0}))
                s = other, s.gravity = gravity;
        }
        if (picks(8)) {
            const Quat tilt =
                scenario::fromAxisAngle({0, 0, 1}, uniform(-1, 1) * std::pow(10.0, uniform(-3, 0)));
            if (chance(0.5))
                s.gravity = rotate(tilt, s.gravity);
            else
                forEachMass(s, 1, false);
        }
    }

  private:
    void changeFriction(Scenario& s) {
        const bool isOne = chance(0.6);
        const auto change = [&](auto& m) {
            m.friction = coefficient(2.0);
            m.staticFriction = isOne ? 0.0 : m.friction + coefficient(1.0);
        };
        for (auto& m : s.materials) change(m);
        for (auto& p : s.pairs) change(p);
    }
    void forEachMass(Scenario& s, double reach, bool withMass) {
        for (auto& b : s.bodies) {
            if (b.type != BodyType::Dynamic) continue;
            const double factor = decades(reach);
            if (withMass) b.massProperties.mass *= factor;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) b.massProperties.inertia(i, j) *= factor;
        }
    }
    double coefficient(double most) {
        const double kind = uniform(0, 1);
        if (kind < 0.2) return 0.0;
        if (kind < 0.3) return most;
        if (kind < 0.6) return most * std::pow(10.0, uniform(-4, 0));
        return uniform(0, most);
    }
    std::mt19937 random_;
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
        const Body& b = s.bodies[static_cast<std::size_t>(body)];
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

/// Position of the centre of mass, where the reference tells it.
std::optional<Vec3> centerAt(const Scenario& s, const Reference& r, int body, double t) {
    const Body& b = s.bodies[static_cast<std::size_t>(body)];
    const PartialState x = r.exact(body, t);
    if (!x.position) return std::nullopt;
    if (b.massProperties.centerOfMass == Vec3{}) return x.position;
    if (!x.orientation) return std::nullopt;
    return *x.position + rotate(*x.orientation, b.massProperties.centerOfMass);
}

std::string checkRate(const Scenario& s, const Reference& r, double end, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.02, 0.98);
    constexpr int kTimes = 24;
    for (const int body : r.bodies()) {
        int off = 0, told = 0;
        double worst = 0.0;
        for (int k = 0; k < kTimes; ++k) {
            const double t = share(random) * end, h = 2e-5 * end;
            const auto v = r.exact(body, t).velocity;
            const auto a = centerAt(s, r, body, t - h), b = centerAt(s, r, body, t + h),
                       a2 = centerAt(s, r, body, t - 2 * h), b2 = centerAt(s, r, body, t + 2 * h);
            if (!v || !a || !b || !a2 || !b2) continue;
            ++told;
            const Vec3 rate = (8.0 / (12 * h)) * (*b - *a) - (1.0 / (12 * h)) * (*b2 - *a2);
            const double rounding = 1e-14 * (norm(*a) + norm(*b)) / h;
            const double miss = norm(rate - *v);
            if (miss <=
                1e-5 * norm(*v) + 1e-7 * norm(*b - *a) / h + 10 * rounding + 1e-12 * lengthOf(s) / end)
                continue;
            ++off;
            worst = std::max(worst, miss);
        }
        if (told >= 8 && 4 * off > told) return at("rate", body, worst);
    }
    return "";
}

/// Kinetic and potential energy of the bodies and the scale of their changes; empty where something drives
/// them or a state is not known in full.
std::optional<double> energyAt(const Scenario& s, const Reference& r, double t) {
    double sum = 0.0;
    for (const int body : r.bodies()) {
        const Body& b = s.bodies[static_cast<std::size_t>(body)];
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
        const Body& b = s.bodies[static_cast<std::size_t>(body)];
        weight += b.massProperties.mass * norm(s.gravity) * (sizeOf(b) + lengthOf(s)) +
                  0.5 * b.massProperties.mass * dot(b.velocity, b.velocity);
    }
    std::vector<double> energy;
    for (int k = 0; k <= 40; ++k) {
        const auto e = energyAt(s, r, end * k / 40);
        if (!e) return "";
        energy.push_back(*e);
        least = std::min(least, *e), most = std::max(most, *e);
    }
    // Beside what the bodies hold: falls and drops that are long compared to the scene count as well.
    const double tolerance = 1e-7 * (weight + std::abs(least) + std::abs(most));
    for (std::size_t k = 1; k < energy.size(); ++k)
        if (energy[k] > energy[k - 1] + tolerance)
            return at("energy", r.bodies()[0], end * static_cast<double>(k) / 40);
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
                const double way = norm(*a - s.bodies[static_cast<std::size_t>(body)].pose.position);
                if (norm(*b / u.length - *a) > 1e-6 * (scale + way)) return at("units", body, t);
            }
    }
    return "";
}

/// "" where all holds, "refused: ..." or what failed.
std::string judge(Scenario s, unsigned seed) {
    Change(seed).apply(s);
    std::unique_ptr<Reference> r;
    try {
        r = makeReference(s);
    } catch (const AssumptionViolated& e) {
        return std::string("refused: ") + e.what();
    } catch (const std::invalid_argument& e) {
        return std::string("refused: ") + e.what();
    }
    if (!r->bodies().empty() && r->measured(r->bodies()[0], 0.0)) return "refused: a measurement";
    const double end = std::min(s.duration, r->validUntil());
    if (!(end >= 0.0)) return "finite: valid until " + std::to_string(end);
    std::string wrong = checkFinite(s, *r, end);
    if (wrong.empty()) wrong = checkStart(s, *r);
    if (wrong.empty() && end > 0.0) wrong = checkRate(s, *r, end, seed);
    if (wrong.empty() && end > 0.0) wrong = checkEnergy(s, *r, end);
    if (wrong.empty()) wrong = checkUnits(s, *r, end);
    return wrong;
}

/// The same in a child; "hangs", "dies" besides.
std::string judgeInChild(const Scenario& s, unsigned seed, int seconds) {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe";
    const pid_t child = fork();
    if (child < 0) return "no child";
    if (child == 0) {
        close(ends[0]);
        const auto limit = static_cast<rlim_t>(seconds);
        const rlimit time{limit, limit}, memory{rlim_t{2} << 30, rlim_t{2} << 30};
        setrlimit(RLIMIT_CPU, &time);
        setrlimit(RLIMIT_AS, &memory);
        std::string result;
        try {
            result = judge(s, seed);
        } catch (const std::exception& e) {
            result = std::string("throws: ") + e.what();
        }
        result = result.substr(0, 400);
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
        return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? "hangs" : "dies";
    return WEXITSTATUS(status) == 0 ? result : "dies";
}

int run(const Options& options) {
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"2d", "3d"})
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::string(RIGOR_SOURCE_DIR "/scenarios/library/") + folder))
            if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    int checked = 0, refused = 0, failed = 0, late = 0, scenes = 0, place = 0;
    for (const auto& file : files) {
        const Scenario s = scenario::loadScenario(file).scenario;
        if (!s.reference) continue;
        ++place;
        if (s.name.find(options.only) == std::string::npos) continue;
        ++scenes;
        for (int set = 0; set < options.sets; ++set) {
            const auto seed = static_cast<unsigned>(options.seed * 1000003 + set * 7919 + place);
            const std::string result = judgeInChild(s, seed, options.seconds);
            ++checked;
            if (result.rfind("refused", 0) == 0) {
                ++refused;
                if (options.verbose) std::printf("%s set %d: %s\n", s.name.c_str(), set, result.c_str());
            } else if (!result.empty()) {
                ++(result == "hangs" ? late : failed);
                std::printf("%s (%s) --seed %d set %d: %s\n", s.name.c_str(), s.reference->name.c_str(),
                            options.seed, set, result.c_str());
                std::fflush(stdout);
            }
        }
    }
    std::printf("%d scenarios, %d sets: %d agree, %d refused, %d failed, %d not finished in time\n", scenes,
                checked, checked - refused - failed - late, refused, failed, late);
    return failed + late == 0 && checked > 0 ? 0 : 1;
}

}  // namespace
}  // namespace rigor::validation

int main(int count, char** arguments) {
    rigor::validation::Options options;
    for (int i = 1; i < count; ++i) {
        const auto is = [&](const char* name) { return std::strcmp(arguments[i], name) == 0; };
        if (is("--verbose")) {
            options.verbose = true;
        } else if (i + 1 < count && is("--only")) {
            options.only = arguments[++i];
        } else if (i + 1 < count && is("--sets")) {
            options.sets = std::atoi(arguments[++i]);
        } else if (i + 1 < count && is("--seed")) {
            options.seed = std::atoi(arguments[++i]);
        } else if (i + 1 < count && is("--seconds")) {
            options.seconds = std::atoi(arguments[++i]);
        } else {
            std::fprintf(
                stderr,
                "usage: references_sweep [--sets N] [--seed N] [--only TEXT] [--seconds N] [--verbose]\n");
            return 2;
        }
    }
    return rigor::validation::run(options);
}
