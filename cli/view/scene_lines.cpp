// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/scene_lines.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adapters/rigor/convert_shape.hpp"
#include "engine/core/disjoint_sets.hpp"
#include "scenarios/model/nearest.hpp"

namespace rigor::cli {
namespace {

using engine::DebugKind;
using scenario::BodyType;

template <class S>
engine::Pose<S> poseOf(const adapter::BodyState& state) {
    return adapter::toEnginePose<S>({state.position, state.orientation});
}
template <class S>
engine::Pose<S> shapePoseOf(const adapter::BodyState& body, const scenario::Shape& shape) {
    return engine::compose<S>(poseOf<S>(body), adapter::toEnginePose<S>(shape.pose));
}
template <class S>
engine::Aabb<S> leastBox(const adapter::BodyState& body, const scenario::Shape& shape) {
    return engine::boundingBox<S>(adapter::toEngineShape<S>(shape.geometry), shapePoseOf<S>(body, shape));
}

template <class S>
class SceneLines {
  public:
    using Vec = typename S::Vec;
    SceneLines(const Scene& scene, const engine::DebugOptions<S>& options, engine::LineSink<S>& sink)
        : scene_(scene), options_(options), sink_(sink) {}

    void drawBody(int body) {
        for (const scenario::Shape& shape : bodyOf(body).shapes) {
            if (options_.outlines)
                engine::drawShape<S>(adapter::toEngineShape<S>(shape.geometry),
                                     shapePoseOf<S>(stateOf(body), shape), idOf(body), options_, sink_);
            if (options_.boxes && scene_.boxes.empty() && hasEnd(shape))
                engine::drawBox<S>(leastBox<S>(stateOf(body), shape), idOf(body), sink_);
        }
        engine::drawVelocity<S>(centerOf(body), adapter::toEngineVec<S>(stateOf(body).velocity), idOf(body),
                                options_, sink_);
    }
    void drawBoxes() {
        if (!options_.boxes) return;
        for (const adapter::ShapeBox& box : scene_.boxes)
            if (hasEnd(bodyOf(box.of.body).shapes[static_cast<std::size_t>(box.of.shape)]))
                engine::drawBox<S>(
                    {adapter::toEngineVec<S>(box.box.min), adapter::toEngineVec<S>(box.box.max)},
                    idOf(box.of.body), sink_);
    }
    void drawContact(const adapter::ContactPoint& c) {
        const Vec at = 0.5 * (adapter::toEngineVec<S>(c.pointA) + adapter::toEngineVec<S>(c.pointB));
        const Vec normal = adapter::toEngineVec<S>(c.normal);
        const Vec impulse = c.hasImpulse
                                ? Vec(c.normalImpulse * normal + adapter::toEngineVec<S>(c.frictionImpulse))
                                : Vec(Vec::Zero());
        engine::drawContact<S>(at, normal, impulse, idOf(c.bodyB), options_, sink_);
    }
    void drawJoint(const scenario::Joint& joint) {
        const engine::BodyId a = idOf(joint.bodyA), b = idOf(joint.bodyB);
        const Vec anchorA = anchorOf(joint.bodyA, joint.anchorA),
                  anchorB = anchorOf(joint.bodyB, joint.anchorB);
        if (a) sink_.line(centerOf(joint.bodyA), anchorA, DebugKind::Joint, a);
        if (b) sink_.line(centerOf(joint.bodyB), anchorB, DebugKind::Joint, b);
        engine::drawAnchors<S>(anchorA, anchorB, a, b, sink_);
    }
    void drawIsland(const std::vector<int>& island) {
        double mass = 0.0;
        Vec center = Vec::Zero();
        for (const int body : island) {
            mass += bodyOf(body).massProperties.mass;
            center += bodyOf(body).massProperties.mass * centerOf(body);
        }
        center /= mass;
        for (const int body : island) sink_.line(centerOf(body), center, DebugKind::Island, idOf(body));
    }

  private:
    static engine::BodyId idOf(int body) {
        return body == scenario::kNone ? engine::BodyId{}
                                       : engine::BodyId{static_cast<std::uint32_t>(body + 1), 0};
    }
    /// False for half-spaces: their boxes have no end.
    static bool hasEnd(const scenario::Shape& shape) {
        return !std::holds_alternative<scenario::HalfSpace>(shape.geometry);
    }
    const scenario::Body& bodyOf(int body) const {
        return scene_.scenario->bodies[static_cast<std::size_t>(body)];
    }
    const adapter::BodyState& stateOf(int body) const {
        return scene_.states[static_cast<std::size_t>(body)];
    }
    Vec centerOf(int body) const {
        return engine::toWorld<S>(poseOf<S>(stateOf(body)),
                                  adapter::toEngineVec<S>(bodyOf(body).massProperties.centerOfMass));
    }
    Vec anchorOf(int body, const scenario::Vec3& anchor) const {
        const Vec local = adapter::toEngineVec<S>(anchor);
        return body == scenario::kNone ? local : engine::toWorld<S>(poseOf<S>(stateOf(body)), local);
    }

