// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Boxes that move, for benchmarks of broad phases; the same on every machine.
//     uniform  unit boxes uniform in a cube of side (8n)^(1/3) m (2D: square of side (4n)^(1/2)), velocities
//              U(-3, 3) m/s per axis, thrown back by its walls; 1/60 s between updates: about 0.5 n overlaps
//     slow     edges 0.5 to 1 m over a floor, each moved by up to 1 cm per axis
//     jump     all of them put somewhere else
//     sizes    slow with edges from 1 cm to 10 m
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/broadphase/broad_phase.hpp"
#include "engine/core/benchmarks/random.hpp"

namespace rigor::engine::benchmark_scene {

enum class BoxOrder { Random, Spatial };  ///< Spatial: by the Morton code of where they start

template <class S>
class MovingBoxes {
  public:
    using Real = typename S::Real;
    using Vec = typename S::Vec;

    MovingBoxes(std::string scene, std::size_t count, BoxOrder order)
        : scene_(std::move(scene)), side_(sideOf(count)), velocities_(count) {
        for (std::size_t i = 0; i < count; ++i) boxes.push_back(made());
        for (auto& v : velocities_) v = vector(-3, 3);
        if (order == BoxOrder::Spatial) sort();
        if (scene_ != "uniform") boxes[0] = floor();
        movable.assign(count, 1);
    }

    /// Moves the boxes to their places at the next update.
    void advance() {
        for (std::size_t i = scene_ == "uniform" ? 0 : 1; i < boxes.size(); ++i) {
            if (scene_ == "jump") {
                boxes[i] = made();
                continue;
            }
            const Vec d = scene_ == "uniform" ? flown(i) : vector(-0.01, 0.01);
            boxes[i].min += d;
            boxes[i].max += d;
        }
    }

    std::vector<Aabb<S>> boxes;
    std::vector<std::uint8_t> movable;

  private:
    double sideOf(std::size_t count) const {
        const auto n = static_cast<double>(count);
        if (scene_ == "uniform") return S::dim == 2 ? std::sqrt(4 * n) : std::cbrt(8 * n);
        return 1.5 * (S::dim == 2 ? std::sqrt(n) : std::cbrt(n));  // box size for about one neighbour per box
    }
    Vec vector(double low, double high) {
        Vec v;
        for (int k = 0; k < S::dim; ++k) v[k] = static_cast<Real>(random_.between(low, high));
        return v;
    }
    Aabb<S> made() {
        const Vec center = vector(0, side_);
        const double edge = scene_ == "uniform" ? 1.0
                            : scene_ == "sizes" ? std::pow(10.0, random_.between(-2, 1))
                                                : random_.between(0.5, 1);
        const Vec half = Vec::Constant(static_cast<Real>(edge / 2));
        return {center - half, center + half};
    }
    Aabb<S> floor() const {
        Aabb<S> box{Vec::Constant(static_cast<Real>(-side_)), Vec::Constant(static_cast<Real>(2 * side_))};
        box.min[1] = -1;
        box.max[1] = 0;
        return box;
    }
    Vec flown(std::size_t i) {
        Vec& v = velocities_[i];
        const Vec center = Real(0.5) * (boxes[i].min + boxes[i].max);
        for (int k = 0; k < S::dim; ++k)
            if ((center[k] < 0 && v[k] < 0) || (center[k] > static_cast<Real>(side_) && v[k] > 0))
                v[k] = -v[k];
        return v * static_cast<Real>(1.0 / 60.0);
    }
    std::uint64_t morton(const Aabb<S>& box) const {
        std::uint64_t code = 0;
        for (int bit = 20; bit >= 0; --bit)
            for (int k = 0; k < S::dim; ++k) {
                const double x = static_cast<double>(box.min[k] + box.max[k]) / (2 * side_);
                const auto cell = static_cast<std::uint64_t>(std::clamp(x, 0.0, 0.999999) * 0x1p21);
                code = (code << 1) | ((cell >> bit) & 1u);
            }
        return code;
    }
    void sort() {
        std::vector<std::pair<std::uint64_t, std::size_t>> order;
        for (std::size_t i = 0; i < boxes.size(); ++i) order.emplace_back(morton(boxes[i]), i);
        std::sort(order.begin(), order.end());
        const std::vector<Aabb<S>> from = boxes;
        for (std::size_t i = 0; i < order.size(); ++i) boxes[i] = from[order[i].second];
    }

    Random random_{12345};
    std::string scene_;
    double side_;
    std::vector<Vec> velocities_;
};

}  // namespace rigor::engine::benchmark_scene
