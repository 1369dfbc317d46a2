// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Bodies of every shape struck in free space: what an impulse J and an angular impulse L make of them shows
// their mass properties: v = J/m, w = I^-1 L, then free rotation (rotation.hpp). Mass, centre and inertia are
// taken from shape and density by closed forms of this file, not from the scenario's own:
//   ball 2/5 m r^2, disc m r^2/2; box m (b^2 + c^2)/3 (half sizes); cylinder m r^2/2 and m (3 r^2 + 4
//   h^2)/12; cone 3/10 m r^2 and 3 m (r^2 + h^2/4)/20 about its centre, h/4 above the base (h: its height);
//   capsule from cylinder and two half balls; polygons and polyhedra as sums of triangles and tetrahedra from
//   one corner.
// Source: Beer and Johnston, Vector Mechanics for Engineers; Mirtich, J. Graph. Tools 1 (1996) 31
// (polyhedra). Assumes: one shape per body; mass as the scenario gives it; gravity off; at rest until its
// event; nothing touches. Scheme-exact: velocities as exact, positions where the event comes at a step.
#include <algorithm>
#include <cmath>

#include "validation/references/flight/rotation.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {
namespace {

constexpr double kCircle = 3.14159265358979323846;

struct Mass {
    double amount = 0.0;  ///< volume (area in 2D)
    Vec3 center;
    Mat3 moments;  ///< moments about the centre, per density
};

double at(const Mat3& m, int i, int j) {
    return m(i, j);
}

Mass solidOfRevolution(double volume, double along, double across, double shift) {
    return {volume, {0, shift, 0}, Mat3::diagonal(across, along, across)};
}

Mass capsule3(double r, double h) {
    const double cylinder = kCircle * r * r * 2 * h, caps = 4.0 / 3 * kCircle * r * r * r, length = 2 * h;
    return solidOfRevolution(cylinder + caps, cylinder * r * r / 2 + caps * 0.4 * r * r,
                             cylinder * (length * length / 12 + r * r / 4) +
                                 caps * (0.4 * r * r + length * length / 4 + 3.0 / 8 * length * r),
                             0.0);
}
Mass capsule2(double r, double h) {
    // A rectangle and two half discs, each with its centre 4 r/(3 pi) beyond the end.
    const double box = 4 * r * h, caps = kCircle * r * r, out = 4 * r / (3 * kCircle);
    const double halves = caps * (r * r / 2 - out * out + (h + out) * (h + out));
    return {box + caps, {}, Mat3::diagonal(1, 1, box * (r * r + h * h) / 3 + halves)};
}

/// Second moments of a simplex from the origin: integral of x x^T, from Mirtich's reduction to corners.
Mass simplices(const std::vector<std::vector<Vec3>>& parts, int dimension) {
    double amount = 0.0;
    Vec3 first;
    Mat3 second;
    const auto entry = [](Vec3 v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
    for (const auto& c : parts) {
        const double det = dimension == 2 ? c[0].x * c[1].y - c[0].y * c[1].x : dot(c[0], cross(c[1], c[2]));
        const double size = det / (dimension == 2 ? 2 : 6), n = dimension;
        Vec3 sum;
        for (const Vec3 v : c) sum += v;
        amount += size;
        first += (size / (n + 1)) * sum;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                double product = entry(sum, i) * entry(sum, j);
                for (const Vec3 v : c) product += entry(v, i) * entry(v, j);
                second(i, j) += size / ((n + 1) * (n + 2)) * product;
            }
    }
    Mass mass;
    mass.amount = amount;
    mass.center = first / amount;
    const double trace = at(second, 0, 0) + at(second, 1, 1) + at(second, 2, 2),
                 cc = dot(mass.center, mass.center);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            mass.moments(i, j) = (i == j ? trace - amount * cc : 0.0) - at(second, i, j) +
                                 amount * entry(mass.center, i) * entry(mass.center, j);
    return mass;
}

/// Triangles of the hull's faces, outwards, by trying every triple of corners: small hulls only.
std::vector<std::vector<Vec3>> hullFaces(const std::vector<Vec3>& corners, const std::string& subject) {
    require(corners.size() <= 64, subject + " has too many corners");
    std::vector<std::vector<Vec3>> faces;
    const std::size_t n = corners.size();
    double size = 0.0;
    for (const Vec3 v : corners) size = std::max(size, norm(v - corners[0]));
    std::vector<std::pair<Vec3, double>> planes;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < n; ++k) {
                const Vec3 normal = cross(corners[j] - corners[i], corners[k] - corners[i]);
                if (i == j || j == k || i == k || norm(normal) < 1e-12 * size * size) continue;
                const Vec3 u = unit(normal);
                const double offset = dot(u, corners[i]);
                const bool outer = std::all_of(corners.begin(), corners.end(),
                                               [&](Vec3 v) { return dot(u, v) <= offset + 1e-9 * size; });
                const bool known = std::any_of(planes.begin(), planes.end(), [&](const auto& p) {
                    return dot(p.first, u) > 1 - 1e-9 && std::abs(p.second - offset) < 1e-9 * size;
                });
                if (!outer || known) continue;
                planes.push_back({u, offset});
                // The corners on this plane, in order about their middle.
                std::vector<Vec3> on;
                Vec3 middle;
                for (const Vec3 v : corners)
                    if (dot(u, v) > offset - 1e-9 * size) {
                        on.push_back(v);
                        middle += v;
                    }
                middle = middle / on.size();
                const Vec3 s = unit(on[0] - middle), t = cross(u, s);
                std::sort(on.begin(), on.end(), [&](Vec3 a, Vec3 b) {
                    return std::atan2(dot(t, a - middle), dot(s, a - middle)) <
                           std::atan2(dot(t, b - middle), dot(s, b - middle));
                });
                for (std::size_t m = 1; m + 1 < on.size(); ++m) faces.push_back({on[0], on[m], on[m + 1]});
            }
    return faces;
}

