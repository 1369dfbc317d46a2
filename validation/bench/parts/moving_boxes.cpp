// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/bench/parts/moving_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "adapters/interface/timed.hpp"

namespace rigor::validation {

using adapter::Aabb;
using adapter::Pair;

MovingBoxes::MovingBoxes(int dimension, std::size_t count, BoxOrder order, std::uint64_t seed)
    : dimension_(dimension),
      side_(static_cast<float>(dimension == 2 ? std::sqrt(4.0 * count) : std::cbrt(8.0 * count))),
      random_(seed),
      movers_(count),
      boxes_(count) {
    for (Mover& mover : movers_)
        for (int k = 0; k < dimension_; ++k) {
            mover.center[k] = static_cast<float>(random_.between(0.0, side_));
            mover.velocity[k] = static_cast<float>(random_.between(-3.0, 3.0));
        }
    if (order == BoxOrder::Spatial)
        std::stable_sort(movers_.begin(), movers_.end(),
                         [this](const Mover& a, const Mover& b) { return morton(a) < morton(b); });
    place();
}

std::uint64_t MovingBoxes::morton(const Mover& mover) const {
    std::uint64_t code = 0;
    for (int bit = 20; bit >= 0; --bit)
        for (int k = 0; k < dimension_; ++k) {
            const double share = static_cast<double>(mover.center[k]) / static_cast<double>(side_);
            const auto cell = static_cast<std::uint64_t>(std::clamp(share, 0.0, 0.999999) * 0x1p21);
            code = (code << 1) | ((cell >> bit) & 1u);
        }
    return code;
}

void MovingBoxes::place() {
    for (std::size_t i = 0; i < movers_.size(); ++i) {
        const float* c = movers_[i].center;
        const auto corner = [&](float by) {
            return adapter::Vec3{static_cast<double>(c[0] + by), static_cast<double>(c[1] + by),
                                 dimension_ == 2 ? 0.0 : c[2] + by};
        };
        boxes_[i] = {corner(-0.5f), corner(0.5f)};
    }
}

void MovingBoxes::advance() {
    for (Mover& mover : movers_)
        for (int k = 0; k < dimension_; ++k) {
            float &x = mover.center[k], &v = mover.velocity[k];
            if ((x < 0.0f && v < 0.0f) || (x > side_ && v > 0.0f)) v = -v;
            x += v * (1.0f / 60.0f);
        }
    place();
}

std::vector<Pair> exactPairs(const std::vector<Aabb>& boxes) {
    struct Entry {
        Aabb box;
        int index;
    };
    std::vector<Entry> sorted;
    for (std::size_t i = 0; i < boxes.size(); ++i) sorted.push_back({boxes[i], static_cast<int>(i)});
    std::sort(sorted.begin(), sorted.end(),
              [](const Entry& a, const Entry& b) { return a.box.min.x < b.box.min.x; });
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].box.min.x <= sorted[i].box.max.x; ++j)
            if (overlap(sorted[i].box, sorted[j].box))
                pairs.push_back(
                    {std::min(sorted[i].index, sorted[j].index), std::max(sorted[i].index, sorted[j].index)});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

PairCheck checkPairs(const std::vector<Aabb>& boxes, std::vector<Pair> held) {
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    const std::vector<Pair> exact = exactPairs(boxes);
    std::vector<Pair> missed;
    std::set_difference(exact.begin(), exact.end(), held.begin(), held.end(), std::back_inserter(missed));
    return {exact.size(), held.size(), missed.size()};
}

}  // namespace rigor::validation
