// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Global to local: W = H^T A^-1 H, q = w + H^T A^-1 f, with A = M, or with bilateral constraints
//     A = | M  -G |   acting on (v, l), H and f continued by 0 and -b.
//         | G^T 0 |
// A falls into independent groups of unknowns (bodies, linkages: the connected components of its pattern);
// each is factored by LU with partial pivoting, since M need not be symmetric. Cost: the sum of the cubes of
// the groups' sizes.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "validation/contact_problems/problem.hpp"

namespace rigor::validation {
namespace {

using adapter::BadInput;

std::size_t place(int i) {
    return i;
}

using Lu = Eigen::PartialPivLU<Eigen::MatrixXd>;

/// A of the equations above, factored group by group.
class Dynamics {
  public:
    explicit Dynamics(const ExportedProblem& exported) : bodies_(place(exported.problem.M.rows)) {
        std::vector<Triplet> A = toTriplets(exported.problem.M);
        const int m = exported.problem.M.rows;
        for (const Triplet& g : toTriplets(exported.G)) {
            A.push_back({g.row, m + g.column, -g.value});
            A.push_back({m + g.column, g.row, g.value});
        }
        size_ = place(m + exported.G.columns);
        findGroups(A);
        factor(A);
    }

    std::size_t size() const { return size_; }
    std::size_t groups() const { return members_.size(); }
    std::size_t groupOf(int unknown) const { return group_[place(unknown)]; }
    const std::vector<int>& members(std::size_t group) const { return members_[group]; }
    std::size_t within(int unknown) const { return within_[place(unknown)]; }
    void solve(std::size_t group, std::vector<double>& x) const {
        auto part = Eigen::VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
        part = lu_[group].solve(part).eval();
    }
    /// x := A^-1 x for a vector over all unknowns.
    void solveAll(std::vector<double>& x) const {
        std::vector<double> part;
        for (std::size_t g = 0; g < groups(); ++g) {
            part.clear();
            for (const int i : members_[g]) part.push_back(x[place(i)]);
            solve(g, part);
            for (std::size_t k = 0; k < part.size(); ++k) x[place(members_[g][k])] = part[k];
        }
    }

  private:
    void findGroups(const std::vector<Triplet>& A) {
        std::vector<std::size_t> root(size_);
        std::iota(root.begin(), root.end(), 0);
        const auto find = [&root](std::size_t i) {
            while (root[i] != i) i = root[i] = root[root[i]];
            return i;
        };
        for (const Triplet& e : A)
            if (e.value != 0.0) root[find(place(e.row))] = find(place(e.column));
        group_.assign(size_, size_);
        within_.assign(size_, 0);
        std::vector<std::size_t> groupOfRoot(size_, size_);
        for (std::size_t i = 0; i < size_; ++i) {
            const std::size_t r = find(i);
            if (groupOfRoot[r] == size_) {
                groupOfRoot[r] = members_.size();
                members_.emplace_back();
            }
            group_[i] = groupOfRoot[r];
            within_[i] = members_[group_[i]].size();
            members_[group_[i]].push_back(i);
        }
    }
    void factor(const std::vector<Triplet>& A) {
        std::vector<Eigen::MatrixXd> blocks;
        double entries = 0.0;
        for (const auto& group : members_) entries += std::pow(static_cast<double>(group.size()), 2);
        checkDenseSize(static_cast<std::size_t>(std::sqrt(entries)));
        for (const auto& group : members_) {
            const auto size = static_cast<Eigen::Index>(group.size());
            blocks.emplace_back(Eigen::MatrixXd::Zero(size, size));
        }
        for (const Triplet& e : A) blocks[groupOf(e.row)](within(e.row), within(e.column)) += e.value;
        for (std::size_t g = 0; g < blocks.size(); ++g) {
            lu_.emplace_back(std::move(blocks[g]));
            if ((lu_.back().matrixLU().diagonal().array().abs() > 0.0).all()) continue;
            const std::string name = place(members_[g].front()) < bodies_ ? "M (with G)" : "G";
            throw BadInput(name + " is singular in the group of unknown " +
                           std::to_string(members_[g].front()));
        }
    }

