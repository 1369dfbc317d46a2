// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Restitution: what a contact that is hit does next. Contacts that rest, or are approached more slowly than
// the world's threshold, never bounce, whatever the law.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/constraints/row.hpp"
#include "engine/core/table.hpp"

namespace rigor::engine {

template <class S>
class Restitution {
  public:
    virtual ~Restitution() = default;
    virtual std::unique_ptr<Restitution> clone() const = 0;
    /// False: no contact does; coefficients are read as zero.
    virtual bool bounces() const { return true; }
    /// True: impact() is called in steps where a contact bounces, before the forces of the step act.
    virtual bool solvesImpacts() const { return false; }
    /// Changes the velocities from before to after the impacts and leaves in the rows the impulses that did
    /// it. Contact rows that bounce (Block::restitution > 0) come with bias e times the approach, which is
    /// Newton's law, and go with the bias that keeps the separation that the impact has led to. `solve` finds
    /// impulses for the rows as they are, starting from zero.
    virtual void impact(ConstraintRows<S>& rows, std::span<Velocity<S>> velocities,
                        const std::function<void()>& solve) {
        (void)rows;
        (void)velocities;
        (void)solve;
    }
};

template <class S>
using RestitutionFactory = std::unique_ptr<Restitution<S>> (*)();
template <class S>
std::span<const AlgorithmEntry<RestitutionFactory<S>>> restitutionTable();

}  // namespace rigor::engine
