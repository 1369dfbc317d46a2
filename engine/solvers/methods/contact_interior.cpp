// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/methods/contact_interior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rigor::engine {
namespace {

constexpr double kSigma = 1e-11;
constexpr int kMostSteps = 60;
constexpr double kDone = 1e-22;  ///< relative to the start; for velocities this is the rounding of the start
constexpr double kProgress = 0.9;
constexpr int kMaxStalled = 8;          ///< steps without progress
constexpr double kStepFraction = 0.99;  ///< fraction of the way to the boundary of the cones
constexpr double kFar = 0.2;            ///< shorter steps do not pay

double dot(const double* a, const double* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const double* tangent) {
    return std::sqrt(tangent[1] * tangent[1] + tangent[2] * tangent[2]);
}
/// x^T J x = x_0^2 - |x_t|^2, as a product: it is zero on the boundary.
double determinant(const double* x) {
    const double t = length(x);
    return (x[0] - t) * (x[0] + t);
}
/// out = beta (2 v v^T - J) x
void reflect(double beta, const double* v, const double* x, double* out) {
    const double along = 2 * dot(v, x);
    out[0] = beta * (along * v[0] - x[0]);
    out[1] = beta * (along * v[1] + x[1]);
    out[2] = beta * (along * v[2] + x[2]);
}
/// Largest step up to `most` for which x + step d stays in Lorentz's cone.
double stepInCone(const double* x, const double* d, double most) {
    const double a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
    const double b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2], c = determinant(x);
    double step = most;
    if (x[0] + step * d[0] < 0) step = -x[0] / d[0];
    // First positive root of a s^2 + 2 b s + c, in the form that does not cancel.
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return step;
    const double root = std::sqrt(discriminant);
    for (const double s : {c / (-b + root), c / (-b - root)})
        if (s > 0 && s < step) step = s;
    return step;
}

}  // namespace

bool ContactInterior::fits(const AssembledProblem& problem) {
    return std::all_of(problem.contacts.begin(), problem.contacts.end(), [](const AssembledContact& contact) {
        return !(contact.applied > 0) && !(contact.muStatic > contact.mu) && !contact.moment;
    });
}

bool ContactInterior::solve(const AssembledProblem& problem, double shift, std::vector<double>& impulses) {
    begin(problem, shift);
    const double start = gap();
    double best = std::numeric_limits<double>::infinity();
    int slow = 0;
    for (int step = 0; step < kMostSteps; ++step) {
        evaluate(problem);
        const double error = std::max(gap(), distance_ * distance_);
        slow = error < kProgress * best ? 0 : slow + 1;
        if (error < best) {
            best = error;
            impulses = lambda_;
        }
        if (error < kDone * start || slow > kMaxStalled) break;
        scaleCones();
        if (!factor(problem)) break;
        direction(0.0, false);
        const double far = std::min(1.0, longestStep());
        // Mehrotra's rule: little centring where the straight step would go far.
        direction((1 - far) * (1 - far) * (1 - far) * gap(), far > kFar);
        double length = std::min(1.0, kStepFraction * longestStep());
        if (length < kFar) {  // off the path: back to its middle before going on
            direction(gap(), false);
            length = std::min(1.0, kStepFraction * longestStep());
        }
        if (!(length > 1e-12)) break;
        advance(length);
    }
    return std::isfinite(best);
}

void ContactInterior::begin(const AssembledProblem& p, double shift) {
    const std::size_t n = p.n;
    cones_.clear();
    bounds_.clear();
    lambda_.assign(p.lambda.begin(), p.lambda.end());
    w_.resize(n);
    right_.resize(n);
    y_.resize(n);
    pinned_.assign(n, 0);
    // Scaled, velocities and impulses of light and heavy bodies have one scale: roots of energies.
    double size = std::numeric_limits<double>::min();
    for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(p.q[i]) / std::sqrt(p.at(i, i)));
    const bool cold = !(shift < 1);
    if (!cold) {
        size *= shift;
        for (std::size_t i = 0; i < n; ++i) w_[i] = p.velocity(i, lambda_);
    }
    for (std::size_t i = 0; i < n; ++i)
        if (p.kind[i] == RowKind::Bounded) addBounds(p, i, p.lower[i], p.upper[i], size, cold);
    for (const AssembledContact& contact : p.contacts) addCone(p, contact, size, cold);
}

