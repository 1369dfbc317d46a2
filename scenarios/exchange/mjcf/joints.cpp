// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Joints of a compiled MuJoCo model. A body has any number of joints that act one after the other; several become
// one six_dof joint where that is exact: slides at right angles before a hinge or a ball, two hinges at right angles
// through one point (a universal joint), three without limits, springs and friction (a ball).
#include <algorithm>
#include <cmath>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointAxis;
using scenario::JointType;
using scenario::kNone;
using scenario::Vec3;

constexpr double kSameDirection = 1e-9;  ///< largest sine or cosine that counts as zero
enum Coordinate : std::size_t { kX, kY, kZ, kTwist, kSwingY, kSwingZ };

bool areParallel(const Vec3& a, const Vec3& b) {
    return norm(cross(a, b)) < kSameDirection;
}
bool areNormal(const Vec3& a, const Vec3& b) {
    return std::abs(dot(a, b)) < kSameDirection;
}
/// A unit vector normal to a unit vector.
Vec3 anyNormal(const Vec3& a) {
    const Vec3 other = std::abs(a.x) < 0.7 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 n = cross(a, other);
    return n / norm(n);
}

class Joints {
  public:
    explicit Joints(Conversion& c) : c_(c) {}

    void add(int body) {
        const int count = c_.m.body_jntnum[body], first = c_.m.body_jntadr[body];
        const int to = c_.bodyOf[static_cast<std::size_t>(body)];
        if (to == kNone ||
            c_.builder.scene.bodies[static_cast<std::size_t>(to)].type != scenario::BodyType::Dynamic)
            return;
        parent_ = c_.endOf(c_.m.body_parentid[body]);
        child_ = to;
        if (parent_ == child_) return;  // a body without mass, part of its parent
        for (int joint = first; joint < first + count; ++joint) checkLinear(joint);
        if (count == 0) return addFixed(body);
        if (count == 1 && type(first) == mjJNT_FREE) return checkFree(first);
        if (count == 1) return addSingle(first);
        addStack(first, count);
    }

  private:
    int type(int joint) const { return c_.m.jnt_type[joint]; }
    Place place(int joint) const { return c_.placeOf(c_.places.joints, joint); }
    Vec3 axis(int joint) const { return c_.point(c_.m.xaxis, joint); }
    Vec3 anchor(int joint) const { return c_.point(c_.m.xanchor, joint); }
    std::string name(int joint) const {
        return c_.nameOf(c_.m.joint_names, joint, "joint_" + std::to_string(joint));
    }

    Joint& make(int joint, JointType kind, const Vec3& at, const Vec3& along,
                const Vec3& normal = {1.0, 0.0, 0.0}) {
        Joint& made =
            c_.builder.addJoint(name(joint), kind, parent_, child_, at, along, place(joint), normal);
        made.collideConnected = c_.isOff("filterparent");
        return made;
    }

    void addFixed(int body) {
        const Vec3 at = c_.point(c_.m.xpos, body);
        Joint& made = c_.builder.addJoint(
            c_.nameOf(c_.m.body_names, body, "body_" + std::to_string(body)) + "_fixed", JointType::Fixed,
            parent_, child_, at, {0.0, 0.0, 1.0}, c_.placeOf(c_.places.bodies, body));
        made.collideConnected = c_.isOff("filterparent");
    }

    bool hasSpring(int joint) const {
        return !c_.isOff("passive") &&
               (c_.m.jnt_stiffness[joint] != 0.0 || c_.m.dof_damping[c_.m.jnt_dofadr[joint]] != 0.0);
    }
    double frictionLoss(int joint) const {
        return c_.isOff("frictionloss") ? 0.0 : c_.m.dof_frictionloss[c_.m.jnt_dofadr[joint]];
    }
    bool isLimited(int joint) const { return c_.m.jnt_limited[joint] != 0 && !c_.isOff("limit"); }

