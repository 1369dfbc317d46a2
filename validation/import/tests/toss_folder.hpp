// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Made-up recordings in the format of the cube tosses.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "scenarios/model/math.hpp"

namespace rigor::validation::testing {

/// One line of a recording.
struct TossLine {
    scenario::Vec3 p;
    scenario::Quat q;
    scenario::Vec3 v, wBody;
};

inline const char* kTossHeader = "t,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";

inline std::string tossText(const std::vector<TossLine>& lines, double rate = 148) {
    std::string text = kTossHeader;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const TossLine& x = lines[k];
        char line[400];
        std::snprintf(line, sizeof line,
                      "%.9f,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
                      k / rate, x.p.x, x.p.y, x.p.z, x.q.w, x.q.x, x.q.y, x.q.z, x.v.x, x.v.y, x.v.z,
                      x.wBody.x, x.wBody.y, x.wBody.z);
        text += line;
    }
    return text;
}

/// Free flight of a cube with isotropic inertia that ends below the board: closed form.
struct Flight {
    scenario::Vec3 p0{0.1, -0.2, 0.15}, v0{0.8, 0.3, 0.1}, wBody{1.5, -2.0, 0.7};
    scenario::Quat q0 = scenario::normalized({0.9, 0.1, -0.3, 0.2});
    double g = 9.614;
    TossLine at(double t) const {
        const double w = scenario::norm(wBody);
        return {p0 + t * v0 - scenario::Vec3{0, 0, 0.5 * g * t * t},
                q0 * scenario::fromAxisAngle(wBody / w, w * t), v0 - scenario::Vec3{0, 0, g * t}, wBody};
    }
    std::vector<TossLine> lines(std::size_t count, double rate = 148) const {
        std::vector<TossLine> all;
        for (std::size_t k = 0; k < count; ++k) all.push_back(at(k / rate));
        return all;
    }
};

/// A new, empty folder.
inline std::filesystem::path freshFolder(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(RIGOR_BINARY_DIR) / "import-test" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

inline void writeText(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

}  // namespace rigor::validation::testing
