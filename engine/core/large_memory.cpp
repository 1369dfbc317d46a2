// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <algorithm>

#include "engine/core/large_vector.hpp"
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rigor::engine {
namespace {

constexpr std::size_t kPage = std::size_t(2) << 20;

/// Whole large pages, and what is left of the last one if that is less than half of it: at most half a page is unused.
std::size_t rounded(std::size_t bytes) {
    const std::size_t rest = bytes % kPage;
    return rest < kPage / 2 ? bytes : bytes - rest + kPage;
}

bool isLarge(std::size_t bytes) {
    return bytes >= kPage / 2;
}

}  // namespace

void* allocateLarge(std::size_t bytes, std::size_t alignment) {
    if (!isLarge(bytes)) return ::operator new(bytes, std::align_val_t(alignment));
    const std::size_t size = rounded(bytes);
    void* const memory = ::operator new(size, std::align_val_t(std::max(alignment, kPage)));
#if defined(MADV_HUGEPAGE)
    madvise(memory, size - size % kPage, MADV_HUGEPAGE);  // advice: without it all is as usual
#endif
    return memory;
}

void freeLarge(void* memory, std::size_t bytes, std::size_t alignment) noexcept {
    ::operator delete(memory, std::align_val_t(isLarge(bytes) ? std::max(alignment, kPage) : alignment));
}

}  // namespace rigor::engine
