// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// "bench": how a scene is timed, and the bounds outside of which a timing does not count.
#include "scenarios/loader/read_parts.hpp"

namespace rigor::scenario {
namespace {

constexpr int kMaxSteps = 1000000;

std::vector<int> readSizes(const Node& list) {
    std::vector<int> sizes;
    for (const Node& node : list.items()) {
        const int size = node.integer(1, 1000000);
        if (!sizes.empty() && size <= sizes.back()) node.problem("bench.sizes", "sizes that rise");
        sizes.push_back(size);
    }
    return sizes;
}

QualityBound readBound(const Node& node, Quality quantity) {
    QualityBound bound{quantity};
    const bool range = node.json().is_object() && !node.has("size");
    if (!range) {
        bound.max = node.scaled(-kLargestNumber, kLargestNumber);
        return bound;
    }
    node.isObject({"min", "max"});
    if (const auto n = node.find("min")) bound.min = n->scaled(-kLargestNumber, kLargestNumber);
    if (const auto n = node.find("max")) bound.max = n->scaled(-kLargestNumber, kLargestNumber);
    if (!node.has("min") && !node.has("max")) node.problem("bench.bound", "min, max or both");
    if (bound.min > bound.max) node.problem("bench.bound", "min not above max");
    return bound;
}

std::vector<QualityBound> readQuality(const Node& object) {
    std::vector<QualityBound> bounds;
    std::string known;
    for (const QualityName& name : qualityNames())
        known += (known.empty() ? "" : ", ") + std::string(name.key);
    for (const auto& [key, node] : object.members()) {
        const QualityName* found = nullptr;
        for (const QualityName& name : qualityNames())
            if (name.key == key) found = &name;
        if (found == nullptr)
            node.problem("schema.unknown_key", "the key '" + key + "'", "one of " + known);
        else
            bounds.push_back(readBound(node, found->quantity));
    }
    return bounds;
}

}  // namespace

BenchPlan readBench(const Node& node) {
    BenchPlan plan;
    node.isObject({"warm_up_steps", "timed_steps", "quality_step", "sizes", "quality"});
    if (const auto n = node.require("warm_up_steps")) plan.warmUpSteps = n->integer(0, kMaxSteps);
    if (const auto n = node.require("timed_steps")) plan.timedSteps = n->integer(1, kMaxSteps);
    plan.qualityStep = plan.warmUpSteps + plan.timedSteps;
    if (const auto n = node.find("quality_step"))
        plan.qualityStep = n->integer(plan.qualityStep, 2 * kMaxSteps);
    if (const auto n = node.find("sizes")) {
        plan.sizes = readSizes(*n);
        if (!node.context().size)
            n->problem("size.missing", "sizes of a scene that has none", "the key 'size' in the scenario");
    }
    if (const auto n = node.require("quality")) {
        plan.quality = readQuality(*n);
        if (n->json().is_object() && n->json().empty())
            n->problem("bench.quality", "at least one bound: a timing without quality says nothing");
    }
    return plan;
}

}  // namespace rigor::scenario
