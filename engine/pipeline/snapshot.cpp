// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The state of a world as a hash, as bytes, and back (state/state_fields.def).
//
// Bytes: "RIGORSNP", version, a word that shows the byte order, dimension, size of a number, a hash of the
// world's structure, the fields, and a hash (FNV-1a, 64 bits) of all bytes before it. The structure is the
// bodies, shapes and joints of the world as built, with their constants. Settings are not part of it:
// restored into a world of other settings the state goes on under those.
//
// Spatial structures of the broad phase are not stored: which pairs it finds, and in which order, does not
// depend on its history (broad_phase.hpp), so it starts afresh.
#include <algorithm>

#include "engine/pipeline/world.hpp"
#include "engine/state/archive.hpp"

namespace rigor::engine {
namespace {

constexpr char kMagic[8] = {'R', 'I', 'G', 'O', 'R', 'S', 'N', 'P'};
constexpr std::uint32_t kVersion = 10;  ///< raised with every change of state_fields.def
constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
    std::uint32_t version = kVersion, byteOrder = kByteOrder;
    std::uint8_t dimension = 0, realSize = 0;
    std::uint64_t structure = 0;
    std::vector<JointId> joints;  ///< joints of the snapshot: some may have broken since the world was built
};
template <class A, class H>
void visitHeader(A& archive, H& header) {
    archive.scalar(header.version);
    archive.scalar(header.byteOrder);
    archive.scalar(header.dimension);
    archive.scalar(header.realSize);
    archive.scalar(header.structure);
    visitValue(archive, header.joints);
}

std::uint64_t checksum(std::span<const unsigned char> bytes) {
    Hasher hash;
    hash.bytes(bytes.data(), bytes.size());
    return hash.value();
}

template <class A, class C>
void visitContact(A& archive, C& contact) {
#define CONTACT_FIELD(member) visitValue(archive, contact.member);
#include "engine/state/state_fields.def"
    // Hashes of worlds without moments do not have them.
    if (!std::is_same_v<A, HashArchive> || dotAng(contact.moment, contact.moment) > 0) {
#define MOMENT_FIELD(member) visitValue(archive, contact.member);
#include "engine/state/state_fields.def"
    }
    if (!std::is_same_v<A, HashArchive> || contact.vetoed) {
#define VETO_FIELD(member) visitValue(archive, contact.member);
#include "engine/state/state_fields.def"
    }
    if (!std::is_same_v<A, HashArchive> || !contact.lastNormal.isZero(0)) {
#define LAST_FIELD(member) visitValue(archive, contact.member);
#include "engine/state/state_fields.def"
    }
    const int count = contact.manifold.count;
    ByteReader::require(count >= 0 && count <= static_cast<int>(contact.points.size()),
                        "a manifold of too many points");
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        auto& where = contact.manifold.points[i];
#define MANIFOLD_POINT_FIELD(member) visitValue(archive, where.member);
#define CONTACT_POINT_FIELD(member) visitValue(archive, contact.member);
#include "engine/state/state_fields.def"
    }
}

/// The cached manifolds: the part of the state of contacts beside their list.
template <class A, class C>
void visitManifoldCache(A& archive, C& candidates) {
    constexpr bool kReading = !std::is_const_v<C>;
    visitValue(archive, candidates.cachedSearch().speculativeDistance);
    visitValue(archive, candidates.cachedSearch().cacheTolerance);
    const auto belongs = [](const auto& c) { return c.cached || c.contact != kNullIndex; };
    std::size_t archived = 0;
    for (const auto& candidate : candidates.list()) archived += belongs(candidate);
    const std::size_t count = archive.size(archived);
    if constexpr (kReading) candidates.list().reset(count);
    std::uint32_t contacts = 0;
    for (auto& candidate : candidates.list()) {
        if (!kReading && !belongs(candidate)) continue;
        bool touches = candidate.contact != kNullIndex;
        visitValue(archive, touches);
        if constexpr (kReading) candidate.contact = touches ? contacts++ : kNullIndex;
#define CANDIDATE_FIELD(member) visitValue(archive, candidate.member);
#include "engine/state/state_fields.def"
        if (!candidate.cached) continue;
#define CACHED_FIELD(member) visitValue(archive, candidate.member);
#include "engine/state/state_fields.def"
    }
}

template <class A, class List>
void visitOverlaps(A& archive, List& overlaps) {
    const std::size_t count = archive.size(overlaps.size());
    if constexpr (!std::is_const_v<List>) overlaps.resize(count);
    for (auto& overlap : overlaps) {
#define OVERLAP_FIELD(member) visitValue(archive, overlap.member);
#include "engine/state/state_fields.def"
    }
}

