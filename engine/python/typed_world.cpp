// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <map>

#include "engine/python/world_building-inl.hpp"
#include "engine/python/world_queries-inl.hpp"
#include "engine/python/world_reading-inl.hpp"
#include "engine/python/world_running-inl.hpp"
#include "engine/state/settings.hpp"

namespace rigor::engine::python {
namespace {

/// A switch is given as a bool, or by the word that a spec has.
bool toSwitch(const std::string& key, const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    static const std::map<std::string, bool> words{{"off", false}, {"on", true}};
    const auto found = words.find(py::str(value));
    if (found == words.end())
        throw EngineError("setting_value",
                          key + ": found '" + std::string(py::str(value)) + "', expected on or off");
    return found->second;
}

template <class T>
T toNumber(const std::string& key, const py::handle& value) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw EngineError("setting_value", key + ": found " + std::string(py::repr(value)) + ", expected " +
                                               (std::is_integral_v<T> ? "an integer" : "a number"));
    }
}

template <class S>
void assign(WorldDef<S>& def, const std::string& key, const py::handle& value) {
    using Real = typename S::Real;
    (void)setting(key);  // throws for an unknown key
#define CHOICE(member, name, byDefault, help) \
    if (key == name) def.member = std::string(py::str(value));
#define INTEGER(member, name, byDefault, min, max, help) \
    if (key == name) def.member = toNumber<int>(key, value);
#define REAL(member, name, byDefault, min, max, help) \
    if (key == name) def.member = static_cast<Real>(toNumber<double>(key, value));
#define SWITCH(member, name, byDefault, help) \
    if (key == name) def.member = toSwitch(key, value);
#include "engine/state/settings.def"
}

template <class S>
std::shared_ptr<AnyWorld> makeTyped(const std::string& preset, const MaybeNumbers& gravity, double h,
                                    const py::dict& settings) {
    WorldDef<S> def = WorldDef<S>::preset(preset);
    def.gravity = toVec<S>(gravity, "gravity", typename S::Vec(typename S::Real(-9.81) * S::Vec::Unit(1)));
    for (const auto& [key, value] : settings) assign<S>(def, key.template cast<std::string>(), value);
    BuiltWorld<S> built{World<S>(def), {}, {}, {}, {}, {}, {}, h, {}};
    built.materials = {kFrictionless, kUsualMaterial};
    built.materialNames = {"frictionless", "usual"};
    return std::make_shared<TypedWorld<S>>(std::move(built));
}

}  // namespace

std::shared_ptr<AnyWorld> makeWorld(int dimension, const std::string& precision, const std::string& preset,
                                    const MaybeNumbers& gravity, double h, const py::dict& settings) {
    const bool single = precision == "f32";
    if (!single && precision != "f64")
        throw EngineError("precision", "no precision '" + precision + "', expected f32 or f64");
    if (dimension == 2)
        return single ? makeTyped<Space2f>(preset, gravity, h, settings)
                      : makeTyped<Space2d>(preset, gravity, h, settings);
    if (dimension != 3)
        throw EngineError("dimension", "found " + std::to_string(dimension) + ", expected 2 or 3");
    return single ? makeTyped<Space3f>(preset, gravity, h, settings)
                  : makeTyped<Space3d>(preset, gravity, h, settings);
}

RIGOR_INSTANTIATE_CLASS(TypedWorld)

}  // namespace rigor::engine::python
