// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A list in sorted order whose items keep their slot in memory while others are added and removed.
//
//     order  [ 2 | 0 | 3 ]          list[k] is slots[order[k]]
//     slots  [ b | - | a | c ]      slot 1 is free
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/core/large_vector.hpp"
#include "engine/core/tasks.hpp"

namespace rigor::engine {

template <class T>
class SlotList {
    template <class List>
    class Iterator {
      public:
        Iterator(List* list, std::size_t place) : list_(list), place_(place) {}
        auto& operator*() const { return (*list_)[place_]; }
        Iterator& operator++() {
            ++place_;
            return *this;
        }
        bool operator==(const Iterator&) const = default;

      private:
        List* list_;
        std::size_t place_;
    };

  public:
    std::size_t size() const { return order_.size(); }
    bool empty() const { return order_.empty(); }
    T& operator[](std::size_t place) { return slots_[order_[place]]; }
    const T& operator[](std::size_t place) const { return slots_[order_[place]]; }
    auto begin() { return Iterator<SlotList>(this, 0); }
    auto end() { return Iterator<SlotList>(this, size()); }
    auto begin() const { return Iterator<const SlotList>(this, 0); }
    auto end() const { return Iterator<const SlotList>(this, size()); }

    /// The item in a slot.
    T& at(std::uint32_t slot) { return slots_[slot]; }
    const T& at(std::uint32_t slot) const { return slots_[slot]; }
    /// Slots in the order of the list. A caller of add() or remove() updates it.
    std::vector<std::uint32_t>& order() { return order_; }
    const std::vector<std::uint32_t>& order() const { return order_; }
    /// Room for `more` calls of add().
    void reserve(std::size_t more) {
        if (more > free_.size()) reserveToGrow(slots_, slots_.size() + more - free_.size());
    }
    /// Takes a slot that is not in order() yet. Its value is unspecified.
    std::uint32_t add() {
        ++changes_;
        if (free_.empty()) {
            slots_.emplace_back();
            return static_cast<std::uint32_t>(slots_.size() - 1);
        }
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    void remove(std::uint32_t slot) {
        free_.push_back(slot);
        ++changes_;
    }

    /// True when many slots are out of order, so that a loop over the list misses the cache.
    bool fragmented() const { return changes_ > size() / 4; }
    /// Moves the item of each position k to slot k.
    void defragment(const Tasks& tasks) {
        changes_ = 0;
        if (order_.size() == slots_.size() && std::is_sorted(order_.begin(), order_.end())) return;
        constexpr std::size_t kGrain = 32;  // least number of slots for a task: some microseconds of work
        spare_.reserve(slots_.capacity());
        spare_.resize(order_.size());
        tasks.forEach(order_.size(), kGrain, [this](std::size_t k) { spare_[k] = slots_[order_[k]]; });
        std::swap(slots_, spare_);
        free_.clear();
        std::iota(order_.begin(), order_.end(), 0u);
    }

    void clear() {
        slots_.clear();
        order_.clear();
        free_.clear();
        changes_ = 0;
    }
    /// Replaces the list by `count` default items in the order of their slots.
    void reset(std::size_t count) {
        clear();
        slots_.resize(count);
        order_.resize(count);
        std::iota(order_.begin(), order_.end(), 0u);
    }

  private:
    LargeVector<T> slots_, spare_;
    std::vector<std::uint32_t> order_, free_;
    std::size_t changes_ = 0;  ///< changes since the last defragment()
};

}  // namespace rigor::engine