void ContactInterior::addBounds(const AssembledProblem& p, std::size_t i, double lower, double upper,
                                double size, bool cold) {
    const double root = std::sqrt(p.at(i, i)), room = 0.5 * (upper - lower),
                 margin = std::min(size / root, room);
    if (!(room > 1e-12 * size / root)) {  // no inside
        pinned_[i] = 1;
        lambda_[i] = lower;
        return;
    }
    if (cold) lambda_[i] = 0;
    lambda_[i] = std::clamp(lambda_[i], lower + margin, upper - margin);
    for (const double sign : {1.0, -1.0}) {
        Bound bound;
        bound.row = i;
        bound.sign = sign;
        const double at = sign > 0 ? lower : upper;
        if (!std::isfinite(at)) continue;
        bound.a = sign * (lambda_[i] - at);
        bound.z = (cold ? 0.0 : std::max(0.0, sign * w_[i])) + size * root;
        bounds_.push_back(bound);
    }
}

void ContactInterior::addCone(const AssembledProblem& p, const AssembledContact& contact, double size,
                              bool cold) {
    const std::size_t normal = contact.normal;
    if (contact.tangents == 0 || !(contact.mu > 0)) {
        addBounds(p, normal, 0.0, std::numeric_limits<double>::infinity(), size, cold);
        for (std::size_t t = 1; t <= contact.tangents; ++t) {
            pinned_[normal + t] = 1;
            lambda_[normal + t] = 0;
        }
        return;
    }
    Cone cone;
    cone.first = normal;
    cone.rows = 1 + contact.tangents;
    const double c = 1 / std::sqrt(p.at(normal + 1, normal + 1));
    cone.d[0] = c / contact.mu;
    for (std::size_t t = 1; t < cone.rows; ++t) cone.d[t] = c;
    for (std::size_t i = 0; !cold && i < cone.rows; ++i) {
        cone.x[i] = lambda_[normal + i] / cone.d[i];
        cone.u[i] = cone.d[i] * w_[normal + i];
    }
    cone.u[0] += length(cone.u);
    cone.x[0] = size + std::max(cone.x[0], length(cone.x));
    cone.u[0] = size + std::max(cone.u[0], length(cone.u));
    for (std::size_t i = 0; i < cone.rows; ++i) lambda_[normal + i] = cone.d[i] * cone.x[i];
    cones_.push_back(cone);
}

