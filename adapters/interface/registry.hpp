// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Engine specs ("ode:stepper=quickstep,iterations=50") and the modules behind them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adapters/interface/engine.hpp"
#include "adapters/interface/float_environment.hpp"

namespace rigor::adapter {

/// A spec as written: engine name and the keys that were given. "preset" and "precision" are among them when
/// given.
struct EngineSpec {
    std::string engine;
    std::map<std::string, std::string> options;
    /// "name" or "name:key=value,..." with keys sorted; the stable id used in results.
    std::string text() const;
    /// The value of "preset" ("default" when absent).
    std::string preset() const;
};

/// Parses one spec. Throws BadInput on malformed text.
EngineSpec parseSpec(const std::string& text);
/// Parses "rigor,ode:stepper=quickstep,iterations=50,bullet" (a part with '=' and no ':' continues the spec
/// before it).
std::vector<EngineSpec> parseSpecList(const std::string& text);

/// Folders that are searched for modules, in this order: RIGOR_ADAPTER_PATH (colon separated), then
/// `adapters/` beside the binary's folder and in it.
std::vector<std::filesystem::path> adapterPath();
/// Engine names with a module, or a guest that is installed (guest.hpp), on the path, sorted.
std::vector<std::string> availableEngines();
/// Precisions that an engine has as modules of their own ("f32" beside the plain module).
std::vector<std::string> availablePrecisions(const std::string& engine);
/// The module file for a spec (its precision picks the variant), or the manifest of a guest. Throws BadInput naming
/// the known engines, or what a guest lacks.
std::filesystem::path moduleFor(const EngineSpec& spec);

/// An engine of a module, which stays open until the process ends.
class LoadedEngine {
  public:
    explicit LoadedEngine(const std::filesystem::path& module);
    const Engine& operator*() const { return *engine_; }
    const Engine* operator->() const { return engine_.get(); }

    /// Changes of the floating-point environment by loading it, which are undone; "" if there were none.
    const std::string& environmentChanges() const { return environmentChanges_; }

    /// A world of its dynamics, which must be there, with every answer checked (checked_world.hpp).
    std::unique_ptr<World> build(const Scenario& scenario, double dt, const Settings& settings) const;

  private:
    void open(const std::filesystem::path& module);

    std::unique_ptr<Engine> engine_;
    FloatEnvironment environment_;  ///< environment of the process before it was loaded
    std::string environmentChanges_;
};

/// Loads the module of the spec into this process.
LoadedEngine loadEngine(const EngineSpec& spec);

/// All options with the preset's values, overridden by those given. Throws BadInput for unknown keys (listing
/// the known ones) and for values not allowed.
Settings resolveSettings(const EngineSpec& spec, const Engine& engine);

}  // namespace rigor::adapter
