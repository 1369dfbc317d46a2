// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A sweep: 89 worlds at once, a ball thrown at another angle in each.
//> farthest at 45 degrees
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <engine/engine.hpp>
#include <vector>
using namespace rigor::engine;
using S = Space2d;

int main() {
    WorldDef<S> def;
    def.gravity = {0, -9.81};
    World<S> world(def);
    const BodyId ball = addSolid<S>(world, {{Sphere<S>{0.1}}});
    WorldBatch<S> batch(world, 89, {.threads = 2});
    batch.forEach([ball](std::size_t i, World<S>& one) {
        const double angle = double(i + 1) * 3.14159265 / 180;
        one.setVelocity(ball, {10 * std::cos(angle), 10 * std::sin(angle)}, 0);
    });
    std::vector<double> states(batch.stateSize()), range(batch.size());
    for (int k = 0; k < 600; ++k) {
        batch.step(1.0 / 240);
        batch.readStates(states);
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const double* state = states.data() + i * kBodyState<S>;  // x, y, angle, ...
            if (state[1] >= 0) range[i] = state[0];
        }
    }
    const auto best = std::max_element(range.begin(), range.end()) - range.begin();
    std::printf("farthest at %d degrees\n", int(best) + 1);
}
