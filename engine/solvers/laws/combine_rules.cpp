// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/solvers/combine_rules.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::engine {
namespace {

template <class R>
R combineAverage(R a, R b) {
    return R(0.5) * (a + b);
}
template <class R>
R combineGeometricMean(R a, R b) {
    return std::sqrt(a * b);
}
template <class R>
R combineMax(R a, R b) {
    return std::max(a, b);
}
template <class R>
R combineMin(R a, R b) {
    return std::min(a, b);
}
template <class R>
R combineMultiply(R a, R b) {
    return a * b;
}

}  // namespace

template <class R>
std::span<const AlgorithmEntry<CombineRule<R>>> combineTable() {
    static constexpr AlgorithmEntry<CombineRule<R>> table[] = {
#define ALGORITHM(name, function, summary) {#name, &function<R>, summary},
#include "engine/solvers/combine_rules.def"
    };
    return table;
}
template std::span<const AlgorithmEntry<CombineRule<float>>> combineTable<float>();
template std::span<const AlgorithmEntry<CombineRule<double>>> combineTable<double>();

}  // namespace rigor::engine
