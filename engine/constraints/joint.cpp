// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Rows that several joints share, and the table of joints.
#include "engine/constraints/joint.hpp"

#include "engine/core/error.hpp"

namespace rigor::engine {

#define JOINT(type, name, evaluate, axes2d, axes3d, summary) \
    template <class S>                                       \
    void evaluate(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
#include "engine/constraints/joints.def"
#undef JOINT

template <class S>
std::span<const JointEntry<S>> jointTable() {
    static constexpr JointEntry<S> table[] = {
#define JOINT(type, name, evaluate, axes2d, axes3d, summary) \
    {JointType::type, #name, &evaluate<S>, S::dim == 2 ? axes2d : axes3d, summary},
#include "engine/constraints/joints.def"
#include "engine/math/portable.hpp"
#undef JOINT
    };
    return table;
}

template <class S>
const JointEntry<S>& findJoint(JointType type) {
    for (const JointEntry<S>& entry : jointTable<S>())
        if (entry.type == type) return entry;
    throw EngineError("unknown_joint", "no joint of type " + std::to_string(static_cast<int>(type)));
}

template <class S>
void addAnchorRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    using Vec = typename S::Vec;
    const Vec rA = rotate(A.q, joint.anchorA), rB = rotate(B.q, joint.anchorB);
    const Vec C = (B.p + rB) - (A.p + rA);
    // r x e_i for the axes e_i.
    for (int i = 0; i < S::dim; ++i) out.add(C[i]).lin[i] = typename S::Real(1);
    Row<S>* const row = &out.row[out.count - S::dim];
    if constexpr (S::dim == 2) {
        row[0].angA = rA.y();
        row[1].angA = -rA.x();
        row[0].angB = -rB.y();
        row[1].angB = rB.x();
    } else {
        row[0].angA = {0, -rA.z(), rA.y()};
        row[0].angB = {0, rB.z(), -rB.y()};
        row[1].angA = {rA.z(), 0, -rA.x()};
        row[1].angB = {-rB.z(), 0, rB.x()};
        row[2].angA = {-rA.y(), rA.x(), 0};
        row[2].angB = {rB.y(), -rB.x(), 0};
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

// Rows for t1, t2 normal to aA and fixed in A:  C_i = t_i . aB,  C_i_dot = (wB - wA) . (aB x t_i).
template <class S>
void addParallelRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    if constexpr (S::dim == 3) {
        const typename S::Vec aB = rotate(B.q, joint.turnB);
        for (const typename S::Vec& local : {joint.turnPerpA1, joint.turnPerpA2}) {
            const typename S::Vec t = rotate(A.q, local);
            Row<S>& row = out.add(t.dot(aB));
            row.angB = aB.cross(t);
            row.angA = -row.angB;
        }
    } else {
        (void)joint;
        (void)A;
        (void)B;
        (void)out;
    }
}

namespace {

// d = xB + rB - xA - rA,  (t . d)_dot = t . (vB - vA) + wB . (rB x t) - wA . ((rA + d) x t).
template <class S>
struct Travel {
    typename S::Vec rA, rB, d;
    Travel(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B)
        : rA(rotate(A.q, joint.anchorA)), rB(rotate(B.q, joint.anchorB)), d((B.p + rB) - (A.p + rA)) {}
    void direct(const typename S::Vec& t, Row<S>& row) const {
        row.lin = t;
        row.angA = -cross(typename S::Vec(rA + d), t);
        row.angB = cross(rB, t);
    }
};

}  // namespace

template <class S>
void addLineRows(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    const Travel<S> travel(joint, A, B);
    for (int i = 0; i < S::dim - 1; ++i) {
        const typename S::Vec t = rotate(A.q, i == 0 ? joint.perpA1 : joint.perpA2);
        travel.direct(t, out.add(t.dot(travel.d)));
    }
}

template <class S>
void addTravelCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, const typename S::Vec& t,
                         JointRows<S>& out) {
    const Travel<S> travel(joint, A, B);
    const typename S::Vec world = rotate(A.q, t);
    travel.direct(world, out.coordinate(world.dot(travel.d)));
}

// 3D: from turnPerpA1 to turnPerpB1 about turnA, by atan2 and so as exact at pi as anywhere. Its rate is
// aA . (wB - wA) while the axes are parallel.
template <class S>
void addTurnCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    const typename S::Real last = joint.lastCoordinate[out.axes];
    if constexpr (S::dim == 2) {
        const typename S::Real angle = logMap(compose(B.q, inverse(compose(A.q, joint.relative))));
        Row<S>& row = out.coordinate(unwrapped(angle, last));
        row.angA = -1;
        row.angB = 1;
    } else {
        const typename S::Vec u = rotateInverse(A.q, rotate(B.q, joint.turnPerpB1));
        Row<S>& row = out.coordinate(
            unwrapped(portable::atan2(joint.turnPerpA2.dot(u), joint.turnPerpA1.dot(u)), last));
        row.angB = rotate(A.q, joint.turnA);
        row.angA = -row.angB;
    }
}

template <class S>
AxisRowCount countAxisRows(const Joint<S>& joint) {
    AxisRowCount n;
    for (std::size_t k = 0; k < static_cast<std::size_t>(joint.axisCount); ++k) {
        const JointAxis<typename S::Real>& axis = joint.axes[k];
        if (axis.mode == AxisMode::Locked) ++n.equalities;
        if (axis.mode == AxisMode::Limited) n.rows += std::isfinite(axis.lower) + std::isfinite(axis.upper);
        n.rows += axis.hasMotor() + axis.hasSpring();
    }
    n.rows += n.equalities;
    return n;
}

template <class S>
void addAxisRows(const Joint<S>& joint, JointRows<S>& out) {
    using Real = typename S::Real;
    const auto append = [&](Real C, const Row<S>& along, Real sign, const RowLaw<S>& law) {
        Row<S>& row = out.add(C, law);
        row.lin = sign * along.lin;
        row.angA = sign * along.angA;
        row.angB = sign * along.angB;
    };
    const auto n = static_cast<std::size_t>(out.axes);
    for (std::size_t k = 0; k < n; ++k)
        if (joint.axes[k].mode == AxisMode::Locked)
            append(out.value[k] - joint.axes[k].lower, out.along[k], Real(1), {});
    for (std::size_t k = 0; k < n; ++k) {
        const JointAxis<Real>& axis = joint.axes[k];
        const Row<S>& along = out.along[k];
        const Real x = out.value[k];
        RowLaw<S> law;
        if (axis.mode == AxisMode::Limited) {
            law.role = RowRole::Limit;
            if (std::isfinite(axis.lower)) append(x - axis.lower, along, Real(1), law);
            if (std::isfinite(axis.upper)) append(axis.upper - x, along, Real(-1), law);
        }
        if (axis.hasMotor()) {
            law.role = RowRole::Motor;
            law.speed = axis.motorSpeed;
            law.maxForce = axis.motorMaxForce;
            append(Real(0), along, Real(1), law);
        }
        if (axis.hasSpring()) {
            law.role = RowRole::Spring;
            law.stiffness = axis.stiffness;
            law.damping = axis.damping;
            law.softness = {axis.frequency, axis.dampingRatio};
            append(x - axis.target, along, Real(1), law);
        }
    }
}

#define RIGOR_INSTANTIATE(S)                                                                             \
    template std::span<const JointEntry<S>> jointTable<S>();                                             \
    template const JointEntry<S>& findJoint<S>(JointType);                                               \
    template void addAnchorRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);      \
    template void addOrientationRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&); \
    template void addParallelRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);    \
    template void addLineRows<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);        \
    template void addTravelCoordinate<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, const S::Vec&, \
                                         JointRows<S>&);                                                 \
    template void addTurnCoordinate<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);  \
    template AxisRowCount countAxisRows<S>(const Joint<S>&);                                             \
    template void addAxisRows<S>(const Joint<S>&, JointRows<S>&);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
