// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/registry.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <set>

#include "adapters/interface/checked_world.hpp"
#include "adapters/interface/guest.hpp"
#include "scenarios/model/nearest.hpp"

namespace rigor::adapter {
namespace {

constexpr const char* kPrefix = "rigor_adapter_";
constexpr const char* kModule = ".so";
constexpr const char* kManifest = ".json";
constexpr const char* kGuestHostFile = "rigor_guest_host.so";

/// "rigor_adapter_bullet.f32.so" -> {"bullet", "f32"}; empty name when it is no file of an engine with this suffix.
std::pair<std::string, std::string> engineName(const std::filesystem::path& file, const std::string& suffix) {
    std::string name = file.filename().string();
    const std::string prefix = kPrefix;
    if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
        return {};
    name = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    const auto dot = name.find('.');
    return {name.substr(0, dot), dot == std::string::npos ? "" : name.substr(dot + 1)};
}
std::pair<std::string, std::string> moduleName(const std::filesystem::path& file) {
    return engineName(file, kModule);
}

std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder, const char* suffix) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (!engineName(entry.path(), suffix).first.empty()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}
std::vector<std::filesystem::path> modulesIn(const std::filesystem::path& folder) {
    return filesIn(folder, kModule);
}

/// Every manifest on the path: of one name, the first.
std::map<std::string, std::filesystem::path> manifests() {
    std::map<std::string, std::filesystem::path> found;
    for (const auto& folder : adapterPath())
        for (const auto& file : filesIn(folder, kManifest))
            found.emplace(engineName(file, kManifest).first, file);
    return found;
}

/// A manifest that can not be read counts as installed: what is wrong with it is said when it is opened.
bool isInstalled(const std::filesystem::path& manifest) {
    try {
        return readGuestManifest(manifest).missing().empty();
    } catch (const BadInput&) {
        return true;
    }
}

std::string absentText(const GuestManifest& guest) {
    return "not installed: " + guest.missing() + " is missing" +
           (guest.install.empty() ? "" : "; to install it: " + guest.install);
}

/// Modules that were opened with success. They stay mapped: objects that they made may outlive their engine, and some
/// libraries do not survive being unloaded. The loader would go through all libraries of the process each time.
class OpenModules {
  public:
    /// Null if it is none of them.
    void* find(const std::filesystem::path& file) const {
        const std::lock_guard lock(mutex_);
        const auto open = handles_.find(file);
        return open == handles_.end() ? nullptr : open->second;
    }
    void add(const std::filesystem::path& file, void* handle) {
        const std::lock_guard lock(mutex_);
        handles_[file] = handle;
    }

  private:
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, void*> handles_;
};

OpenModules& openModules() {
    static OpenModules modules;
    return modules;
}

void* openLibrary(const std::filesystem::path& file) {
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw std::runtime_error(std::string("cannot load the module: ") + dlerror());
    return handle;
}

/// The description that a module exports, its version checked. The module is closed again where it is none.
template <class Described>
const Described& entryOf(const std::filesystem::path& file, const char* symbol) {
    void* handle = openModules().find(file);
    if (handle == nullptr) handle = openLibrary(file);
    using Entry = const Described* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(handle, symbol));
    if (entry == nullptr) {
        dlclose(handle);
        throw std::runtime_error(file.string() + ": no entry point " + symbol);
    }
    const Described* described = entry();
    if (described->abi != kAdapterAbi) {
        const int abi = described->abi;
        dlclose(handle);
        throw std::runtime_error(file.string() + ": built for adapter interface " + std::to_string(abi) +
                                 ", this program has " + std::to_string(kAdapterAbi));
    }
    openModules().add(file, handle);
    return *described;
}

std::filesystem::path guestHost() {
    for (const auto& folder : adapterPath())
        if (std::filesystem::exists(folder / kGuestHostFile)) return folder / kGuestHostFile;
    throw std::runtime_error(std::string("guests need ") + kGuestHostFile +
                             ", which is in no folder of the path");
}

}  // namespace

