// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The choices of an import, and the answer of a reader. Readers are programs of their own, one per library, so that
// no library's crash or licence reaches the rest: they get the options and give the answer as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "scenarios/exchange/common/report.hpp"

namespace rigor::models {

struct ReadOptions {
    std::filesystem::path file;
    std::string name;                           ///< name of the scenario; "": the file's
    std::set<std::string> without;              ///< features to leave out
    std::vector<std::filesystem::path> assets;  ///< folders for files that the model refers to
    std::string licence;                        ///< "": found beside the model
    double duration = 5.0;                      ///< [s]
    double timeStep = 0.0;                      ///< [s]; 0: the model's, else 1/240
    double friction = 1.0;                      ///< coefficient where the format states none
    double density = 1000.0;                    ///< density of meshes [kg/m^3]
    double scale = 1.0;                         ///< metres per unit of a mesh file
    std::string keyframe;                       ///< MJCF: name or number of the start; "": none
    bool fixedBase = false;                     ///< URDF: the root link does not move
    bool selfCollision = false;  ///< URDF: links of one robot collide unless a joint connects them
    bool hull = false;           ///< moving meshes that are not convex: their convex hull
    int hullCorners = 0;         ///< most corners of a hull, 4 to 64; 0: all, and more than 64 are refused
    bool isStatic = false;       ///< a mesh file is the ground, of triangles
    bool hasFloor = false;       ///< adds a static half-space, up is +z ...
    double floor = 0.0;          ///< ... at this height [m]
};

nlohmann::json toJson(const ReadOptions& options);
ReadOptions optionsFromJson(const nlohmann::json& json);

struct Answer {
    std::string scenario;  ///< text of the scenario; "" where something is refused
    Report report;
};

/// The main function of a reader: options as JSON in argv[1], the file for the answer in argv[2].
int runReader(int argc, char** argv, Answer (*read)(const ReadOptions&));

}  // namespace rigor::models