    std::size_t bodies_, size_ = 0;
    std::vector<std::size_t> group_, within_;
    std::vector<std::vector<int>> members_;
    std::vector<Lu> lu_;
};

/// f, continued by -b.
std::vector<double> load(const ExportedProblem& exported) {
    std::vector<double> x = exported.problem.f;
    for (const double b : exported.b) x.push_back(-b);
    return x;
}

void condense(ExportedProblem& exported) {
    ContactProblem& p = exported.problem;
    const Dynamics dynamics(exported);
    const std::size_t n = p.w.size();
    std::vector<double> free = load(exported);
    dynamics.solveAll(free);
    p.q = p.w;
    checkDenseSize(n);
    multiplyTransposedAdd(p.H, free, p.q);
    p.W.assign(n * n, 0.0);
    // Columns of H that touch each group.
    std::vector<std::vector<int>> touching(dynamics.groups());
    for (const Triplet& e : toTriplets(p.H)) {
        auto& columns = touching[dynamics.groupOf(e.row)];
        if (e.value != 0.0 && (columns.empty() || columns.back() != e.column)) columns.push_back(e.column);
    }
    for (std::size_t g = 0; g < dynamics.groups(); ++g) {
        std::vector<std::vector<double>> h;
        for (const int j : touching[g]) {
            h.emplace_back(dynamics.members(g).size(), 0.0);
            for (int k = p.H.start[place(j)]; k < p.H.start[place(j) + 1]; ++k) {
                const int row = p.H.row[place(k)];
                if (dynamics.groupOf(row) == g) h.back()[dynamics.within(row)] += p.H.value[place(k)];
            }
        }
        for (std::size_t b = 0; b < h.size(); ++b) {
            std::vector<double> x = h[b];
            dynamics.solve(g, x);
            for (std::size_t a = 0; a < h.size(); ++a)
                p.W[place(touching[g][a]) * n + place(touching[g][b])] +=
                    std::inner_product(x.begin(), x.end(), h[a].begin(), 0.0);
        }
    }
}

void expect(bool holds, const std::string& what, const std::string& part, const std::string& found,
            const std::string& expected) {
    if (!holds) throw BadInput(what + ": " + part + " has " + found + ", expected " + expected);
}
void expectSize(const std::string& what, const std::string& part, std::size_t found, std::size_t expected) {
    expect(found == expected, what, part, std::to_string(found) + " values", std::to_string(expected));
}
void expectMatrix(const std::string& what, const std::string& part, const SparseMatrix& A, std::size_t rows,
                  std::size_t columns) {
    expect(place(A.rows) == rows && place(A.columns) == columns, what, part,
           std::to_string(A.rows) + " x " + std::to_string(A.columns) + " entries",
           std::to_string(rows) + " x " + std::to_string(columns));
}
void expectFinite(const std::string& what, const std::string& part, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
        expect(std::isfinite(values[i]), what, part + "[" + std::to_string(i) + "]",
               std::to_string(values[i]), "a finite number");
}

}  // namespace

void complete(ExportedProblem& exported, const std::string& what) {
    ContactProblem& p = exported.problem;
    expect(p.dimension == 2 || p.dimension == 3, what, "the dimension", std::to_string(p.dimension),
           "2 or 3");
    const std::size_t n = p.contacts() * place(p.dimension);
    expectFinite(what, "mu", p.mu);
    for (std::size_t i = 0; i < p.mu.size(); ++i)
        expect(p.mu[i] >= 0.0, what, "mu[" + std::to_string(i) + "]", std::to_string(p.mu[i]),
               "no less than 0");
    if (exported.isGlobal) {
        const std::size_t m = p.f.size();
        expectMatrix(what, "M", p.M, m, m);
        expectMatrix(what, "H", p.H, m, n);
        expectSize(what, "w", p.w.size(), n);
        if (exported.G.columns > 0 || !exported.b.empty())
            expectMatrix(what, "G", exported.G, m, exported.b.size());
        for (const auto& [part, values] :
             {std::pair{"f", &p.f}, {"w", &p.w}, {"M", &p.M.value}, {"H", &p.H.value}, {"b", &exported.b}})
            expectFinite(what, part, *values);
        p.hasBodies = exported.b.empty();
        try {
            condense(exported);
        } catch (const BadInput& error) {
            throw BadInput(what + ": " + error.what());
        }
    }
    expectSize(what, "q", p.q.size(), n);
    expectSize(what, "W", p.W.size(), n * n);
    expectFinite(what, "q", p.q);
    expectFinite(what, "W", p.W);
    for (const auto& [part, values, size] :
         {std::tuple{"the stored r", &exported.storedR, n}, {"the stored u", &exported.storedU, n}}) {
        if (values->empty()) continue;
        expectSize(what, part, values->size(), size);
        expectFinite(what, part, *values);
    }
}

std::vector<double> velocitiesFor(const ExportedProblem& exported, const std::vector<double>& r) {
    std::vector<double> x = load(exported);
    multiplyAdd(exported.problem.H, r, x);
    Dynamics(exported).solveAll(x);
    x.resize(exported.problem.f.size());
    return x;
}

std::vector<double> relativeVelocities(const ContactProblem& problem, const std::vector<double>& r) {
    std::vector<double> u = problem.q;
    const std::size_t n = u.size();
    for (std::size_t i = 0; i < n; ++i)
        u[i] += std::inner_product(r.begin(), r.end(), problem.W.begin() + (i * n), 0.0);
    return u;
}

}  // namespace rigor::validation
