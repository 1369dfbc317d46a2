// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// State: what of a world in mid-run can be given to another one, built alike, through Box2D's public members,
// and how far the two then go on with the same bits. Poses, velocities and the manifolds of contacts are all
// there is; it does for a stack. The impulses of joints, the order in which contacts were made, the timers of
// sleep and, of a body with its centre of mass away from its origin, the centre itself are not among them.
// The adapter's snapshots replay the run instead.
#include "adapters/conformance/plain_programs/box2d/run.hpp"

namespace rigor::plain {
namespace {

enum class Scene { Stack, Pile, OffCenterPile, Chain };

struct State {
    explicit State(Scene scene) {
        bodies.push_back(makeBody(world, b2_staticBody, {0.0f, -1.0f}));
        addFixture(*bodies[0], box(20.0f, 1.0f), 0.5f);
        const int count = scene == Scene::Stack ? 6 : scene == Scene::Chain ? 5 : 30;
        for (int i = 0; i < count; ++i) {
            const auto n = static_cast<float>(i);
            if (scene == Scene::Stack)
                addBox(*add({0.05f * n, 0.52f + 1.03f * n}), 0.5, 0.5, 0.5f);
            else if (scene == Scene::Chain)
                hang(n);
            else
                drop(i, scene == Scene::OffCenterPile ? b2Vec2(0.1f, 0.05f) : b2Vec2_zero);
        }
    }
    b2Body* add(const b2Vec2& position) {
        bodies.push_back(makeBody(world, b2_dynamicBody, position));
        bodies.back()->SetSleepingAllowed(false);
        return bodies.back();
    }
    void hang(float n) {
        addBox(*add({n + 0.5f, 4.0f}), 0.5, 0.1);
        b2RevoluteJointDef joint;
        joint.Initialize(bodies[bodies.size() - 2], bodies.back(), {n, 4.0f});
        world.CreateJoint(&joint);
    }
    void drop(int i, const b2Vec2& center) {
        b2Body& body = *add({0.37f * static_cast<float>((i * 7) % 5) - 0.7f, 0.5f + 0.6f * i});
        body.SetTransform(body.GetPosition(), 0.3f * i);
        b2PolygonShape shape;
        shape.SetAsBox(0.3f, 0.2f, center, 0.0f);
        addFixture(body, shape, 0.5f);
    }
    std::size_t indexOf(const b2Fixture* fixture) const {
        std::size_t i = 0;
        while (bodies.at(i) != fixture->GetBody()) ++i;
        return i;
    }

    b2World world{b2Vec2(0.0f, -9.81f)};
    std::vector<b2Body*> bodies;
};

void copyBodies(const State& from, State& to) {
    for (std::size_t i = 1; i < from.bodies.size(); ++i) {
        const b2Body& a = *from.bodies[i];
        to.bodies[i]->SetTransform(a.GetPosition(), a.GetAngle());
        to.bodies[i]->SetLinearVelocity(a.GetLinearVelocity());
        to.bodies[i]->SetAngularVelocity(a.GetAngularVelocity());
    }
}

/// A step without time finds the contacts; a step with time before it, since a world's first step does not
/// warm start.
void copyContacts(State& from, State& to) {
    to.world.Step(1.0f / 60.0f, 8, 3);
    copyBodies(from, to);
    to.world.Step(0.0f, 8, 3);
    for (b2Contact* a = from.world.GetContactList(); a != nullptr; a = a->GetNext())
        for (b2Contact* b = to.world.GetContactList(); b != nullptr; b = b->GetNext())
            if (from.indexOf(a->GetFixtureA()) == to.indexOf(b->GetFixtureA()) &&
                from.indexOf(a->GetFixtureB()) == to.indexOf(b->GetFixtureB()))
                *b->GetManifold() = *a->GetManifold();
    copyBodies(from, to);
}

/// A new world that is given what another one has; both go on for 200 steps.
bool goesOnAlike(Scene scene, int before, bool contacts) {
    State old(scene), fresh(scene);
    run(old.world, old.bodies, 1.0f / 60.0f, before);
    copyBodies(old, fresh);
    if (contacts) copyContacts(old, fresh);
    const Trajectory a = run(old.world, old.bodies, 1.0f / 60.0f, 200);
    return static_cast<bool>(same(a, run(fresh.world, fresh.bodies, 1.0f / 60.0f, 200)));
}

TEST(PlainBox2d, ThePartsOfAState) {
    for (const int before : {20, 100}) {
        EXPECT_FALSE(goesOnAlike(Scene::Stack, before, false));
        EXPECT_TRUE(goesOnAlike(Scene::Stack, before, true));
        EXPECT_FALSE(goesOnAlike(Scene::Chain, before, true)) << "impulses of joints";
        EXPECT_FALSE(goesOnAlike(Scene::Pile, before, true)) << "order of contacts";
    }
}

TEST(PlainBox2d, ACenterOfMassAwayFromTheOriginIsNotGiven) {
    State old(Scene::OffCenterPile), fresh(Scene::OffCenterPile);
    run(old.world, old.bodies, 1.0f / 60.0f, 100);
    copyBodies(old, fresh);
    bool same = true;
    for (std::size_t i = 1; i < old.bodies.size(); ++i)
        same = same && old.bodies[i]->GetWorldCenter() == fresh.bodies[i]->GetWorldCenter();
    EXPECT_FALSE(same);
}

}  // namespace
}  // namespace rigor::plain
