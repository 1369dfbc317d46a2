// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/mjcf/compiled_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rigor::models::mjcf {
namespace {

template <class T>
void requireSize(const Array<T>& array, int count, int width, const char* name) {
    if (count < 0 || array.values.size() != static_cast<std::size_t>(count) * static_cast<std::size_t>(width))
        throw std::runtime_error(std::string(name) + ": found " + std::to_string(array.values.size()) +
                                 " numbers, expected " + std::to_string(count) + " x " +
                                 std::to_string(width));
}

bool allFinite(const Array<double>& numbers) {
    return std::all_of(numbers.values.begin(), numbers.values.end(),
                       [](double v) { return std::abs(v) < 1e15; });
}

}  // namespace

void CompiledModel::requireSizes() const {
#define MODEL_FIELD(type, name, count, width) requireSize(name, count, width, #name);
#define NEWER_FIELD(type, name, count, width) \
    if (!name.empty()) requireSize(name, count, width, #name);
#define START_FIELD(type, name, count, width) requireSize(name, count, width, #name);
#include "scenarios/exchange/mjcf/compiled_fields.def"
    requireSize(body_velocity, nbody, 6, "body_velocity");
    requireSize(eq_violation, neq, 1, "eq_violation");
    requireSize(body_names, nbody, 1, "body_names");
    requireSize(joint_names, njnt, 1, "joint_names");
    requireSize(equality_names, neq, 1, "equality_names");
    requireSize(tendon_names, ntendon, 1, "tendon_names");
    requireSize(gravity, 1, 3, "gravity");
}

bool CompiledModel::isFinite() const {
    return allFinite(qpos) && allFinite(xpos) && allFinite(xquat) && allFinite(body_velocity) &&
           allFinite(body_mass) && allFinite(body_inertia) && allFinite(geom_pos) && allFinite(geom_size) &&
           allFinite(gravity);
}

}  // namespace rigor::models::mjcf
