// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Twist and swing. Let x, y, z be turnA, turnPerpA1, turnPerpA2 in world axes, b = aB the axis of B, and
// w = wB - wA. The swing is the shortest rotation that takes x to b, by the angle phi; what is left of the
// relative rotation is a twist tau about x. In a frame that turns with A:
//     cone     phi = atan2(|x x b|, x . b)             phi_dot = n . w,   n = x x b / |x x b|
//     twist    tau = angle from y to yB swung back     tau_dot = (x + b) . w / (1 + x . b)
//     swing    s = phi n = (0, s_y, s_z)               s_dot = [n n^T + phi cot(phi) e e^T] w - phi e (x . w)
//              with e = n x x the unit vector of b's part normal to x, phi e = (0, s_z, -s_y)
// The twist's rate follows from tau = 2 atan2(q_x, q_w) of the relative quaternion and q_dot = w q / 2; the
// swing's from the rates of phi and of the azimuth of b. All are exact gradients, so that limits and springs
// do the work that their energies say. Where b = -x (phi = pi) twist and swing are not defined; rates are
// kept finite there.
#include "engine/constraints/swing.hpp"

#include <algorithm>

#include "engine/math/portable.hpp"

namespace rigor::engine {
namespace {

template <class S>
struct Swing {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    Vec x, y, z, b;
    Vec by;      ///< y of B
    Vec normal;  ///< x x b
    Vec n;       ///< unit; any normal of x where x and b are parallel
    Real cosine, sine, phi;

    Swing(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B)
        : x(rotate(A.q, joint.turnA)),
          y(rotate(A.q, joint.turnPerpA1)),
          z(rotate(A.q, joint.turnPerpA2)),
          b(rotate(B.q, joint.turnB)),
          by(rotate(B.q, joint.turnPerpB1)) {
        normal = cross(x, b);
        cosine = x.dot(b);
        sine = normal.norm();
        phi = portable::atan2(sine, cosine);
        // The cross product of nearly parallel vectors is rounding in any direction: it is made normal to x
        // again.
        const Vec u = normal - x.dot(normal) * x;
        const Real length = u.norm();
        n = length > std::numeric_limits<Real>::min() ? Vec(u / length) : y;
    }
    /// 1 + x . b, kept away from zero.
    Real opening() const { return std::max(Real(1) + cosine, std::numeric_limits<Real>::epsilon()); }
    /// v rotated back by the swing: R v = v cos + (m x v) sin + m (m . v)(1 - cos) with m = -n.
    Vec swungBack(const Vec& v) const {
        return cosine * v - sine * cross(n, v) + (Real(1) - cosine) * n.dot(v) * n;
    }
};

template <class S>
void direct(const typename S::Vec& rate, Row<S>& row) {
    row.angB = rate;
    row.angA = -rate;
}

}  // namespace

template <class S>
void addTwistCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    const typename S::Real last = joint.lastCoordinate[out.axes];
    const Swing<S> swing(joint, A, B);
    const typename S::Vec u = swing.swungBack(swing.by);
    Row<S>& row = out.coordinate(unwrapped(portable::atan2(u.dot(swing.z), u.dot(swing.y)), last));
    direct<S>((swing.x + swing.b) / swing.opening(), row);
}

template <class S>
void addConeCoordinate(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    const Swing<S> swing(joint, A, B);
    direct<S>(swing.n, out.coordinate(swing.phi));
}

template <class S>
void addSwingCoordinates(const Joint<S>& joint, const Pose<S>& A, const Pose<S>& B, JointRows<S>& out) {
    using Real = typename S::Real;
    using Vec = typename S::Vec;
    const Swing<S> swing(joint, A, B);
    // phi / sin(phi) and phi cot(phi) - 1: 1 and 0 near zero; near pi, where they have no bound, kept within
    // reason.
    const Real floor = std::sqrt(std::numeric_limits<Real>::epsilon());
    const Real sine = std::max(swing.sine, floor);
    const bool small = swing.phi < floor;
    const Vec s = (small ? Real(1) : swing.phi / sine) * swing.normal;
    const Vec side = cross(s, swing.x), e = cross(swing.n, swing.x);
    const Real bent = small ? Real(0) : swing.phi * swing.cosine / sine - Real(1);
    for (const Vec& t : {swing.y, swing.z})
        direct<S>(t + bent * t.dot(e) * e - t.dot(side) * swing.x, out.coordinate(t.dot(s)));
}

#define RIGOR_INSTANTIATE(S)                                                                             \
    template void addTwistCoordinate<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&); \
    template void addConeCoordinate<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);  \
    template void addSwingCoordinates<S>(const Joint<S>&, const Pose<S>&, const Pose<S>&, JointRows<S>&);
RIGOR_INSTANTIATE(Space3f)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
