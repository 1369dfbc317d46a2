// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/tests/tool.hpp"

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace rigor::models::testing {
namespace fs = std::filesystem;
using scenario::Body;
using scenario::Joint;
using scenario::kNone;
using scenario::Mat3;
using scenario::Pose;
using scenario::Scenario;
using scenario::Vec3;

Mat3 inertiaInWorld(const Body& b) {
    const Mat3 r = toMatrix(b.pose.orientation);
    return r * b.massProperties.inertia * transpose(r);
}

namespace {

std::string readText(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
std::string quoted(const fs::path& file) {
    return "'" + file.string() + "'";
}
Pose poseOf(const Scenario& s, int body) {
    return body == kNone ? Pose{} : s.bodies[static_cast<std::size_t>(body)].pose;
}
std::string nameOf(const Scenario& s, int body) {
    return body == kNone ? "world" : s.bodies[static_cast<std::size_t>(body)].name;
}

void expectSameBody(const Body& a, const Body& b, double tolerance) {
    const std::string what = "body " + a.name;
    EXPECT_EQ(a.type, b.type) << what;
    EXPECT_EQ(a.shapes.size(), b.shapes.size()) << what;
    EXPECT_NEAR(a.massProperties.mass, b.massProperties.mass, tolerance) << what;
    EXPECT_DOUBLE_EQ(a.gravityScale, b.gravityScale) << what;
    if (a.type == scenario::BodyType::Dynamic) {
        expectNear(a.pose * a.massProperties.centerOfMass, b.pose * b.massProperties.centerOfMass, tolerance,
                   what + ", centre");
        expectNear(inertiaInWorld(a), inertiaInWorld(b), tolerance, what + ", inertia");
        expectNear(a.velocity, b.velocity, tolerance, what + ", velocity");
        expectNear(a.angularVelocity, b.angularVelocity, tolerance, what + ", angular velocity");
    }
    for (std::size_t k = 0; k < std::min(a.shapes.size(), b.shapes.size()); ++k) {
        EXPECT_EQ(a.shapes[k].geometry.index(), b.shapes[k].geometry.index()) << what;
        if (std::holds_alternative<scenario::HalfSpace>(a.shapes[k].geometry)) continue;
        if (std::holds_alternative<scenario::ConvexHull>(a.shapes[k].geometry)) continue;
        const Pose p = a.pose * a.shapes[k].pose, q = b.pose * b.shapes[k].pose;
        expectNear(p.position, q.position, tolerance, what + ", shape");
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
            expectNear(rotate(p.orientation, axis), rotate(q.orientation, axis), tolerance,
                       what + ", shape's axis");
    }
}

void expectSameJoint(const Scenario& s, const Joint& a, const Scenario& t, const Joint& b, double tolerance) {
    const std::string what = "joint " + a.name;
    EXPECT_EQ(a.type, b.type) << what;
    EXPECT_EQ(nameOf(s, a.bodyA), nameOf(t, b.bodyA)) << what;
    EXPECT_EQ(nameOf(s, a.bodyB), nameOf(t, b.bodyB)) << what;
    EXPECT_EQ(a.collideConnected, b.collideConnected) << what;
    if (a.type != scenario::JointType::Fixed)
        expectNear(poseOf(s, a.bodyB) * a.anchorB, poseOf(t, b.bodyB) * b.anchorB, tolerance,
                   what + ", anchor");
    const bool hasAxis = a.type == scenario::JointType::Hinge || a.type == scenario::JointType::Slider;
    if (hasAxis)
        expectNear(rotate(poseOf(s, a.bodyB).orientation, a.axisB),
                   rotate(poseOf(t, b.bodyB).orientation, b.axisB), tolerance, what + ", axis");
    EXPECT_NEAR(a.length, b.length, tolerance) << what;
    for (std::size_t k = 0; k < a.axes.size(); ++k) {
        EXPECT_EQ(a.axes[k].mode, b.axes[k].mode) << what;
        const auto end = [](double value) { return std::abs(value) < 1e6 ? value : 1e6; };
        EXPECT_NEAR(end(a.axes[k].lower), end(b.axes[k].lower), tolerance) << what;
        EXPECT_NEAR(end(a.axes[k].upper), end(b.axes[k].upper), tolerance) << what;
        EXPECT_NEAR(a.axes[k].stiffness, b.axes[k].stiffness, tolerance) << what;
        EXPECT_NEAR(a.axes[k].damping, b.axes[k].damping, tolerance) << what;
        EXPECT_NEAR(a.axes[k].motorMaxForce, b.axes[k].motorMaxForce, tolerance) << what;
        EXPECT_NEAR(a.axes[k].target, b.axes[k].target, tolerance) << what;
    }
}

}  // namespace

Outcome rigor(const std::string& arguments) {
    const fs::path errors = fs::path(::testing::TempDir()) / "stderr.txt";
    const std::string command =
        std::string(RIGOR_BINARY_DIR) + "/bin/rigor " + arguments + " 2>" + quoted(errors);
    FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) outcome.out.append(buffer, n);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.err = readText(errors);
    return outcome;
}

fs::path freshFolder(const std::string& name) {
    const fs::path folder = fs::path(::testing::TempDir()) / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

fs::path writeText(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

Scenario imported(const std::string& format, const fs::path& file, const std::string& options) {
    const Outcome outcome = rigor("import " + format + " " + quoted(file) + " " + options);
    EXPECT_EQ(outcome.code, 0) << file << ": " << outcome.err;
    if (outcome.code != 0) return {};
    return scenario::loadScenarioText(outcome.out, file.string()).scenario;
}

std::string refusal(const std::string& format, const fs::path& file, const std::string& options) {
    const Outcome outcome = rigor("import " + format + " " + quoted(file) + " " + options);
    EXPECT_EQ(outcome.code, 2) << file << ": " << outcome.err;
    EXPECT_EQ(outcome.out, "") << file;
    return outcome.err;
}

std::vector<double> lastState(const fs::path& scenario) {
    const std::string out = rigor("run " + quoted(scenario) + " -e rigor --csv -").out;
    std::string line = out.substr(out.rfind("\n10,") + 1);
    line.resize(line.find('\n'));
    std::vector<double> values;
    std::istringstream in(line);
    int column = 0;
    for (std::string cell; std::getline(in, cell, ','); ++column)
        if (column != 1) values.push_back(std::stod(cell));
    return values;
}

fs::path modelsFolder() {
    const char* data = std::getenv("RIGOR_DATA");
    return data && fs::exists(fs::path(data) / "models") ? fs::path(data) / "models" : fs::path();
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance, const std::string& what) {
    const double scale = 1.0 + norm(b);
    EXPECT_LE(norm(a - b), tolerance * scale)
        << what << ": " << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

void expectNear(const Mat3& a, const Mat3& b, double tolerance, const std::string& what) {
    const double scale = std::abs(b(0, 0)) + std::abs(b(1, 1)) + std::abs(b(2, 2));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(a(i, j), b(i, j), tolerance * scale) << what << " " << i << j;
}

void expectSameMeaning(const Scenario& a, const Scenario& b, double tolerance) {
    expectNear(a.gravity, b.gravity, tolerance, "gravity");
    EXPECT_EQ(a.bodies.size(), b.bodies.size());
    EXPECT_EQ(a.joints.size(), b.joints.size());
    for (const Body& body : a.bodies) {
        const int other = findBody(b, body.name);
        ASSERT_NE(other, kNone) << body.name;
        expectSameBody(body, b.bodies[static_cast<std::size_t>(other)], tolerance);
    }
    for (const Joint& joint : a.joints) {
        const auto other = std::find_if(b.joints.begin(), b.joints.end(),
                                        [&](const Joint& j) { return j.name == joint.name; });
        ASSERT_NE(other, b.joints.end()) << joint.name;
        expectSameJoint(a, joint, b, *other, tolerance);
    }
    for (std::size_t i = 0; i < a.bodies.size(); ++i)
        for (std::size_t j = i + 1; j < a.bodies.size(); ++j) {
            const Body &one = a.bodies[i], &two = a.bodies[j];
            const int k = findBody(b, one.name), l = findBody(b, two.name);
            const std::string what = one.name + " and " + two.name;
            const bool touch = mayCollide(a, static_cast<int>(i), static_cast<int>(j));
            EXPECT_EQ(touch, mayCollide(b, k, l)) << what;
            if (!touch || one.shapes.empty() || two.shapes.empty()) continue;
            const auto p = pairCoefficients(a, one.shapes[0].material, two.shapes[0].material);
            const auto q = pairCoefficients(b, b.bodies[static_cast<std::size_t>(k)].shapes[0].material,
                                            b.bodies[static_cast<std::size_t>(l)].shapes[0].material);
            EXPECT_NEAR(p.friction, q.friction, tolerance) << what;
            EXPECT_NEAR(p.rollingFriction, q.rollingFriction, tolerance) << what;
            EXPECT_NEAR(p.torsionalFriction, q.torsionalFriction, tolerance) << what;
        }
}

}  // namespace rigor::models::testing
