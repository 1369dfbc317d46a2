// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems for the in-house solvers, through the code that a step runs: rows and bodies made
// from M and H where these are rigid bodies', else rows on W itself (engine/solvers/matrix_space.hpp) for the
// solvers that need no bodies.
#include <algorithm>
#include <cmath>

#include "adapters/interface/types.hpp"
#include "adapters/rigor/contact_bodies.hpp"
#include "adapters/rigor/parts.hpp"
#include "engine/core/error.hpp"
#include "engine/solvers/matrix_space.hpp"
#include "engine/solvers/traits.hpp"

namespace rigor::adapter {
namespace {

using engine::Block;
using engine::ConstraintRows;
using engine::MatrixSpace;
using engine::Row;
using engine::Space2d;
using engine::Space3d;
using engine::Velocity;

/// Reason why a solver cannot be run on one velocity-level problem; null: it can.
const char* whyNotSolvable(const engine::SolverTraits& traits) {
    if (traits.errors == engine::ErrorHandling::Positions)
        return "solves positions; a contact problem has none";
    if (traits.errors == engine::ErrorHandling::Correction) return nullptr;
    return traits.substeps > 1 ? "moves the bodies between its sub-steps; a contact problem has no positions"
                               : "softens the bias of position errors; a contact problem has none";
}

FrictionModel frictionModel(engine::FrictionShape shape, int directions) {
    if (shape == engine::FrictionShape::Box) return {FrictionModel::Kind::Box};
    if (shape == engine::FrictionShape::Polygon) return {FrictionModel::Kind::Polygon, directions};
    return {};
}

template <class S>
class Monitor final : public engine::IterationMonitor<S> {
  public:
    explicit Monitor(double tolerance) : tolerance_(tolerance) {}
    void before(std::span<const Velocity<S>>) override {}
    bool after(std::span<const Velocity<S>>, double change) override {
        ++iterations;
        return change <= tolerance_;
    }
    double tolerance() const override { return tolerance_; }
    int iterations = 0;

  private:
    double tolerance_;
};

/// Rows, velocities and a solver that has been given them.
template <class S>
class EngineSolve : public ContactSolve {
  public:
    EngineSolve(const Settings& settings, std::unique_ptr<engine::Solver<S>> solver)
        : solver_(std::move(solver)),
          friction_(frictionOf(textSetting(settings, "friction"))),
          shape_(engine::solverTraits(textSetting(settings, "solver"))
                     .friction.value_or(engine::frictionShape(textSetting(settings, "friction")))),
          directions_(integerSetting(settings, "pyramid_directions")) {}

    ContactSolution run(int iterations, double tolerance) final {
        velocities_ = start_;
        for (Row<S>& row : rows_.rows) row.impulse = 0;
        Monitor<S> monitor(tolerance);
        solver_->solve(
            {rows_, velocities_, friction_, monitor, iterations, 1.0, false, tolerance, directions_});
        ContactSolution found;
        for (const Row<S>& row : rows_.rows) found.r.push_back(row.impulse);
        found.iterations = monitor.iterations;
        found.gaveUp = solver_->gaveUp();
        return found;
    }
    FrictionModel friction() const final { return frictionModel(shape_, S::dim == 2 ? 2 : directions_); }

  protected:
    static engine::FrictionLaw<S> frictionOf(const std::string& name) {
        if constexpr (S::dim == 2)
            return engine::findAlgorithm(engine::frictionTable<Space2d>(), "friction", name).make;
        else
            return engine::findAlgorithm(engine::frictionTable<Space3d>(), "friction", name).make;
    }

    std::unique_ptr<engine::Solver<S>> solver_;
    ConstraintRows<S> rows_;
    std::vector<Velocity<S>> start_, velocities_;

  private:
    engine::FrictionLaw<S> friction_;
    engine::FrictionShape shape_;  ///< shape of the law that is really solved
    int directions_;
};

/// Sets the data that every contact block has, after its rows are complete.
template <class S>
void finishContact(Block<S>& block, std::vector<Row<S>>& rows, double mu) {
    block.kind = engine::BlockKind::Contact;
    block.rows = static_cast<std::uint8_t>(S::dim);
    block.friction = mu;
    Row<S>* r = rows.data() + block.first;
    for (int i = 0; i < block.rows; ++i) {
        const double K = engine::rowCoupling<S>(r[i], r[i], block);
        if (!(K > 0.0))
            throw Unsupported("contact row " + std::to_string(block.first + i) +
                              " has no K > 0: nothing can follow it");
        r[i].invK = 1.0 / K;
    }
    block.k11 = engine::rowCoupling<S>(r[1], r[1], block);
    block.k12 = S::tangents > 1 ? engine::rowCoupling<S>(r[1], r[S::tangents], block) : 0.0;
    block.k22 = S::tangents > 1 ? engine::rowCoupling<S>(r[S::tangents], r[S::tangents], block) : 1.0;
}

template <class S>
class OnBodies final : public EngineSolve<S> {
  public:
    OnBodies(const ContactProblem& p, const ProblemBodies& given, const Settings& settings)
        : EngineSolve<S>(settings, engine::findAlgorithm(engine::solverTable<S>(), "solver",
                                                         textSetting(settings, "solver"))
                                       .make()) {
        const auto none = static_cast<std::uint32_t>(given.bodies.size());
        for (const ProblemBody& body : given.bodies) addBody(body);
        this->start_.emplace_back();  // body of everything that does not move
        for (std::size_t c = 0; c < given.contacts.size(); ++c) {
            const ProblemContact& contact = given.contacts[c];
            Block<S> block;
            block.first = this->rows_.rows.size();
            block.a = contact.a < 0 ? none : static_cast<std::uint32_t>(contact.a);
            block.b = contact.b;
            block.invMassA = contact.a < 0 ? 0.0 : 1.0 / given.bodies[block.a].mass;
            block.invMassB = 1.0 / given.bodies[block.b].mass;
            for (std::size_t i = 0; i < static_cast<std::size_t>(S::dim); ++i)
                addRow(contact, contact.rows[i], p.w[c * S::dim + i]);
            finishContact<S>(block, this->rows_.rows, p.mu[c]);
            this->rows_.blocks.push_back(block);
        }
    }

