// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Time per update of every broad phase of the table. Not a test; build with
// `ninja engine_broadphase_benchmark` and run it on an idle machine.
//
// Scenes, n boxes of edges 0.5 to 1 m over a floor: `slow` moves each box by 1 cm between updates, `fast` by
// 30 cm, `jump` puts all of them somewhere else; `sizes` is slow with edges from 1 cm to 10 m.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>

#include "engine/broadphase/broad_phase.hpp"

namespace rigor::engine {
namespace {

using S = Space3d;

void bench(const char* name, BroadPhase<S>& broadPhase, int n, const char* scene) {
    std::mt19937 random(3);
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    const double side = 1.5 * std::cbrt(n);  // about one neighbour per box
    const bool jump = !std::strcmp(scene, "jump"), sizes = !std::strcmp(scene, "sizes");
    const double step = !std::strcmp(scene, "fast") ? 0.3 : 0.01;
    const auto make = [&] {
        const S::Vec c(uniform(0, side), uniform(0, side), uniform(0, side));
        const double edge = sizes ? std::pow(10, uniform(-2, 1)) : uniform(0.5, 1);
        return Aabb<S>{c.array() - edge / 2, c.array() + edge / 2};
    };
    std::vector<Aabb<S>> boxes(static_cast<std::size_t>(n));
    for (auto& box : boxes) box = make();
    boxes[0] = {S::Vec(-side, -1, -side), S::Vec(2 * side, 0, 2 * side)};
    const std::vector<std::uint8_t> movable(boxes.size(), 1);
    std::vector<ProxyPair> pairs;
    std::vector<double> times;
    for (int round = 0; round < 15; ++round) {
        const auto t0 = std::chrono::steady_clock::now();
        broadPhase.update(boxes, movable, pairs);
        const auto t1 = std::chrono::steady_clock::now();
        if (round >= 4) times.push_back(std::chrono::duration<double, std::micro>(t1 - t0).count());
        for (std::size_t i = 1; i < boxes.size(); ++i) {
            const S::Vec d(uniform(-step, step), uniform(-step, step), uniform(-step, step));
            if (jump)
                boxes[i] = make();
            else
                boxes[i].min += d, boxes[i].max += d;
        }
    }
    std::sort(times.begin(), times.end());
    std::printf("%-26s %-6s %6d boxes %7zu pairs  median %9.0f us\n", name, scene, n, pairs.size(),
                times[times.size() / 2]);
}

}  // namespace
}  // namespace rigor::engine

int main() {
    using namespace rigor::engine;
    for (const char* scene : {"slow", "fast", "jump", "sizes"})
        for (const int n : {1000, 4000, 10000})
            for (const auto& entry : broadPhaseTable<S>()) bench(entry.name, *entry.make(), n, scene);
}
