// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/constraints/joint.hpp"

#include "engine/core/error.hpp"

namespace rigor::engine {

#define JOINT(type, name, evaluate, summary) \
    template <class S>                       \
    void evaluate(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
#include "engine/constraints/joints.def"
#undef JOINT

template <class S>
std::span<const JointEntry<S>> jointTable() {
    static constexpr JointEntry<S> table[] = {
#define JOINT(type, name, evaluate, summary) {JointType::type, #name, &evaluate<S>, summary},
#include "engine/constraints/joints.def"
#undef JOINT
    };
    return table;
}

template <class S>
EvaluateJoint<S> findJoint(JointType type) {
    for (const JointEntry<S>& entry : jointTable<S>())
        if (entry.type == type) return entry.evaluate;
    throw EngineError("unknown_joint", "no joint of type " + std::to_string(static_cast<int>(type)));
}

template <class S>
void addAnchorRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    using Vec = typename S::Vec;
    const Vec rA = rotate(A.q, joint.anchorA), rB = rotate(B.q, joint.anchorB);
    const Vec C = (B.p - A.p) + (rB - rA);
    for (int i = 0; i < S::dim; ++i) {
        const Vec e = Vec::Unit(i);
        Row<S>& row = out.add(C[i]);
        row.lin = e;
        row.angA = -cross(rA, e);
        row.angB = cross(rB, e);
    }
}

template <class S>
void addOrientationRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    // C = log(qB (qA relative)^-1), whose rate is wB - wA to first order in C.
    const typename S::Ang C = logMap(compose(B.q, inverse(compose(A.q, joint.relative))));
    if constexpr (S::dim == 2) {
        Row<S>& row = out.add(C);
        row.angA = -1;
        row.angB = 1;
    } else {
        for (int i = 0; i < 3; ++i) {
            Row<S>& row = out.add(C[i]);
            row.angA = -S::Vec::Unit(i);
            row.angB = S::Vec::Unit(i);
        }
    }
}

template <class S>
Joint<S> makeJoint(const JointDef<S>& def, const Pose<S>& A, const typename S::Vec& centerA, const Pose<S>& B,
                   const typename S::Vec& centerB) {
    using Real = typename S::Real;
    if (!def.anchorA.allFinite() || !def.anchorB.allFinite())
        throw EngineError("joint_anchor", "anchors of a joint must be finite");
    const bool usesAxis = def.type == JointType::Slider || (def.type == JointType::Hinge && S::dim == 3);
    const auto unit = [](const typename S::Vec& v) { return std::abs(v.norm() - Real(1)) < Real(1e-4); };
    if (usesAxis && !(unit(def.axisA) && unit(def.axisB)))
        throw EngineError("joint_axis", "axes of a joint must be unit vectors");
    if (def.type == JointType::Distance && !(def.length > 0 && std::isfinite(def.length)))
        throw EngineError("joint_length", "the length of a distance joint must be positive");
    Joint<S> joint;
    joint.type = def.type;
    joint.collideConnected = def.collideConnected;
    joint.anchorA = def.anchorA - centerA;
    joint.anchorB = def.anchorB - centerB;
    joint.axisA = usesAxis ? typename S::Vec(def.axisA.normalized()) : S::Vec::Unit(0);
    joint.axisB = usesAxis ? typename S::Vec(def.axisB.normalized()) : S::Vec::Unit(0);
    if constexpr (S::dim == 2) {
        joint.perpA1 = joint.perpA2 = typename S::Vec(-joint.axisA.y(), joint.axisA.x());
    } else {
        joint.perpA1 = joint.axisA.unitOrthogonal();
        joint.perpA2 = joint.axisA.cross(joint.perpA1);
    }
    joint.relative = compose(inverse(A.q), B.q);
    joint.length = def.length;
    return joint;
}

#define RIGOR_INSTANTIATE(S)                                                                             \
    template std::span<const JointEntry<S>> jointTable<S>();                                             \
    template EvaluateJoint<S> findJoint<S>(JointType);                                                   \
    template void addAnchorRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);      \
    template void addOrientationRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&); \
    template Joint<S> makeJoint<S>(const JointDef<S>&, const Pose<S>&, const S::Vec&, const Pose<S>&,    \
                                   const S::Vec&);
RIGOR_INSTANTIATE(Space2f)
RIGOR_INSTANTIATE(Space2d)
RIGOR_INSTANTIATE(Space3f)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
