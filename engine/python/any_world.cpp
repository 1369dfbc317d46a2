// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/python/any_world.hpp"

#include <algorithm>
#include <cmath>

namespace rigor::engine::python {

void Names::check(const std::string& name) const {
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
        throw EngineError("name", std::string("there is a ") + kind_ + " '" + name + "' already");
}

void Names::add(const std::string& name) {
    const std::string own = name.empty() ? std::string(kind_) + "_" + std::to_string(names_.size()) : name;
    check(own);
    names_.push_back(own);
}

std::size_t Names::find(const Key& key) const {
    if (const auto* number = std::get_if<py::ssize_t>(&key)) {
        if (*number < 0 || static_cast<std::size_t>(*number) >= names_.size())
            throw py::index_error(std::string(kind_) + " " + std::to_string(*number) + ": there are " +
                                  std::to_string(names_.size()));
        return static_cast<std::size_t>(*number);
    }
    const std::string& name = std::get<std::string>(key);
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end())
        throw py::key_error(std::string("no ") + kind_ + " has the name '" + name + "'");
    return static_cast<std::size_t>(found - names_.begin());
}

void AnyWorld::setTimeStep(double h) {
    if (!(h > 0) || !std::isfinite(h))
        throw EngineError("time_step", "found " + std::to_string(h) + ", expected a number above 0 [s]");
    timeStep_ = h;
}

}  // namespace rigor::engine::python
