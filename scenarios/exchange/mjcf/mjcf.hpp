// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The parts of the MJCF reader: rules of elements, elements that are newer than the library, the library itself, and
// the mapping of its compiled model.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/common/files.hpp"
#include "scenarios/exchange/common/xml_file.hpp"
#include "scenarios/exchange/mjcf/compiled_model.hpp"

namespace rigor::models::mjcf {

std::span<const ElementRule> rules();

/// Rewrites elements that are newer than the library into ones that it reads: frame, replicate, gravcomp, the file
/// paths (absolute, checked), today's default of autolimits.
void lower(XmlFile& file, const AssetFolders& assets, Report& report);

/// Pose of an element from pos and quat, axisangle, euler, xyaxes or zaxis, as <compiler> says.
struct Compiler {
    bool degrees = true;
    std::string eulerSequence = "xyz";
};
Compiler compilerOf(XmlFile& file);
scenario::Pose poseOf(const XmlFile& file, const tinyxml2::XMLElement& element, const Compiler& compiler);

/// Places of the bodies, joints, geoms and so on in the order of the compiled model, and gravcomp of the bodies.
struct Places {
    std::vector<Place> bodies, joints, geoms, equalities, tendons;
    std::vector<double> gravityCompensation;
};
/// Removes gravcomp from the document.
Places collectPlaces(XmlFile& file);

/// The message of a library about a document that it does not compile, at the line that it names.
Refusal refusalOf(const XmlFile& file, const std::string& library, std::string said);

/// Whether libmujoco knows an element, or an attribute of it; from the schema that it prints.
bool libraryKnows(const std::string& element, const std::string& attribute);
std::string libraryName();  ///< "libmujoco 2.2.2"
/// Compiles the document and starts it from a keyframe (-1: from its own pose). Throws Refusal with the library's message.
CompiledModel compile(XmlFile& file, int keyframe);

/// MuJoCo 3, the package @mujoco/mujoco of npm, in a process of its own.
class NewerLibrary {
  public:
    /// The program beside the reader, or an object that is not installed.
    NewerLibrary();
    bool isInstalled() const { return !program_.empty(); }
    /// Command that installs it: another one in a package than in the source tree.
    const std::string& install() const { return install_; }
    /// Whether MuJoCo 3 knows an element or attribute that libmujoco does not, and this reader maps it.
    static bool maps(const std::string& element, const std::string& attribute);
    /// As compile(). Throws Refusal also where the process ends otherwise than with a model.
    CompiledModel compile(XmlFile& file, int keyframe) const;

  private:
    std::filesystem::path program_;
    std::string install_ = "./rigor --with guests";
};

/// A compiled model and the scenario that is being made from it.
struct Conversion {
    const ReadOptions& options;
    Report& report;
    SceneBuilder& builder;
    const CompiledModel& m;
    const Places& places;
    std::vector<int> bodyOf;  ///< scenario's body of a model's body, or kNone

    /// A flag of <option>: constraint switches off all that makes constraints.
    bool isOff(const char* flag) const {
        return m.off.contains(flag) || (m.off.contains("constraint") && isConstraint(flag));
    }
    static bool isConstraint(std::string_view flag) {
        return flag == "equality" || flag == "frictionloss" || flag == "limit" || flag == "contact";
    }
    Place placeOf(const std::vector<Place>& list, int index) const;
    static scenario::Vec3 point(const Array<double>& points, int index, int stride = 3) {
        const double* p = points.from(stride * index);
        return {p[0], p[1], p[2]};
    }
    static scenario::Quat turn(const Array<double>& turns, int index) {
        const double* q = turns.from(4 * index);
        return {q[0], q[1], q[2], q[3]};
    }
    /// A body of the scenario for joints: the world where it does not move.
    int endOf(int body) const;
    static std::string nameOf(const Array<std::string>& names, int index, const std::string& otherwise);
};

void addBodies(Conversion& c);
void addGeoms(Conversion& c);
void addJoints(Conversion& c);
void addConstraints(Conversion& c);  ///< equalities and tendons
void addContactRules(Conversion& c);

}  // namespace rigor::models::mjcf
