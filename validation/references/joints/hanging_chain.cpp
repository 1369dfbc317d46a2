// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A chain of rigid links hangs at rest between two fixed points. With T the pull at the first hinge, the pull
// at the next is T_(i+1) = T_i - m_i g, and balance of moments turns link i, whose centre of mass is the part
// c_i of its length l_i from its first hinge, into the direction of T_i - (1 - c_i) m_i g:
//   sum l_i (T_i - (1 - c_i) m_i g)/|...| = end - start,
// two equations for T (Newton's method); of uniform links tan = (V + (i + 1/2) m g)/H. The shape is not a
// catenary.
// Source: Routh, A Treatise on Analytical Statics, 1891, ch. 10; Beer and Johnston, Vector Mechanics for
// Engineers: Statics, ch. 7. Assumes: hinges or ball joints in a row between two fixed points, all at rest
// where they hang, gravity alone. Quantities: sag (depth of the lowest hinge under the first), at the end.
#include <algorithm>
#include <cmath>

#include "validation/references/joints/joint_parts.hpp"
#include "validation/references/numerics/vector.hpp"

namespace rigor::validation {
namespace {

using namespace numerics;
using scenario::kNone;

class HangingChain : public Reference {
  public:
    HangingChain(const Scenario& scenario, std::vector<int> bodies) : scenario_(scenario) {
        order(std::move(bodies));
        balance();
        placeLinks();
    }
    std::vector<int> bodies() const override {
        std::vector<int> result;
        for (const Link& link : links_) result.push_back(link.body);
        return result;
    }
    PartialState exact(int index, double) const override {
        for (const Link& link : links_)
            if (link.body == index) {
                const Body& body = scenario_.bodies[index];
                return stateOf(body, link.center, body.pose.orientation, {}, {});
            }
        throw std::invalid_argument("hanging_chain: unknown body");
    }
    std::vector<Quantity> quantities(double, adapter::Scheme) const override {
        const Vec3 down = unit(gravityOn(scenario_, links_.front().body));
        double sag = 0.0;
        for (const Link& link : links_) sag = std::max(sag, dot(down, link.end - start_));
        Quantity q{"sag", "m", sag, {}, sag, {}};
        q.measure = [this, down](const Trajectory& run) -> std::optional<double> {
            double deepest = 0.0;
            for (const Link& link : links_) {
                const auto& state = run.state(run.frames() - 1, link.body);
                const Vec3 tip = state.position + rotate(state.orientation, link.tip);
                deepest = std::max(deepest, dot(down, tip - start_));
            }
            return deepest;
        };
        return {q};
    }

  private:
    struct Link {
        int body = 0;
        Real length = 0, part = 0, mass = 0;
        Vec3 tip;          ///< second hinge, body frame
        Vec3 center, end;  ///< places where they hang
    };
    bool isFixed(int body) const {
        return body == kNone || scenario_.bodies[body].type == scenario::BodyType::Static;
    }

    /// Follows the joints from the world and back to it.
    void order(std::vector<int> bodies) {
        std::vector<bool> used(scenario_.joints.size(), false);
        int at = kNone;
        Vec3 hinge{};
        for (std::size_t n = 0; n <= bodies.size(); ++n) {
            const scenario::Joint* next = nullptr;
            for (std::size_t j = 0; j < used.size() && !next; ++j) {
                const auto& joint = scenario_.joints[j];
                const bool here = n == 0 ? isFixed(joint.bodyA) != isFixed(joint.bodyB)
                                         : joint.bodyA == at || joint.bodyB == at;
                if (used[j] || !here) continue;
                used[j] = true;
                next = &joint;
            }
            require(next != nullptr, "the chain does not reach from one fixed point to another");
            require(next->type == scenario::JointType::Hinge || next->type == scenario::JointType::Ball,
                    "joint '" + next->name + "' is neither a hinge nor a ball joint");
            requirePassive(*next);
            const Vec3 place = anchorOf(scenario_, *next, next->bodyA);
            if (n == 0) start_ = place;
            if (n > 0) addLink(at, hinge, place);
            const int other = n == 0 ? (isFixed(next->bodyA) ? next->bodyB : next->bodyA)
                                     : (next->bodyA == at ? next->bodyB : next->bodyA);
            hinge = place;
            at = other;
            if (n == bodies.size()) end_ = place;
        }
        require(isFixed(at), "the chain does not end at a fixed point");
        require(links_.size() == bodies.size(), "not every body is a link of the chain");
    }
    void addLink(int index, Vec3 from, Vec3 to) {
        require(!isFixed(index), "the chain ends before all its links");
        requireUndisturbed(scenario_, index, {.joints = true});
        requireStill(scenario_, index);
        const Body& body = scenario_.bodies[index];
        const Vec3 arm = to - from, com = centerOfMass(body) - from;
        Link link;
        link.body = index;
        link.length = norm(arm);
        link.mass = body.massProperties.mass;
        link.part = dot(com, arm) / dot(arm, arm);
        require(norm(com - static_cast<double>(link.part) * arm) <= 1e-9 * norm(arm),
                "the centre of mass of " + bodyTitle(scenario_, index) + " is off the line of its hinges");
        link.tip = rotateInverse(body.pose.orientation, to - body.pose.position);
        links_.push_back(link);
    }