/// World: WorldParts, const to be read.
template <class S, class A, class World>
void visitState(A& archive, World& world) {
    auto& bodies = world.bodies.arrays();
#define WORLD_FIELD(member) visitValue(archive, world.member);
#define BODY_FIELD(member) visitValue(archive, bodies.member);
#include "engine/state/state_fields.def"
    if (!std::is_same_v<A, HashArchive> || !bodies.midpoints.pose.empty()) {
#define MIDPOINT_FIELD(member) visitValue(archive, bodies.midpoints.member);
#include "engine/state/state_fields.def"
    }
    for (auto& shape : world.contacts.shapes().records()) {
#define SHAPE_FIELD(member) visitValue(archive, shape.member);
#include "engine/state/state_fields.def"
        if (!std::is_same_v<A, HashArchive> || shape.hasSurfaceVelocity) {
#define SURFACE_FIELD(member) visitValue(archive, shape.member);
#include "engine/state/state_fields.def"
        }
        if (std::is_same_v<A, HashArchive> && shape.filter == ShapeFilter{}) continue;
#define FILTER_FIELD(member) visitValue(archive, shape.filter.member);
#include "engine/state/state_fields.def"
    }
    for (auto& record : world.joints.records()) {
#define JOINT_FIELD(member) visitValue(archive, record.member);
#include "engine/state/state_fields.def"
    }
    ForceSet<S>::visitIds(archive, world.forces);
    auto& contacts = world.contacts.list();
    const std::size_t count = archive.size(contacts.size());
    if constexpr (!std::is_const_v<World>) contacts.reset(count);
    for (auto& contact : contacts) visitContact(archive, contact);
    if (!std::is_same_v<A, HashArchive> || world.gravityChanged) {
#define SET_FIELD(member) visitValue(archive, world.member);
#include "engine/state/state_fields.def"
    }
    auto& overlaps = world.contacts.sensors().overlaps();
    if (!std::is_same_v<A, HashArchive> || !overlaps.empty()) visitOverlaps(archive, overlaps);
    // These follow from the rest of the state where all islands are usual.
    const bool others = std::any_of(bodies.islands.begin(), bodies.islands.end(),
                                    [](IslandKind kind) { return kind != IslandKind::Usual; });
    if (!std::is_same_v<A, HashArchive> || others) {
        visitValue(archive, bodies.islands);
        visitValue(archive, world.contacts.candidates().cachedSearch().largeCacheTolerance);
    }
    // If no manifolds are cached, the candidates follow from the rest of the state.
    if (!std::is_same_v<A, HashArchive> || world.def.cacheTolerance > 0 || others)
        visitManifoldCache(archive, world.contacts.candidates());
}

/// Structure of the world as built.
template <class S>
std::uint64_t structureHash(const WorldParts<S>& world) {
    const BodyArrays<S>& bodies = world.bodies.arrays();
    HashArchive hash;
    hash.size(bodies.size());
    for (const BodyConstants<S>& body : bodies.constants) {
        hash.scalar(body.type);
        hash.scalar(body.collides);
        hash.scalar(body.continuousMode);
        hash.scalar(body.mass);
        visitValue(hash, body.inertia);
        visitValue(hash, body.centerOfMass);
        hash.scalar(body.gravityScale);
        hash.scalar(body.linearVelocityKept);
        hash.scalar(body.angularVelocityKept);
    }
    hash.size(world.contacts.shapes().size());
    for (const ShapeRecord<S>& shape : world.contacts.shapes().records()) {
        hash.scalar(shape.body);
        hash.scalar(shape.material);
        hash.scalar(shape.sensor);
        hash.scalar(shape.density);
        visitValue(hash, shape.local);
        hash.size(shape.shape.index());
        const Aabb<S> box = boundingBox<S>(shape.shape, Pose<S>{});
        visitValue(hash, box.min);
        visitValue(hash, box.max);
    }
    hash.size(world.joints.records().size());
    for (const auto& record : world.joints.records()) {
        const Joint<S>& joint = record.joint;
        hash.scalar(joint.type);
        hash.scalar(joint.a);
        hash.scalar(joint.b);
        visitValue(hash, joint.anchorA);
        visitValue(hash, joint.anchorB);
        hash.scalar(joint.length);
    }
    hash.size(world.forces.size());
    for (const auto& record : world.forces.records()) {
        hash.size(record.def.index());
        hash.scalar(record.place.a);
        hash.scalar(record.place.b);
        visitValue(hash, record.place.armA);
        visitValue(hash, record.place.armB);
    }
    return hash.value();
}

