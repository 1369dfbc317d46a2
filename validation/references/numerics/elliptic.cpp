// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See elliptic.hpp.
#include "validation/references/numerics/elliptic.hpp"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <stdexcept>

namespace rigor::validation::numerics {
namespace {

/// The modulus of a parameter in [0, 1), or in [0, 1].
Real modulusOf(Real m, bool oneAllowed) {
    if (!(m >= 0 && (m < 1 || (oneAllowed && m == 1))))
        throw std::domain_error("elliptic function: parameter m outside [0, 1)");
    return std::sqrt(m);
}

}  // namespace

Real ellipticK(Real m) {
    return boost::math::ellint_1(modulusOf(m, false));
}

Real ellipticE(Real m) {
    return boost::math::ellint_2(modulusOf(m, true));
}

Real ellipticF(Real phi, Real m) {
    return boost::math::ellint_1(modulusOf(m, false), phi);
}

Jacobi jacobi(Real u, Real m) {
    const Real k = modulusOf(m, true);
    // Whole half periods 2 K are taken off: Boost knows no amplitude, and its series for small k has terms
    // that grow with u.
    const Real period = m < 1 ? 2 * ellipticK(m) : 0, turns = m < 1 ? std::round(u / period) : 0;
    Jacobi f;
    f.sn = boost::math::jacobi_elliptic(k, u - turns * period, &f.cn, &f.dn);
    // Boost 1.74 has dn as a quotient of two cosines that vanish together at u = K.
    f.dn = std::sqrt(f.cn * f.cn + (1 - m) * f.sn * f.sn);
    f.am = std::atan2(f.sn, f.cn) + turns * kPi;
    if (std::fmod(turns, 2) != 0) {
        f.sn = -f.sn;
        f.cn = -f.cn;
    }
    return f;
}

}  // namespace rigor::validation::numerics
