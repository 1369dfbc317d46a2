// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/guest.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenarios/model/nearest.hpp"

namespace rigor::adapter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Reads one manifest, key by key.
class ManifestReader {
  public:
    explicit ManifestReader(const fs::path& file) : file_(file) {
        std::ifstream in(file);
        if (!in) refuse("", "no file that can be read", "a manifest");
        json_ = json::parse(in, nullptr, false);
        if (!json_.is_object()) refuse("", "no JSON object", "a manifest");
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& found,
                             const std::string& expected) const {
        throw BadInput(file_.string() + (key.empty() ? "" : ", key '" + key + "'") + ": found " + found +
                       ", expected " + expected);
    }

    std::string text(const char* key, const std::string& absent) {
        const json* value = take(key);
        if (value == nullptr) return absent;
        if (!value->is_string()) refuse(key, value->dump(), "a text");
        return value->get<std::string>();
    }

    std::string choice(const char* key, const std::vector<std::string>& allowed, const std::string& absent) {
        const std::string value = text(key, absent);
        std::string names;
        for (const auto& name : allowed) {
            if (name == value) return value;
            names += (names.empty() ? "" : ", ") + name;
        }
        refuse(key, value.empty() ? "nothing" : "'" + value + "'", "one of " + names);
    }

    std::vector<std::string> texts(const char* key) {
        const json* value = take(key);
        if (value == nullptr) return {};
        if (!value->is_array()) refuse(key, value->dump(), "an array of texts");
        std::vector<std::string> list;
        for (const json& item : *value) {
            if (!item.is_string()) refuse(key, item.dump(), "a text");
            list.push_back(item.get<std::string>());
        }
        return list;
    }

    double seconds(const char* key, double absent) {
        const json* value = take(key);
        if (value == nullptr) return absent;
        if (!value->is_number() || value->get<double>() <= 0.0) refuse(key, value->dump(), "seconds > 0");
        return value->get<double>();
    }

    bool flag(const char* key) {
        const json* value = take(key);
        if (value == nullptr) return false;
        if (!value->is_boolean()) refuse(key, value->dump(), "true or false");
        return value->get<bool>();
    }

    void version(const char* key, int expected) {
        const json* value = take(key);
        if (value == nullptr || !value->is_number_integer() || value->get<int>() != expected)
            refuse(key, value == nullptr ? "nothing" : value->dump(), std::to_string(expected));
    }

    /// To be called last.
    void refuseOthers() const {
        for (const auto& [key, value] : json_.items())
            if (std::find(known_.begin(), known_.end(), key) == known_.end())
                refuse(key, "an unknown key",
                       "a key of the protocol's page" + scenario::didYouMean(key, known_));
    }

  private:
    const json* take(const char* key) {
        known_.emplace_back(key);
        const auto it = json_.find(key);
        return it == json_.end() ? nullptr : &*it;
    }
    fs::path file_;
    json json_;
    std::vector<std::string> known_;
};

bool isOnPath(const std::string& program) {
    const char* variable = std::getenv("PATH");
    std::string rest = variable == nullptr ? "/usr/bin:/bin" : variable;
    while (!rest.empty()) {
        const auto colon = rest.find(':');
        const std::string folder = rest.substr(0, colon);
        if (!folder.empty() && access((folder + "/" + program).c_str(), X_OK) == 0) return true;
        rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
    return false;
}

}  // namespace

std::string GuestManifest::missing() const {
    const std::string& program = command.front();
    const bool found = program.find('/') == std::string::npos ? isOnPath(program)
                                                              : access((folder / program).c_str(), X_OK) == 0;
    if (!found) return "the program '" + program + "'";
    for (const std::string& need : needs)
        if (!fs::exists(folder / need)) return "'" + need + "'";
    return "";
}

GuestManifest readGuestManifest(const fs::path& file) {
    ManifestReader read(file);
    read.version("rigor_guest", 1);
    read.version("protocol", kGuestProtocol);
    GuestManifest m;
    m.file = file;
    m.name = read.text("name", "");
    if (file.filename() != "rigor_adapter_" + m.name + ".json")
        read.refuse("name", "'" + m.name + "'", "the name in rigor_adapter_<name>.json");
    m.title = read.text("title", m.name);
    m.command = read.texts("command");
    if (m.command.empty() || m.command.front().empty()) read.refuse("command", "no program", "its name");
    m.folder = file.parent_path() / read.text("folder", ".");
    m.precision = read.choice("precision", {"f32", "f64"}, "");
    m.licence = read.text("licence", "");
    m.clock = read.choice("clock", {"native", "wasm", "interpreted"}, "native");
    const std::string memory = read.choice("memory", {"address_space", "resident"}, "address_space");
    m.memory = memory == "resident" ? GuestMemory::Resident : GuestMemory::AddressSpace;
    m.startSeconds = read.seconds("start_seconds", m.startSeconds);
    m.replySeconds = read.seconds("reply_seconds", m.replySeconds);
    m.keepAlive = read.flag("keep_alive");
    m.needs = read.texts("needs");
    m.install = read.text("install", "");
    read.refuseOthers();
    return m;
}

}  // namespace rigor::adapter
