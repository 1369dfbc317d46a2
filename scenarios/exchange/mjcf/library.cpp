// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

/// Elements of the schema with their attributes, as printed: "geom (*)  name class type ...", the attributes of one
/// element over several lines.
std::map<std::string, std::set<std::string>> readSchema() {
    std::string text(1u << 18, '\0');
    mj_printSchema(nullptr, text.data(), static_cast<int>(text.size()), 0, 0);
    text.resize(std::strlen(text.c_str()));
    std::map<std::string, std::set<std::string>> schema;
    std::istringstream lines(text);
    std::vector<std::string> current;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> tokens;
        for (std::string word; words >> word;) tokens.push_back(word);
        std::size_t first = 0;
        if (tokens.size() > 1 && tokens[1].size() == 3 && tokens[1].front() == '(') {
            current = {tokens[0]};
            if (tokens[0] == "(world)body") current = {"body", "worldbody"};
            first = 2;
        }
        for (const std::string& element : current) {
            schema[element].insert("");
            schema[element].insert(tokens.begin() + static_cast<std::ptrdiff_t>(first), tokens.end());
        }
    }
    return schema;
}

struct Deleter {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};
using Model = std::unique_ptr<mjModel, Deleter>;
using Data = std::unique_ptr<mjData, Deleter>;

/// The library's errors end the process: the caller reads the message.
void onError(const char* message) {
    std::fprintf(stderr, "libmujoco: %s\n", message);
    std::fflush(stderr);
    _exit(4);
}
void onWarning(const char* message) {
    std::fprintf(stderr, "libmujoco: %s\n", message);
}

Model load(XmlFile& file) {
    mju_user_error = onError;
    mju_user_warning = onWarning;
    const TemporaryFile text("rigor-mjcf", textOnSameLines(*file.root()));
    char message[1000] = "";
    Model model(mj_loadXML(text.path().c_str(), nullptr, message, sizeof message));
    if (!model) throw refusalOf(file, libraryName(), message);
    return model;
}

/// The start: the model's own pose at rest, or a keyframe, without contacts.
void setStart(mjModel& m, mjData& d, int keyframe) {
    mj_resetData(&m, &d);
    if (keyframe >= 0) mj_resetDataKeyframe(&m, &d, keyframe);
    const int flags = m.opt.disableflags;
    m.opt.disableflags |= mjDSBL_CONTACT;
    mj_forward(&m, &d);
    m.opt.disableflags = flags;
}

std::set<std::string> flagsOff(const mjModel& m) {
    const std::pair<mjtDisableBit, const char*> flags[] = {
        {mjDSBL_CONSTRAINT, "constraint"},     {mjDSBL_EQUALITY, "equality"},
        {mjDSBL_FRICTIONLOSS, "frictionloss"}, {mjDSBL_LIMIT, "limit"},
        {mjDSBL_CONTACT, "contact"},           {mjDSBL_PASSIVE, "passive"},
        {mjDSBL_GRAVITY, "gravity"},           {mjDSBL_FILTERPARENT, "filterparent"}};
    std::set<std::string> off;
    for (const auto& [bit, name] : flags)
        if ((m.opt.disableflags & bit) != 0) off.insert(name);
    return off;
}

Array<std::string> namesOf(const mjModel& m, mjtObj kind, int count) {
    Array<std::string> names;
    for (int i = 0; i < count; ++i) {
        const char* name = mj_id2name(&m, kind, i);
        names.values.emplace_back(name ? name : "");
    }
    return names;
}

CompiledModel gather(const mjModel& m, const mjData& d) {
    CompiledModel out;
    out.library = libraryName();
#define SIZE(name) out.name = m.name;
#define MODEL_FIELD(type, name, count, width) out.name.values.assign(m.name, m.name + m.count * (width));
#define START_FIELD(type, name, count, width) out.name.values.assign(d.name, d.name + m.count * (width));
#include "scenarios/exchange/mjcf/compiled_fields.def"
    for (int body = 0; body < m.nbody; ++body) {
        mjtNum velocity[6];
        mj_objectVelocity(&m, &d, mjOBJ_BODY, body, velocity, 0);
        out.body_velocity.values.insert(out.body_velocity.values.end(), velocity, velocity + 6);
    }
    out.eq_violation.values.assign(static_cast<std::size_t>(m.neq), 0.0);
    for (int row = 0; row < d.nefc; ++row) {
        if (d.efc_type[row] != mjCNSTR_EQUALITY) continue;
        double& most = out.eq_violation.values[static_cast<std::size_t>(d.efc_id[row])];
        most = std::max(most, std::abs(d.efc_pos[row]));
    }
    out.body_names = namesOf(m, mjOBJ_BODY, m.nbody);
    out.joint_names = namesOf(m, mjOBJ_JOINT, m.njnt);
    out.equality_names = namesOf(m, mjOBJ_EQUALITY, m.neq);
    out.tendon_names = namesOf(m, mjOBJ_TENDON, m.ntendon);
    out.timestep = m.opt.timestep;
    out.gravity.values.assign(m.opt.gravity, m.opt.gravity + 3);
    out.onlyPairs = m.opt.collision == mjCOL_PAIR;
    out.onlyDynamic = m.opt.collision == mjCOL_DYNAMIC;
    out.off = flagsOff(m);
    return out;
}

}  // namespace

bool libraryKnows(const std::string& element, const std::string& attribute) {
    static const auto schema = readSchema();
    const auto found = schema.find(element);
    return found != schema.end() && found->second.contains(attribute);
}

std::string libraryName() {
    const std::string digits = std::to_string(mj_version());
    std::string dotted;
    for (const char c : digits) dotted += (dotted.empty() ? "" : ".") + std::string(1, c);
    return "libmujoco " + dotted;
}

Refusal refusalOf(const XmlFile& file, const std::string& library, std::string said) {
    std::replace(said.begin(), said.end(), '\n', ' ');
    said.erase(said.find_last_not_of(' ') + 1);
    int line = 0;
    if (const auto at = said.rfind("line "); at != std::string::npos) {
        line = std::atoi(said.c_str() + at + 5);
        said.erase(said.find_last_not_of(" ,", at - 1) + 1);
    }
    return Refusal({file.shownName(), line}, library + " says: " + said);
}

CompiledModel compile(XmlFile& file, int keyframe) {
    const Model model = load(file);
    const Data data(mj_makeData(model.get()));
    setStart(*model, *data, keyframe);
    return gather(*model, *data);
}

}  // namespace rigor::models::mjcf
