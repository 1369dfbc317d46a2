// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Manifests for tests, in a folder of their own.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "adapters/interface/registry.hpp"

namespace rigor::guest::tests {

namespace fs = std::filesystem;

inline const fs::path kGuestFolder = fs::path(RIGOR_SOURCE_DIR) / "adapters/guest";

/// A folder that goes away with its owner, and the adapter path with it and the guest host.
class GuestFolder {
  public:
    GuestFolder() {
        std::string name = testing::TempDir() + "guests-XXXXXX";
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
        const std::string path = name + ":" + RIGOR_BINARY_DIR + "/bin/adapters";
        setenv("RIGOR_ADAPTER_PATH", path.c_str(), 1);
    }
    ~GuestFolder() {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    GuestFolder(const GuestFolder&) = delete;
    GuestFolder& operator=(const GuestFolder&) = delete;

    /// Writes the manifest of a name; `rest`: what follows its name.
    fs::path add(const std::string& name, const std::string& rest) const {
        const fs::path file = folder_ / ("rigor_adapter_" + name + ".json");
        std::ofstream(file) << R"({"rigor_guest": 1, "protocol": 1, "precision": "f64", "name": ")" << name
                            << "\", " << rest << "}";
        return file;
    }

    /// A guest of faulty_guest.py, with short times.
    fs::path addFaulty(const std::string& fault, const std::string& rest = "") const {
        const std::string script = (kGuestFolder / "tests/faulty_guest.py").string();
        return add("faulty", R"("command": ["python3", ")" + script + "\", \"" +
                                 (kGuestFolder / "sdk").string() + "\", \"" + fault +
                                 R"("], "start_seconds": 10, "reply_seconds": 1)" +
                                 (rest.empty() ? "" : ", " + rest));
    }

    const fs::path& path() const { return folder_; }

  private:
    fs::path folder_;
};

/// A ball over a half-space.
inline scenario::Scenario ballOverGround() {
    scenario::Scenario s;
    s.name = "ball_over_ground";
    s.duration = 1.0;
    s.materials.push_back({"stuff", 0.5, 0.5, 1000.0});
    scenario::Body ground;
    ground.name = "ground";
    ground.type = scenario::BodyType::Static;
    ground.shapes.push_back({scenario::HalfSpace{}, {}, 0});
    scenario::Body ball;
    ball.name = "ball";
    ball.pose.position = {0, 2, 0};
    ball.shapes.push_back({scenario::Sphere{0.5}, {}, 0});
    ball.massProperties = {2.0, {}, scenario::Mat3::diagonal(0.2, 0.2, 0.2)};
    s.bodies = {ground, ball};
    return s;
}

}  // namespace rigor::guest::tests
