// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Torque-free rotation in closed form. Principal moments I1 <= I2 <= I3, L and T constant.
//   symmetric (axis s):  R(t) = Rot(L/|L|, |L| t/I) R(0) Rot(s, w_s (1 - I_s/I) t)
//   asymmetric, L^2 > 2 T I2:  w1 = A1 cn(u), w2 = A2 sn(u), w3 = A3 dn(u), u = p t + u0, parameter m;
//   otherwise the axes 1 and 3 change roles. With c the dn axis, the body turns about L by
//   phi' = L (2 T - I_c w_c^2)/(L^2 - I_c^2 w_c^2), smooth because w_c never vanishes.
// All differences such as 2 T I3 - L^2 are formed as sums of positive terms: no cancellation.
#include <array>
#include <cmath>

#include "validation/references/flight/rotation.hpp"
#include "validation/references/numerics/elliptic.hpp"
#include "validation/references/numerics/principal_axes.hpp"

namespace rigor::validation {
namespace {

using numerics::Real;

constexpr double kSame = 1e-13;            // moments equal to this are one moment
constexpr Real kSeparatrixMargin = 1e-9L;  // 1 - m below this: integrate

std::array<double, 3> components(Vec3 v) {
    return {v.x, v.y, v.z};
}
Vec3 toVec(const std::array<double, 3>& a) {
    return {a[0], a[1], a[2]};
}

}  // namespace

TorqueFreeMotion::TorqueFreeMotion(const Body& body, int dimension, double duration)
    : q0_(scenario::normalized(body.pose.orientation)), w0_(body.angularVelocity) {
    const Mat3& inertia = body.massProperties.inertia;
    if (dimension == 2) {
        angularMomentum_ = inertia(2, 2) * w0_;
        return;
    }
    const auto principal = numerics::principalAxes(inertia);
    moments_ = components(principal.values);
    frameInBody_ = numerics::toQuaternion(principal.axes);
    frame0_ = q0_ * frameInBody_;
    rates0_ = components(rotateInverse(frame0_, w0_));
    std::array<double, 3> momentum{};
    for (std::size_t i = 0; i < 3; ++i) momentum[i] = moments_[i] * rates0_[i];
    angularMomentum_ = rotate(frame0_, toVec(momentum));
    momentum_ = norm(angularMomentum_);
    // Spin about a principal axis: w parallel to L.
    if (norm(cross(toVec(momentum), toVec(rates0_))) <= 1e-15 * momentum_ * norm(w0_)) return;
    const double scale = moments_[2];
    if (moments_[1] - moments_[0] <= kSame * scale) {
        buildSymmetric(false);
    } else if (moments_[2] - moments_[1] <= kSame * scale) {
        buildSymmetric(true);
    } else {
        buildAsymmetric();
        if (kind_ == Kind::Integrated) integrated_.emplace(inertia, 1.0, Vec3{}, Vec3{}, q0_, w0_, duration);
    }
}

void TorqueFreeMotion::buildSymmetric(bool prolate) {
    kind_ = Kind::Symmetric;
    const std::size_t s = prolate ? 0 : 2;
    std::array<double, 3> axis{};
    axis[s] = 1.0;
    symmetryAxis_ = rotate(frameInBody_, toVec(axis));
    precession_ = momentum_ / moments_[1];
    spinRate_ = rates0_[s] * (1.0 - moments_[s] / moments_[1]);
}

void TorqueFreeMotion::buildAsymmetric() {
    kind_ = Kind::Asymmetric;
    std::array<Real, 3> I{}, w{};
    for (std::size_t i = 0; i < 3; ++i) {
        I[i] = moments_[i];
        w[i] = rates0_[i];
    }
    const Real high =
        I[0] * (I[2] - I[0]) * w[0] * w[0] + I[1] * (I[2] - I[1]) * w[1] * w[1];               // 2 T I3 - L^2
    const Real low = I[1] * (I[1] - I[0]) * w[1] * w[1] + I[2] * (I[2] - I[0]) * w[2] * w[2];  // L^2 - 2 T I1
    const bool aboutThird = I[2] * (I[2] - I[1]) * w[2] * w[2] > I[0] * (I[1] - I[0]) * w[0] * w[0];
    const Real product = I[0] * I[1] * I[2];
    axisDn_ = aboutThird ? 2 : 0;
    axisCn_ = 2 - axisDn_;
    amplitude_[0] = std::sqrt(high / (I[0] * (I[2] - I[0])));
    amplitude_[2] = std::sqrt(low / (I[2] * (I[2] - I[0])));
    if (aboutThird) {
        amplitude_[1] = std::sqrt(high / (I[1] * (I[2] - I[1])));
        rate_ = std::sqrt((I[2] - I[1]) * low / product);
        parameter_ = (I[1] - I[0]) * high / ((I[2] - I[1]) * low);
    } else {
        amplitude_[1] = std::sqrt(low / (I[1] * (I[1] - I[0])));
        rate_ = std::sqrt((I[1] - I[0]) * high / product);
        parameter_ = (I[2] - I[1]) * low / ((I[1] - I[0]) * high);
    }
    if (!(1 - parameter_ > kSeparatrixMargin)) {
        kind_ = Kind::Integrated;
        return;
    }
    // Euler's equations fix the signs: the product of the three amplitudes is positive.
    if (w[axisDn_] < 0) {
        amplitude_[axisDn_] = -amplitude_[axisDn_];
        amplitude_[1] = -amplitude_[1];
    }
    u0_ = numerics::ellipticF(std::atan2(w[1] / amplitude_[1], w[axisCn_] / amplitude_[axisCn_]), parameter_);
    halfPeriod_ = 2 * numerics::ellipticK(parameter_);
    const auto turning = [this](Real u, const numerics::OdeState&, numerics::OdeState& d) {
        const auto f = numerics::jacobi(u, parameter_);
        const Real a = amplitude_[axisCn_] * f.cn, b = amplitude_[1] * f.sn;
        const Real Ia = moments_[axisCn_], Ib = moments_[1];
        d[0] = static_cast<Real>(momentum_) / rate_ * (Ia * a * a + Ib * b * b) /
               (Ia * Ia * a * a + Ib * Ib * b * b);
    };
    precessionTable_ = numerics::DenseSolution(turning, 0, {0}, halfPeriod_, 1e-15L);
    halfPeriodPrecession_ = precessionTable_.at(halfPeriod_)[0];
}

Vec3 TorqueFreeMotion::principalRates(Real u) const {
    const auto f = numerics::jacobi(u, parameter_);
    std::array<double, 3> w{};
    w[axisCn_] = static_cast<double>(amplitude_[axisCn_] * f.cn);
    w[1] = static_cast<double>(amplitude_[1] * f.sn);
    w[axisDn_] = static_cast<double>(amplitude_[axisDn_] * f.dn);
    return toVec(w);
}

/// Angle turned about L since u = 0; the rate has half the period of sn.
Real TorqueFreeMotion::precessionAt(Real u) const {
    const Real turns = std::floor(u / halfPeriod_);
    return turns * halfPeriodPrecession_ + precessionTable_.at(u - turns * halfPeriod_)[0];
}

Attitude TorqueFreeMotion::at(double t) const {
    switch (kind_) {
        case Kind::Symmetric:
            return symmetricAt(t);
        case Kind::Asymmetric:
            return asymmetricAt(t);
        case Kind::Integrated:
            return integrated_->at(t);
        case Kind::Constant:
            break;
    }
    return {turned(q0_, w0_, t), w0_};
}

Attitude TorqueFreeMotion::symmetricAt(double t) const {
    const Vec3 axis = angularMomentum_ / momentum_;
    Attitude attitude;
    attitude.orientation = scenario::normalized(scenario::fromAxisAngle(axis, precession_ * t) * q0_ *
                                                scenario::fromAxisAngle(symmetryAxis_, spinRate_ * t));
    // L = I w + (I_s - I) w_s s gives w.
    const double other = moments_[1];
    attitude.angularVelocity =
        angularMomentum_ / other + spinRate_ * rotate(attitude.orientation, symmetryAxis_);
    return attitude;
}

Attitude TorqueFreeMotion::asymmetricAt(double t) const {
    const Real u = rate_ * t + u0_;
    const Real angle = precessionAt(u) - precessionAt(u0_);
    // Triads (x, y, z): z along L, x the part of the dn axis across L; in the frame and in the world.
    const auto triad = [&](Vec3 rates) {
        const auto w = components(rates);
        std::array<double, 3> l{}, x{};
        for (std::size_t i = 0; i < 3; ++i) l[i] = moments_[i] * w[i];
        x[axisDn_] = l[axisCn_] * l[axisCn_] + l[1] * l[1];
        x[axisCn_] = -l[axisDn_] * l[axisCn_];
        x[1] = -l[axisDn_] * l[1];
        Mat3 m;
        const Vec3 ex = unit(toVec(x)), ez = unit(toVec(l)), ey = cross(ez, ex);
        m(0, 0) = ex.x;
        m(1, 0) = ex.y;
        m(2, 0) = ex.z;
        m(0, 1) = ey.x;
        m(1, 1) = ey.y;
        m(2, 1) = ey.z;
        m(0, 2) = ez.x;
        m(1, 2) = ez.y;
        m(2, 2) = ez.z;
        return m;
    };
    const Vec3 rates = principalRates(u);
    const Quat start = frame0_ * numerics::toQuaternion(triad(toVec(rates0_)));
    const Quat turn = scenario::fromAxisAngle({0, 0, 1}, static_cast<double>(angle));
    const Quat frame = start * turn * conjugate(numerics::toQuaternion(triad(rates)));
    Attitude attitude;
    attitude.orientation = scenario::normalized(frame * conjugate(frameInBody_));
    attitude.angularVelocity = rotate(frame, rates);
    return attitude;
}

double TorqueFreeMotion::period() const {
    return static_cast<double>(2 * halfPeriod_ / rate_);
}

double TorqueFreeMotion::firstFlip() const {
    // sn vanishes at u = 0, 2 K, 4 K, ...
    const Real ahead = std::floor(u0_ / halfPeriod_) + 1;
    return static_cast<double>((ahead * halfPeriod_ - u0_) / rate_);
}

Vec3 TorqueFreeMotion::intermediateAxis() const {
    return rotate(frameInBody_, {0, 1, 0});
}

}  // namespace rigor::validation
