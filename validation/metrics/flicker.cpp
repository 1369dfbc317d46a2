// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts that come, go or turn for a single step. Both look at three steps in a row, so that motion, which
// carries a contact on, does not count, and what comes back at once does. Persistent manifolds exist to avoid
// it: Moravanszky and Terdiman, Fast Contact Reduction for Dynamics Simulation, Game Programming Gems 4,
// 2004.
#include <algorithm>
#include <array>
#include <map>

#include "validation/metrics/metric_parts.hpp"

namespace rigor::validation {
namespace {

using scenario::Vec3;

using PairKey = std::array<int, 4>;       ///< bodies and shapes of A and B
using Normals = std::map<PairKey, Vec3>;  ///< normals of the deepest contact of each pair
using ByBody = std::map<int, std::pair<Worst, std::vector<double>>>;

Normals deepestNormals(const std::vector<ContactPoint>& contacts) {
    std::map<PairKey, const ContactPoint*> deepest;
    for (const ContactPoint& c : contacts) {
        const ContactPoint*& known = deepest[{c.bodyA, c.bodyB, c.shapeA, c.shapeB}];
        if (known == nullptr || c.depth > known->depth) known = &c;
    }
    Normals normals;
    for (const auto& [key, contact] : deepest) normals[key] = contact->normal;
    return normals;
}

/// Calls `look(before, now or null, after, key, frame)` for every pair that touches in the first and the last
/// of three consecutive steps.
template <class Look>
void overTriples(const MetricInput& input, Look&& look) {
    const auto& run = input.trajectory;
    if (run.stride != 1) return;
    std::array<Normals, 3> window;  // frame k at k % 3
    const std::size_t frames = std::min(run.frames(), run.contacts.size());
    for (std::size_t k = 0; k < frames; ++k) {  // one at an end of the run has none
        window[k % 3] = deepestNormals(run.contacts[k]);
        if (k < 2) continue;
        const Normals &before = window[(k - 2) % 3], &now = window[(k - 1) % 3], &after = window[k % 3];
        for (const auto& [key, normal] : before) {
            const auto last = after.find(key);
            if (last == after.end()) continue;
            const auto middle = now.find(key);
            look(normal, middle == now.end() ? nullptr : &middle->second, last->second, key, k - 1);
        }
    }
}

/// The mean of what each body's contacts did, and when the most was done.
std::vector<MetricValue> meanRows(const MetricInput& input, const ByBody& found) {
    std::vector<MetricValue> rows;
    for (const int body : observedDynamic(input)) {
        const auto it = found.find(body);
        if (it == found.end()) continue;
        const auto& [worst, values] = it->second;
        double sum = 0.0;
        for (const double v : values) sum += v;
        MetricValue row = worst.row(bodyName(input, body));
        row.value = sum / values.size();
        rows.push_back(row);
    }
    return withWorst(std::move(rows));
}

void add(ByBody& found, const PairKey& key, double value, double at) {
    for (const int body : {key[0], key[1]}) {
        auto& [worst, values] = found[body];
        worst.add(value, at);
        values.push_back(value);
    }
}

}  // namespace

std::vector<MetricValue> normalFlicker(const MetricInput& input) {
    ByBody found;
    overTriples(input, [&](Vec3 before, const Vec3* now, Vec3 after, const PairKey& key, std::size_t frame) {
        if (now == nullptr) return;
        const double turned = angleBetween(before, *now) + angleBetween(*now, after);
        add(found, key, std::max(0.0, turned - angleBetween(before, after)), input.trajectory.times[frame]);
    });
    return meanRows(input, found);
}

std::vector<MetricValue> contactFlicker(const MetricInput& input) {
    ByBody found;
    overTriples(input, [&](Vec3, const Vec3* now, Vec3, const PairKey& key, std::size_t frame) {
        if (now == nullptr) add(found, key, 1.0, input.trajectory.times[frame]);
    });
    if (input.trajectory.stride == 1)
        for (const auto& contacts : input.trajectory.contacts)
            for (const auto& [key, normal] : deepestNormals(contacts)) add(found, key, 0.0, -1.0);
    return meanRows(input, found);
}

}  // namespace rigor::validation
