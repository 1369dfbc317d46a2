// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The forces of a world.
#pragma once

#include <vector>

#include "engine/forces/force.hpp"

namespace rigor::engine {

template <class S>
class ForceSet {
  public:
    struct Record {
        ForceDef<S> def;
        ForcePlace<S> place;
        ForceId id;
    };

    /// Throws EngineError for values out of range and forces that push no dynamic body; "stale_handle" for bodies that
    /// are gone.
    ForceId add(const ForceDef<S>& def, const BodyArrays<S>& bodies, const IdTable<BodyTag>& bodyIds);
    void remove(ForceId id);
    /// Removes the forces of body `gone`, whose dense index body `last` takes.
    void bodyRemoved(std::uint32_t gone, std::uint32_t last);
    /// The centre of mass of a body has moved by `way`, body axes [m]: arms are from it.
    void centerMoved(std::uint32_t body, const typename S::Vec& way);

    bool contains(ForceId id) const { return ids_.contains(id); }
    const ForceDef<S>& def(ForceId id) const { return records_[ids_.dense(id)].def; }
    const ForcePlace<S>& place(ForceId id) const { return records_[ids_.dense(id)].place; }
    std::size_t size() const { return records_.size(); }
    const std::vector<Record>& records() const { return records_; }
    /// Shows `archive` the handles (state/archive.hpp): all that changes about forces. Set may be const.
    template <class Archive, class Set>
    static void visitIds(Archive& archive, Set& set) {
        IdTable<ForceTag>::visit(archive, set.ids_);
        for (auto& record : set.records_) {
            archive.scalar(record.id.index);
            archive.scalar(record.id.generation);
        }
    }

    /// Adds what acts during the moment to its wrenches, in the order in which forces were added.
    void evaluate(const ForceMoment<S>& moment) const;
    /// Appends the times in (begin, end) at which a force starts or ends, in no order.
    void edges(double begin, double end, std::vector<double>& times) const;

  private:
    std::vector<Record> records_;
    IdTable<ForceTag> ids_;
};

}  // namespace rigor::engine