Mass massOf(const scenario::Geometry& geometry, int dimension, const std::string& subject) {
    const bool flat = dimension == 2;
    if (const auto* s = std::get_if<scenario::Sphere>(&geometry)) {
        const double r = s->radius, amount = flat ? kCircle * r * r : 4.0 / 3 * kCircle * r * r * r;
        const double i = (flat ? 0.5 : 0.4) * amount * r * r;
        return {amount, {}, Mat3::diagonal(i, i, i)};
    }
    if (const auto* b = std::get_if<scenario::Box>(&geometry)) {
        const Vec3 h = b->halfExtents;
        const double amount = flat ? 4 * h.x * h.y : 8 * h.x * h.y * h.z, k = amount / 3;
        const double z = flat ? 0.0 : h.z;
        return {
            amount,
            {},
            Mat3::diagonal(k * (h.y * h.y + z * z), k * (h.x * h.x + z * z), k * (h.x * h.x + h.y * h.y))};
    }
    if (const auto* c = std::get_if<scenario::Capsule>(&geometry))
        return flat ? capsule2(c->radius, c->halfLength) : capsule3(c->radius, c->halfLength);
    if (const auto* c = std::get_if<scenario::Cylinder>(&geometry)) {
        const double r = c->radius, h = c->halfLength, volume = kCircle * r * r * 2 * h;
        return solidOfRevolution(volume, volume * r * r / 2, volume * (3 * r * r + 4 * h * h) / 12, 0.0);
    }
    if (const auto* c = std::get_if<scenario::Cone>(&geometry)) {
        const double r = c->radius, h = 2 * c->halfLength, volume = kCircle * r * r * h / 3;
        return solidOfRevolution(volume, 0.3 * volume * r * r, 3 * volume * (r * r + h * h / 4) / 20,
                                 -c->halfLength + h / 4);
    }
    if (const auto* p = std::get_if<scenario::ConvexHull>(&geometry)) {
        if (!flat) return simplices(hullFaces(p->vertices, subject), 3);
        std::vector<std::vector<Vec3>> triangles;
        for (std::size_t i = 0; i < p->vertices.size(); ++i)
            triangles.push_back({p->vertices[i], p->vertices[(i + 1) % p->vertices.size()]});
        return simplices(triangles, 2);
    }
    violated(subject + " has a shape without a volume");
}

