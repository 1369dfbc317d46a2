// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// See swing.hpp.
#include "validation/references/joints/swing.hpp"

#include <cmath>

namespace rigor::validation {

Swing::Swing(Real frequency, double angle, double rate) : angle0_(angle), rate0_(rate), W_(frequency) {
    if (W_ == 0) return;
    const Real s = std::sin(static_cast<Real>(angle0_) / 2), r = static_cast<Real>(rate0_) / (2 * W_);
    m_ = s * s + r * r;
    if (m_ == 0) return;
    root_ = std::sqrt(m_);
    if (m_ < 1) {
        u0_ = numerics::ellipticF(std::atan2(s / root_, r / root_), m_);
        period_ = 4 * numerics::ellipticK(m_) / W_;
    } else if (m_ > 1) {
        u0_ = numerics::ellipticF(static_cast<Real>(angle0_) / 2, 1 / m_) * (rate0_ < 0 ? -1 : 1);
        period_ = 2 * numerics::ellipticK(1 / m_) / (W_ * root_);
    } else {
        u0_ = std::atanh(rate0_ < 0 ? -s : s);
    }
}

Swing::State Swing::at(double t) const {
    const Real sign = rate0_ < 0 ? -1 : 1;
    if (W_ == 0) return {static_cast<Real>(angle0_) + static_cast<Real>(rate0_) * t, rate0_};
    if (m_ == 0) return {};
    if (m_ < 1) {
        const auto f = numerics::jacobi(W_ * t + u0_, m_);
        return {2 * std::asin(root_ * f.sn), 2 * W_ * root_ * f.cn};
    }
    const auto f = numerics::jacobi(root_ * W_ * t + u0_, 1 / m_);
    return {sign * 2 * f.am, sign * 2 * W_ * root_ * f.dn};
}

Swing::Real Swing::amplitude() const {
    return 2 * std::asin(root_);
}

double Swing::firstPassage() const {
    const Real inU = m_ < 1 ? 4 * numerics::ellipticK(m_) : 2 * numerics::ellipticK(1 / m_);
    const Real ahead = (std::floor(u0_ / inU) + 1) * inU - u0_;
    return static_cast<double>(ahead / (W_ * (m_ < 1 ? 1 : root_)));
}

}  // namespace rigor::validation
