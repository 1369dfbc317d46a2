// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Orders of elimination against eliminating by the definition: the pattern is complete, trees have no fill,
// connected nodes are together.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/solvers/joints/elimination.hpp"

namespace rigor::engine {
namespace {

using Graph = std::vector<std::vector<std::uint32_t>>;

Graph graphOf(std::size_t nodes, const std::set<std::pair<std::uint32_t, std::uint32_t>>& edges) {
    Graph near(nodes);
    for (const auto& [a, b] : edges) {
        near[a].push_back(b);
        near[b].push_back(a);
    }
    for (auto& list : near) std::sort(list.begin(), list.end());
    return near;
}

/// Entries below the diagonal of L for the order of `found`, by its definition.
std::vector<std::set<std::uint32_t>> eliminated(const Graph& graph, const Elimination& found) {
    std::vector<std::uint32_t> position(graph.size());
    for (std::uint32_t k = 0; k < graph.size(); ++k) position[found.order[k]] = k;
    std::vector<std::set<std::uint32_t>> columns(graph.size());
    for (std::uint32_t i = 0; i < graph.size(); ++i)
        for (const std::uint32_t j : graph[i])
            if (position[j] > position[i]) columns[position[i]].insert(position[j]);
    for (auto& column : columns)
        for (const std::uint32_t i : column)
            for (const std::uint32_t j : column)
                if (j > i) columns[i].insert(j);
    return columns;
}

void expectComplete(const Graph& graph, const Elimination& found) {
    const auto expected = eliminated(graph, found);
    ASSERT_EQ(found.start.size(), graph.size() + 1);
    for (std::size_t k = 0; k < graph.size(); ++k) {
        const std::vector<std::uint32_t> column(
            found.row.begin() + static_cast<std::ptrdiff_t>(found.start[k]),
            found.row.begin() + static_cast<std::ptrdiff_t>(found.start[k + 1]));
        EXPECT_EQ(column, std::vector<std::uint32_t>(expected[k].begin(), expected[k].end())) << k;
    }
}

TEST(EliminationOrder, PatternsAreThoseOfTheDefinition) {
    std::mt19937 random(5);
    for (int round = 0; round < 20; ++round) {
        const std::uint32_t n = 3 + random() % 30;
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::uint32_t e = 0; e < n + n / 2; ++e) {
            const std::uint32_t a = random() % n, b = random() % n;
            if (a != b) edges.insert(std::minmax(a, b));
        }
        const Graph graph = graphOf(n, edges);
        Elimination found;
        ASSERT_TRUE(findElimination(graph, 10000, found));
        auto sorted = found.order;
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t i = 0; i < n; ++i) EXPECT_EQ(sorted[i], i);
        expectComplete(graph, found);
        // No entry leads from one part to another, and there are as many parts as columns without entries.
        std::size_t roots = 0;
        for (std::size_t p = 0; p + 1 < found.part.size(); ++p)
            for (std::uint32_t k = found.part[p]; k < found.part[p + 1]; ++k) {
                roots += found.start[k] == found.start[k + 1];
                for (std::size_t e = found.start[k]; e < found.start[k + 1]; ++e)
                    EXPECT_LT(found.row[e], found.part[p + 1]);
            }
        EXPECT_EQ(roots, found.part.size() - 1);
        EXPECT_EQ(found.part.back(), n);
    }
}

TEST(EliminationOrder, GivenOrdersKeepTheirEntries) {
    std::mt19937 random(6);
    for (int round = 0; round < 20; ++round) {
        const std::uint32_t n = 3 + random() % 30;
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::uint32_t e = 0; e < 2 * n; ++e) {
            const std::uint32_t a = random() % n, b = random() % n;
            if (a != b) edges.insert(std::minmax(a, b));
        }
        const Graph graph = graphOf(n, edges);
        Elimination given, found;
        for (std::uint32_t i = 0; i < n; ++i) given.order.push_back(i);
        std::shuffle(given.order.begin(), given.order.end(), random);
        std::size_t entries = 0, products = 0;
        for (const auto& column : eliminated(graph, given)) {
            entries += column.size();
            products += column.size() * (column.size() + 3) / 2;
        }
        ASSERT_TRUE(findElimination(graph, given.order, entries, found));
        expectComplete(graph, found);
        EXPECT_EQ(found.row.size(), entries);
        EXPECT_EQ(found.products(), products);
        if (entries > 0) {
            EXPECT_FALSE(findElimination(graph, given.order, entries - 1, found));
        }
    }
}

TEST(EliminationOrder, TreesHaveNoFill) {
    std::mt19937 random(7);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t i = 1; i < 200; ++i) edges.insert({static_cast<std::uint32_t>(random() % i), i});
    Elimination found;
    ASSERT_TRUE(findElimination(graphOf(200, edges), 199, found));
    EXPECT_EQ(found.row.size(), 199U);
}

TEST(EliminationOrder, GridsHaveLittleFill) {
    constexpr std::uint32_t n = 30;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < n * n; ++i) {
        if (i % n + 1 < n) edges.insert({i, i + 1});
        if (i + n < n * n) edges.insert({i, i + n});
    }
    Elimination found;
    ASSERT_TRUE(findElimination(graphOf(n * n, edges), n * n * n, found));
    // Row by row it would be n per column, 27000 in all.
    EXPECT_LT(found.row.size(), 12000U);
}

TEST(EliminationOrder, TooManyEntriesAreRefused) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < 20; ++i)
        for (std::uint32_t j = 0; j < i; ++j) edges.insert({j, i});
    Elimination found;
    EXPECT_FALSE(findElimination(graphOf(20, edges), 189, found));
    EXPECT_TRUE(findElimination(graphOf(20, edges), 190, found));
}

}  // namespace
}  // namespace rigor::engine
