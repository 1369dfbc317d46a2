// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One known error for every metric of the table: the exact run shows none, and a run with the error shows it
// with the size computed by hand. The exact solution here is made up, so that nothing is assumed of any
// reference of the project. A metric without a row in this table fails the last test.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <set>

#include "validation/metrics/metric.hpp"
#include "validation/references/tests/scene.hpp"

namespace rigor::validation::testing {
namespace {

constexpr double kDt = 0.01;
constexpr std::size_t kLast = 100;
const Vec3 kVelocity{3, 4, 0}, kSpin{0, 0, 4};

/// Two balls in step, |v| = 5 m/s, the first of them spinning; the ideal run of its scheme lags by h/2, and
/// its clock by 1 %.
class Glide : public Reference {
  public:
    explicit Glide(const Scenario& scenario) : scenario_(scenario) {}
    std::vector<int> bodies() const override { return {0, 1}; }
    PartialState exact(int body, double t) const override {
        const Vec3 w = body == 0 ? kSpin : Vec3{};
        return {scenario_.bodies[body].pose.position + t * kVelocity, fromAxisAngle({0, 0, 1}, t * w.z),
                kVelocity, w};
    }
    std::optional<PartialState> schemeExact(int body, std::size_t step, double dt,
                                            adapter::Scheme) const override {
        const double t = step * dt;
        PartialState late = exact(body, t);
        late.position = *late.position - 0.5 * dt * kVelocity;
        late.velocity = 0.99 * *late.velocity;
        late.orientation = fromAxisAngle({0, 0, 1}, 0.9 * t * late.angularVelocity->z);
        return late;
    }
    std::vector<Quantity> quantities(double dt, adapter::Scheme) const override {
        Quantity range{"range", "m", 5.0, 5.0 - 2.5 * dt, 0.0, {}};
        range.measure = [this](const Trajectory& run) {
            return norm(run.state(kLast, 0).position - scenario_.bodies[0].pose.position);
        };
        Quantity end{"end", "s", 1.0, 1.0, 0.0, {}};
        end.measure = [](const Trajectory& run) { return run.times.back(); };
        return {range, end};
    }

  private:
    const Scenario& scenario_;
};

class Still : public Reference {
  public:
    explicit Still(const Scenario& scenario) : scenario_(scenario) {}
    std::vector<int> bodies() const override { return {1}; }
    PartialState exact(int body, double) const override {
        const Pose& X = scenario_.bodies[body].pose;
        return {X.position, X.orientation, Vec3{}, Vec3{}};
    }

