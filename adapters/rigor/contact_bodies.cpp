// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/rigor/contact_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::adapter {
namespace {

constexpr double kEqual = 1e-9;  ///< relative: files are written with 10 or more digits

[[noreturn]] void refuse(const std::string& what) {
    throw Unsupported("needs rigid bodies, but " + what);
}

/// Calls action(row, value) for each entry of a column.
template <class Action>
void forEach(const SparseMatrix& A, int column, const Action& action) {
    const auto j = static_cast<std::size_t>(column);
    for (int k = A.start[j]; k < A.start[j + 1]; ++k) action(A.row[k], A.value[k]);
}

std::size_t place(int i) {
    return i;
}

using BodyMatrix = std::array<std::array<double, 6>, 6>;

/// x = A^-1 b for the symmetric positive definite inertia, by cofactors.
std::array<double, 3> solveInertia(const std::array<std::array<double, 3>, 3>& A,
                                   const std::array<double, 3>& b) {
    const Vec3 r0{A[0][0], A[0][1], A[0][2]}, r1{A[1][0], A[1][1], A[1][2]}, r2{A[2][0], A[2][1], A[2][2]};
    const double det = dot(r0, cross(r1, r2));
    if (!(det > 0.0)) refuse("an inertia is not positive definite");
    const Vec3 x = (b[0] * cross(r1, r2) + b[1] * cross(r2, r0) + b[2] * cross(r0, r1)) / det;
    return {x.x, x.y, x.z};
}

ProblemBody readBody(const BodyMatrix& block, const double* f, int dimension, int index) {
    const std::string name = "block " + std::to_string(index) + " of M";
    const int lin = dimension, dofs = dimension == 3 ? 6 : 3;
    ProblemBody body;
    body.mass = block[0][0];
    if (!(body.mass > 0.0)) refuse(name + " has no mass");
    double largest = 0.0;
    for (int i = 0; i < dofs; ++i)
        for (int j = 0; j < dofs; ++j) largest = std::max(largest, std::abs(block[place(i)][place(j)]));
    for (int i = 0; i < dofs; ++i)
        for (int j = 0; j < dofs; ++j) {
            const double x = block[place(i)][place(j)];
            if (i >= lin && j >= lin) {
                body.inertia[place(i - lin)][place(j - lin)] = x;
                if (std::abs(x - block[place(j)][place(i)]) > kEqual * largest)
                    refuse(name + " is not symmetric");
            } else if (std::abs(x - (i == j ? body.mass : 0.0)) > kEqual * largest) {
                refuse(name + " is not one mass and one inertia");
            }
        }
    for (int i = 0; i < lin; ++i) body.freeVelocity[place(i)] = f[i] / body.mass;
    if (dimension == 2) {
        if (!(body.inertia[0][0] > 0.0)) refuse(name + " has no inertia");
        body.freeVelocity[2] = f[2] / body.inertia[0][0];
        return body;
    }
    const auto w = solveInertia(body.inertia, {f[3], f[4], f[5]});
    for (std::size_t i = 0; i < 3; ++i) body.freeVelocity[3 + i] = w[i];
    return body;
}

void readMasses(const ContactProblem& p, int dofs, ProblemBodies& out) {
    if (p.M.rows % dofs != 0)
        refuse("M has " + std::to_string(p.M.rows) + " rows, no multiple of " + std::to_string(dofs));
    const int bodies = p.M.rows / dofs;
    std::vector<BodyMatrix> blocks(place(bodies), BodyMatrix{});
    for (int j = 0; j < p.M.columns; ++j)
        forEach(p.M, j, [&](int i, double x) {
            if (x == 0.0) return;
            if (i / dofs != j / dofs)
                refuse("M couples rows " + std::to_string(i) + " and " + std::to_string(j));
            blocks[place(i / dofs)][place(i % dofs)][place(j % dofs)] = x;
        });
    for (int b = 0; b < bodies; ++b)
        out.bodies.push_back(readBody(blocks[place(b)], p.f.data() + b * dofs, p.dimension, b));
}

ProblemContact readContact(const ContactProblem& p, int dofs, int contact) {
    const std::string name = "contact " + std::to_string(contact);
    ProblemContact c;
    for (int k = 0; k < p.dimension; ++k)
        forEach(p.H, contact * p.dimension + k, [&](int i, double x) {
            const int body = i / dofs;
            if (x == 0.0 || body == c.a || body == c.b) return;
            if (c.a >= 0) refuse(name + " touches more than two bodies");
            (c.b < 0 ? c.b : c.a) = body;
        });
    if (c.b < 0) refuse(name + " touches no body");
    if (c.a > c.b) std::swap(c.a, c.b);
    if (c.a >= 0 && c.b < 0) std::swap(c.a, c.b);
    for (int k = 0; k < p.dimension; ++k) {
        ProblemContact::Row& row = c.rows[place(k)];
        std::array<double, 3> linA{};
        double largest = 0.0;
        forEach(p.H, contact * p.dimension + k, [&](int i, double x) {
            const bool ofB = i / dofs == c.b;
            const int at = i % dofs;
            largest = std::max(largest, std::abs(x));
            if (at < p.dimension)
                (ofB ? row.lin : linA)[place(at)] = x;
            else
                (ofB ? row.angB : row.angA)[place(at - p.dimension)] = x;
        });
        for (std::size_t i = 0; c.a >= 0 && i < 3; ++i)
            if (std::abs(linA[i] + row.lin[i]) > kEqual * largest)
                refuse(name + " does not push its bodies equally and oppositely");
    }
    return c;
}

}  // namespace

ProblemBodies readBodies(const ContactProblem& problem) {
    if (!problem.hasBodies) throw Unsupported("needs bodies, and the problem is given by W and q alone");
    const int dofs = problem.dimension == 3 ? 6 : 3;
    ProblemBodies out;
    readMasses(problem, dofs, out);
    for (std::size_t c = 0; c < problem.contacts(); ++c)
        out.contacts.push_back(readContact(problem, dofs, c));
    return out;
}

}  // namespace rigor::adapter
