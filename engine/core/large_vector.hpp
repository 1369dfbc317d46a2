// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Arrays whose memory comes in pages of 2 MiB where it is large. The first use of a page costs the same for a small one
// as for a large one, so that the step in which thousands of contacts begin would mostly wait for pages of 4 KiB.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rigor::engine {

/// Uninitialised memory, aligned to `alignment` at least. The system is advised to use large pages for it, which it may
/// not have.
/// @throws std::bad_alloc
void* allocateLarge(std::size_t bytes, std::size_t alignment);
void freeLarge(void* memory, std::size_t bytes, std::size_t alignment) noexcept;

template <class T>
struct LargeAllocator {
    using value_type = T;
    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}  // as the requirements of allocators have it: implicit

    T* allocate(std::size_t n) { return static_cast<T*>(allocateLarge(n * sizeof(T), alignof(T))); }
    void deallocate(T* memory, std::size_t n) noexcept { freeLarge(memory, n * sizeof(T), alignof(T)); }
    bool operator==(const LargeAllocator&) const = default;
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// Room for `n` items in all, with at least as much growth as that of push_back.
template <class T>
void reserveToGrow(LargeVector<T>& items, std::size_t n) {
    if (n > items.capacity()) items.reserve(std::max(n, 2 * items.capacity()));
}

/// Memory for items that are written once and read once in a step. Copies are empty.
template <class T>
class LargeScratch {
  public:
    LargeScratch() = default;
    LargeScratch(const LargeScratch&) {}
    LargeScratch(LargeScratch&& other) noexcept
        : items_(std::exchange(other.items_, nullptr)), capacity_(std::exchange(other.capacity_, 0)) {}
    LargeScratch& operator=(LargeScratch other) noexcept {
        std::swap(items_, other.items_);
        std::swap(capacity_, other.capacity_);
        return *this;
    }
    ~LargeScratch() { freeLarge(items_, capacity_ * sizeof(T), alignof(T)); }

    /// Room for `n` items; what is there may be lost.
    void require(std::size_t n) {
        if (n <= capacity_) return;
        *this = LargeScratch();
        const std::size_t more = n + n / 2;
        items_ = static_cast<T*>(allocateLarge(more * sizeof(T), alignof(T)));
        capacity_ = more;
    }
    void put(std::size_t k, const T& item) { new (items_ + k) T(item); }
    const T& operator[](std::size_t k) const { return items_[k]; }

  private:
    static_assert(std::is_trivially_destructible_v<T>);
    T* items_ = nullptr;
    std::size_t capacity_ = 0;
};

}  // namespace rigor::engine
