// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The islands of a world: dynamic bodies, asleep or not, that contacts and joints connect. They are found on
// demand and stay until changed(): building a world changes what they connect, but what falls asleep or wakes
// is decided on those of the last step.
#pragma once

#include <vector>

#include "engine/contacts/contact.hpp"
#include "engine/pipeline/joints.hpp"
#include "engine/sleeping/islands.hpp"

namespace rigor::engine {

template <class S>
class WorldIslands {
  public:
    /// Contacts and joints that connect the bodies.
    struct Links {
        const BodyArrays<S>& bodies;
        const ContactList<S>& contacts;
        const Joints<S>& joints;
    };
    void changed() { stale_ = true; }
    /// Found anew if they have changed. The first call after that must not be concurrent.
    const Islands& get(const Links& links) const {
        if (stale_) find(links);
        return islands_;
    }
    void find(const Links& links) const;
    /// Scratch, by body.
    std::vector<std::uint8_t>& marks() { return marks_; }

  private:
    mutable Islands islands_;
    mutable std::vector<std::uint8_t> marks_;
    mutable bool stale_ = false;
};

}  // namespace rigor::engine