double ContactInterior::gap() const {
    double sum = 0;
    for (const Cone& cone : cones_) sum += dot(cone.x, cone.u);
    for (const Bound& bound : bounds_) sum += bound.a * bound.z;
    const std::size_t count = cones_.size() + bounds_.size();
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// w, and how far the equations are from holding.
void ContactInterior::evaluate(const AssembledProblem& p) {
    distance_ = 0;
    for (std::size_t i = 0; i < p.n; ++i) {
        w_[i] = p.velocity(i, lambda_);
        right_[i] = pinned_[i] ? 0.0 : -w_[i];
    }
    for (const Bound& bound : bounds_) right_[bound.row] += bound.sign * bound.z;
    for (Cone& cone : cones_) {
        const double slip = length(cone.u);
        for (std::size_t i = 0; i < kDim; ++i) {
            cone.t[i] = i > 0 && slip > 0 ? cone.u[i] / slip : 0.0;
            cone.rho[i] = cone.u[i] - (i < cone.rows ? cone.d[i] * w_[cone.first + i] : 0.0);
        }
        cone.rho[0] -= slip;
        for (const double rho : cone.rho) distance_ = std::max(distance_, std::abs(rho));
        cone.rho[0] += dot(cone.t, cone.rho);
    }
    for (std::size_t i = 0; i < p.n; ++i)
        if (p.kind[i] == RowKind::Free || p.kind[i] == RowKind::Bounded)
            distance_ = std::max(distance_, std::abs(right_[i]) / std::sqrt(p.at(i, i)));
}

/// Nesterov and Todd's scaling: T = beta (2 v v^T - J), T^2 = beta^2 (2 w w^T - J), T x = T^-1 u.
void ContactInterior::scaleCones() {
    for (Cone& cone : cones_) {
        const double dx = std::sqrt(determinant(cone.x)), du = std::sqrt(determinant(cone.u));
        const double gamma = std::sqrt(0.5 * (1 + dot(cone.x, cone.u) / (dx * du)));
        for (int i = 0; i < kDim; ++i)
            cone.w[i] = (cone.u[i] / du + (i == 0 ? 1 : -1) * cone.x[i] / dx) / (2 * gamma);
        const double norm = 1 / std::sqrt(2 * (cone.w[0] + 1));
        for (int i = 0; i < kDim; ++i) cone.v[i] = norm * (cone.w[i] + (i == 0 ? 1 : 0));
        cone.beta = std::sqrt(du / dx);
    }
}

/// The matrix B D W D + T^2 in the rows of cones, in terms of lambda: columns divided by d.
bool ContactInterior::factor(const AssembledProblem& p) {
    const std::size_t n = p.n;
    double* A = lu_.reset(n);
    std::copy_n(p.W.data(), n * n, A);
    for (std::size_t i = 0; i < n; ++i) {
        A[i * n + i] *= 1 + kSigma;
        if (!pinned_[i]) continue;
        std::fill_n(A + i * n, n, 0.0);
        A[i * n + i] = 1;
    }
    for (const Bound& bound : bounds_) A[bound.row * n + bound.row] += bound.z / bound.a;
    for (const Cone& cone : cones_) {
        double* row = A + cone.first * n;
        for (std::size_t i = 0; i < cone.rows; ++i)
            for (std::size_t j = 0; j < n; ++j) row[i * n + j] *= cone.d[i];
        for (std::size_t t = 1; t < cone.rows; ++t)
            for (std::size_t j = 0; j < n; ++j) row[j] += cone.t[t] * row[t * n + j];
        const double beta2 = cone.beta * cone.beta;
        for (std::size_t i = 0; i < cone.rows; ++i)
            for (std::size_t j = 0; j < cone.rows; ++j) {
                const double J = i != j ? 0.0 : (i == 0 ? 1.0 : -1.0);
                row[i * n + cone.first + j] += beta2 * (2 * cone.w[i] * cone.w[j] - J) / cone.d[j];
            }
    }
    return lu_.factor();
}

/// Changes of all unknowns towards x o u = centering e; `corrected` with the product of the changes that the
/// last direction has left.
void ContactInterior::direction(double centering, bool corrected) {
    y_.assign(right_.begin(), right_.end());
    for (Bound& bound : bounds_) {
        const double product = corrected ? bound.da * bound.dz : 0.0;
        y_[bound.row] += bound.sign * (centering - bound.a * bound.z - product) / bound.a;
    }
    for (Cone& cone : cones_) {
        // l = T x; h solves l o h = centering e - l o l - (T^-1 du) o (T dx)
        double l[kDim], right[kDim], h[kDim], Th[kDim];
        reflect(cone.beta, cone.v, cone.x, l);
        right[0] = centering - dot(l, l);
        for (int i = 1; i < kDim; ++i) right[i] = -2 * l[0] * l[i];
        if (corrected) {
            const double Jv[kDim] = {cone.v[0], -cone.v[1], -cone.v[2]};
            double a[kDim], b[kDim];
            reflect(1 / cone.beta, Jv, cone.du, a);
            reflect(cone.beta, cone.v, cone.dx, b);
            right[0] -= dot(a, b);
            for (int i = 1; i < kDim; ++i) right[i] -= a[0] * b[i] + b[0] * a[i];
        }
        h[0] = (l[0] * right[0] - l[1] * right[1] - l[2] * right[2]) / determinant(l);
        for (int i = 1; i < kDim; ++i) h[i] = (right[i] - h[0] * l[i]) / l[0];
        reflect(cone.beta, cone.v, h, Th);
        for (int i = 0; i < kDim; ++i) cone.du[i] = Th[i];  // T h - T^2 dx below
        for (std::size_t i = 0; i < cone.rows; ++i) y_[cone.first + i] = Th[i] + cone.rho[i];
    }
    lu_.solve(y_.data());
    for (Bound& bound : bounds_) {
        const double product = corrected ? bound.da * bound.dz : 0.0;
        bound.da = bound.sign * y_[bound.row];
        bound.dz = (centering - bound.a * bound.z - product - bound.z * bound.da) / bound.a;
    }
    for (Cone& cone : cones_) {
        for (std::size_t i = 0; i < cone.rows; ++i) cone.dx[i] = y_[cone.first + i] / cone.d[i];
        double TTdx[kDim];
        reflect(cone.beta * cone.beta, cone.w, cone.dx, TTdx);
        for (int i = 0; i < kDim; ++i) cone.du[i] -= TTdx[i];
    }
}

double ContactInterior::longestStep() const {
    double step = 1e3;
    for (const Cone& cone : cones_) step = stepInCone(cone.u, cone.du, stepInCone(cone.x, cone.dx, step));
    for (const Bound& bound : bounds_) {
        if (bound.da < 0) step = std::min(step, -bound.a / bound.da);
        if (bound.dz < 0) step = std::min(step, -bound.z / bound.dz);
    }
    return step;
}

void ContactInterior::advance(double step) {
    for (std::size_t i = 0; i < lambda_.size(); ++i)
        if (!pinned_[i]) lambda_[i] += step * y_[i];
    for (Bound& bound : bounds_) {
        bound.a += step * bound.da;
        bound.z += step * bound.dz;
    }
    for (Cone& cone : cones_)
        for (int i = 0; i < kDim; ++i) {
            cone.x[i] += step * cone.dx[i];
            cone.u[i] += step * cone.du[i];
        }
}

}  // namespace rigor::engine
