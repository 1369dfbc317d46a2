// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// References against the histories of textbook multibody benchmarks that the folder mbs-benchmarks of
// RIGOR_DATA holds (computed without any of this code). Skipped where it is not set.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "scenarios/loader/loader.hpp"
#include "validation/references/tests/newton_euler.hpp"

namespace rigor::validation::testing {
namespace {

/// Columns of a CSV file by name.
using Table = std::map<std::string, std::vector<double>>;

std::filesystem::path dataFile(const char* name) {
    const char* data = std::getenv("RIGOR_DATA");
    return data ? std::filesystem::path(data) / "mbs-benchmarks" / name : std::filesystem::path();
}

Table readTable(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(in, line);
    for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
    Table table;
    while (std::getline(in, line)) {
        std::istringstream row(line);
        for (std::size_t k = 0; std::getline(row, cell, ','); ++k)
            table[names.at(k)].push_back(std::stod(cell));
    }
    return table;
}

class BenchmarkData : public ::testing::Test {
  protected:
    /// The table; empty where there is none and the test is skipped.
    Table table(const char* name) {
        const auto path = dataFile(name);
        if (path.empty())
            skip_ = "RIGOR_DATA is not set";
        else if (!std::filesystem::exists(path))
            skip_ = "no such file: mbs-benchmarks/" + std::string(name);
        return skip_.empty() ? readTable(path) : Table{};
    }
    std::string skip_;
};

Scenario scene(const char* name, double duration) {
    Scenario s = loadScenario(findScenario(name)).scenario;
    s.duration = duration;
    return s;
}

/// Problem A05 of the IFToMM library: rods with heavy tips on a free shaft, springs and dampers to a slider.
/// It is not a scenario: its dampers (4e4 N s/m on 3 kg) need steps of 1e-5 s with an explicit spring.
Scenario governor(double duration) {
    Scenario s = emptyScene(3, {0, 0, -9.81}, duration);
    const double rod = 3000 * 1e-4, heavy = 3000 * 1e-3, tip = 5, w = 2 * std::numbers::pi;
    const double thin = rod * 2e-4 / 12, slender = rod * (1 + 1e-4) / 12;
    const auto add = [&](const char* name, double mass, Vec3 at, Mat3 inertia) {
        addBody(s, name, BodyType::Dynamic, Sphere{0.01}, at);
        Body& b = s.bodies.back();
        b.massProperties = {mass, {}, inertia};
        b.angularVelocity = {0, 0, w};
        b.velocity = cross(b.angularVelocity, at);
        b.collides = false;
    };
    add("shaft", rod, {0, 0, 0.5}, Mat3::diagonal(slender, slender, thin));
    add("slider", heavy, {0, 0, 0.5},
        Mat3::diagonal(heavy * 0.02 / 12, heavy * 0.02 / 12, heavy * 0.02 / 12));
    addJoint(s, JointType::Hinge, kNone, 0, {}, {0, 0, 1});
    addJoint(s, JointType::Slider, 0, 1, {0, 0, 0.5}, {0, 0, 1});
    for (const double side : {1.0, -1.0}) {
        const double total = rod + tip, c = (0.5 * rod + tip) / total;
        const double across = slender + rod * (c - 0.5) * (c - 0.5) + tip * (1 - c) * (1 - c);
        const Vec3 hinge{0.05 * side, 0, 1}, along{side * std::sqrt(0.75), 0, -0.5};
        add(side > 0 ? "right" : "left", total, hinge + c * along, Mat3::diagonal(across, across, thin));
        Body& b = s.bodies.back();
        b.pose.orientation = fromAxisAngle({0, 1, 0}, std::atan2(along.x, along.z));
        const int index = static_cast<int>(s.bodies.size()) - 1;
        addJoint(s, JointType::Hinge, 0, index, hinge, {0, 1, 0});
        s.forces.push_back(SpringForce{1, index, {0.05 * side, 0, 0}, {0, 0, 0.5 - c}, 8e5, 4e4, 0.5});
    }
    setReference(s, "mechanism");
    return s;
}

#define RIGOR_TABLE(name)           \
    const Table data = table(name); \
    if (!skip_.empty()) GTEST_SKIP() << skip_

TEST_F(BenchmarkData, A01Pendulum) {
    RIGOR_TABLE("A01_pendulum_10s.csv");
    const Scenario s = scene("point_pendulum", 10);
    const auto r = makeReference(s);
    for (std::size_t k = 0; k < data.at("t").size(); k += 7) {
        const auto e = r->exact(0, data.at("t")[k]);
        EXPECT_NEAR(e.position->x, data.at("x")[k], 1e-10);
        EXPECT_NEAR(e.position->y, data.at("y")[k], 1e-10);
        EXPECT_NEAR(norm(*e.velocity), std::abs(data.at("omega")[k]), 1e-9);
    }
}

TEST_F(BenchmarkData, A02TwoWindows) {
    RIGOR_TABLE("A02_fourbar_N2.csv");
    const Scenario s = scene("parallel_windows_2d", 10);
    const auto r = makeReference(s);
    const int bar = findBody(s, "bar_0");
    for (std::size_t k = 0; k < data.at("t").size(); ++k) {
        const double t = data.at("t")[k];
        const Vec3 left = pointAt(*r, bar, t, {-0.5, 0, 0}), v = *r->exact(bar, t).velocity;
        EXPECT_NEAR(left.x, data.at("B0x")[k], 1e-9);
        EXPECT_NEAR(left.y, data.at("B0y")[k], 1e-9);
        EXPECT_NEAR(v.x, data.at("B0vx")[k], 1e-8);
        EXPECT_NEAR(v.y, data.at("B0vy")[k], 1e-8);
    }
}

TEST_F(BenchmarkData, A03Andrews) {
    RIGOR_TABLE("A03_andrews.csv");
    const Scenario s = scene("andrews_squeezer_2d", 0.015);
    const auto r = makeReference(s);
    for (std::size_t k = 0; data.at("t")[k] < 0.0151; k += 5) {
        const double t = data.at("t")[k];
        EXPECT_NEAR(r->exact(0, t).angularVelocity->z, data.at("dbeta")[k], 1e-3) << t;
        EXPECT_NEAR(angleAboutZ(*r->exact(4, t).orientation), data.at("delta")[k] - data.at("delta")[0],
                    1e-6);
        EXPECT_NEAR(angleAboutZ(*r->exact(6, t).orientation), data.at("epsilon")[k] - data.at("epsilon")[0],
                    1e-6);
    }
}

TEST_F(BenchmarkData, A04Bricard) {
    RIGOR_TABLE("A04_bricard_P3.csv");
    const Scenario s = scene("bricard_loop", 2);
    const auto r = makeReference(s);
    const int bar = findBody(s, "bar_2");
    for (std::size_t k = 0; data.at("t")[k] < 2.0; k += 2) {
        const double t = data.at("t")[k];
        const Vec3 tip = pointAt(*r, bar, t, {0, -0.5, 0});
        EXPECT_LT(norm(tip - Vec3{data.at("P3x")[k], data.at("P3y")[k], data.at("P3z")[k]}), 1e-7) << t;
    }
}

TEST_F(BenchmarkData, A05Governor) {
    RIGOR_TABLE("A05_governor.csv");
    const Scenario s = governor(0.02);
    const auto r = makeReference(s);
    const int slider = findBody(s, "slider"), shaft = findBody(s, "shaft");
    for (std::size_t k = 0; data.at("t")[k] < 0.0201; ++k) {
        const double t = data.at("t")[k];
        EXPECT_NEAR(r->exact(slider, t).position->z, data.at("s")[k], 1e-6) << t;
        EXPECT_NEAR(r->exact(shaft, t).angularVelocity->z, data.at("omega")[k], 1e-5) << t;
    }
}

TEST_F(BenchmarkData, HeavyTop) {
    RIGOR_TABLE("heavy_top.csv");
    const Scenario s = scene("heavy_top_fast", 1);
    const auto r = makeReference(s);
    for (std::size_t k = 0; data.at("t")[k] < 1.0; ++k) {
        const double t = data.at("t")[k];
        const auto e = r->exact(0, t);
        const Vec3 com{data.at("com_x")[k], data.at("com_y")[k], data.at("com_z")[k]};
        EXPECT_LT(norm(*e.position - com), 1e-8) << t;
        const Quat q{data.at("q0")[k], data.at("q1")[k], data.at("q2")[k], data.at("q3")[k]};
        for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 0, 1}})
            EXPECT_LT(norm(rotate(*e.orientation, axis) - rotate(q, axis)), 1e-6) << t;
    }
}

}  // namespace
}  // namespace rigor::validation::testing
