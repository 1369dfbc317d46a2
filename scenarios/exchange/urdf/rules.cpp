// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/urdf/rules.hpp"

namespace rigor::models {
namespace {

using enum Verdict;

constexpr const char* kSoft = "softness of contacts: those of a scenario are rigid";
constexpr const char* kActuator = "a scenario has no actuators";
constexpr const char* kBound = "it bounds actuators, of which a scenario has none";

constexpr ElementRule kRules[] = {
    {"robot", "", Read},
    {"robot", "name", Read},
    {"robot", "version", NoPhysics},
    {"material", "", NoPhysics},
    {"link", "", Read},
    {"link", "name", Read},
    {"link", "type", NoPhysics},
    {"visual", "", NoPhysics},
    {"inertial", "", Read},
    {"mass", "", Read},
    {"mass", "value", Read},
    {"inertia", "", Read},
    {"inertia", "*", Read},
    {"origin", "", Read},
    {"origin", "xyz", Read},
    {"origin", "rpy", Read},
    {"collision", "", Read},
    {"collision", "name", Read},
    {"collision", "group", NoPhysics},
    {"collision/verbose", "", NoPhysics},
    {"geometry", "", Read},
    {"geometry/box", "", Read},
    {"box", "size", Read},
    {"geometry/sphere", "", Read},
    {"sphere", "radius", Read},
    {"geometry/cylinder", "", Read},
    {"cylinder", "radius", Read},
    {"cylinder", "length", Read},
    {"geometry/capsule", "", Read},
    {"capsule", "radius", Read},
    {"capsule", "length", Read},
    {"geometry/mesh", "", Read},
    {"mesh", "filename", Read},
    {"mesh", "scale", Read},
    {"robot/joint", "", Read},
    {"joint", "name", Read},
    {"joint", "type", Read},
    {"parent", "", Read},
    {"parent", "link", Read},
    {"child", "", Read},
    {"child", "link", Read},
    {"axis", "", Read},
    {"axis", "xyz", Read},
    {"limit", "", Read},
    {"limit", "lower", Read},
    {"limit", "upper", Read},
    {"limit", "effort", Read, "", kBound},
    {"limit", "velocity", Read, "", kBound},
    {"joint/dynamics", "", Read},
    {"dynamics", "damping", Read},
    {"dynamics", "friction", Read},
    {"mimic", "", Feature, "mimic", "a joint that follows another has no counterpart"},
    {"safety_controller", "", Feature, "actuators", kActuator},
    {"calibration", "", NoPhysics},
    {"transmission", "", Feature, "actuators", kActuator},
    {"gazebo", "", Feature, "gazebo", "Gazebo's extensions of URDF are not read"},
    {"frame", "", NoPhysics},
    {"sensor", "", NoPhysics},
    {"link/contact", "", Read},
    {"contact/lateral_friction", "", Read},
    {"lateral_friction", "value", Read},
    {"contact/rolling_friction", "", Read},
    {"rolling_friction", "value", Read},
    {"contact/spinning_friction", "", Read},
    {"spinning_friction", "value", Read},
    {"contact/restitution", "", Read},
    {"restitution", "value", Read},
    {"contact/inertia_scaling", "", Feature, "inertia_scaling", "scaling of the inertia is not read"},
    {"contact/contact_cfm", "", Feature, "softness", kSoft},
    {"contact/contact_erp", "", Feature, "softness", kSoft},
    {"contact/stiffness", "", Feature, "softness", kSoft},
    {"contact/damping", "", Feature, "softness", kSoft},
    {"collision/drake:proximity_properties", "", Read},
    {"drake:proximity_properties/drake:mu_static", "", Read},
    {"drake:mu_static", "value", Read},
    {"drake:proximity_properties/drake:mu_dynamic", "", Read},
    {"drake:mu_dynamic", "value", Read},
    {"drake:proximity_properties/*", "", Feature, "softness", kSoft},
    {"drake:collision_filter_group", "", Feature, "contact_filters",
     "Drake's groups of filters are not read"},
};

}  // namespace

std::span<const ElementRule> urdfRules() {
    return kRules;
}

}  // namespace rigor::models
