// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/contact_problems/joint_rows.hpp"

#include "validation/metrics/contact_point.hpp"
#include "validation/metrics/mechanics.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;

Pose poseOf(std::span<const BodyState> states, int body) {
    if (body == kNone) return {};
    const BodyState& s = states[body];
    return {s.position, s.orientation};
}
Vec3 centerOf(const Scenario& s, std::span<const BodyState> states, int body) {
    if (body == kNone) return {};
    return centerOfMassOf(s.bodies[body], states[body]);
}

/// Rows about where the joint stands.
class Rows {
  public:
    Rows(const Scenario& s, const Joint& joint, std::span<const BodyState> states) : flat_(s.dimension == 2) {
        const Pose a = poseOf(states, joint.bodyA), b = poseOf(states, joint.bodyB);
        onA_ = a * joint.anchorA;
        onB_ = b * joint.anchorB;
        axis_ = rotate(a.orientation, joint.axisA);
        centerA_ = centerOf(s, states, joint.bodyA);
        centerB_ = centerOf(s, states, joint.bodyB);
    }
    /// The anchors stay together along d.
    void hold(const Vec3& d) { rows_.push_back({d, {}, onA_ - centerA_, onB_ - centerB_}); }
    /// B's anchor stays where it is in A along d, which turns with A.
    void guide(const Vec3& d) { rows_.push_back({d, {}, onB_ - centerA_, onB_ - centerB_}); }
    void hold() {
        for (const Vec3& d : axes()) hold(d);
    }
    /// No relative turning about t.
    void align(const Vec3& t) { rows_.push_back({{}, t, {}, {}}); }
    void align() {
        if (flat_) return align({0, 0, 1});
        for (const Vec3& t : axes()) align(t);
    }
    std::vector<Vec3> axes() const {
        if (flat_) return {{1, 0, 0}, {0, 1, 0}};
        return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    }
    /// Two unit vectors normal to the joint's axis.
    std::vector<Vec3> across() const {
        const auto both = tangentsOf(axis_, flat_ ? 2 : 3);
        if (flat_) return {both[0]};
        return {both[0], both[1]};
    }
    Vec3 gap() const { return onB_ - onA_; }
    bool flat() const { return flat_; }
    std::vector<JointRow> take() { return std::move(rows_); }

  private:
    bool flat_;
    Vec3 onA_, onB_, axis_, centerA_, centerB_;
    std::vector<JointRow> rows_;
};

[[noreturn]] void refuse(const Joint& joint, const std::string& what) {
    throw adapter::Unsupported(
        "joint " + joint.name + ": " + what +
        " is no equation between velocities; exporting a step needs a scenario without");
}

}  // namespace

std::vector<JointRow> jointRows(const Scenario& s, const Joint& joint, std::span<const BodyState> states) {
    for (const std::string& feature : joint.features())
        if (feature != "break") refuse(joint, "a " + feature);
    Rows rows(s, joint, states);
    switch (joint.type) {
        case JointType::Ball:
            rows.hold();
            break;
        case JointType::Hinge:
            rows.hold();
            if (!rows.flat())
                for (const Vec3& t : rows.across()) rows.align(t);
            break;
        case JointType::Slider:
            for (const Vec3& d : rows.across()) rows.guide(d);
            rows.align();
            break;
        case JointType::Fixed:
            rows.hold();
            rows.align();
            break;
        case JointType::Distance:
            if (joint.axes[0].mode != AxisMode::Usual && joint.axes[0].mode != AxisMode::Locked)
                refuse(joint, "a length that is not fixed");
            rows.hold(rows.gap() / norm(rows.gap()));
            break;
        case JointType::ConeTwist:
        case JointType::SixDof:
        case JointType::Wheel:
            refuse(joint, "a joint with coordinates to choose");
    }
    return rows.take();
}

}  // namespace rigor::validation