    /// MuJoCo 3 has springs and dampers whose force is a polynomial.
    void checkLinear(int joint) {
        const int dof = c_.m.jnt_dofadr[joint];
        const auto isBent = [](const Array<double>& higher, int index) {
            return !higher.empty() && (higher[2 * index] != 0.0 || higher[2 * index + 1] != 0.0);
        };
        if (isBent(c_.m.jnt_stiffnesspoly, joint) || isBent(c_.m.dof_dampingpoly, dof))
            c_.report.refuse("<joint> stiffness", place(joint),
                             "a spring or damper whose force is not linear has no counterpart");
    }

    void checkFree(int joint) {
        if (hasSpring(joint) || frictionLoss(joint) > 0.0)
            c_.report.leavesOut("free_joint_forces", "<joint> type=\"free\"", place(joint),
                                "a spring, damper or friction on the motion in the world has no counterpart");
    }

    /// Limits, spring, damper and dry friction of a hinge or slide; zero is the start.
    void control(int joint, JointAxis& to) {
        const int dof = c_.m.jnt_dofadr[joint], q = c_.m.jnt_qposadr[joint];
        const double start = c_.m.qpos[q];
        to.mode = AxisMode::Free;
        if (isLimited(joint)) {
            to.mode = AxisMode::Limited;
            const double lower = c_.m.jnt_range[2 * joint], upper = c_.m.jnt_range[2 * joint + 1];
            if (lower > -kUnlimited) to.lower = lower - start;
            if (upper < kUnlimited) to.upper = upper - start;
        }
        if (hasSpring(joint)) {
            to.stiffness = c_.m.jnt_stiffness[joint];
            to.damping = c_.m.dof_damping[dof];
            if (to.stiffness > 0.0) to.target = c_.m.qpos_spring[q] - start;
        }
        if (frictionLoss(joint) > 0.0) {
            to.motorMaxForce = frictionLoss(joint);
            c_.report.changed("<joint> frictionloss", place(joint), "a motor of speed 0 and this strength");
        }
    }

    void addSingle(int joint) {
        if (type(joint) == mjJNT_BALL) {
            checkBall(joint);
            make(joint, JointType::Ball, anchor(joint), {0.0, 0.0, 1.0});
            return;
        }
        const JointType kind = type(joint) == mjJNT_HINGE ? JointType::Hinge : JointType::Slider;
        control(joint, make(joint, kind, anchor(joint), axis(joint)).axes[0]);
        JointAxis& made = c_.builder.scene.joints.back().axes[0];
        if (made.mode == AxisMode::Free) made.mode = AxisMode::Usual;
    }

    void checkBall(int joint) {
        if (isLimited(joint))
            c_.report.leavesOut("ball_limits", "<joint> range", place(joint),
                                "a limit of the whole angle of a ball joint has no counterpart");
        if (hasSpring(joint))
            c_.report.leavesOut("ball_springs", "<joint> type=\"ball\"", place(joint),
                                "a spring or damper of a ball joint has no counterpart");
        if (frictionLoss(joint) > 0.0)
            c_.report.leavesOut("ball_friction", "<joint> frictionloss", place(joint),
                                "dry friction of a ball joint has no counterpart");
    }

