// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact filters: "layers" of a file, and "layers", "collides_with" and "group" of its bodies and shapes.
#include <algorithm>

#include "scenarios/loader/read_parts.hpp"

namespace rigor::scenario {
namespace {

constexpr int kLargestGroup = 32767;

std::string listed(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

/// Bits of a list of names.
std::uint32_t readNames(const Node& list, const Scenario& scenario) {
    std::uint32_t bits = 0;
    for (const Node& item : list.items()) {
        const std::string name = item.text();
        if (!item.json().is_string()) continue;
        const auto found = std::find(scenario.layers.begin(), scenario.layers.end(), name);
        if (found != scenario.layers.end())
            bits |= 1U << (found - scenario.layers.begin());
        else if (scenario.layers.empty())
            item.problem("layer.unknown", "a layer of the file, whose key 'layers' names none");
        else
            item.problem("layer.unknown", "a layer of the file: " + listed(scenario.layers));
    }
    return bits;
}

}  // namespace

void readLayers(const Node& list, Scenario& scenario) {
    scenario.layers = {kDefaultLayer};
    for (const Node& item : list.items()) {
        const std::string name = item.name();
        if (!item.json().is_string()) continue;
        if (std::find(scenario.layers.begin(), scenario.layers.end(), name) != scenario.layers.end())
            item.problem("layer.duplicate", name == kDefaultLayer
                                                ? "a name other than 'default', which every file has"
                                                : "each layer once");
        else
            scenario.layers.push_back(name);
    }
    if (scenario.layers.size() > static_cast<std::size_t>(kMaxLayers)) {
        list.problem(
            "layer.count", std::to_string(scenario.layers.size()) + " layers with 'default'",
            "at most " + std::to_string(kMaxLayers) + ": the bits of the smallest filter of an engine");
        scenario.layers.resize(kMaxLayers);
    }
}

ContactFilter readFilter(const Node& node, const Scenario& scenario, ContactFilter filter) {
    if (const auto layers = node.find("layers")) {
        const auto before = node.context().problems.size();
        filter.layers = readNames(*layers, scenario);
        if (filter.layers == 0 && node.context().problems.size() == before)
            layers->problem("layer.none", "at least one layer; \"collides_with\": [] collides with nothing");
    }
    if (const auto others = node.find("collides_with")) filter.collidesWith = readNames(*others, scenario);
    if (const auto group = node.find("group"))
        filter.group = group->integer(-kLargestGroup - 1, kLargestGroup);
    return filter;
}

}  // namespace rigor::scenario
