// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The parts of the MJCF reader: rules of elements, elements that are newer than the library, the library itself, and
// the mapping of its compiled model.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scenarios/exchange/common/builder.hpp"
#include "scenarios/exchange/common/files.hpp"
#include "scenarios/exchange/common/xml_file.hpp"

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

struct Deleter {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};
using Model = std::unique_ptr<mjModel, Deleter>;
using Data = std::unique_ptr<mjData, Deleter>;

/// Whether the library knows an element, or an attribute of it; from the schema that it prints.
bool libraryKnows(const std::string& element, const std::string& attribute);
std::string libraryName();
/// Compiles the document. Throws Refusal with the library's message.
Model compile(XmlFile& file, const std::string& nameInMessages);

/// A compiled model and the scenario that is being made from it.
struct Conversion {
    const ReadOptions& options;
    Report& report;
    SceneBuilder& builder;
    const mjModel& m;
    const mjData& d;
    const Places& places;
    std::vector<int> bodyOf;  ///< scenario's body of a model's body, or kNone

    bool isOff(mjtDisableBit bit) const {
        return (m.opt.disableflags & (bit | mjDSBL_CONSTRAINT * isConstraint(bit))) != 0;
    }
    static bool isConstraint(mjtDisableBit bit) {
        return bit == mjDSBL_EQUALITY || bit == mjDSBL_FRICTIONLOSS || bit == mjDSBL_LIMIT ||
               bit == mjDSBL_CONTACT;
    }
    Place placeOf(const std::vector<Place>& list, int index) const;
    scenario::Vec3 point(const mjtNum* p, int index) const {
        return {p[3 * index], p[3 * index + 1], p[3 * index + 2]};
    }
    scenario::Quat turn(const mjtNum* q, int index) const {
        return {q[4 * index], q[4 * index + 1], q[4 * index + 2], q[4 * index + 3]};
    }
    std::string nameOf(mjtObj kind, int index, const std::string& otherwise) const;
};

void addBodies(Conversion& c);
void addGeoms(Conversion& c);
void addJoints(Conversion& c);
void addConstraints(Conversion& c);  ///< equalities and tendons
void addContactRules(Conversion& c);

}  // namespace rigor::models::mjcf