    void addStack(int first, int count) {
        std::vector<int> slides, turns;
        bool slideAfterTurn = false;
        for (int j = first; j < first + count; ++j) {
            slideAfterTurn = slideAfterTurn || (type(j) == mjJNT_SLIDE && !turns.empty());
            (type(j) == mjJNT_SLIDE ? slides : turns).push_back(j);
        }
        const auto refuse = [&](const std::string& why) {
            c_.report.refuse("<joint>", place(first), std::to_string(count) + " joints on one body: " + why);
        };
        for (std::size_t i = 0; i < slides.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (!areNormal(axis(slides[i]), axis(slides[k])))
                    return refuse("slides that are not at right angles have no counterpart");
        if (turns.empty()) return addSlides(slides, slides.front(), JointType::Fixed);
        if (slides.empty()) return addTurns(turns, refuse);
        if (turns.size() > 1) return refuse("slides and several turns have no counterpart");
        if (type(turns[0]) == mjJNT_BALL && !slideAfterTurn)
            return addSlides(slides, turns[0], JointType::Ball);
        if (type(turns[0]) == mjJNT_BALL) return refuse("a slide after a ball has no counterpart");
        const Vec3 h = axis(turns[0]);
        const bool aligned = std::all_of(slides.begin(), slides.end(), [&](int s) {
            return areParallel(axis(s), h) || (areNormal(axis(s), h) && !slideAfterTurn);
        });
        if (!aligned)
            return refuse(slideAfterTurn
                              ? "a slide that turns with a hinge has no counterpart"
                              : "a slide and a hinge that are neither parallel nor at right angles");
        addSlides(slides, turns[0], JointType::Hinge);
    }

    /// Slides, then nothing (Fixed), a hinge or a ball.
    void addSlides(const std::vector<int>& slides, int turn, JointType kind) {
        Vec3 x = axis(slides[0]);
        if (kind == JointType::Hinge) x = axis(turn);
        Vec3 y = anyNormal(x);
        for (const int s : slides)
            if (areNormal(axis(s), x)) {
                y = axis(s);
                break;
            }
        const Vec3 z = cross(x, y);
        Joint& made = make(turn, JointType::SixDof, anchor(turn), x, y);
        for (JointAxis& a : made.axes) a.mode = AxisMode::Locked;
        for (const int s : slides) {
            const Vec3 a = axis(s);
            const std::size_t k = areParallel(a, x) ? kX : areParallel(a, y) ? kY : kZ;
            const Vec3& direction = k == kX ? x : k == kY ? y : z;
            JointAxis coordinate;
            control(s, coordinate);
            made.axes[k] = dot(a, direction) > 0.0 ? coordinate : mirrored(coordinate);
        }
        if (kind == JointType::Hinge) control(turn, made.axes[kTwist]);
        if (kind != JointType::Ball) return;
        checkBall(turn);
        for (const std::size_t k : {kTwist, kSwingY, kSwingZ}) made.axes[k].mode = AxisMode::Free;
    }

    static JointAxis mirrored(JointAxis a) {
        const double lower = a.lower;
        a.lower = -a.upper;
        a.upper = -lower;
        a.target = -a.target;
        return a;
    }

    template <class Refuse>
    void addTurns(const std::vector<int>& turns, const Refuse& refuse) {
        for (const int t : turns) {
            if (type(t) != mjJNT_HINGE) return refuse("a ball beside another turn has no counterpart");
            if (norm(anchor(t) - anchor(turns[0])) > kSameDirection)
                return refuse("hinges through different points have no counterpart");
        }
        if (turns.size() == 2 && areNormal(axis(turns[0]), axis(turns[1]))) {
            c_.report.changed("<joint>", place(turns[0]), "two hinges are one universal joint (six_dof)");
            Joint& made = make(turns[0], JointType::SixDof, anchor(turns[0]), axis(turns[1]), axis(turns[0]));
            for (JointAxis& a : made.axes) a.mode = AxisMode::Locked;
            control(turns[1], made.axes[kTwist]);
            control(turns[0], made.axes[kSwingY]);
            return;
        }
        const bool plain = std::none_of(turns.begin(), turns.end(), [&](int t) {
            return isLimited(t) || hasSpring(t) || frictionLoss(t) > 0.0;
        });
        if (turns.size() == 3 && plain && areNormal(axis(turns[0]), axis(turns[1])) &&
            areNormal(axis(turns[1]), axis(turns[2]))) {
            c_.report.changed("<joint>", place(turns[0]), "three hinges through one point are a ball joint");
            make(turns[0], JointType::Ball, anchor(turns[0]), {0.0, 0.0, 1.0});
            return;
        }
        refuse(
            "these hinges have no counterpart: two at right angles have, and three without limits, springs "
            "and "
            "friction");
    }

    Conversion& c_;
    int parent_ = kNone, child_ = kNone;
};

}  // namespace

void addJoints(Conversion& c) {
    Joints joints(c);
    for (int body = 1; body < c.m.nbody; ++body) joints.add(body);
}

}  // namespace rigor::models::mjcf