class StruckBodies : public Reference {
  public:
    StruckBodies(const Scenario& scenario, const std::vector<int>& bodies) : scenario_(scenario) {
        for (const int index : bodies) {
            requireUndisturbed(scenario, index, {.events = true});
            add(index);
        }
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const auto& one : struck_) result.push_back(one.index);
        return result;
    }
    double validUntil() const override {
        double end = 1e300;
        for (const auto& one : struck_) end = std::min(end, one.rotation->validUntil());
        return end;
    }

    PartialState exact(int body, double t) const override {
        const Struck& one = find(body);
        if (t <= one.time) return stateOf(one.body, one.com, one.body.pose.orientation, {}, {});
        const Attitude a = one.rotation->at(t - one.time);
        return stateOf(one.body, one.com + (t - one.time) * one.velocity, a.orientation, one.velocity,
                       a.angularVelocity);
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        std::vector<Quantity> result;
        for (const auto& one : struck_) {
            // The spin of the first frame after the blow, along it: 1/I before anything else can act.
            const Vec3 direction = unit(one.spin);
            Quantity q{"spin_" + one.body.name, "rad/s", norm(one.spin), norm(one.spin), 0.0, {}};
            q.measure = [index = one.index, direction,
                         time = one.time](const Trajectory& run) -> std::optional<double> {
                for (std::size_t k = 1; k < run.frames(); ++k)
                    if (run.times[k] > time + 1e-9 * run.dt)
                        return dot(direction, run.state(k, index).angularVelocity);
                return std::nullopt;
            };
            if (one.spin != Vec3{}) result.push_back(std::move(q));
        }
        return result;
    }

  private:
    struct Struck {
        int index = 0;
        Body body;  ///< body with the mass properties of this file
        double time = 0.0;
        Vec3 com, velocity, spin;  ///< state after the blow
        std::shared_ptr<TorqueFreeMotion> rotation;
    };

    void add(int index) {
        Struck one;
        one.index = index;
        one.body = scenario_.bodies[index];
        Body& body = one.body;
        const std::string subject = bodyTitle(scenario_, index);
        require(gravityOn(scenario_, index) == Vec3{}, "gravity acts on " + subject);
        require(body.velocity == Vec3{} && body.angularVelocity == Vec3{},
                subject + " moves before it is struck");
        require(body.shapes.size() == 1, subject + " has more than one shape");
        const auto& shape = body.shapes[0];
        const Mass mass = massOf(shape.geometry, scenario_.dimension, subject);
        const double given = body.massProperties.mass,
                     scale = given / mass.amount;  // scale by density, or by the given mass
        const Mat3 turn = toMatrix(shape.pose.orientation);
        MassOf mine{given, shape.pose * mass.center, turn * mass.moments * transpose(turn)};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) mine.inertia(i, j) *= scale;
        const double size =
            scenario_.dimension == 2 ? mine.inertia(2, 2) : mine.inertia(0, 0) + mine.inertia(1, 1);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                require(scenario_.dimension == 2
                            ? (i != 2 || j != 2 ||
                               negligible(mine.inertia(i, j) - body.massProperties.inertia(i, j), size))
                            : negligible(mine.inertia(i, j) - body.massProperties.inertia(i, j), size),
                        "the inertia of " + subject + " is not that of its shape");
        body.massProperties = {mine.mass, mine.center, mine.inertia};
        one.com = centerOfMass(body);
        const scenario::Event* blow = nullptr;
        for (const auto& event : scenario_.events) {
            if (event.body != index) continue;
            require(blow == nullptr, subject + " is struck twice");
            blow = &event;
        }
        require(blow != nullptr && blow->time < scenario_.duration, subject + " is not struck");
        one.time = blow->time;
        one.velocity = blow->impulse / mine.mass;
        if (scenario_.dimension == 2) {
            one.spin = {0, 0, blow->angularImpulse.z / mine.inertia(2, 2)};
        } else {
            one.spin = numerics::toVec3(
                numerics::solve(numerics::real33(worldInertia(body)), numerics::real3(blow->angularImpulse)));
        }
        body.velocity = one.velocity;
        body.angularVelocity = one.spin;
        one.rotation = std::make_shared<TorqueFreeMotion>(body, scenario_.dimension, runEnd(scenario_));
        struck_.push_back(std::move(one));
    }

    const Struck& find(int body) const {
        for (const auto& one : struck_)
            if (one.index == body) return one;
        throw std::invalid_argument("struck_bodies: unknown body");
    }

    struct MassOf {
        double mass = 0.0;
        Vec3 center;
        Mat3 inertia;
    };
    const Scenario& scenario_;
    std::vector<Struck> struck_;
};

}  // namespace

std::unique_ptr<Reference> makeStruckBodies(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<StruckBodies>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
