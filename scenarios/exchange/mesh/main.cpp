// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The reader of mesh files: one body of convex hulls that falls, or with --static the ground, onto which a ball falls.
#include <algorithm>

#include "scenarios/exchange/common/text.hpp"
#include "scenarios/exchange/geometry/mesh_file.hpp"

namespace rigor::models {
namespace {

using scenario::Body;
using scenario::BodyType;
using scenario::Vec3;

Answer read(const ReadOptions& options) {
    Report report(options.without);
    const Place place{options.file.filename().string(), 0};
    if (!std::filesystem::is_regular_file(options.file)) throw Refusal(place, "there is no such file");
    const Vec3 scale{options.scale, options.scale, options.scale};
    const auto parts = readMesh(options.file, scale, place);
    SceneBuilder builder(options, report, "a mesh", "assimp");
    builder.scene.gravity = {0.0, -9.81, 0.0};
    report.changed("mesh", place,
                   "a mesh file has no physics: +y is up, friction " + digits({options.friction}) +
                       ", density " + digits({options.density}) + " kg/m3");
    const Surface surface{options.friction, 0.0, 0.0, 0.0, 6, 0, 0};
    const std::string name = options.file.stem().string();
    Body body;
    if (options.isStatic) body.type = BodyType::Static;
    const int index = builder.addBody(name, body, place);
    addMesh(builder, report, index, parts, {}, surface, 0, options, place);
    if (options.isStatic) {
        Vec3 low = parts[0].vertices[0], high = low;
        for (const auto& part : parts)
            for (const Vec3& v : part.vertices) {
                low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
                high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
            }
        const double radius = 0.05 * norm(high - low);
        Body ball;
        ball.pose.position = {0.5 * (low.x + high.x), high.y + 3.0 * radius, 0.5 * (low.z + high.z)};
        const int probe = builder.addBody("probe", ball, place);
        builder.addShape(probe, scenario::Sphere{radius}, {}, surface, 0);
        report.changed("mesh", place, "a ball, 'probe', was added, since a scenario needs a body that moves");
    }
    // Density times the volume of the shapes, as for a scenario that gives no mass.
    scenario::Material material{"surface"};
    material.density = options.density;
    for (Body& b : builder.scene.bodies)
        if (b.type == BodyType::Dynamic && !b.shapes.empty())
            b.massProperties = scenario::massPropertiesFromShapes(b.shapes, {material}, 3);
    return builder.finish();
}

}  // namespace
}  // namespace rigor::models

int main(int argc, char** argv) {
    return rigor::models::runReader(argc, argv, rigor::models::read);
}
