// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/tests/library_says.hpp"

#include <mujoco/mujoco.h>

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "scenarios/exchange/tests/tool.hpp"

namespace rigor::models::testing {
namespace fs = std::filesystem;
using namespace scenario;
using nlohmann::json;

namespace {

struct Deleter {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
};

Vec3 vector(const double* v) {
    return {v[0], v[1], v[2]};
}
Mat3 matrix(const double* v) {
    Mat3 r;
    for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = v[i];
    return r;
}
Mat3 inertiaOf(const Mat3& axes, const Vec3& moments) {
    return axes * Mat3::diagonal(moments.x, moments.y, moments.z) * transpose(axes);
}
std::string nameOf(const mjModel* m, mjtObj kind, int index) {
    const char* name = mj_id2name(m, kind, index);
    return name ? name : "";
}

}  // namespace

LibrarySays libmujocoSays(const fs::path& file) {
    LibrarySays says;
    char message[500] = "";
    const std::unique_ptr<mjModel, Deleter> m(mj_loadXML(file.c_str(), nullptr, message, sizeof message));
    EXPECT_TRUE(m) << message;
    if (!m) return says;
    const std::unique_ptr<mjData, Deleter> d(mj_makeData(m.get()));
    mj_forward(m.get(), d.get());
    for (int i = 0; i < m->nbody; ++i)
        says.bodies.push_back({nameOf(m.get(), mjOBJ_BODY, i), vector(d->xpos + 3 * i),
                               matrix(d->xmat + 9 * i), m->body_mass[i], vector(d->xipos + 3 * i),
                               inertiaOf(matrix(d->ximat + 9 * i), vector(m->body_inertia + 3 * i))});
    for (int i = 0; i < m->njnt; ++i) {
        const double start = d->qpos[m->jnt_qposadr[i]];
        says.joints.push_back({nameOf(m.get(), mjOBJ_JOINT, i), vector(d->xanchor + 3 * i),
                               vector(d->xaxis + 3 * i), m->jnt_range[2 * i] - start,
                               m->jnt_range[2 * i + 1] - start});
    }
    return says;
}

fs::path mujoco3Package() {
    const fs::path folder = fs::path(RIGOR_SOURCE_DIR) / "adapters/guest/engines/node_modules/@mujoco/mujoco";
    return fs::exists(folder / "package.json") ? folder : fs::path();
}

LibrarySays mujoco3Says(const fs::path& file) {
    const std::string command = "node '" + std::string(RIGOR_SOURCE_DIR) +
                                "/scenarios/exchange/tests/mujoco3_says.mjs' '" + mujoco3Package().string() +
                                "' '" + file.string() + "'";
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer;
    while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
    EXPECT_EQ(pclose(pipe), 0);
    const json read = json::parse(text, nullptr, false);
    LibrarySays says;
    EXPECT_TRUE(read.is_object()) << text;
    if (!read.is_object()) return says;
    const auto numbers = [](const json& values) { return values.get<std::vector<double>>(); };
    for (const json& b : read["bodies"])
        says.bodies.push_back(
            {b["name"], vector(numbers(b["position"]).data()), matrix(numbers(b["axes"]).data()), b["mass"],
             vector(numbers(b["centre"]).data()),
             inertiaOf(matrix(numbers(b["principal_axes"]).data()), vector(numbers(b["moments"]).data()))});
    for (const json& j : read["joints"])
        says.joints.push_back({j["name"], vector(numbers(j["anchor"]).data()),
                               vector(numbers(j["axis"]).data()), j["range"][0], j["range"][1]});
    return says;
}

void expectAsLibrarySays(const Scenario& s, const LibrarySays& library) {
    int compared = 0;
    for (std::size_t i = 1; i < library.bodies.size(); ++i) {
        const LibrarySays::Body& expected = library.bodies[i];
        const int index = findBody(s, expected.name.empty() ? "body_" + std::to_string(i) : expected.name);
        if (index == kNone) continue;
        const Body& b = s.bodies[static_cast<std::size_t>(index)];
        expectNear(b.pose.position, expected.position, kTolerance, b.name + ", position");
        const Mat3 turn = toMatrix(b.pose.orientation);
        expectNear(turn, expected.axes, kTolerance, b.name + ", axes");
        if (b.type != BodyType::Dynamic) continue;
        ++compared;
        EXPECT_NEAR(b.massProperties.mass, expected.mass, kTolerance * expected.mass);
        expectNear(b.pose * b.massProperties.centerOfMass, expected.centre, kTolerance, b.name + ", centre");
        expectNear(inertiaInWorld(b), expected.inertia, kTolerance, b.name + ", inertia");
    }
    EXPECT_GT(compared, 0);
    for (std::size_t i = 0; i < library.joints.size(); ++i) {
        const LibrarySays::Joint& expected = library.joints[i];
        const std::string name = expected.name.empty() ? "joint_" + std::to_string(i) : expected.name;
        for (const Joint& j : s.joints) {
            if (j.name != name || (j.type != JointType::Hinge && j.type != JointType::Slider)) continue;
            const Pose pose = s.bodies[static_cast<std::size_t>(j.bodyB)].pose;
            expectNear(pose * j.anchorB, expected.anchor, kTolerance, j.name + ", anchor");
            expectNear(rotate(pose.orientation, j.axisB), expected.axis, kTolerance, j.name + ", axis");
            if (j.axes[0].mode != AxisMode::Limited) continue;
            EXPECT_NEAR(j.axes[0].lower, expected.lower, kTolerance) << j.name;
            EXPECT_NEAR(j.axes[0].upper, expected.upper, kTolerance) << j.name;
        }
    }
}

}  // namespace rigor::models::testing
