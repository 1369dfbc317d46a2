// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact law of one contact alone, exactly. With w = W r + b (r its impulse, b the velocity that all
// other impulses lead to, bias included) there are three cases:
//     open    b_n >= 0: r = 0
//     stick   r = -W^-1 b, if that is in the cone (of static friction)
//     slip    w_n = 0, w_t = -alpha r_t, |r_t| = mu r_n, alpha > 0. With r_n eliminated,
//                 (S + alpha I) r_t = -beta,   S = W_tt - W_tn W_nt / W_nn,   beta = b_t - W_tn b_n / W_nn
//             and alpha is the root of f(alpha) = |r_t| - mu r_n: f(0) > 0 where sticking failed, and
//             f(inf) = mu b_n / W_nn < 0, so that a root exists for every mu; bracketed Newton finds it.
//             Bonnefon and Daviet [BonnefonDaviet2011] state the same as a quartic in alpha.
// Cost: about five Newton steps where it slides. Known limits: where W has a W_tn strong enough (a wedge)
// there is more than one root; which one is found depends on the bracket.
#pragma once

#include "engine/math/space.hpp"

namespace rigor::engine {

/// The impulse (n, t1, t2) of one contact. If `applied` > 0 the limit of friction is mu (r_n + applied), and
/// an open contact may have friction too. In 2D W(2, 2) is any positive number, the rest zero.
template <class R>
Eigen::Matrix<R, 3, 1> solveContactAlone(const Eigen::Matrix<R, 3, 3>& W, const Eigen::Matrix<R, 3, 1>& b,
                                         R mu, R muStatic, R applied);

}  // namespace rigor::engine