/// Indices within their arrays, handles that lead back to what they name.
template <class S>
void checkRestored(const WorldParts<S>& world, std::size_t bodyCount) {
    const BodyArrays<S>& bodies = world.bodies.arrays();
    const IdTable<BodyTag>& bodyIds = world.bodies.ids();
    const auto require = &ByteReader::require;
    require(bodies.id.size() == bodyCount && bodies.pose.size() == bodyCount &&
                bodies.velocity.size() == bodyCount && bodies.wrench.size() == bodyCount &&
                bodies.asleep.size() == bodyCount && bodies.stillTime.size() == bodyCount &&
                bodies.islands.size() == bodyCount,
            "another number of bodies");
    const Midpoints<S>& midpoints = bodies.midpoints;
    const std::size_t known = midpoints.pose.size();
    require(known <= bodyCount && midpoints.velocity.size() == known && midpoints.valid.size() == known,
            "midpoints of another number of bodies");
    for (std::size_t i = 1; i < bodyCount; ++i)
        require(bodyIds.contains(bodies.id[i]) && bodyIds.dense(bodies.id[i]) == i, "a body without a name");
    const ShapeSet<S>& shapes = world.contacts.shapes();
    for (std::size_t i = 0; i < shapes.size(); ++i)
        require(shapes.ids().contains(shapes[i].id) && shapes.ids().dense(shapes[i].id) == i,
                "a shape without a name");
    const auto& joints = world.joints.records();
    const IdTable<JointTag>& jointIds = world.joints.ids();
    for (std::size_t i = 0; i < joints.size(); ++i)
        require(jointIds.contains(joints[i].joint.id) && jointIds.dense(joints[i].joint.id) == i &&
                    joints[i].rows <= joints[i].total.size(),
                "a joint without a name");
    for (const Contact<S>& contact : world.contacts.list())
        require(contact.shapeA < shapes.size() && contact.shapeB < shapes.size() &&
                    contact.bodyA == shapes[contact.shapeA].body &&
                    contact.bodyB == shapes[contact.shapeB].body,
                "a contact of shapes that are not there");
}

}  // namespace

template <class S>
std::uint64_t World<S>::stateHash() const {
    HashArchive hash;
    visitState<S>(hash, parts_);
    return hash.value();
}

template <class S>
void World<S>::saveSnapshot(std::vector<unsigned char>& bytes) const {
    if (stepping()) throw EngineError("step_in_progress", "a snapshot is of the time between steps");
    bytes.assign(std::begin(kMagic), std::end(kMagic));
    ByteWriter writer(bytes);
    Header header;
    header.dimension = S::dim;
    header.realSize = sizeof(Real);
    header.structure = structureHash<S>(parts_);
    for (const auto& record : parts_.joints.records()) header.joints.push_back(record.joint.id);
    visitHeader(writer, header);
    visitState<S>(writer, parts_);
    writer.scalar(checksum(bytes));
}

template <class S>
void World<S>::restoreSnapshot(std::span<const unsigned char> bytes) {
    if (stepping()) throw EngineError("step_in_progress", "a snapshot is restored between steps");
    constexpr std::size_t kEnds = sizeof kMagic + sizeof(std::uint64_t);
    if (bytes.size() < kEnds || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
        throw EngineError("snapshot_format", "not a snapshot");
    std::uint64_t stored = 0;
    const auto body = bytes.first(bytes.size() - sizeof stored);
    std::memcpy(&stored, bytes.data() + body.size(), sizeof stored);
    ByteReader::require(stored == checksum(body), "the bytes are not those that were saved");
    ByteReader reader(body.subspan(sizeof kMagic));
    Header header;
    visitHeader(reader, header);
    if (header.version != kVersion || header.byteOrder != kByteOrder)
        throw EngineError("snapshot_format", "of another version or machine");
    World next(*this);  // this world stays as it is if anything below throws
    for (const auto& record : parts_.joints.records())
        if (std::find(header.joints.begin(), header.joints.end(), record.joint.id) == header.joints.end())
            next.removeJoint(record.joint.id);
    if (header.dimension != S::dim || header.realSize != sizeof(Real) ||
        header.structure != structureHash<S>(next.parts_))
        throw EngineError("snapshot_world", "of a world with other bodies, shapes, joints or forces");
    WorldParts<S>& restored = next.parts_;
    visitState<S>(reader, restored);
    reader.end();
    checkRestored<S>(restored, parts_.bodies.size());
    ByteReader::require(restored.contacts.completeRestored(),
                        "contacts and pairs that do not belong together");
    restored.islands.changed();
    BodyArrays<S>& bodies = restored.bodies.arrays();
    for (std::size_t i = 0; i < bodies.size(); ++i) {  // state that follows from the sleep flags
        const BodyConstants<S>& constants = bodies.constants[i];
        const bool awake = constants.type == BodyType::Dynamic && !bodies.asleep[i];
        bodies.invMass[i] = awake ? Real(1) / constants.mass : Real(0);
        bodies.invInertia[i] = zeroInertia<S>();
    }
    const auto sizeOf = [&bodies](std::uint32_t a, std::uint32_t b) {
        return std::max(bodies.islands[a], bodies.islands[b]);
    };
    for (Contact<S>& contact : restored.contacts.list())
        contact.islands = sizeOf(contact.bodyA, contact.bodyB);
    for (auto& record : restored.joints.records()) record.islands = sizeOf(record.joint.a, record.joint.b);
    restored.contacts.structureChanged();
    restored.algorithms.broadPhase->reset();
    next.step_.result = {};
    *this = std::move(next);
}

#define RIGOR_INSTANTIATE(S)                                                 \
    template std::uint64_t World<S>::stateHash() const;                      \
    template void World<S>::saveSnapshot(std::vector<unsigned char>&) const; \
    template void World<S>::restoreSnapshot(std::span<const unsigned char>);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
