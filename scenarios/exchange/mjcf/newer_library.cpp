// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// MuJoCo 3 of npm compiles what libmujoco does not know: a program of the guest mujoco3 (compile.mjs) gets the document, the
// files that it names and the names of the arrays, and writes them as JSON.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Word {
    const char *element, *attribute;
};
constexpr Word kMapped[] = {{"mesh", "inertia"},     {"mesh", "builtin"},     {"mesh", "params"},
                            {"mesh", "maxhullvert"}, {"hfield", "elevation"}, {"connect", "site1"},
                            {"connect", "site2"},    {"weld", "site1"},       {"weld", "site2"}};

/// The manifest of the guest beside the modules; null where there is none.
json guestManifest(const fs::path& file) {
    std::ifstream in(file);
    const json read = in ? json::parse(in, nullptr, false) : json();
    return read.is_object() && read.contains("folder") ? read : json();
}

json requestOf(XmlFile& file, int keyframe) {
    json request{{"document", textOnSameLines(*file.root())},
                 {"keyframe", keyframe},
                 {"files", json::array()},
                 {"sizes", json::array()},
                 {"arrays", json::array()}};
    for (auto* asset = file.root()->FirstChildElement("asset"); asset;
         asset = asset->NextSiblingElement("asset"))
        for (auto* e = asset->FirstChildElement(); e; e = e->NextSiblingElement())
            if (const char* name = e->Attribute("file")) request["files"].push_back(name);
#define SIZE(name) request["sizes"].push_back(#name);
#define MODEL_FIELD(type, name, count, width) request["arrays"].push_back(#name);
#define NEWER_FIELD(type, name, count, width) request["arrays"].push_back(#name);
#define START_FIELD(type, name, count, width) request["arrays"].push_back(#name);
#include "scenarios/exchange/mjcf/compiled_fields.def"
    return request;
}

/// Runs Node.js, which ends with this process. WebAssembly takes more addresses than a reader may, and does not use them.
int runNode(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t self = getpid(), child = fork();
    if (child < 0) throw std::runtime_error("no process can be started");
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != self) _exit(127);
        struct rlimit limit {};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_AS, &limit);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Numbers that are not finite are null in JSON.
void read(const json& from, Array<double>& to) {
    for (const json& value : from) to.values.push_back(value.is_null() ? HUGE_VAL : value.get<double>());
}
template <class T>
void read(const json& from, Array<T>& to) {
    to.values = from.get<std::vector<T>>();
}

CompiledModel modelOf(const json& answer) {
    CompiledModel m;
    m.library = answer.at("library").get<std::string>();
    const json &sizes = answer.at("sizes"), &arrays = answer.at("arrays");
#define SIZE(name) m.name = sizes.at(#name).get<int>();
#define MODEL_FIELD(type, name, count, width) read(arrays.at(#name), m.name);
#define NEWER_FIELD(type, name, count, width) read(arrays.at(#name), m.name);
#define START_FIELD(type, name, count, width) read(arrays.at(#name), m.name);
#include "scenarios/exchange/mjcf/compiled_fields.def"
    read(answer.at("body_velocity"), m.body_velocity);
    read(answer.at("eq_violation"), m.eq_violation);
    read(answer.at("names").at("body"), m.body_names);
    read(answer.at("names").at("joint"), m.joint_names);
    read(answer.at("names").at("equality"), m.equality_names);
    read(answer.at("names").at("tendon"), m.tendon_names);
    m.timestep = answer.at("timestep").get<double>();
    read(answer.at("gravity"), m.gravity);
    m.off = answer.at("off").get<std::set<std::string>>();
    m.requireSizes();
    return m;
}

}  // namespace

NewerLibrary::NewerLibrary() {
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    const fs::path file = self.parent_path() / "../adapters/rigor_adapter_mujoco3.json";
    const json manifest = guestManifest(file);
    if (manifest.is_null()) return;
    install_ = manifest.value("install", install_);
    const fs::path folder = file.parent_path() / manifest["folder"].get<std::string>();
    for (const json& needed : manifest.value("needs", json::array()))
        if (!fs::exists(folder / needed.get<std::string>(), error)) return;
    program_ = folder / "compile.mjs";
}

bool NewerLibrary::maps(const std::string& element, const std::string& attribute) {
    return std::any_of(std::begin(kMapped), std::end(kMapped),
                       [&](const Word& w) { return element == w.element && attribute == w.attribute; });
}

CompiledModel NewerLibrary::compile(XmlFile& file, int keyframe) const {
    const TemporaryFile request("rigor-mjcf", requestOf(file, keyframe).dump()), answer("rigor-mjcf", "");
    const int status = runNode({"node", program_.string(), request.path(), answer.path()});
    std::ifstream in(answer.path(), std::ios::binary);
    const json read = json::parse(in, nullptr, false);
    if (status != 0 || !read.is_object())
        throw Refusal({file.shownName(), 0}, WIFEXITED(status) && WEXITSTATUS(status) == 127
                                                 ? "MuJoCo 3 of npm cannot be run: there is no node"
                                                 : "MuJoCo 3 of npm ended without a model");
    if (read.contains("error"))
        throw refusalOf(file, read.at("library").get<std::string>(), read.at("error").get<std::string>());
    return modelOf(read);
}

}  // namespace rigor::models::mjcf
