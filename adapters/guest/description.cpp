// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/description.hpp"

#include <set>

#include "adapters/interface/capability_fields.hpp"

namespace rigor::guest {
namespace {

[[noreturn]] void refuse(const std::string& what, const Json& found, const std::string& expected) {
    throw BadFrame(what + ": found " + found.dump() + ", expected " + expected);
}

const Json& member(const Json& object, const std::string& where, const char* key) {
    if (!object.is_object()) refuse(where, object, "an object");
    const auto it = object.find(key);
    if (it == object.end()) throw BadFrame(where + ": the key '" + key + "' is missing");
    return *it;
}

std::string textOf(const Json& object, const std::string& where, const char* key) {
    const Json& value = member(object, where, key);
    if (!value.is_string()) refuse(where + "." + key, value, "a text");
    return value.get<std::string>();
}

std::string optionalText(const Json& object, const std::string& where, const char* key) {
    return object.contains(key) ? textOf(object, where, key) : "";
}

/// Capabilities that are not named are absent; a name that is none is refused.
adapter::Capabilities capabilitiesOf(const Json& json) {
    if (!json.is_object()) refuse("capabilities", json, "an object");
    adapter::Capabilities capabilities;
    std::set<std::string> known;
    adapter::forEachCapability(capabilities, [&](const char* name, auto& field) {
        known.insert(name);
        const auto it = json.find(name);
        if (it == json.end()) return;
        try {
            it->get_to(field);
        } catch (const Json::exception&) {
            refuse(std::string("capabilities.") + name, *it, "a value of the page's type");
        }
    });
    for (const auto& [key, value] : json.items())
        if (!known.contains(key)) refuse("capabilities." + key, value, "a key of the protocol's page");
    for (const char* name : {"broad_phase", "contact_solvers"})
        if (json.value(name, false))
            refuse(std::string("capabilities.") + name, true, "false: guests have none");
    return capabilities;
}

adapter::Option optionOf(const Json& json) {
    const std::string where = "options";
    adapter::Option option;
    option.key = textOf(json, where, "key");
    option.defaultValue = textOf(json, where, "default");
    option.matchedValue = textOf(json, where, "matched");
    option.help = textOf(json, where, "help");
    if (json.contains("values")) {
        option.values = json["values"].get<std::vector<std::string>>();
        return option;
    }
    option.min = member(json, where, "min").get<double>();
    option.max = member(json, where, "max").get<double>();
    option.integer = json.value("integer", false);
    return option;
}

std::string clockLabel(const adapter::GuestManifest& manifest) {
    return manifest.clock == "native" ? "guest" : "guest, " + manifest.clock;
}

Description describe(const Json& answer, const adapter::GuestManifest& manifest) {
    const Json& protocol = member(answer, "answer", "protocol");
    if (protocol != adapter::kGuestProtocol)
        throw BadFrame("it speaks version " + protocol.dump() + " of the protocol, this program version " +
                       std::to_string(adapter::kGuestProtocol));
    const Json& engine = member(answer, "answer", "engine");
    Description d;
    d.info.name = textOf(engine, "engine", "name");
    d.info.version = textOf(engine, "engine", "version");
    d.info.precision = textOf(engine, "engine", "precision");
    d.info.title = textOf(engine, "engine", "title");
    d.info.buildNotes = optionalText(engine, "engine", "build_notes");
    d.info.package = optionalText(engine, "engine", "package");
    d.info.clock = clockLabel(manifest);
    if (d.info.name != manifest.name)
        refuse("engine.name", d.info.name, "'" + manifest.name + "' as in its manifest");
    if (d.info.precision != manifest.precision)
        refuse("engine.precision", d.info.precision, "'" + manifest.precision + "' as in its manifest");
    d.capabilities = capabilitiesOf(member(answer, "answer", "capabilities"));
    for (const Json& option : answer.value("options", Json::array())) d.options.push_back(optionOf(option));
    for (const Json& preset : answer.value("presets", Json::array()))
        d.presets.push_back({textOf(preset, "presets", "name"),
                             member(preset, "presets", "values").get<std::map<std::string, std::string>>()});
    return d;
}

}  // namespace

Description sayHello(Connection& connection) {
    Frame hello;
    hello.header["protocol"] = adapter::kGuestProtocol;
    const Frame answer = connection.call("hello", std::move(hello));
    return connection.take("hello", [&] { return describe(answer.header, connection.manifest()); });
}

}  // namespace rigor::guest
