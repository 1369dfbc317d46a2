// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/joint_args.hpp"

#include "engine/constraints/joint.hpp"

namespace rigor::engine::python {
namespace {

constexpr std::pair<const char*, AxisMode> kModes[]{{"usual", AxisMode::Usual},
                                                    {"free", AxisMode::Free},
                                                    {"locked", AxisMode::Locked},
                                                    {"limited", AxisMode::Limited}};

AxisMode modeOf(const std::string& name) {
    for (const auto& [known, mode] : kModes)
        if (name == known) return mode;
    throw EngineError("joint_axes", "no mode '" + name + "', expected usual, free, locked or limited");
}

template <class S>
JointType jointType(const std::string& name) {
    std::string known;
    for (const JointEntry<S>& entry : jointTable<S>()) {
        if (name == entry.name) return entry.type;
        if (entry.axes >= 0) known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw EngineError("joint_type", "no joint '" + name + "', expected one of " + known);
}

AxisArgs makeAxis(const std::string& mode, double lower, double upper, double motorSpeed,
                  double motorMaxForce, double target, double frequency, double dampingRatio,
                  double stiffness, double damping) {
    AxisArgs axis;
    axis.mode = modeOf(mode);
    axis.lower = lower;
    axis.upper = upper;
    axis.motorSpeed = motorSpeed;
    axis.motorMaxForce = motorMaxForce;
    axis.target = target;
    axis.frequency = frequency;
    axis.dampingRatio = dampingRatio;
    axis.stiffness = stiffness;
    axis.damping = damping;
    return axis;
}

}  // namespace

template <class R>
JointAxis<R> toJointAxis(const AxisArgs& args) {
    const auto number = [](double value) { return static_cast<R>(value); };
    return {args.mode,
            number(args.lower),
            number(args.upper),
            number(args.motorSpeed),
            number(args.motorMaxForce),
            number(args.target),
            number(args.frequency),
            number(args.dampingRatio),
            number(args.stiffness),
            number(args.damping)};
}

template <class S>
JointDef<S> toJointDef(const JointArgs& args) {
    using R = typename S::Real;
    JointDef<S> def;
    def.type = jointType<S>(args.type);
    def.anchorA = toVec<S>(args.anchorA, "anchor_a", def.anchorA);
    def.anchorB = toVec<S>(args.anchorB, "anchor_b", def.anchorB);
    def.axisA = toVec<S>(args.axisA, "axis_a", def.axisA);
    def.axisB = toVec<S>(args.axisB, "axis_b", def.axisB);
    def.spinAxisB = toVec<S>(args.spinAxisB, "spin_axis_b", def.spinAxisB);
    def.normalA = toVec<S>(args.normalA, "normal_a", def.normalA);
    def.length = static_cast<R>(args.length);
    def.collideConnected = args.collideConnected;
    if (args.axes.size() > def.axes.size())
        throw EngineError("joint_axes", "a joint has at most " + std::to_string(def.axes.size()) + " axes");
    for (std::size_t k = 0; k < args.axes.size(); ++k) def.axes[k] = toJointAxis<R>(args.axes[k]);
    def.breakForce = static_cast<R>(args.breakForce);
    def.breakTorque = static_cast<R>(args.breakTorque);
    return def;
}

void bindJoints(py::module_& module) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    py::class_<AxisArgs> axis(module, "JointAxis", R"(Stops, motor and spring along one coordinate of a joint.

Unit u is [m] for travel and [rad] for angles, which count turns.

mode: 'usual' (the joint's own: locked for distance and six_dof, else free), 'free', 'locked' (at `lower` where that equals
    `upper`, else as it was when added), 'limited' (within [lower, upper], infinite for one-sided limits).
motor_speed, motor_max_force: the motor drives the coordinate's rate to this speed [u/s] with at most this force [N] or torque
    [N m]; 0: no motor.
target: rest value of the spring [u]; frequency [Hz] and damping_ratio on the effective mass of the coordinate, or stiffness
    [N/m, N m/rad] and damping [N s/m, N m s/rad].)");
    axis.def(py::init(&makeAxis), py::arg("mode") = "usual", py::kw_only(), py::arg("lower") = -kInfinity,
             py::arg("upper") = kInfinity, py::arg("motor_speed") = 0.0, py::arg("motor_max_force") = 0.0,
             py::arg("target") = 0.0, py::arg("frequency") = 0.0, py::arg("damping_ratio") = 0.0,
             py::arg("stiffness") = 0.0, py::arg("damping") = 0.0);
    axis.def_property_readonly(
        "mode", [](const AxisArgs& a) { return kModes[static_cast<std::size_t>(a.mode)].first; },
        "As given.");
    const auto number = [&axis](const char* name, double AxisArgs::*member) {
        axis.def_readonly(name, member, "As given.");
    };
    number("lower", &AxisArgs::lower);
    number("upper", &AxisArgs::upper);
    number("motor_speed", &AxisArgs::motorSpeed);
    number("motor_max_force", &AxisArgs::motorMaxForce);
    number("target", &AxisArgs::target);
    number("frequency", &AxisArgs::frequency);
    number("damping_ratio", &AxisArgs::dampingRatio);
    number("stiffness", &AxisArgs::stiffness);
    number("damping", &AxisArgs::damping);
}

#define RIGOR_INSTANTIATE(S) template JointDef<S> toJointDef<S>(const JointArgs&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE
template JointAxis<float> toJointAxis<float>(const AxisArgs&);
template JointAxis<double> toJointAxis<double>(const AxisArgs&);

}  // namespace rigor::engine::python
