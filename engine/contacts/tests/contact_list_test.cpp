// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/contacts/slot_list.hpp"
#include "engine/pipeline/world.hpp"

namespace rigor::engine::test {
namespace {

/// Contacts come and go at random; each is found in its slot and at its place until it is removed.
TEST(ContactList, KeepsEachContactUntilItIsRemoved) {
    const Tasks tasks(2);
    SlotList<Contact<Space2f>> list;
    std::vector<std::uint32_t> names;  // shape that each contact gets, by its place
    std::mt19937 random(1);
    bool tidied = false;
    for (std::uint32_t round = 0; round < 500; ++round) {
        std::vector<std::uint32_t>& order = list.order();
        if (!names.empty() && random() % 2 == 0) {
            const std::size_t place = random() % names.size();
            list.remove(order[place]);
            order.erase(order.begin() + static_cast<std::ptrdiff_t>(place));
            names.erase(names.begin() + static_cast<std::ptrdiff_t>(place));
        } else {
            const std::size_t place = random() % (names.size() + 1);
            const std::uint32_t slot = list.add();
            list.at(slot) = {};
            list.at(slot).shapeA = round;
            order.insert(order.begin() + static_cast<std::ptrdiff_t>(place), slot);
            names.insert(names.begin() + static_cast<std::ptrdiff_t>(place), round);
        }
        if (list.fragmented()) {
            list.defragment(tasks);
            tidied = true;
        }
        ASSERT_EQ(list.size(), names.size());
        std::size_t place = 0;
        for (const Contact<Space2f>& contact : list) ASSERT_EQ(contact.shapeA, names[place++]) << round;
    }
    EXPECT_TRUE(tidied);
    list.defragment(tasks);
    for (std::uint32_t k = 0; k < names.size(); ++k) EXPECT_EQ(list.order()[k], k);
}

TEST(ContactList, LeavesContactsThatAreInOrderWhereTheyAre) {
    SlotList<Contact<Space2f>> list;
    list.reserve(100);
    for (std::uint32_t k = 0; k < 100; ++k) list.order().push_back(list.add());
    const Contact<Space2f>* const first = &list[0];
    ASSERT_TRUE(list.fragmented());
    list.defragment(Tasks::one());
    EXPECT_EQ(&list[0], first);
    EXPECT_FALSE(list.fragmented());
}

/// Known pairs are not tested again by the collision filter; a joint that comes in between is seen.
TEST(ContactList, JointBetweenBodiesThatTouchEndsTheirContact) {
    WorldDef<Space2f> def;
    World<Space2f> world(def);
    ShapeDef<Space2f> shape;
    shape.shape = Box<Space2f>{{0.5f, 0.5f}};
    std::vector<BodyId> boxes;
    for (const float x : {0.0f, 0.95f, 1.9f}) {
        BodyDef<Space2f> body;
        body.mass = 1;
        body.inertia = 1;
        body.pose.p = {x, 0};
        boxes.push_back(world.addBody(body));
        world.addShape(boxes.back(), shape);
    }
    world.step(1.0f / 60);
    ASSERT_EQ(world.manifolds().size(), 2u);
    JointDef<Space2f> joint;
    joint.type = JointType::Fixed;
    joint.bodyA = boxes[0];
    joint.bodyB = boxes[1];
    joint.anchorA = {0.5f, 0};
    joint.anchorB = {-0.5f, 0};
    world.addJoint(joint);
    world.step(1.0f / 60);
    ASSERT_EQ(world.manifolds().size(), 1u);
    EXPECT_EQ(world.manifolds()[0].bodyA + world.manifolds()[0].bodyB, 5u)
        << "the other two, and the world is 0";
}

}  // namespace
}  // namespace rigor::engine::test
