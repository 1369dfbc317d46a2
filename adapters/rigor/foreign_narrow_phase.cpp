// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The other engine is queried for overlaps only: none of them reports contacts of shapes that are apart, so
// resting bodies sink in by the slop before they are held. Its contacts become one manifold: the normal of
// the deepest, the contacts with the same normal, reduced to four. Engines name no features; points get names
// of their own, and impulses are taken over from the nearest point of the last step.
#include "adapters/rigor/foreign_narrow_phase.hpp"

#include <algorithm>
#include <cstring>

#include "adapters/interface/registry.hpp"
#include "adapters/rigor/convert_shape.hpp"
#include "engine/narrowphase/detail.hpp"

namespace rigor::adapter {
namespace {

constexpr const char* kForeign[] = {"bullet", "fcl"};

/// Contacts requested before the reduction.
constexpr int kMostContacts = 16;
/// Cosine of the largest angle to the deepest contact's normal, 8 degrees: a manifold has one normal.
constexpr double kSameNormal = 0.99;

template <class S>
Geometry toGeometry(const engine::Shape<S>& shape) {
    if (const auto* s = std::get_if<engine::Sphere<S>>(&shape))
        return scenario::Sphere{static_cast<double>(s->radius)};
    if (const auto* s = std::get_if<engine::Box<S>>(&shape))
        return scenario::Box{fromEngineVec(s->halfExtents)};
    if (const auto* s = std::get_if<engine::Capsule<S>>(&shape))
        return scenario::Capsule{static_cast<double>(s->radius), static_cast<double>(s->halfLength)};
    if (const auto* s = std::get_if<engine::HalfSpace<S>>(&shape))
        return scenario::HalfSpace{fromEngineVec(s->normal), static_cast<double>(s->offset)};
    if (const auto* s = std::get_if<engine::Hull<S>>(&shape)) {
        scenario::ConvexHull hull;
        for (const typename S::Vec& v : s->data->vertices) hull.vertices.push_back(fromEngineVec(v));
        return hull;
    }
    throw notInAdapter("rigor", "such a shape in a narrow phase of another engine");
}

template <class S>
Pose toPose(const engine::Pose<S>& X) {
    Pose pose;
    pose.position = fromEngineVec(X.p);
    // A rounded float quaternion is not a unit quaternion in double.
    pose.orientation = scenario::normalized(Quat{static_cast<double>(X.q.w()), static_cast<double>(X.q.x()),
                                                 static_cast<double>(X.q.y()), static_cast<double>(X.q.z())});
    return pose;
}

std::uint32_t nameOf(const Vec3& v) {
    std::uint32_t name = 2166136261u;
    for (const double x : {v.x, v.y, v.z}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        name = (name ^ static_cast<std::uint32_t>(bits ^ (bits >> 32))) * 16777619u;
    }
    return name;
}

template <class S>
class ForeignNarrowPhase final : public engine::NarrowPhase<S> {
  public:
    explicit ForeignNarrowPhase(LoadedEngine loaded) : engine_(std::move(loaded)) {}

    void collide(const engine::Shape<S>& a, const engine::Pose<S>& Xa, const engine::Shape<S>& b,
                 const engine::Pose<S>& Xb, typename S::Real, engine::Manifold<S>& out) const override {
        using R = typename S::Real;
        using V = typename S::Vec;
        out.count = 0;
        const Geometry geometryA = toGeometry<S>(a), geometryB = toGeometry<S>(b);
        CollisionQuery query;
        query.a = {&geometryA, toPose<S>(Xa)};
        query.b = {&geometryB, toPose<S>(Xb)};
        query.maxContacts = kMostContacts;
        const CollisionAnswer answer = engine_->collision()->collide(query);
        const ContactPoint* deepest = nullptr;
        for (const ContactPoint& c : answer.contacts)
            if (c.depth >= 0 && (deepest == nullptr || c.depth > deepest->depth)) deepest = &c;
        if (deepest == nullptr) return;
        std::array<const ContactPoint*, kMostContacts> used;
        int count = 0;
        for (const ContactPoint& c : answer.contacts)
            if (c.depth >= 0 && dot(c.normal, deepest->normal) > kSameNormal && count < kMostContacts)
                used[count++] = &c;
        out.normal = toEngineVec<S>(deepest->normal).normalized();
        const auto at = [&](int i) -> const ContactPoint& { return *used[i]; };
        engine::reducePoints<S>(
            count, out.normal, [&](int i) { return R(-at(i).depth); },
            [&](int i) { return V(toEngineVec<S>(at(i).pointB)); },
            [&](int i) {
                const V onB = toEngineVec<S>(at(i).pointB);
                const R separation = static_cast<R>(-at(i).depth);
                engine::addPoint<S>(out, V(onB - separation * out.normal), onB, separation,
                                    nameOf(at(i).pointB));
            });
    }

  private:
    LoadedEngine engine_;
};

}  // namespace

std::vector<std::string> foreignNarrowPhases() {
    static const std::vector<std::string> names = [] {
        const std::vector<std::string> installed = availableEngines();
        std::vector<std::string> found;
        for (const char* name : kForeign)
            if (std::find(installed.begin(), installed.end(), name) != installed.end())
                found.emplace_back(name);
        return found;
    }();
    return names;
}

bool isForeignNarrowPhase(const std::string& name) {
    return std::find(std::begin(kForeign), std::end(kForeign), name) != std::end(kForeign);
}

template <class S>
std::shared_ptr<const engine::NarrowPhase<S>> makeForeignNarrowPhase(const std::string& name) {
    const std::vector<std::string> installed = foreignNarrowPhases();
    if (std::find(installed.begin(), installed.end(), name) == installed.end())
        throw BadInput("narrow_phase=" + name + ": the adapter '" + name + "' is not installed");
    LoadedEngine loaded = loadEngine(parseSpec(name));
    if (loaded->collision() == nullptr)
        throw BadInput("narrow_phase=" + name + ": the engine has no collision queries");
    return std::make_shared<ForeignNarrowPhase<S>>(std::move(loaded));
}

template std::shared_ptr<const engine::NarrowPhase<engine::Space3f>> makeForeignNarrowPhase(
    const std::string&);
template std::shared_ptr<const engine::NarrowPhase<engine::Space3d>> makeForeignNarrowPhase(
    const std::string&);

}  // namespace rigor::adapter
