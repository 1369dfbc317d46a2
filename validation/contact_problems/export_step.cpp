// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/contact_problems/export_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "validation/contact_problems/joint_rows.hpp"
#include "validation/metrics/contact_point.hpp"
#include "validation/metrics/mechanics.hpp"
#include "validation/runner/forces.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;
using adapter::Unsupported;

std::size_t placeOf(int i) {
    return i;
}
double component(const Vec3& v, int i) {
    return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

/// Writes down what is applied to it.
class Scale final : public adapter::World {
  public:
    explicit Scale(std::size_t bodies) : loads(bodies) {}
    void applyForce(int body, const Vec3& force, const Vec3& torque) override {
        loads[placeOf(body)].force += force;
        loads[placeOf(body)].torque += torque;
    }
    void step() override {}
    void readStates(std::span<BodyState>) const override {}
    void readContacts(std::vector<ContactPoint>& contacts) const override { contacts.clear(); }
    adapter::ReadBack readBack() const override { return {}; }
    std::vector<adapter::LedgerEntry> ledger() const override { return {}; }
    adapter::Scheme scheme() const override { return adapter::Scheme::Unknown; }
    std::vector<AppliedLoad> loads;
};

/// Fills the matrices body by body and contact by contact.
class StepExporter {
  public:
    StepExporter(const Scenario& scenario, const RecordedStep& step)
        : s_(scenario), step_(step), dofs_(scenario.dimension == 3 ? 6 : 3), first_(s_.bodies.size(), kNone) {
        for (std::size_t i = 0; i < s_.bodies.size(); ++i)
            if (s_.bodies[i].type == BodyType::Dynamic) first_[i] = dofs_ * bodies_++;
    }

    ExportedProblem make() {
        for (std::size_t i = 0; i < s_.bodies.size(); ++i)
            if (first_[i] != kNone) addBody(i);
        for (const Joint& joint : s_.joints) addJoint(joint);
        bool hasImpulses = true;
        for (const ContactPoint& contact : step_.contacts) {
            if (!isKnownContact(s_, contact)) continue;
            addContact(contact);
            hasImpulses = hasImpulses && contact.hasImpulse;
        }
        if (p().mu.empty()) throw adapter::BadInput("the step has no contacts to export");
        const int rows = dofs_ * bodies_, columns = p().w.size();
        p().dimension = s_.dimension;
        p().M = fromTriplets(rows, rows, mass_);
        p().H = fromTriplets(rows, columns, direction_);
        if (!problem_.b.empty()) problem_.G = fromTriplets(rows, problem_.b.size(), bilateral_);
        problem_.isGlobal = true;
        if (hasImpulses) problem_.storedR = impulses_;
        storeVelocities();
        complete(problem_, s_.name);
        return std::move(problem_);
    }

  private:
    ContactProblem& p() { return problem_.problem; }

    Mat3 inertia(int body) const {
        const Mat3& local = s_.bodies[placeOf(body)].massProperties.inertia;
        if (s_.dimension == 2) return local;
        const Mat3 R = toMatrix(step_.before[placeOf(body)].orientation);
        return R * local * transpose(R);
    }
    void addBody(int body) {
        const Body& b = s_.bodies[placeOf(body)];
        const BodyState& state = step_.before[placeOf(body)];
        const double m = b.massProperties.mass, h = step_.dt;
        const AppliedLoad& load = step_.loads[placeOf(body)];
        const int first = first_[placeOf(body)];
        const Mat3 I = inertia(body);
        const Vec3 spin =
            s_.dimension == 2 ? Vec3{0, 0, I(2, 2) * state.angularVelocity.z} : I * state.angularVelocity;
        const Vec3 torque = load.torque - cross(state.angularVelocity, spin);
        const double kept = std::pow(b.linearVelocityKept, h), keptSpin = std::pow(b.angularVelocityKept, h);
        const Vec3 push = kept * (m * state.velocity + h * (m * b.gravityScale * s_.gravity + load.force));
        const Vec3 turn = keptSpin * (spin + h * torque);
        for (int i = 0; i < s_.dimension; ++i) {
            mass_.push_back({first + i, first + i, m});
            p().f.push_back(component(push, i));
        }
        if (s_.dimension == 2) {
            mass_.push_back({first + 2, first + 2, I(2, 2)});
            p().f.push_back(turn.z);
            return;
        }
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) mass_.push_back({first + 3 + i, first + 3 + j, I(i, j)});
            p().f.push_back(component(turn, i));
        }
    }
    /// A column of H or G: what direction d on an arm, and turning about t, are to one body's velocities.
    void addColumn(std::vector<Triplet>& matrix, int body, int column, const Vec3& d, const Vec3& arm,
                   const Vec3& t = {}) const {
        const int first = body == kNone ? kNone : first_[placeOf(body)];
        if (first == kNone) return;
        const Vec3 turn = cross(arm, d) + t;
        for (int i = 0; i < s_.dimension; ++i) matrix.push_back({first + i, column, component(d, i)});
        if (s_.dimension == 2)
            matrix.push_back({first + 2, column, turn.z});
        else
            for (int i = 0; i < 3; ++i) matrix.push_back({first + 3 + i, column, component(turn, i)});
    }
    /// Velocity of the point on a body that no impulse moves, along d.
    double carried(int body, const Vec3& d, const Vec3& arm, const Vec3& t = {}) const {
        if (body == kNone || first_[placeOf(body)] != kNone) return 0.0;
        const BodyState& state = step_.before[placeOf(body)];
        return dot(d, state.velocity + cross(state.angularVelocity, arm)) + dot(t, state.angularVelocity);
    }
    void addJoint(const Joint& joint) {
        for (const JointRow& row : jointRows(s_, joint, step_.before)) {
            const int column = problem_.b.size();
            addColumn(bilateral_, joint.bodyA, column, -row.linear, row.armA, -row.angular);
            addColumn(bilateral_, joint.bodyB, column, row.linear, row.armB, row.angular);
            problem_.b.push_back(carried(joint.bodyB, row.linear, row.armB, row.angular) -
                                 carried(joint.bodyA, row.linear, row.armA, row.angular));
        }
    }
    void addContact(const ContactPoint& contact) {
        const PairCoefficients pair = coefficientsOf(s_, contact);
        if (pair.staticFriction > pair.friction)
            throw Unsupported("a exported contact has one coefficient of friction; " +
                              s_.bodies[placeOf(contact.bodyA)].name + " and " +
                              s_.bodies[placeOf(contact.bodyB)].name + " have a static one above it");
        if (pair.rollingFriction > 0.0 || pair.torsionalFriction > 0.0 ||
            norm(surfaceSlip(s_, contact, step_.before)) > 0.0)
            throw Unsupported(
                "an exported contact has no rolling or torsional friction and no moving surface; " +
                s_.bodies[placeOf(contact.bodyA)].name + " and " + s_.bodies[placeOf(contact.bodyB)].name +
                " have");
        const PointOfContact point(s_, contact, step_.atContacts());
        const auto tangents = tangentsOf(contact.normal, s_.dimension);
        const Vec3 impulse = contact.normalImpulse * contact.normal + contact.frictionImpulse;
        for (int k = 0; k < s_.dimension; ++k) {
            const Vec3 d = k == 0 ? contact.normal : tangents[placeOf(k - 1)];
            const int column = p().w.size();
            addColumn(direction_, contact.bodyA, column, -d, point.armA());
            addColumn(direction_, contact.bodyB, column, d, point.armB());
            p().w.push_back(carried(contact.bodyB, d, point.armB()) -
                            carried(contact.bodyA, d, point.armA()));
            impulses_.push_back(dot(d, impulse));
            if (k > 0) continue;
            const double before = dot(d, point.velocity(step_.before));
            if (contact.depth < 0.0)
                p().w.back() += -contact.depth / step_.dt;
            else
                p().w.back() += pair.restitution * std::min(0.0, before);
        }
        p().mu.push_back(pair.friction);
    }
    void storeVelocities() {
        for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
            if (first_[i] == kNone) continue;
            const BodyState& state = step_.after[i];
            for (int k = 0; k < s_.dimension; ++k) problem_.storedV.push_back(component(state.velocity, k));
            if (s_.dimension == 2) problem_.storedV.push_back(state.angularVelocity.z);
            for (int k = 0; s_.dimension == 3 && k < 3; ++k)
                problem_.storedV.push_back(component(state.angularVelocity, k));
        }
        problem_.storedU = p().w;
        multiplyTransposedAdd(p().H, problem_.storedV, problem_.storedU);
    }

    const Scenario& s_;
    const RecordedStep& step_;
    int dofs_, bodies_ = 0;
    std::vector<int> first_;  ///< first unknown of each scenario body, or kNone
    std::vector<Triplet> mass_, direction_, bilateral_;
    std::vector<double> impulses_;
    ExportedProblem problem_;
};

}  // namespace

std::vector<AppliedLoad> loadsOf(const Scenario& scenario, std::size_t step, double dt,
                                 std::span<const BodyState> states) {
    Scale scale(scenario.bodies.size());
    applyForces(scenario, step, dt, states, scale);
    return scale.loads;
}

ExportedProblem exportStep(const Scenario& scenario, const RecordedStep& step) {
    ExportedProblem exported = StepExporter(scenario, step).make();
    exported.title = scenario.name;
    return exported;
}

}  // namespace rigor::validation