    /// End of the chain for the pull T at its start; the places of its links go to `links`.
    Real3 follow(Real3 pull, std::vector<Link>* links) const {
        Real3 at = real3(start_);
        for (std::size_t i = 0; i < links_.size(); ++i) {
            const Link& link = links_[i];
            const Real3 weight = link.mass * real3(gravityOn(scenario_, link.body));
            const Real3 along = pull - (1 - link.part) * weight;
            const Real3 arm = (link.length / norm(along)) * along;
            if (links) {
                (*links)[i].center = toVec3(at + link.part * arm);
                (*links)[i].end = toVec3(at + arm);
            }
            at = at + arm;
            pull = pull - weight;
        }
        return at;
    }

    void balance() {
        const Real3 goal = real3(end_);
        Real reach = 0, weight = 0;
        for (const Link& link : links_) {
            reach += link.length;
            weight += link.mass * norm(real3(gravityOn(scenario_, link.body)));
        }
        require(weight > 0, "no gravity acts on the chain");
        require(norm(goal - real3(start_)) < 0.9999L * reach, "the chain is too short for its two ends");
        const Vec3 g = gravityOn(scenario_, links_.front().body);
        const Vec3 span = end_ - start_, side = span - (dot(span, g) / dot(g, g)) * g;
        require(norm(side) > 1e-6 * norm(span), "the ends of the chain are above each other");
        // Axes of the plane of gravity and the ends. The iteration starts with half the weight at each end,
        // and as much across.
        const Real3 e1 = real3(unit(side)), e2 = real3(-1.0 * unit(g));
        Real h = weight / 2, v = -weight / 2;
        for (int k = 0; k < 200; ++k) {
            const auto miss = [&](Real a, Real b) { return follow(a * e1 + b * e2, nullptr) - goal; };
            const Real d = 1e-7L * weight;
            const Real3 m = miss(h, v), ma = (1 / (2 * d)) * (miss(h + d, v) - miss(h - d, v)),
                        mb = (1 / (2 * d)) * (miss(h, v + d) - miss(h, v - d));
            const Real a11 = dot(ma, e1), a21 = dot(ma, e2), a12 = dot(mb, e1), a22 = dot(mb, e2);
            const Real det = a11 * a22 - a12 * a21, r1 = dot(m, e1), r2 = dot(m, e2);
            const Real dh = (r1 * a22 - r2 * a12) / det, dv = (r2 * a11 - r1 * a21) / det;
            const Real step = std::min(
                Real(1), 0.3L * std::max(std::abs(h), std::abs(v)) / std::max(std::abs(dh), std::abs(dv)));
            h -= step * dh;
            v -= step * dv;
            if (norm(m) < 1e-15L * reach) break;
        }
        require(norm(follow(h * e1 + v * e2, nullptr) - goal) < 1e-12L * reach, "the chain finds no balance");
        std::vector<Link> placed = links_;
        follow(h * e1 + v * e2, &placed);
        links_ = placed;
    }

    void placeLinks() const {
        for (const Link& link : links_) {
            const Body& body = scenario_.bodies[link.body];
            const double off = norm(centerOfMass(body) - link.center);
            require(off <= 1e-6 * static_cast<double>(link.length),
                    bodyTitle(scenario_, link.body) + " does not start where it hangs, " +
                        shown(link.center, scenario_.dimension));
        }
    }

    const Scenario& scenario_;
    std::vector<Link> links_;
    Vec3 start_, end_;
};

}  // namespace

std::unique_ptr<Reference> makeHangingChain(const Scenario& scenario, const scenario::ReferenceSpec& spec) {
    const Parts parts(scenario, spec, {"bodies"});
    return std::make_unique<HangingChain>(scenario, parts.dynamicBodies("bodies"));
}

}  // namespace rigor::validation
