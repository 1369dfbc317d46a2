// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contacts that DART's narrow phases find at two triangles from their front and from behind, and at two prisms whose ends lie in
// one plane.
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"
#include "adapters/conformance/plain_programs/dart/mesh.hpp"

namespace rigor::plain {
namespace {

using namespace dart::dynamics;
using dart::collision::CollisionDetectorPtr;
using dart::collision::FCLCollisionDetector;
using dart::collision::OdeCollisionDetector;

CollisionDetectorPtr fcl(FCLCollisionDetector::PrimitiveShape kind) {
    const auto detector = FCLCollisionDetector::create();
    detector->setPrimitiveShapeType(kind);
    return detector;
}

/// Contacts of two shapes; normals point to the second.
std::vector<dart::collision::Contact> between(const CollisionDetectorPtr& detector, const ShapePtr& first,
                                              const ShapePtr& second, const Eigen::Vector3d& at) {
    SimpleFrame one(Frame::World(), "one"), two(Frame::World(), "two");
    const auto groupOf = [&](SimpleFrame& frame, const ShapePtr& of) {
        frame.setShape(of);
        frame.createCollisionAspect();
        auto group = detector->createCollisionGroupAsSharedPtr();
        group->addShapeFrame(&frame);
        return group;
    };
    two.setTranslation(at);
    const auto a = groupOf(one, first), b = groupOf(two, second);
    dart::collision::CollisionResult found;
    a->collide(b.get(), dart::collision::CollisionOption(true, 1000), &found);
    std::vector<dart::collision::Contact> contacts = found.getContacts();
    for (auto& contact : contacts)
        if (contact.collisionObject1->getShapeFrame() == &one) contact.normal = -contact.normal;
    return contacts;
}

enum class Found { Nothing, Right, Through, NegativeDepth };

/// A shape of half height 0.2 m that overlaps two triangles by 5 mm, whose front is above. Through: most normals lead
/// through the triangles.
Found found(const CollisionDetectorPtr& detector, const ShapePtr& shape, double side) {
    scenario::TriangleMesh mesh;
    mesh.vertices = {{-2, 0, -0.5}, {-2, 0, 0.5}, {2, 0, -0.5}, {2, 0, 0.5}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto contacts = between(detector, meshShape(mesh), shape, {0.3, 0.195 * side, 0.02});
    std::size_t through = 0;
    for (const auto& contact : contacts) through += contact.normal.y() * side < 0.0 ? 1 : 0;
    if (contacts.empty()) return Found::Nothing;
    if (contacts.front().penetrationDepth < 0.0) return Found::NegativeDepth;
    return 2 * through > contacts.size() ? Found::Through : Found::Right;
}

ShapePtr hull() {
    scenario::TriangleMesh mesh;
    for (const double x : {-0.3, 0.3})
        for (const double y : {-0.2, 0.2})
            for (const double z : {-0.3, 0.3}) mesh.vertices.push_back({x, y, z});
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                      {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return meshShape(mesh);
}

/// FCL's ball has a negative depth from either side, and DART's solver leaves such contacts out. Everything else is right
/// from the front.
TEST(PlainDart, MeshesFromBehind) {
    const ShapePtr ball = std::make_shared<SphereShape>(0.2),
                   box = std::make_shared<BoxShape>(Eigen::Vector3d(0.6, 0.4, 0.6)),
                   capsule = std::make_shared<CapsuleShape>(0.2, 0.5),
                   cylinder = std::make_shared<CylinderShape>(0.2, 0.5);
    struct Row {
        CollisionDetectorPtr detector;
        ShapePtr shape;
        Found front, behind;
    };
    const auto ode = OdeCollisionDetector::create();
    const auto primitives = fcl(FCLCollisionDetector::PRIMITIVE), meshes = fcl(FCLCollisionDetector::MESH);
    const Row rows[] = {{ode, ball, Found::Right, Found::Nothing},
                        {ode, box, Found::Right, Found::Right},
                        {ode, capsule, Found::Right, Found::Nothing},
                        {ode, cylinder, Found::Right, Found::Nothing},
                        {ode, hull(), Found::Right, Found::Through},
                        {primitives, ball, Found::NegativeDepth, Found::NegativeDepth},
                        {primitives, box, Found::Right, Found::Right},
                        {primitives, cylinder, Found::Right, Found::Through},
                        {primitives, hull(), Found::Right, Found::Through},
                        {meshes, ball, Found::Right, Found::Through},
                        {meshes, box, Found::Right, Found::Through},
                        {meshes, cylinder, Found::Right, Found::Through},
                        {meshes, hull(), Found::Right, Found::Through}};
    for (const Row& row : rows) {
        SCOPED_TRACE(row.detector->getType() + ", " + row.shape->getType());
        EXPECT_EQ(found(row.detector, row.shape, 1.0), row.front);
        EXPECT_EQ(found(row.detector, row.shape, -1.0), row.behind);
    }
}

/// A box on a plane of triangles, the foremost of which it covers by 5 mm, by FCL's meshes. From behind, their contacts push
/// it back along the plane: it covers them by less than its own height. So a box that slides over triangles which have both
/// sides stops at the next one.
TEST(PlainDart, ATriangleThatABoxBeginsToCoverPushesItBackFromBehind) {
    const auto detector = fcl(FCLCollisionDetector::MESH);
    scenario::TriangleMesh front;
    for (const double x : {-2.0, 0.245, 2.0})
        for (const double z : {-1.0, 1.0}) front.vertices.push_back({x, 0, z});
    front.triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}};
    scenario::TriangleMesh back = front;
    for (auto& triangle : back.triangles) std::swap(triangle[1], triangle[2]);
    const auto sideways = [&](const scenario::TriangleMesh& mesh) {
        const auto contacts =
            between(detector, meshShape(mesh), std::make_shared<BoxShape>(Eigen::Vector3d(0.5, 0.1, 1)),
                    {0, 0.05 - 6e-9, 0});
        EXPECT_GE(contacts.size(), 4u);
        return std::count_if(contacts.begin(), contacts.end(), [](const auto& contact) {
            return contact.normal.x() < -0.99 && std::abs(contact.penetrationDepth - 0.005) < 1e-4;
        });
    };
    EXPECT_EQ(sideways(front), 0);
    EXPECT_GE(sideways(back), 1);
}

/// A box that stands a millimetre deep in a greater one, by FCL's meshes. Where their ends lie in one plane, contacts
/// there have sideways normals and depths of half a metre; where the greater one reaches farther, none has.
TEST(PlainDart, PrismsWithEndsInOnePlaneTouchSideways) {
    const auto detector = fcl(FCLCollisionDetector::MESH);
    const auto sideways = [&](double depth) {
        const auto contacts =
            between(detector, std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, depth)),
                    std::make_shared<BoxShape>(Eigen::Vector3d(0.5, 0.5, 1)), {0.13, 0.749, 0});
        EXPECT_GE(contacts.size(), 4u);
        return std::count_if(contacts.begin(), contacts.end(), [](const auto& contact) {
            return std::abs(contact.normal.x()) > 0.9 && contact.penetrationDepth > 0.5;
        });
    };
    EXPECT_GE(sideways(1.0), 2);
    EXPECT_EQ(sideways(2.0), 0);
}

}  // namespace
}  // namespace rigor::plain