  private:
    static typename S::Ang angular(const double* x) {
        if constexpr (S::dim == 2)
            return x[0];
        else
            return {x[0], x[1], x[2]};
    }
    void addBody(const ProblemBody& body) {
        typename S::Inertia inverse;
        if constexpr (S::dim == 2) {
            inverse = 1.0 / body.inertia[0][0];
        } else {
            typename S::Inertia I;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) I(i, j) = body.inertia[i][j];
            inverse = I.inverse();
        }
        invInertia_.push_back(inverse);
        Velocity<S> v;
        for (int i = 0; i < S::dim; ++i) v.v[i] = body.freeVelocity[i];
        v.w = angular(body.freeVelocity.data() + S::dim);
        this->start_.push_back(v);
    }
    void addRow(const ProblemContact& contact, const ProblemContact::Row& given, double bias) {
        Row<S> row;
        for (int i = 0; i < S::dim; ++i) row.lin[i] = given.lin[i];
        row.angA = angular(given.angA.data());
        row.angB = angular(given.angB.data());
        if (contact.a >= 0) row.invIAngA = invInertia_[contact.a] * row.angA;
        row.invIAngB = invInertia_[contact.b] * row.angB;
        row.bias = row.relaxedBias = bias;
        this->rows_.rows.push_back(row);
    }
    std::vector<typename S::Inertia> invInertia_;
};

template <int D>
class OnMatrix final : public EngineSolve<MatrixSpace<D>> {
  public:
    using S = MatrixSpace<D>;
    OnMatrix(const ContactProblem& p, const Settings& settings)
        : EngineSolve<S>(settings, engine::findAlgorithm(engine::matrixSolverTable<S>(), "solver",
                                                         textSetting(settings, "solver"))
                                       .make()),
          columns_(p.W.size()) {
        const std::size_t n = p.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) columns_[j * n + i] = p.W[i * n + j];
        this->start_.resize(1);
        this->start_[0].w = p.q;
        this->rows_.rows.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            this->rows_.rows[i].index = i;
            this->rows_.rows[i].column = columns_.data() + i * n;
        }
        for (std::size_t c = 0; c < p.contacts(); ++c) {
            Block<S> block;
            block.first = static_cast<std::uint32_t>(c * D);
            block.invMassB = 1;
            finishContact<S>(block, this->rows_.rows, p.mu[c]);
            this->rows_.blocks.push_back(block);
        }
    }

  private:
    std::vector<double> columns_;
};

bool worksOnMatrix(const std::string& solver) {
    for (const auto& entry : engine::matrixSolverTable<MatrixSpace<3>>())
        if (solver == entry.name) return true;
    return false;
}

class RigorContactSolvers final : public ContactSolverEngine {
  public:
    std::vector<std::string> solvers() const override {
        std::vector<std::string> names;
        for (const auto& entry : engine::solverTable<Space3d>()) names.emplace_back(entry.name);
        return names;
    }
    std::unique_ptr<ContactSolve> take(const ContactProblem& p, const Settings& settings) const override {
        const std::string& name = textSetting(settings, "solver");
        if (const char* beyond = whyNotSolvable(engine::solverTraits(name)))
            throw Unsupported(name + " " + beyond);
        if (textSetting(settings, "precision") == "f32")
            throw Unsupported("contact problems are solved in double precision");
        try {
            const ProblemBodies bodies = readBodies(p);
            if (p.dimension == 2) return std::make_unique<OnBodies<Space2d>>(p, bodies, settings);
            return std::make_unique<OnBodies<Space3d>>(p, bodies, settings);
        } catch (const Unsupported& error) {
            if (!worksOnMatrix(name)) throw Unsupported(name + " " + error.what());
        }
        if (p.dimension == 2) return std::make_unique<OnMatrix<2>>(p, settings);
        return std::make_unique<OnMatrix<3>>(p, settings);
    }
};

}  // namespace

std::unique_ptr<ContactSolverEngine> makeRigorContactSolvers() {
    return std::make_unique<RigorContactSolvers>();
}

}  // namespace rigor::adapter