  private:
    const Scenario& scenario_;
};

/// A plate filmed while it is carried along and turned; a filmed motion has no velocities.
class Filmed : public Reference {
  public:
    std::vector<int> bodies() const override { return {0}; }
    std::optional<PartialState> measured(int, double t) const override {
        return PartialState{t * kVelocity, fromAxisAngle({0, 0, 1}, t * kSpin.z), {}, {}};
    }
};

struct Case {
    Scenario scenario;
    std::unique_ptr<Reference> reference;
    Trajectory run;
    BodyState& at(std::size_t frame, std::size_t body) { return run.states[frame * run.bodyCount + body]; }
    BodyState& last(std::size_t body) { return at(kLast, body); }
};

std::unique_ptr<Case> gliding() {
    auto c = std::make_unique<Case>();
    c->scenario = emptyScene(3, {}, 1);
    addBall(c->scenario, "first", 0.1, 2, 0.4, {0, 0, 0}, kVelocity, kSpin);
    addBall(c->scenario, "second", 0.2, 1, 0.4, {0, 0, 5}, kVelocity);
    c->reference = std::make_unique<Glide>(c->scenario);
    c->run = exactRun(c->scenario, *c->reference, kDt, kLast);
    return c;
}
/// The same, as an ideal run of the scheme.
std::unique_ptr<Case> ideal() {
    auto c = gliding();
    for (std::size_t k = 0; k <= kLast; ++k)
        for (const int b : {0, 1}) {
            const auto s = c->reference->schemeExact(b, k, kDt, adapter::Scheme::SymplecticEuler);
            c->at(k, b) = {*s->position, *s->orientation, *s->velocity, *s->angularVelocity};
        }
    return c;
}
/// A plate 0.2 m thin.
std::unique_ptr<Case> filmed() {
    auto c = std::make_unique<Case>();
    c->scenario = emptyScene(3, {}, 1);
    addBox(c->scenario, "plate", {0.4, 0.1, 0.3}, 1, {});
    c->reference = std::make_unique<Filmed>();
    c->run = exactRun(c->scenario, *c->reference, kDt, kLast);
    for (std::size_t k = 0; k <= kLast; ++k) {
        const auto pose = *c->reference->measured(0, c->run.times[k]);
        c->at(k, 0).position = *pose.position;
        c->at(k, 0).orientation = *pose.orientation;
    }
    return c;
}
/// A ball of 2 kg on the floor, with a contact.
std::unique_ptr<Case> resting() {
    auto c = std::make_unique<Case>();
    c->scenario = emptyScene(3, {0, -10, 0}, 1);
    addFloor(c->scenario);
    addBall(c->scenario, "ball", 0.25, 2, 0.4, {0, 0.25, 0});
    c->reference = std::make_unique<Still>(c->scenario);
    c->run = exactRun(c->scenario, *c->reference, kDt, kLast);
    ContactPoint touch;
    touch.bodyA = 0;
    touch.bodyB = 1;
    touch.normal = {0, 1, 0};
    for (std::size_t k = 0; k < kLast; ++k) c->run.contacts[k] = {touch};
    return c;
}
/// The ball on a floor of two triangles.
std::unique_ptr<Case> onMesh() {
    auto c = resting();
    TriangleMesh mesh;
    mesh.vertices = {{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
    c->scenario.bodies[0].shapes[0].geometry = mesh;
    return c;
}
/// The ball pressed on the floor by 2 N s in one step: mu p_n = 1 N s. K is 1/m = 0.5 1/kg along the normal
/// and 1/m + r^2/(0.4 m r^2) = 1.75 1/kg across it.
std::unique_ptr<Case> pressed() {
    auto c = resting();
    c->scenario.materials[0].friction = 0.5;
    c->run.contacts[10][0].hasImpulse = true;
    c->run.contacts[10][0].normalImpulse = 2;
    return c;
}
/// The same, its contacts 2 mm deep.
std::unique_ptr<Case> overlapping() {
    auto c = resting();
    for (auto& contacts : c->run.contacts)
        for (auto& touch : contacts) {
            touch.depth = 0.002;
            touch.pointB = {0, -0.002, 0};
        }
    return c;
}
/// A rod on a hinge about z with stops at 0.1 rad.
std::unique_ptr<Case> hinged() {
    auto c = std::make_unique<Case>();
    c->scenario = emptyScene(3, {}, 1);
    addFloor(c->scenario);
    addBox(c->scenario, "rod", {0.1, 0.5, 0.1}, 1, {0, 5, 0});
    Joint hinge;
    hinge.name = "hinge";
    hinge.type = JointType::Hinge;
    hinge.bodyB = 1;
    hinge.anchorA = {0, 5.5, 0};
    hinge.anchorB = {0, 0.5, 0};
    hinge.axes[0].mode = AxisMode::Limited;
    hinge.axes[0].lower = -0.1;
    hinge.axes[0].upper = 0.1;
    c->scenario.joints = {hinge};
    c->reference = std::make_unique<Still>(c->scenario);
    c->run = exactRun(c->scenario, *c->reference, kDt, kLast);
    return c;
}

/// Two balls and a box of 1 kg each that lie on the floor, without a reference.
std::unique_ptr<Case> heaped() {
    auto c = std::make_unique<Case>();
    c->scenario = emptyScene(3, {0, -10, 0}, 1);
    addFloor(c->scenario);
    addBall(c->scenario, "left", 0.25, 1, 0.4, {-3, 0.25, 0});
    addBall(c->scenario, "right", 0.25, 1, 0.4, {3, 0.25, 0});
    addBox(c->scenario, "box", {0.3, 0.4, 0.5}, 1, {0, 0.4, 0});
    c->run = exactRun(c->scenario, Still(c->scenario), kDt, kLast);
    return c;
}

/// Turned about the hinge's anchor.
void swing(BodyState& rod, const Quat& q) {
    rod.orientation = q;
    rod.position = Vec3{0, 5.5, 0} - rotate(q, {0, 0.5, 0});
}
/// A range 2 % too long.
void stretch(Case& c) {
    c.last(0).position = 1.02 * c.last(0).position;
}
void shiftUp(BodyState& s, double by) {
    s.position += Vec3{0, by, 0};
}
void turnBy(BodyState& s, double angle) {
    s.orientation = fromAxisAngle({0.6, 0, 0.8}, angle) * s.orientation;
}
// 0.5 x 3 kg x 25 + 0.5 x 0.008 kg m^2 x 16
constexpr double kEnergy = 37.564;

struct Row {
    const char* metric;
    const char* subject;  ///< subject of the row that shows the error
    std::unique_ptr<Case> (*make)();
    std::function<void(Case&)> injectFault;
    double expected;
    double unspoiled = 0.0;  ///< value for the exact run; an outcome is no error
};
const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {"position_final", "first", gliding,
         [](Case& c) {
             c.last(0).position += Vec3{0.03, 0, -0.04};
         },
         0.05},
        {"position_max", "second", gliding, [](Case& c) { shiftUp(c.at(40, 1), 0.2); }, 0.2},
        {"position_rmse", "second", gliding, [](Case& c) { shiftUp(c.at(40, 1), 0.2); },
         0.2 / std::sqrt(101.0)},
        {"velocity_final", "second", gliding,
         [](Case& c) {
             c.last(1).velocity += Vec3{0, 0.7, 0};
         },
         0.7},
        {"velocity_max", "first", gliding,
         [](Case& c) {
             c.at(40, 0).velocity += Vec3{0, 0, 0.6};
         },
         0.6},
        {"orientation_final", "first", gliding, [](Case& c) { turnBy(c.last(0), 0.25); }, 0.25},
        {"orientation_max", "second", gliding, [](Case& c) { turnBy(c.at(60, 1), 3.0); }, 3.0},
        {"spin_final", "first", gliding,
         [](Case& c) {
             c.last(0).angularVelocity += Vec3{0, 0.1, 0};
         },
         0.1},
        {"quantity_error", "range", gliding, stretch, 0.02},
        {"event_time_error", "end", gliding, [](Case& c) { c.run.times.back() += 0.02; }, 0.02},
        {"energy_error", "", gliding, [](Case& c) { c.at(30, 0).velocity = 2.0 * kVelocity; }, 75 / kEnergy},
        {"energy_drift", "", gliding, [](Case& c) { c.at(30, 0).velocity = {}; }, 25 / kEnergy},
        {"energy_final", "", gliding, [](Case& c) { c.last(0).velocity = 2.0 * kVelocity; }, 75 / kEnergy},
        // It loses 25 J first: what it has gained is counted from there.
        {"energy_gain", "", gliding,
         [](Case& c) {
             c.at(30, 0).velocity = {};
             c.at(40, 0).velocity = 2.0 * kVelocity;
         },
         100 / kEnergy},
        {"scheme_position_final", "first", ideal, [](Case& c) { shiftUp(c.last(0), 0.05); }, 0.05},
        {"scheme_position_max", "second", ideal, [](Case& c) { shiftUp(c.at(40, 1), 0.2); }, 0.2},
        {"scheme_velocity_max", "first", ideal,
         [](Case& c) {
             c.at(40, 0).velocity += Vec3{0, 0, 0.6};
         },
         0.6},
        {"scheme_orientation_max", "first", ideal, [](Case& c) { turnBy(c.at(60, 0), 0.25); }, 0.25},
        {"scheme_quantity_error", "range", ideal, stretch, 0.02},
        {"measured_position_mean", "plate", filmed, [](Case& c) { shiftUp(c.at(40, 0), 0.2); }, 1.0 / 101},
        {"measured_position_max", "plate", filmed, [](Case& c) { shiftUp(c.at(40, 0), 0.5); }, 2.5},
        {"measured_position_final", "plate", filmed, [](Case& c) { shiftUp(c.last(0), 0.1); }, 0.5},
        {"measured_orientation_mean", "plate", filmed, [](Case& c) { turnBy(c.at(40, 0), 2.0); }, 2.0 / 101},
        {"measured_orientation_rms", "plate", filmed, [](Case& c) { turnBy(c.at(40, 0), 2.0); },
         2.0 / std::sqrt(101.0)},
        {"measured_orientation_max", "plate", filmed, [](Case& c) { turnBy(c.at(40, 0), 2.0); }, 2.0},
        {"measured_loss", "plate", filmed,
         [](Case& c) {
             shiftUp(c.at(40, 0), 0.2);
             turnBy(c.at(60, 0), 2.0);
         },
         (0.04 / 0.1 + 4.0) / 101},
        // 2 kg x 0.6 m/s of 15 kg m/s
        {"linear_momentum_drift", "", gliding,
         [](Case& c) {
             c.at(30, 0).velocity += Vec3{0, 0, 0.6};
         },
         0.08},
        // 0.008 kg m^2 x 5 rad/s of 0.032 kg m^2/s
        {"angular_momentum_drift", "", gliding,
         [](Case& c) {
             c.at(30, 0).angularVelocity += Vec3{0, 5, 0};
         },
         1.25},
        {"quaternion_norm_error", "second", gliding, [](Case& c) { c.at(20, 1).orientation.w *= 1.003; },
         0.003},
        {"penetration_max", "ball", resting, [](Case& c) { c.run.contacts[10][0].depth = 0.004; }, 0.004},
        {"overlap_max", "ball", resting, [](Case& c) { shiftUp(c.at(50, 1), -0.01); }, 0.01},
        {"initial_overlap", "ball", resting, [](Case& c) { c.run.contacts[0][0].depth = 0.04; }, 0.04},
        {"bodies_through", "", onMesh,
         [](Case& c) {
             for (std::size_t k = 50; k <= kLast; ++k) shiftUp(c.at(k, 1), -0.5);
         },
         1},
        {"normal_error", "ball", resting,
         [](Case& c) {
             c.run.contacts[10][0].normal = {std::sin(0.02), std::cos(0.02), 0};
         },
         0.02},
        {"normal_error_median", "", resting,
         [](Case& c) {
             for (std::size_t k = 10; k < 70; ++k)
                 c.run.contacts[k][0].normal = {std::sin(0.02), std::cos(0.02), 0};
         },
         0.02},
        {"contact_inconsistency", "", overlapping,
         [](Case& c) {
             for (auto& contacts : c.run.contacts)
                 for (auto& touch : contacts) touch.depth = -touch.depth;
         },
         2.0},
        // the normal turns out and back in one of the 98 triples of frames with contacts
        {"normal_flicker", "ball", resting,
         [](Case& c) {
             c.run.contacts[10][0].normal = {std::sin(0.02), std::cos(0.02), 0};
         },
         0.04 / 98},
        {"contact_flicker", "ball", resting, [](Case& c) { c.run.contacts[10].clear(); }, 1.0 / 100},
        // Leaves while it is pressed.
        {"signorini_residual", "ball", pressed,
         [](Case& c) {
             c.at(11, 1).velocity = {0, 0.3, 0};
         },
         0.3},
        // 10 % beyond the cone, as a velocity
        {"coulomb_residual", "ball", pressed,
         [](Case& c) {
             c.run.contacts[10][0].frictionImpulse = {0.88, 0, 0.66};
         },
         0.175},
        // Slides and nothing brakes.
        {"dissipation_error", "ball", pressed,
         [](Case& c) {
             c.at(11, 1).velocity = {0.12, 0, -0.16};
         },
         0.2},
        {"joint_drift", "hinge", hinged,
         [](Case& c) {
             c.at(50, 1).position += Vec3{0.003, 0, 0.004};
         },
         0.005},
        {"joint_axis_drift", "hinge", hinged,
         [](Case& c) {
             swing(c.at(50, 1), fromAxisAngle({1, 0, 0}, 0.03));
         },
         0.03},
        {"joint_limit_violation", "hinge.angle", hinged,
         [](Case& c) {
             swing(c.at(50, 1), fromAxisAngle({0, 0, 1}, -0.15));
         },
         0.05},
        {"rest_motion", "ball", resting,
         [](Case& c) {
             c.at(30, 1).position += Vec3{0.003, 0.004, 0};
         },
         0.005},
        {"rest_sink", "ball", resting,
         [](Case& c) {
             c.at(30, 1).position += Vec3{0.003, -0.004, 0};
         },
         0.004},
        {"rest_creep", "ball", resting,
         [](Case& c) {
             c.last(1).position += Vec3{0.003, -0.007, 0.004};
         },
         0.005},
        {"rest_turn", "ball", resting, [](Case& c) { turnBy(c.at(10, 1), 0.1); }, 0.1},
        {"rest_jitter", "ball", resting,
         [](Case& c) {
             for (std::size_t k = 76; k <= kLast; ++k) c.at(k, 1).velocity = {0.03, 0, k % 2 ? 0.04 : -0.04};
         },
         0.05},
        {"kinetic_energy_final", "", resting,
         [](Case& c) {
             c.last(1).velocity = {0, 0.3, 0};
         },
         0.09},
        // the box on its side, one of its edges of 0.5 m up
        {"pile_height", "", heaped,
         [](Case& c) {
             c.last(3).orientation = fromAxisAngle({1, 0, 0}, std::acos(-1.0) / 2.0);
             c.last(3).position.y = 0.5;
         },
         1.0, 0.8},
        // centres at -3, 3, 0: sqrt(18/3); then all on z = 4 but one
        {"spread_radius", "", heaped,
         [](Case& c) {
             c.last(3).position = {0, 7, 3};
         },
         std::sqrt((18.0 + 6.0) / 3.0), std::sqrt(6.0)},
        // 0.05 sqrt(2 g R) = 0.112 m/s: 0.11 is slow enough, 0.1 + 0.25 x 0.1 is not
        {"settling_time", "", heaped,
         [](Case& c) {
             for (std::size_t k = 0; k < 70; ++k) c.at(k, 1).velocity = {0.11, 0, 0};
             c.at(42, 2).velocity = {0, 0, 0.1};
             c.at(42, 2).angularVelocity = {0, 0.1, 0};
         },
         0.42},
        // it falls by 0.2 m and keeps 0.5 J
        {"dissipated_energy", "", heaped,
         [](Case& c) {
             c.last(1).position.y -= 0.2;
             c.last(1).velocity = {1, 0, 0};
         },
         1.5},
    };
    return table;
}

double valueOf(const Case& c, const Row& row) {
    const MetricEntry* entry = findMetric(row.metric);
    if (entry == nullptr) throw std::invalid_argument("no such metric");
    for (const MetricValue& v :
         entry->evaluate({c.scenario, c.run, c.reference.get(), adapter::Scheme::SymplecticEuler}))
        if (v.subject == row.subject) return v.value;
    throw std::invalid_argument(std::string("no row of '") + row.subject + "'");
}

TEST(KnownErrors, ComeBackWithTheirSizeAndAnExactRunHasNone) {
    for (const Row& row : rows()) {
        SCOPED_TRACE(row.metric);
        const auto c = row.make();
        EXPECT_NEAR(valueOf(*c, row), row.unspoiled, 1e-13);
        row.injectFault(*c);
        EXPECT_NEAR(valueOf(*c, row), row.expected, 1e-12);
    }
}

TEST(KnownErrors, MeasuredAndExactAreNeverMixed) {
    const auto answers = [](const Case& c, MetricKind kind) {
        int count = 0;
        for (const MetricEntry& entry : metricTable())
            if (entry.kind == kind)
                count +=
                    entry.evaluate({c.scenario, c.run, c.reference.get(), adapter::Scheme::SymplecticEuler})
                        .size();
        return count;
    };
    const auto recorded = filmed(), known = gliding();
    EXPECT_EQ(answers(*recorded, MetricKind::Exact) + answers(*recorded, MetricKind::SchemeExact), 0);
    EXPECT_GT(answers(*recorded, MetricKind::Measured), 0);
    EXPECT_EQ(answers(*known, MetricKind::Measured), 0);
    EXPECT_GT(answers(*known, MetricKind::Exact), 0);
}

TEST(KnownErrors, EveryMetricHasOne) {
    std::set<std::string> tested, listed;
    for (const Row& row : rows()) tested.insert(row.metric);
    for (const MetricEntry& entry : metricTable()) listed.insert(entry.name);
    EXPECT_EQ(tested, listed);
}

}  // namespace
}  // namespace rigor::validation::testing
