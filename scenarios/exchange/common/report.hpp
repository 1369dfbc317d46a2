// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The report of an import or export: what was changed, what has no physics, what was left out, and what the
// scenario model can not hold, each with its place in the file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace rigor::models {

/// A place in a file; line 0: unknown.
struct Place {
    std::string file;
    int line = 0;
    std::string text() const;  ///< "car.xml:12"
};

enum class RemarkKind {
    Changed,    ///< the scenario says it in another way
    NoPhysics,  ///< pictures, sensors, settings of a solver
    LeftOut,    ///< left out because `--without` names its feature
    Refused,    ///< the scenario model has no counterpart
};

struct Remark {
    RemarkKind kind;
    std::string element;  ///< "joint armature"
    std::string text;     ///< one sentence
    std::string feature;  ///< word for `--without`; "" where nothing can be left out
    Place place;          ///< the first place
    int count = 1;
};

/// Ends a reading at once: the file can not be read on.
class Refusal : public std::runtime_error {
  public:
    Refusal(const Place& place, const std::string& text) : std::runtime_error(text), place_(place) {}
    const Place& place() const { return place_; }

  private:
    Place place_;
};

class Report {
  public:
    explicit Report(std::set<std::string> without = {}) : without_(std::move(without)) {}

    void changed(const std::string& element, const Place& place, const std::string& text);
    void noPhysics(const std::string& element, const Place& place, const std::string& text);
    void refuse(const std::string& element, const Place& place, const std::string& text);
    /// True if the caller must leave the feature out, because `--without` names it; else it is refused.
    bool leavesOut(const std::string& feature, const std::string& element, const Place& place,
                   const std::string& text);

    bool isRefused() const;
    const std::vector<Remark>& remarks() const { return remarks_; }
    const std::set<std::string>& without() const { return without_; }
    /// Words of `--without` that met nothing in the file.
    std::vector<std::string> unusedWords() const;
    nlohmann::json json() const;
    static Report fromJson(const nlohmann::json& json);
    /// Lines for people: refusals as errors, then what was changed and left out.
    std::string text() const;

  private:
    void add(Remark remark);
    std::vector<Remark> remarks_;
    std::set<std::string> without_, used_;
};

}  // namespace rigor::models
