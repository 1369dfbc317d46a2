// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
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

/// A file that goes away with this object.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& text) {
        std::string pattern = (std::filesystem::temp_directory_path() / "rigor-mjcf-XXXXXX").string();
        const int descriptor = mkstemp(pattern.data());
        if (descriptor < 0) throw std::runtime_error("no temporary file can be made");
        close(descriptor);
        path_ = pattern;
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TemporaryFile() {
        std::error_code error;
        std::filesystem::remove(path_, error);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

bool allFinite(const mjtNum* values, int count) {
    return std::all_of(values, values + count, [](double v) { return std::abs(v) < 1e15; });
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

Model compile(XmlFile& file, const std::string& shown) {
    const TemporaryFile text(textOnSameLines(*file.root()));
    char message[1000] = "";
    Model model(mj_loadXML(text.path().c_str(), nullptr, message, sizeof message));
    std::string said = message;
    std::replace(said.begin(), said.end(), '\n', ' ');
    int line = 0;
    if (const auto at = said.rfind("line "); at != std::string::npos) {
        line = std::atoi(said.c_str() + at + 5);
        said.erase(said.find_last_not_of(" ,", at - 1) + 1);
    }
    if (!model) throw Refusal({shown, line}, libraryName() + " says: " + said);
    const mjModel& m = *model;
    if (!allFinite(m.qpos0, m.nq) || !allFinite(m.body_pos, 3 * m.nbody) ||
        !allFinite(m.body_mass, m.nbody) || !allFinite(m.body_inertia, 3 * m.nbody) ||
        !allFinite(m.geom_pos, 3 * m.ngeom) || !allFinite(m.geom_size, 3 * m.ngeom) ||
        !allFinite(m.opt.gravity, 3))
        throw Refusal({shown, 0}, "a value is not a number, not finite or beyond 1e15");
    return model;
}

}  // namespace rigor::models::mjcf
