// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Part of a joint group that is constant while the joints' bodies are the same: which joints are connected, and
// room for the numbers of bounded rows. Allocates; joint_group.cpp does not.
#include <algorithm>
#include <numeric>

#include "engine/core/disjoint_sets.hpp"
#include "engine/solvers/joints/joint_group.hpp"

namespace rigor::engine {

/// Returns true where the joints are not those of the call before.
template <class S>
bool JointGroup<S>::findBlocks(const ConstraintRows<S>& constraints) {
    std::size_t n = 0;
    changed_ = false;
    for (std::uint32_t i = 0; i < constraints.blocks.size(); ++i) {
        const Block<S>& block = constraints.blocks[i];
        if (isOfContact(block.kind)) continue;
        const Place place{i, block.invMassA > 0 ? block.a : kNullIndex,
                          block.invMassB > 0 ? block.b : kNullIndex, block.kind, block.rows};
        if (n == places_.size()) {
            places_.push_back(place);
            changed_ = true;
        } else if (!(places_[n] == place)) {
            places_[n] = place;
            changed_ = true;
        }
        ++n;
    }
    changed_ = changed_ || n != places_.size();
    places_.resize(n);
    return changed_;
}

/// Sorts the blocks by the parts that their bodies connect, parts in the order of their first blocks.
template <class S>
void JointGroup<S>::findParts() {
    std::uint32_t bodies = 0;
    for (const Place& place : places_)
        for (const std::uint32_t body : {place.a, place.b})
            if (body != kNullIndex) bodies = std::max(bodies, body + 1);
    DisjointSets connected;
    connected.begin(bodies);
    std::vector<std::uint32_t> partOf(bodies, kNullIndex), part(places_.size());
    for (const Place& place : places_)
        if (place.a != kNullIndex && place.b != kNullIndex) connected.join(place.a, place.b);
    std::uint32_t parts = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const std::uint32_t body = std::min(places_[k].a, places_[k].b);  // kNullIndex is above all
        if (body == kNullIndex) {
            part[k] = parts++;
            continue;
        }
        std::uint32_t& own = partOf[connected.rootOf(body)];
        if (own == kNullIndex) own = parts++;
        part[k] = own;
    }
    std::vector<std::uint32_t> order(places_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t k, std::uint32_t l) { return part[k] < part[l]; });
    parts_.assign(parts, {});
    found_.assign(parts, Real(0));
    blocks_.clear();
    equalities_.clear();
    bounded_.clear();
    for (const std::uint32_t k : order) {
        Part& own = parts_[part[k]];
        const bool holds = places_[k].kind == BlockKind::Joint;
        if (own.lastBlock == 0) {
            own.block = static_cast<std::uint32_t>(blocks_.size());
            own.equality = static_cast<std::uint32_t>(equalities_.size());
            own.bounded = static_cast<std::uint32_t>(bounded_.size());
        }
        blocks_.push_back(places_[k].block);
        (holds ? equalities_ : bounded_).push_back(places_[k].block);
        own.lastBlock = static_cast<std::uint32_t>(blocks_.size());
        own.lastEquality = static_cast<std::uint32_t>(equalities_.size());
        own.lastBounded = static_cast<std::uint32_t>(bounded_.size());
    }
    partOf_.assign(places_.empty() ? 0 : places_.back().block + 1, 0);
    for (std::uint32_t p = 0; p < parts; ++p)
        for (std::uint32_t k = parts_[p].block; k < parts_[p].lastBlock; ++k) partOf_[blocks_[k]] = p;
    separate_ = std::is_sorted(blocks_.begin(), blocks_.end());
}

/// Bounded rows may connect what are several parts of the system of equality rows.
template <class S>
void JointGroup<S>::findSystems() {
    systems_.clear();
    for (Part& part : parts_) {
        part.system = static_cast<std::uint32_t>(systems_.size());
        for (std::uint32_t i = part.equality; i < part.lastEquality; ++i)
            systems_.push_back(system_.partOf(i));
        const auto first = systems_.begin() + part.system;
        std::sort(first, systems_.end());
        systems_.erase(std::unique(first, systems_.end()), systems_.end());
        part.lastSystem = static_cast<std::uint32_t>(systems_.size());
    }
}

/// Finds the equality blocks at the bodies of each bounded row.
template <class S>
void JointGroup<S>::findNear() {
    const auto placeOf = [&](std::uint32_t block) -> const Place& {
        return *std::lower_bound(places_.begin(), places_.end(), block,
                                 [](const Place& place, std::uint32_t b) { return place.block < b; });
    };
    struct End {
        std::uint32_t body, equality;
        bool isB;
        bool operator<(const End& other) const {
            return body != other.body ? body < other.body : equality < other.equality;
        }
    };
    std::vector<End> ends;
    for (std::uint32_t k = 0; k < equalities_.size(); ++k) {
        const Place& place = placeOf(equalities_[k]);
        if (place.a != kNullIndex) ends.push_back({place.a, k, false});
        if (place.b != kNullIndex) ends.push_back({place.b, k, true});
    }
    std::sort(ends.begin(), ends.end());
    firstNear_.assign(1, 0);
    near_.clear();
    for (const std::uint32_t block : bounded_) {
        const Place& place = placeOf(block);
        for (const bool isB : {false, true}) {
            const std::uint32_t body = isB ? place.b : place.a;
            if (body == kNullIndex) continue;
            for (auto end = std::lower_bound(ends.begin(), ends.end(), End{body, 0, false});
                 end != ends.end() && end->body == body; ++end)
                near_.push_back({end->equality, end->isB, isB});
        }
        firstNear_.push_back(static_cast<std::uint32_t>(near_.size()));
    }
}

/// Room for as many acting rows as a part can have.
template <class S>
void JointGroup<S>::makeRoom() {
    std::size_t acting = 0, columns = 0, matrix = 0, lanes = 0;
    offset_.resize(equalities_.size());
    firstLane_.assign(systems_.size(), 0);
    for (Part& part : parts_) {
        part.numbers = 0;
        for (std::uint32_t k = part.equality; k < part.lastEquality; ++k) {
            offset_[k] = part.numbers;
            part.numbers += static_cast<std::uint32_t>(items_[k].block->rows);
        }
        part.room = std::min(kMostActing, part.lastBounded - part.bounded);
        part.acting = acting;
        part.columns = columns;
        part.matrix = matrix;
        acting += part.room;
        columns += std::size_t(part.room) * part.numbers;
        matrix += std::size_t(part.room) * part.room;
        if (part.room == 0) continue;
        for (std::uint32_t k = part.system; k < part.lastSystem; ++k) {
            firstLane_[systems_[k]] = lanes;
            lanes += JointSystem<S>::kLanes * system_.numbersOf(systems_[k]);
        }
    }
    acts_.assign(bounded_.size(), 0);
    acting_.assign(acting, 0);
    for (auto* numbers : {&error_, &impulse_, &change_, &lower_, &upper_}) numbers->assign(acting, Real(0));
    columns_.assign(columns, Real(0));
    matrix_.assign(matrix, Real(0));
    lanes_.assign(lanes, Real(0));
}

#define RIGOR_INSTANTIATE(S)                                           \
    template bool JointGroup<S>::findBlocks(const ConstraintRows<S>&); \
    template void JointGroup<S>::findParts();                          \
    template void JointGroup<S>::findSystems();                        \
    template void JointGroup<S>::findNear();                           \
    template void JointGroup<S>::makeRoom();
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