std::vector<std::filesystem::path> adapterPath() {
    std::vector<std::filesystem::path> folders;
    if (const char* variable = std::getenv("RIGOR_ADAPTER_PATH")) {
        std::string rest = variable;
        while (!rest.empty()) {
            const auto colon = rest.find(':');
            if (colon != 0) folders.emplace_back(rest.substr(0, colon));
            rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
        }
    }
    std::error_code error;
    const auto binary = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        folders.push_back(binary.parent_path() / "adapters");
        folders.push_back(binary.parent_path().parent_path() / "lib" / "rigor" / "adapters");
    }
    return folders;
}

std::vector<std::string> availableEngines() {
    std::set<std::string> names;
    for (const auto& folder : adapterPath())
        for (const auto& file : modulesIn(folder)) names.insert(moduleName(file).first);
    for (const auto& [name, file] : manifests())
        if (isInstalled(file)) names.insert(name);
    return {names.begin(), names.end()};
}

std::vector<GuestManifest> absentGuests() {
    std::vector<GuestManifest> absent;
    for (const auto& [name, file] : manifests())
        if (!isInstalled(file)) absent.push_back(readGuestManifest(file));
    return absent;
}

std::vector<std::string> availablePrecisions(const std::string& engine) {
    std::set<std::string> variants;
    for (const auto& folder : adapterPath())
        for (const auto& file : modulesIn(folder))
            if (const auto [name, precision] = moduleName(file); name == engine && !precision.empty())
                variants.insert(precision);
    return {variants.begin(), variants.end()};
}

std::filesystem::path moduleFor(const EngineSpec& spec) {
    const auto given = spec.options.find("precision");
    const std::string precision = given == spec.options.end() ? "" : given->second;
    std::filesystem::path plain;
    for (const auto& folder : adapterPath())
        for (const auto& file : modulesIn(folder)) {
            const auto [name, variant] = moduleName(file);
            if (name != spec.engine) continue;
            if (!variant.empty() && variant == precision) return file;
            if (variant.empty() && plain.empty()) plain = file;
        }
    if (!plain.empty()) return plain;
    const auto guests = manifests();
    if (const auto guest = guests.find(spec.engine); guest != guests.end()) {
        if (isInstalled(guest->second)) return guest->second;
        throw BadInput("engine '" + spec.engine + "' is " + absentText(readGuestManifest(guest->second)));
    }
    std::string known;
    const auto names = availableEngines();
    for (const auto& name : names) known += (known.empty() ? "" : ", ") + name;
    throw BadInput("engine '" + spec.engine + "' is not installed; known engines: " +
                   (known.empty() ? "none" : known) + scenario::didYouMean(spec.engine, names));
}

LoadedEngine::LoadedEngine(const std::filesystem::path& module) {
    const KeepFloatEnvironment keep;
    open(module);
    if (const std::string changed = environment_.restore(); !changed.empty())
        environmentChanges_ = changed + " when it is loaded";
}

void LoadedEngine::open(const std::filesystem::path& module) {
    if (module.extension() == kManifest) {
        const GuestManifest manifest = readGuestManifest(module);
        const auto host = guestHost();
        engine_ = entryOf<GuestHost>(host, "rigorGuestHost").open(manifest);
        return;
    }
    engine_ = entryOf<Module>(module, "rigorAdapter").create();
}

std::unique_ptr<World> LoadedEngine::build(const Scenario& scenario, double dt,
                                           const Settings& settings) const {
    return buildChecked(*engine_->dynamics(), scenario, dt, settings, environment_, environmentChanges_);
}

LoadedEngine loadEngine(const EngineSpec& spec) {
    LoadedEngine engine(moduleFor(spec));
    const auto given = spec.options.find("precision");
    if (given != spec.options.end()) {
        const std::string native = engine->info().precision;
        const auto options = engine->options();
        const bool selectable =
            std::any_of(options.begin(), options.end(), [](const Option& o) { return o.key == "precision"; });
        if (given->second != native && !selectable)
            throw BadInput("engine '" + spec.engine + "', key 'precision': found '" + given->second +
                           "', this build has " + native);
    }
    return engine;
}

}  // namespace rigor::adapter
