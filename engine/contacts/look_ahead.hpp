// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Interface by which continuous collision adds contacts while contacts are found. The search knows this
// interface alone; the implementations are in engine/ccd.
#pragma once

#include <span>

#include "engine/contacts/contact.hpp"
#include "engine/contacts/shape_record.hpp"

namespace rigor::engine {

template <class S>
class LookAhead {
  public:
    virtual ~LookAhead() = default;
    /// True: boxes are to be grown, and pairs queried, by the functions below.
    virtual bool looksAhead() const { return false; }
    /// The box of a shape that may move, grown by its way ahead.
    virtual void growBox(std::uint32_t shape, Aabb<S>& box) const {
        (void)shape;
        (void)box;
    }
    /// The contact of two shapes that the narrow phase has (count > 0) or has not found where they are: sets
    /// Contact::speculative, and the manifold, separations and arms of a contact further ahead.
    virtual void findAhead(Contact<S>& contact, std::span<const ShapeRecord<S>> shapes,
                           const NarrowPhase<S>& narrowPhase) const {
        (void)contact;
        (void)shapes;
        (void)narrowPhase;
    }
};

}  // namespace rigor::engine
