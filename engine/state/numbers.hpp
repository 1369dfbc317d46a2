// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Velocities as one long row of numbers, for operations that are the same for all of them.
#pragma once

#include <type_traits>

#include "engine/state/body_arrays.hpp"

namespace rigor::engine {

/// The numbers of velocities [first, last), gaps and all.
template <class V>
auto numbers(V* velocities, std::size_t first, std::size_t last) {
    using S = typename V::S;
    using Real = std::conditional_t<std::is_const_v<V>, const typename S::Real, typename S::Real>;
    using Array = Eigen::Array<typename S::Real, Eigen::Dynamic, 1>;
    using Numbers = std::conditional_t<std::is_const_v<V>, const Array, Array>;
    constexpr std::size_t each = sizeof(V) / sizeof(Real);
    return Eigen::Map<Numbers, Eigen::Aligned16>(reinterpret_cast<Real*>(velocities + first),
                                                 static_cast<Eigen::Index>((last - first) * each));
}

}  // namespace rigor::engine
