// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Minimum degree [GeorgeLiu1989]: eliminating a node joins its neighbours to each other, so the one with the
// fewest goes next (of equals the first). Chains and trees are eliminated from their leaves without any fill.
// The order is then rearranged without a change of L's entries: component by component, and within one by a
// postorder of the elimination tree [Liu1990], so that dependent columns are together in memory.
// Cost: about the entries of L times their number per column, once per graph.
#include "engine/solvers/joints/elimination.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "engine/core/ids.hpp"

namespace rigor::engine {
namespace {

using Nodes = std::vector<std::uint32_t>;
/// Node -> number of its component, in the order of their first nodes.
Nodes findComponents(const std::vector<Nodes>& near) {
    Nodes component(near.size(), kNullIndex), open;
    std::uint32_t count = 0;
    for (std::uint32_t first = 0; first < near.size(); ++first) {
        if (component[first] != kNullIndex) continue;
        component[first] = count;
        open.assign(1, first);
        while (!open.empty()) {
            const std::uint32_t node = open.back();
            open.pop_back();
            for (const std::uint32_t other : near[node])
                if (component[other] == kNullIndex) {
                    component[other] = count;
                    open.push_back(other);
                }
        }
        ++count;
    }
    return component;
}

/// Leaves in near[i] the nodes of column i of L and returns the order; empty where there are too many.
Nodes minimumDegree(std::vector<Nodes>& near, std::size_t most) {
    std::set<std::pair<std::size_t, std::uint32_t>> byDegree;
    for (std::uint32_t i = 0; i < near.size(); ++i) byDegree.insert({near[i].size(), i});
    Nodes order, both;
    for (std::size_t entries = 0; !byDegree.empty();) {
        const std::uint32_t next = byDegree.begin()->second;
        byDegree.erase(byDegree.begin());
        order.push_back(next);
        entries += near[next].size();
        if (entries > most) return {};
        for (const std::uint32_t i : near[next]) {
            byDegree.erase({near[i].size(), i});
            both.clear();
            std::set_union(near[i].begin(), near[i].end(), near[next].begin(), near[next].end(),
                           std::back_inserter(both));
            std::erase_if(both, [&](std::uint32_t j) { return j == i || j == next; });
            near[i] = both;
            byDegree.insert({near[i].size(), i});
        }
    }
    return order;
}

/// The same for an order that is given [Liu1990]: a column has what its node is coupled with and what the
/// columns of its children in the elimination tree have, of what comes later. False where there are too many.
bool columnsInOrder(std::vector<Nodes>& near, const Nodes& order, std::size_t most) {
    const std::size_t n = order.size();
    Nodes position(n), both;
    for (std::uint32_t k = 0; k < n; ++k) position[order[k]] = k;
    std::vector<Nodes> children(n);
    std::size_t entries = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t node = order[k];
        Nodes& column = near[node];
        for (const std::uint32_t child : children[node]) {
            both.clear();
            std::set_union(column.begin(), column.end(), near[child].begin(), near[child].end(),
                           std::back_inserter(both));
            column.swap(both);
        }
        std::erase_if(column, [&](std::uint32_t j) { return position[j] <= k; });
        entries += column.size();
        if (entries > most) return false;
        if (column.empty()) continue;
        children[*std::min_element(column.begin(), column.end(), [&](std::uint32_t a, std::uint32_t b) {
            return position[a] < position[b];
        })].push_back(node);
    }
    return true;
}

/// A postorder of the elimination tree: a node's parent is the first of its column.
Nodes postorder(const Nodes& order, const std::vector<Nodes>& columns, const Nodes& component) {
    const std::size_t n = order.size();
    Nodes position(n), parent(n, kNullIndex), child(n, kNullIndex), sibling(n, kNullIndex), roots;
    for (std::uint32_t k = 0; k < n; ++k) position[order[k]] = k;
    const auto earlier = [&](std::uint32_t a, std::uint32_t b) { return position[a] < position[b]; };
    for (std::size_t k = n; k-- > 0;) {
        const std::uint32_t node = order[k];
        if (columns[node].empty()) {
            roots.push_back(node);
            continue;
        }
        parent[node] = *std::min_element(columns[node].begin(), columns[node].end(), earlier);
        sibling[node] = child[parent[node]];  // siblings are in the order of elimination
        child[parent[node]] = node;
    }
    std::sort(roots.begin(), roots.end(),
              [&](std::uint32_t a, std::uint32_t b) { return component[a] < component[b]; });
    Nodes result;
    for (std::uint32_t node : roots)
        for (const std::uint32_t root = node;;) {
            while (child[node] != kNullIndex) node = child[node];
            result.push_back(node);
            while (node != root && sibling[node] == kNullIndex) result.push_back(node = parent[node]);
            if (node == root) break;
            node = sibling[node];
        }
    return result;
}

/// Arranges the columns of L, by node, for the order that was found.
void arrange(std::vector<Nodes>& near, const Nodes& found, const Nodes& component, Elimination& out) {
    const std::size_t n = near.size();
    out.order = postorder(found, near, component);
    out.part.clear();
    out.start.assign(1, 0);
    out.row.clear();
    Nodes position(n);
    for (std::uint32_t k = 0; k < n; ++k) position[out.order[k]] = k;
    for (std::uint32_t k = 0; k < n; ++k) {
        Nodes& column = near[out.order[k]];
        for (std::uint32_t& node : column) node = position[node];
        std::sort(column.begin(), column.end());
        out.row.insert(out.row.end(), column.begin(), column.end());
        out.start.push_back(out.row.size());
        if (k == 0 || component[out.order[k]] != component[out.order[k - 1]]) out.part.push_back(k);
    }
    out.part.push_back(static_cast<std::uint32_t>(n));
}

}  // namespace

std::size_t Elimination::products() const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k + 1 < start.size(); ++k) {
        const std::size_t c = start[k + 1] - start[k];
        sum += c * (c + 3) / 2;
    }
    return sum;
}

bool findElimination(std::vector<std::vector<std::uint32_t>> near, std::size_t most, Elimination& out) {
    const Nodes component = findComponents(near);
    const Nodes found = minimumDegree(near, most);
    if (found.size() != near.size()) return false;
    arrange(near, found, component, out);
    return true;
}

bool findElimination(std::vector<std::vector<std::uint32_t>> near, const std::vector<std::uint32_t>& order,
                     std::size_t most, Elimination& out) {
    const Nodes component = findComponents(near);
    if (!columnsInOrder(near, order, most)) return false;
    arrange(near, order, component, out);
    return true;
}

}  // namespace rigor::engine
