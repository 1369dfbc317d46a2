// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Numbers between NumPy and the engine. Every function throws EngineError "array" for arrays of another size than it
// needs; whether numbers are in range is for the engine to say.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/math/rotation.hpp"
#include "engine/math/space.hpp"

namespace rigor::engine::python {

namespace py = pybind11;

/// Anything that NumPy makes an array of doubles: tuples, lists, arrays of other types.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using MaybeNumbers = std::optional<Numbers>;

inline void requireSize(const Numbers& numbers, py::ssize_t size, const char* name) {
    if (numbers.size() != size)
        throw EngineError("array", std::string(name) + ": found " + std::to_string(numbers.size()) +
                                       " numbers, expected " + std::to_string(size));
}

template <class S>
typename S::Vec toVec(const double* numbers) {
    typename S::Vec v;
    for (int i = 0; i < S::dim; ++i) v[i] = static_cast<typename S::Real>(numbers[i]);
    return v;
}
template <class S>
typename S::Vec toVec(const Numbers& numbers, const char* name) {
    requireSize(numbers, S::dim, name);
    return toVec<S>(numbers.data());
}
template <class S>
typename S::Vec toVec(const MaybeNumbers& numbers, const char* name, const typename S::Vec& otherwise) {
    return numbers ? toVec<S>(*numbers, name) : otherwise;
}

/// An angular velocity or torque: 3 numbers, in 2D one.
template <class S>
typename S::Ang toAng(const double* numbers) {
    if constexpr (S::dim == 2)
        return static_cast<typename S::Real>(*numbers);
    else
        return toVec<S>(numbers);
}
template <class S>
typename S::Ang toAng(const MaybeNumbers& numbers, const char* name) {
    if (!numbers) return zeroAng<S>();
    requireSize(*numbers, S::dim == 2 ? 1 : 3, name);
    return toAng<S>(numbers->data());
}

/// An orientation: a quaternion w, x, y, z, in 2D an angle.
template <class S>
typename S::Rot toRot(const MaybeNumbers& numbers) {
    using R = typename S::Real;
    if (!numbers) return Pose<S>::identityRot();
    requireSize(*numbers, S::dim == 2 ? 1 : 4, "orientation");
    const double* x = numbers->data();
    if constexpr (S::dim == 2)
        return S::Rot::fromAngle(static_cast<R>(x[0]));
    else
        return {static_cast<R>(x[0]), static_cast<R>(x[1]), static_cast<R>(x[2]), static_cast<R>(x[3])};
}

template <class S>
Pose<S> toPose(const MaybeNumbers& position, const MaybeNumbers& orientation) {
    return {toVec<S>(position, "position", S::Vec::Zero()), toRot<S>(orientation)};
}

/// Rows of an array of points.
template <class S>
std::vector<typename S::Vec> toPoints(const Numbers& numbers, const char* name) {
    if (numbers.ndim() != 2 || numbers.shape(1) != S::dim)
        throw EngineError("array", std::string(name) + ": expected an array of points x " +
                                       std::to_string(S::dim) + " numbers");
    std::vector<typename S::Vec> points;
    for (py::ssize_t i = 0; i < numbers.shape(0); ++i) points.push_back(toVec<S>(numbers.data(i, 0)));
    return points;
}

template <class R, int N>
py::array_t<double> fromVec(const Eigen::Matrix<R, N, 1>& v) {
    py::array_t<double> result(N);
    for (int i = 0; i < N; ++i) result.mutable_data()[i] = static_cast<double>(v[i]);
    return result;
}
inline py::object fromAng(double w) {
    return py::float_(w);
}
template <class R>
py::object fromAng(const Eigen::Matrix<R, 3, 1>& w) {
    return fromVec(w);
}

}  // namespace rigor::engine::python
