// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The disc of ball_in_trough_2d on its facets, with ODE's narrow phase. A disc that overlaps the surface touches several
// facets at once, and DART stops it along the normal of each, those ahead included: it is lifted off, and the landing
// takes energy. With the deepest contact of each step alone it rolls as on a smooth trough.
#include <algorithm>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "adapters/conformance/plain_programs/dart/loop.hpp"
#include "adapters/conformance/plain_programs/dart/mesh.hpp"

namespace rigor::plain {
namespace {

using namespace dart::dynamics;
using dart::constraint::ContactConstraint;

/// DART's solver with the deepest contact of each step, which is found in DART's own way.
class DeepestContact final : public dart::constraint::BoxedLcpConstraintSolver {
  public:
    void find(double dt) {
        if (group_ == nullptr) {
            group_ = mCollisionGroup;
            mCollisionGroup = mCollisionDetector->createCollisionGroupAsSharedPtr();
            option_.collisionFilter = std::make_shared<dart::collision::BodyNodeCollisionFilter>();
        }
        mManualConstraints.clear();
        found_.clear();
        group_->collide(option_, &found_);
        dart::collision::Contact* deepest = nullptr;
        for (std::size_t i = 0; i < found_.getNumContacts(); ++i) {
            dart::collision::Contact& contact = found_.getContact(i);
            if (deepest == nullptr || contact.penetrationDepth > deepest->penetrationDepth)
                deepest = &contact;
        }
        if (deepest != nullptr)
            mManualConstraints.push_back(std::make_shared<ContactConstraint>(*deepest, dt));
    }

  private:
    dart::collision::CollisionGroupPtr group_;
    dart::collision::CollisionOption option_{true, 1000};
    dart::collision::CollisionResult found_;
};

const Scenario& troughScene() {
    static const Scenario scene = load("scenarios/library/2d/ball_in_trough_2d.json");
    return scene;
}

struct Trough {
    Loop loop;
    double step;
    DeepestContact* deepest = nullptr;  ///< null: all contacts, as DART takes them

    Trough(double dt, bool one) : loop(dt, {0, -9.81, 0}), step(dt) {
        auto detector = dart::collision::OdeCollisionDetector::create();
        loop.world->getConstraintSolver()->setCollisionDetector(detector);
        // The 301 corners are taken from the file instead of written out.
        scenario::TriangleMesh mesh;
        for (const Vec3& v : std::get<scenario::Chain>(troughScene().bodies[0].shapes[0].geometry).vertices)
            for (const double z : {-0.5, 0.5}) mesh.vertices.push_back({v.x, v.y, z});
        for (int i = 0; i + 3 < static_cast<int>(mesh.vertices.size()); i += 2) {
            mesh.triangles.push_back({i, i + 1, i + 2});
            mesh.triangles.push_back({i + 2, i + 1, i + 3});
        }
        loop.add(nullptr, {0, 0, 0}, meshShape(mesh), 0.9);
        const auto skeleton = Skeleton::create("disc");
        const auto disc = skeleton->createJointAndBodyNodePair<PlanarJoint>();
        disc.second->setInertia(inertia(1, {0.005, 0.005, 0.005}));
        auto* node = disc.second->createShapeNodeWith<CollisionAspect, DynamicsAspect>(
            std::make_shared<SphereShape>(0.1));
        node->getDynamicsAspect()->setFrictionCoeff(0.9);
        disc.first->setPositions(Eigen::Vector3d(0.6391600776080361, -0.6336065502976024, 0));
        loop.world->addSkeleton(skeleton);
        loop.bodies.push_back(disc.second);
        if (!one) return;
        auto solver = std::make_unique<DeepestContact>();
        solver->setCollisionDetector(detector);
        deepest = solver.get();
        loop.world->setConstraintSolver(std::move(solver));
    }

    /// Two and a half seconds.
    Trajectory run() {
        Trajectory plain = loop.run(0);
        for (int i = 0; i < std::lround(2.5 / step); ++i) {
            if (deepest != nullptr) deepest->find(step);
            plain.push_back(loop.run(1).back());
        }
        return plain;
    }
};

/// Largest distance from a disc that rolls in a smooth trough [m]: a pendulum of 0.9 m with 1.5 times its inertia.
double error(const Trajectory& run, double dt) {
    constexpr int kParts = 1000;
    const Vec3 start = run[0][1].position;
    const double length = norm(start), h = dt / kParts;
    double angle = std::atan2(start.x, -start.y), rate = 0.0, most = 0.0;
    for (std::size_t i = 1; i < run.size(); ++i) {
        for (int k = 0; k < kParts; ++k) {
            rate -= h * 9.81 / (1.5 * length) * std::sin(angle);
            angle += h * rate;
        }
        const Vec3 exact = length * Vec3{std::sin(angle), -std::cos(angle), 0};
        most = std::max(most, norm(run[i][1].position - exact));
    }
    return most;
}

/// `matched` reduces a fifth of an overlap in a step, at 1 m/s at most.
class PlainDartTrough : public testing::Test {
  protected:
    void SetUp() override {
        ContactConstraint::setErrorReductionParameter(0.2);
        ContactConstraint::setMaxErrorReductionVelocity(1.0);
    }
    void TearDown() override {
        ContactConstraint::setErrorReductionParameter(0.01);
        ContactConstraint::setMaxErrorReductionVelocity(1e-3);
    }
};

TEST_F(PlainDartTrough, AllContactsAsThroughTheAdapter) {
    const Trajectory plain = Trough(1.0 / 240, false).run();
    EXPECT_GT(travel(plain, 1), 1.0);
    const Trajectory adapter = adapterRun("dart:preset=matched", troughScene(), 1.0 / 240, 600);
    const Trajectory start(plain.begin(), plain.begin() + 61), same61(adapter.begin(), adapter.begin() + 61);
    EXPECT_TRUE(same(start, same61, {1e-6, 1e-6, 1e-4, 1e-3}));
    EXPECT_NEAR(error(adapter, 1.0 / 240) / error(plain, 1.0 / 240), 1.0, 0.4);
}

TEST_F(PlainDartTrough, ContactsAheadTakeTheEnergy) {
    for (const auto& [dt, all] : {std::pair{1.0 / 60, 0.5}, {1.0 / 240, 0.1}}) {
        EXPECT_GT(error(Trough(dt, false).run(), dt), all);
        EXPECT_LT(error(Trough(dt, true).run(), dt), 0.015);
    }
}

}  // namespace
}  // namespace rigor::plain
