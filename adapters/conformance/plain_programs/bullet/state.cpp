// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// State: what of a world in mid-run has to be given to another one, built alike, so that both go on with the
// same bits. Poses and velocities are not enough; with the points and impulses of contacts, the order of
// pairs and of manifolds and the tree of the broad phase, all public members of Bullet's, the future of awake
// single shapes is the same. The adapter's snapshots replay the run instead, which holds for every shape.
#include <map>

#include "adapters/conformance/plain_programs/bullet/rigid_body_base.hpp"

namespace rigor::plain {
namespace {

/// Boxes and balls that fall onto each other.
class Pile : public RigidBodyBase {
  public:
    Pile() {
        createRigidBody(0, {0, -1, 0}, std::make_unique<btBoxShape>(btVector3(20, 1, 20)));
        for (int i = 0; i < 40; ++i) {
            const btTransform pose(btQuaternion(btVector3(1, 2, 3).normalized(), 0.3 * i),
                                   {0.37 * ((i * 7) % 5) - 0.7, 0.5 + 0.45 * i, 0.31 * ((i * 3) % 4) - 0.5});
            std::unique_ptr<btCollisionShape> shape = std::make_unique<btSphereShape>(0.3);
            if (i % 2 == 1) shape = std::make_unique<btBoxShape>(btVector3(0.3, 0.2, 0.4));
            createRigidBody(1 + 0.1 * (i % 3), pose, std::move(shape));
        }
        for (auto& body : bodies) body->setActivationState(DISABLE_DEACTIVATION);
    }
    btDbvtBroadphase& broadphase() { return static_cast<btDbvtBroadphase&>(*world->getBroadphase()); }
    btOverlappingPairCache& pairs() { return *broadphase().getOverlappingPairCache(); }
    btBroadphaseProxy* proxyOf(std::size_t body) { return bodies[body]->getBroadphaseHandle(); }
    std::size_t indexOf(const void* object) const {
        std::size_t i = 0;
        while (bodies.at(i).get() != object) ++i;
        return i;
    }
    std::pair<std::size_t, std::size_t> bodiesOf(const btPersistentManifold& manifold) const {
        return {indexOf(manifold.getBody0()), indexOf(manifold.getBody1())};
    }
};

void copyBodies(const Pile& from, Pile& to) {
    for (std::size_t i = 0; i < from.bodies.size(); ++i) {
        const btRigidBody& a = *from.bodies[i];
        btRigidBody& b = *to.bodies[i];
        if (a.isStaticObject()) continue;
        b.setWorldTransform(a.getWorldTransform());
        b.setInterpolationWorldTransform(a.getInterpolationWorldTransform());
        b.setLinearVelocity(a.getLinearVelocity());
        b.setAngularVelocity(a.getAngularVelocity());
        b.setInterpolationLinearVelocity(a.getInterpolationLinearVelocity());
        b.setInterpolationAngularVelocity(a.getInterpolationAngularVelocity());
        b.updateInertiaTensor();
    }
}

/// Points and impulses of the contacts that both worlds have, found anew in `to` by its narrow phase.
void copyContacts(Pile& from, Pile& to) {
    btDispatcher &a = *from.world->getDispatcher(), &b = *to.world->getDispatcher();
    std::map<std::pair<std::size_t, std::size_t>, btPersistentManifold*> found;
    for (int i = 0; i < b.getNumManifolds(); ++i) {
        btPersistentManifold* manifold = b.getManifoldByIndexInternal(i);
        found[to.bodiesOf(*manifold)] = manifold;
    }
    for (int i = 0; i < a.getNumManifolds(); ++i) {
        const btPersistentManifold& old = *a.getManifoldByIndexInternal(i);
        const auto it = found.find(from.bodiesOf(old));
        if (it == found.end()) continue;
        it->second->setNumContacts(old.getNumContacts());
        for (int k = 0; k < old.getNumContacts(); ++k)
            it->second->getContactPoint(k) = old.getContactPoint(k);
    }
}

void copyPairs(Pile& from, Pile& to) {
    const btBroadphasePairArray wrong = to.pairs().getOverlappingPairArray();
    for (int i = 0; i < wrong.size(); ++i)
        to.pairs().removeOverlappingPair(wrong[i].m_pProxy0, wrong[i].m_pProxy1, to.world->getDispatcher());
    const btBroadphasePairArray& order = from.pairs().getOverlappingPairArray();
    for (int i = 0; i < order.size(); ++i)
        to.pairs().addOverlappingPair(to.proxyOf(from.indexOf(order[i].m_pProxy0->m_clientObject)),
                                      to.proxyOf(from.indexOf(order[i].m_pProxy1->m_clientObject)));
}

void copyManifoldOrder(Pile& from, Pile& to) {
    btDispatcher &a = *from.world->getDispatcher(), &b = *to.world->getDispatcher();
    btPersistentManifold** const order = b.getInternalManifoldPointer();
    ASSERT_EQ(a.getNumManifolds(), b.getNumManifolds());
    for (int i = 0; i < a.getNumManifolds(); ++i) {
        const auto wanted = from.bodiesOf(*a.getManifoldByIndexInternal(i));
        int j = i;
        while (to.bodiesOf(*order[j]) != wanted) ASSERT_LT(++j, b.getNumManifolds());
        std::swap(order[i], order[j]);
        order[i]->m_index1a = i;
        order[j]->m_index1a = j;
    }
}

btDbvtNode* copyNode(const btDbvtNode& node, btDbvtNode* parent, Pile& from, Pile& to) {
    auto* const copy = static_cast<btDbvtNode*>(btAlignedAlloc(sizeof(btDbvtNode), 16));
    *copy = node;
    copy->parent = parent;
    if (node.isleaf()) {
        const auto* old = static_cast<const btDbvtProxy*>(node.data);
        auto* const proxy = static_cast<btDbvtProxy*>(to.proxyOf(from.indexOf(old->m_clientObject)));
        copy->childs[1] = nullptr;
        copy->data = proxy;
        proxy->leaf = copy;
    } else {
        for (int i = 0; i < 2; ++i) copy->childs[i] = copyNode(*node.childs[i], copy, from, to);
    }
    return copy;
}

/// Copies both trees of the broad phase, the lists of its stages, and its counters.
void copyBroadPhase(Pile& from, Pile& to) {
    const btDbvtBroadphase& a = from.broadphase();
    btDbvtBroadphase& b = to.broadphase();
    for (int set = 0; set < 2; ++set) {
        b.m_sets[set].clear();
        if (a.m_sets[set].m_root != nullptr)
            b.m_sets[set].m_root = copyNode(*a.m_sets[set].m_root, nullptr, from, to);
        b.m_sets[set].m_leaves = a.m_sets[set].m_leaves;
        b.m_sets[set].m_opath = a.m_sets[set].m_opath;
        b.m_sets[set].m_lkhd = a.m_sets[set].m_lkhd;
    }
    const auto twin = [&](const btDbvtProxy* p) {
        return p == nullptr ? nullptr
                            : static_cast<btDbvtProxy*>(to.proxyOf(from.indexOf(p->m_clientObject)));
    };
    for (int stage = 0; stage < 3; ++stage) b.m_stageRoots[stage] = twin(a.m_stageRoots[stage]);
    for (std::size_t i = 0; i < from.bodies.size(); ++i) {
        const auto& p = static_cast<const btDbvtProxy&>(*from.proxyOf(i));
        auto& q = static_cast<btDbvtProxy&>(*to.proxyOf(i));
        for (int k = 0; k < 2; ++k) q.links[k] = twin(p.links[k]);
        q.stage = p.stage;
        q.m_aabbMin = p.m_aabbMin;
        q.m_aabbMax = p.m_aabbMax;
    }
    b.m_stageCurrent = a.m_stageCurrent;
    b.m_fixedleft = a.m_fixedleft;
    b.m_newpairs = a.m_newpairs;
    b.m_needcleanup = a.m_needcleanup;
    b.m_pid = a.m_pid;
    b.m_cid = a.m_cid;
    b.m_updates_call = a.m_updates_call;
    b.m_updates_done = a.m_updates_done;
    b.m_updates_ratio = a.m_updates_ratio;
}

enum Given { Bodies, Contacts, PairOrder, Tree, ManifoldOrder };

/// A new world that is given what another one has, up to and with `given`; both go on for 200 steps.
bool goesOnAlike(int before, Given given) {
    Pile old, fresh;
    old.run(1.0 / 60, before);
    copyBodies(old, fresh);
    if (given >= Tree) copyBroadPhase(old, fresh);
    if (given >= PairOrder) {
        copyPairs(old, fresh);
        fresh.world->getDispatcher()->dispatchAllCollisionPairs(
            &fresh.pairs(), fresh.world->getDispatchInfo(), fresh.world->getDispatcher());
    } else if (given >= Contacts) {
        fresh.world->performDiscreteCollisionDetection();
    }
    if (given >= Contacts) copyContacts(old, fresh);
    if (given >= ManifoldOrder) copyManifoldOrder(old, fresh);
    const Trajectory a = old.run(1.0 / 60, 200), b = fresh.run(1.0 / 60, 200);
    return static_cast<bool>(same(a, b));
}

TEST(PlainBullet, ThePartsOfAState) {
    EXPECT_FALSE(goesOnAlike(100, Bodies));
    EXPECT_FALSE(goesOnAlike(100, Contacts));
    EXPECT_FALSE(goesOnAlike(20, PairOrder));
    EXPECT_FALSE(goesOnAlike(100, Tree));
    for (const int before : {20, 100, 300}) EXPECT_TRUE(goesOnAlike(before, ManifoldOrder)) << before;
}

}  // namespace
}  // namespace rigor::plain