    const Scene& scene_;
    const engine::DebugOptions<S>& options_;
    engine::LineSink<S>& sink_;
};

/// Islands of dynamic bodies by contacts and joints.
std::vector<std::vector<int>> islandsOf(const Scene& scene) {
    const std::vector<scenario::Body>& bodies = scene.scenario->bodies;
    engine::DisjointSets sets;
    sets.begin(static_cast<std::uint32_t>(bodies.size()));
    const auto moves = [&](int body) {
        return body != scenario::kNone && bodies[static_cast<std::size_t>(body)].type == BodyType::Dynamic;
    };
    const auto join = [&](int a, int b) {
        if (moves(a) && moves(b)) sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    };
    for (const adapter::ContactPoint& contact : scene.contacts) join(contact.bodyA, contact.bodyB);
    for (std::size_t j = 0; j < scene.scenario->joints.size(); ++j)
        if (scene.jointHolds.empty() || scene.jointHolds[j])
            join(scene.scenario->joints[j].bodyA, scene.scenario->joints[j].bodyB);
    std::vector<std::vector<int>> byRoot(bodies.size());
    for (std::uint32_t body = 0; body < bodies.size(); ++body)
        if (moves(static_cast<int>(body))) byRoot[sets.rootOf(body)].push_back(static_cast<int>(body));
    std::erase_if(byRoot, [](const std::vector<int>& island) { return island.empty(); });
    return byRoot;
}

}  // namespace

std::set<DebugKind> kindsOf(const std::string& list, const std::string& option) {
    std::set<DebugKind> kinds;
    std::vector<std::string> names;
    std::string expected;
    for (int i = 0; i < engine::kDebugKinds; ++i) {
        names.emplace_back(engine::debugKindName(static_cast<DebugKind>(i)));
        expected += names.back() + ", ";
    }
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string name = list.substr(begin, end - begin);
        const auto it = std::find(names.begin(), names.end(), name);
        if (it == names.end())
            throw std::invalid_argument(option + ": found '" + name + "', expected some of " + expected +
                                        "with commas between" + scenario::didYouMean(name, names));
        kinds.insert(static_cast<DebugKind>(it - names.begin()));
        begin = end + 1;
    }
    return kinds;
}

template <class S>
engine::DebugOptions<S> optionsFor(const std::set<DebugKind>& kinds) {
    engine::DebugOptions<S> options;
    options.outlines = kinds.contains(DebugKind::Outline);
    options.boxes = kinds.contains(DebugKind::Box);
    options.contacts = kinds.contains(DebugKind::Contact);
    options.normals = kinds.contains(DebugKind::Normal);
    options.impulses = kinds.contains(DebugKind::Impulse);
    options.velocities = kinds.contains(DebugKind::Velocity);
    options.joints = kinds.contains(DebugKind::Joint);
    options.islands = kinds.contains(DebugKind::Island);
    return options;
}

/// Reach of a ground from the origin [m] that is half as wide again as what moves above it.
template <class S>
double groundSize(typename S::Vec low, typename S::Vec high, const scenario::Scenario& scenario) {
    const auto down = adapter::toEngineVec<S>(scenario.gravity);
    int vertical = 0;
    if (down.norm() > 0.0) {
        down.cwiseAbs().maxCoeff(&vertical);
        low[vertical] = high[vertical] = 0.0;
    }
    return 1.5 * low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
}

template <class S>
void fitLengths(const Scene& scene, engine::DebugOptions<S>& options) {
    using Vec = typename S::Vec;
    Vec low = Vec::Constant(1e300), high = Vec::Constant(-1e300);
    double fastest = 0.0, hardest = 0.0;
    for (std::size_t i = 0; i < scene.scenario->bodies.size(); ++i) {
        const scenario::Body& body = scene.scenario->bodies[i];
        if (body.type == BodyType::Static) continue;
        fastest = std::max(fastest, adapter::toEngineVec<S>(scene.states[i].velocity).norm());
        for (const scenario::Shape& shape : body.shapes) {
            const engine::Aabb<S> box = leastBox<S>(scene.states[i], shape);
            low = low.cwiseMin(box.min);
            high = high.cwiseMax(box.max);
        }
    }
    for (const adapter::ContactPoint& c : scene.contacts)
        hardest =
            std::max(hardest, std::hypot(c.normalImpulse, adapter::toEngineVec<S>(c.frictionImpulse).norm()));
    const bool any = (high.array() >= low.array()).all();
    const double length = 0.1 * (any ? (high - low).norm() : 1.0);
    options.normalLength = 0.4 * length;
    if (S::dim == 3 && any) options.planeSize = groundSize<S>(low, high, *scene.scenario);
    if (fastest > 0.0) options.velocityScale = length / fastest;
    if (hardest > 0.0) options.impulseScale = length / hardest;
}

template <class S>
void drawScene(const Scene& scene, const engine::DebugOptions<S>& options, engine::LineSink<S>& sink,
               const std::function<void(bool)>& before) {
    SceneLines<S> lines(scene, options, sink);
    for (std::size_t i = 0; i < scene.scenario->bodies.size(); ++i) {
        before(scene.scenario->bodies[i].type != BodyType::Static);
        lines.drawBody(static_cast<int>(i));
    }
    before(false);
    lines.drawBoxes();
    before(true);
    for (const adapter::ContactPoint& contact : scene.contacts) lines.drawContact(contact);
    for (std::size_t j = 0; options.joints && j < scene.scenario->joints.size(); ++j)
        if (scene.jointHolds.empty() || scene.jointHolds[j]) lines.drawJoint(scene.scenario->joints[j]);
    if (!options.islands) return;
    for (const auto& island : scene.islands.empty() ? islandsOf(scene) : scene.islands)
        lines.drawIsland(island);
}

#define RIGOR_INSTANTIATE(S)                                                                    \
    template engine::DebugOptions<engine::S> optionsFor<engine::S>(const std::set<DebugKind>&); \
    template void fitLengths<engine::S>(const Scene&, engine::DebugOptions<engine::S>&);        \
    template void drawScene<engine::S>(const Scene&, const engine::DebugOptions<engine::S>&,    \
                                       engine::LineSink<engine::S>&, const std::function<void(bool)>&);
RIGOR_INSTANTIATE(Space2d)
RIGOR_INSTANTIATE(Space3d)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::cli
