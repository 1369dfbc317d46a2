// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/broadphase/pair_sort.hpp"

#include <algorithm>
#include <utility>

namespace rigor::engine {
namespace {

void sortByB(ProxyPair* begin, ProxyPair* end) {
    if (end - begin > 24) {  // few boxes overlap that many others; insertion is faster for the rest
        std::sort(begin, end, [](const ProxyPair& p, const ProxyPair& q) { return p.b < q.b; });
        return;
    }
    for (ProxyPair* i = begin; i < end; ++i) {
        const ProxyPair pair = *i;
        ProxyPair* j = i;
        for (; j > begin && pair.b < j[-1].b; --j) *j = j[-1];
        *j = pair;
    }
}

}  // namespace

void PairSort::count(std::span<const std::vector<ProxyPair>> parts, Range& range) {
    std::fill(ends_.begin() + range.begin, ends_.begin() + range.end, 0u);
    std::uint32_t count = 0;  // other threads have their ranges beside this one
    for (const auto& part : parts)
        for (const ProxyPair& pair : part) {
            if (pair.a - range.begin >= range.end - range.begin) continue;
            ++ends_[pair.a];
            ++count;
        }
    range.count = count;
}

void PairSort::place(std::span<const std::vector<ProxyPair>> parts, const Range& range,
                     std::vector<ProxyPair>& sorted) {
    std::uint32_t sum = range.first;
    for (std::uint32_t a = range.begin; a < range.end; ++a) sum += std::exchange(ends_[a], sum);
    for (const auto& part : parts)
        for (const ProxyPair& pair : part)
            if (pair.a - range.begin < range.end - range.begin) sorted[ends_[pair.a]++] = pair;
    std::uint32_t begin = range.first;
    for (std::uint32_t a = range.begin; a < range.end; ++a) {
        if (ends_[a] - begin > 1) sortByB(sorted.data() + begin, sorted.data() + ends_[a]);
        begin = ends_[a];
    }
}

void PairSort::sort(std::span<const std::vector<ProxyPair>> parts, std::size_t proxies,
                    std::vector<ProxyPair>& sorted, const Tasks& tasks) {
    std::size_t total = 0;
    for (const auto& part : parts) total += part.size();
    sorted.resize(total);
    if (total < proxies / 16) {  // too few pairs for a pass over the proxies
        auto to = sorted.begin();
        for (const auto& part : parts) to = std::copy(part.begin(), part.end(), to);
        std::sort(sorted.begin(), sorted.end());
        return;
    }
    // Each range of a is one thread's: it reads all pairs, which costs less than it saves.
    constexpr std::size_t kWorthSharing = 2048;
    const std::size_t ranges = total < kWorthSharing ? 1 : static_cast<std::size_t>(tasks.threads());
    ends_.resize(proxies);
    ranges_.resize(ranges);
    for (std::size_t r = 0; r < ranges; ++r) {
        ranges_[r].begin = static_cast<std::uint32_t>(proxies * r / ranges);
        ranges_[r].end = static_cast<std::uint32_t>(proxies * (r + 1) / ranges);
    }
    tasks.forEach(ranges, 1, [&](std::size_t r) { count(parts, ranges_[r]); });
    std::uint32_t first = 0;
    for (Range& range : ranges_) {
        range.first = first;
        first += range.count;
    }
    tasks.forEach(ranges, 1, [&](std::size_t r) { place(parts, ranges_[r], sorted); });
}

}  // namespace rigor::engine
