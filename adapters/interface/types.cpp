// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/types.hpp"

#include <charconv>
#include <cmath>

#include "adapters/interface/staged.hpp"

namespace rigor::adapter {

const char* realisationName(Realisation r) {
    switch (r) {
        case Realisation::Exact:
            return "exact";
        case Realisation::Approximate:
            return "approximate";
        case Realisation::Unsupported:
            return "unsupported";
    }
    return "?";
}

const char* rowKindName(StagedRow::Kind kind) {
    switch (kind) {
        case StagedRow::Kind::Normal:
            return "normal";
        case StagedRow::Kind::Friction:
            return "friction";
        case StagedRow::Kind::Joint:
            return "joint";
        case StagedRow::Kind::Limit:
            return "limit";
    }
    return "?";
}

const char* schemeName(Scheme s) {
    switch (s) {
        case Scheme::Unknown:
            return "unknown";
        case Scheme::SymplecticEuler:
            return "symplectic_euler";
        case Scheme::ExplicitEuler:
            return "explicit_euler";
        case Scheme::MoreauMidpoint:
            return "moreau_midpoint";
        case Scheme::VelocityVerlet:
            return "velocity_verlet";
        case Scheme::RungeKutta4:
            return "rk4";
    }
    return "?";
}

bool isEuler(Scheme s) {
    return s == Scheme::SymplecticEuler || s == Scheme::ExplicitEuler;
}

const std::string& textSetting(const Settings& settings, const std::string& key) {
    const auto it = settings.find(key);
    if (it == settings.end()) throw BadInput("setting '" + key + "' was not resolved");
    return it->second;
}

double numberSetting(const Settings& settings, const std::string& key) {
    const std::string& text = textSetting(settings, key);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw BadInput("setting '" + key + "': found '" + text + "', expected a number");
    return value;
}

int integerSetting(const Settings& settings, const std::string& key) {
    const double value = numberSetting(settings, key);
    if (value != std::floor(value) || std::abs(value) > 2e9)
        throw BadInput("setting '" + key + "': found '" + settings.at(key) + "', expected an integer");
    return static_cast<int>(value);
}

}  // namespace rigor::adapter
