// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Equalities, tendons and the rules of contacts of a compiled MuJoCo model. A tendon between two sites is a distance
// joint (a rope, a spring). The law of two surfaces is that of the higher priority, else the larger value of each.
#include <algorithm>
#include <cmath>
#include <map>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

using scenario::AxisMode;
using scenario::Joint;
using scenario::JointType;
using scenario::kNone;
using scenario::PairCoefficients;
using scenario::Vec3;

constexpr double kMostGap = 1e-9;  ///< [m, rad] largest violation at the start that is rounding

/// Bodies of an equality, and where it holds them at the start.
struct Ends {
    int one, two;
    Vec3 at;
};

Ends endsOf(const Conversion& c, int e) {
    const int one = c.m.eq_obj1id[e], two = c.m.eq_obj2id[e];
    const bool ofSites = !c.m.eq_objtype.empty() && c.m.eq_objtype[e] == mjOBJ_SITE;
    if (ofSites) return {c.m.site_bodyid[one], c.m.site_bodyid[two], c.point(c.m.site_xpos, one)};
    const Vec3 local = c.m.eq_type[e] == mjEQ_WELD ? Vec3{} : c.point(c.m.eq_data, e, mjNEQDATA);
    return {one, two, c.point(c.m.xpos, one) + rotate(c.turn(c.m.xquat, one), local)};
}

void addEquality(Conversion& c, int e) {
    const Place place = c.placeOf(c.places.equalities, e);
    const bool isWeld = c.m.eq_type[e] == mjEQ_WELD;
    const std::string shown = isWeld ? "<weld>" : "<connect>";
    if (c.m.eq_active[e] == 0) return c.report.noPhysics(shown, place, "it is not active");
    if (c.isOff("equality")) return c.report.noPhysics(shown, place, "the file switches equalities off");
    if (!isWeld && c.m.eq_type[e] != mjEQ_CONNECT)
        return c.report.refuse("<equality>", place, "only connect and weld have a counterpart");
    const Ends ends = endsOf(c, e);
    int a = c.endOf(ends.one), b = c.endOf(ends.two);
    if (b == kNone) std::swap(a, b);
    if (b == kNone || a == b)
        return c.report.noPhysics(shown, place, "it connects two bodies that do not move");
    if (c.m.eq_violation[e] > kMostGap)
        return c.report.refuse(shown, place, "the bodies are not where it holds them at the start");
    const std::string name = c.nameOf(c.m.equality_names, e, "equality_" + std::to_string(e));
    c.builder
        .addJoint(name, isWeld ? JointType::Fixed : JointType::Ball, a, b, ends.at, {0.0, 0.0, 1.0}, place)
        .collideConnected = true;
}

/// MuJoCo 3 has springs with a dead band, and springs and dampers whose force is a polynomial.
bool isPlainSpring(const Conversion& c, int t) {
    const auto isZero = [t](const Array<double>& numbers, int width) {
        return numbers.empty() || std::all_of(numbers.from(width * t), numbers.from(width * (t + 1)),
                                              [](double x) { return x == 0.0; });
    };
    return isZero(c.m.tendon_stiffnesspoly, 2) && isZero(c.m.tendon_dampingpoly, 2) &&
           isZero(c.m.tendon_deadband, 1);
}

void addTendon(Conversion& c, int t) {
    const Place place = c.placeOf(c.places.tendons, t);
    const int first = c.m.tendon_adr[t];
    const bool isPlain = c.m.tendon_num[t] == 2 && c.m.wrap_type[first] == mjWRAP_SITE &&
                         c.m.wrap_type[first + 1] == mjWRAP_SITE;
    const bool isLimited = c.m.tendon_limited[t] != 0 && !c.isOff("limit");
    if (!isPlainSpring(c, t))
        return c.report.refuse("<spatial>", place,
                               "a spring with a dead band or a force that is not linear has no counterpart");
    const bool isSpring =
        !c.isOff("passive") && (c.m.tendon_stiffness[t] > 0.0 || c.m.tendon_damping[t] > 0.0);
    if (!isLimited && !isSpring)
        return c.report.noPhysics("<spatial>", place, "a tendon without limit and spring");
    if (!isPlain) {
        c.report.leavesOut("tendons", "<spatial>", place, "only a tendon of two sites has a counterpart");
        return;
    }
    const int siteA = c.m.wrap_objid[first], siteB = c.m.wrap_objid[first + 1];
    int a = c.endOf(c.m.site_bodyid[siteA]), b = c.endOf(c.m.site_bodyid[siteB]);
    Vec3 pointA = c.point(c.m.site_xpos, siteA), pointB = c.point(c.m.site_xpos, siteB);
    if (b == kNone) {
        std::swap(a, b);
        std::swap(pointA, pointB);
    }
    if (a == b) return c.report.noPhysics("<spatial>", place, "its ends do not move against each other");
    const std::string name = c.nameOf(c.m.tendon_names, t, "tendon_" + std::to_string(t));
    Joint& made = c.builder.addJoint(name, JointType::Distance, a, b, pointA, {0.0, 0.0, 1.0}, place);
    made.anchorB = inverse(c.builder.scene.bodies[static_cast<std::size_t>(b)].pose) * pointB;
    made.length = norm(pointB - pointA);
    made.collideConnected = true;
    auto& axis = made.axes[0];
    axis.mode = AxisMode::Free;
    if (isLimited) {
        axis.mode = AxisMode::Limited;
        if (c.m.tendon_range[2 * t] > 0.0) axis.lower = c.m.tendon_range[2 * t];
        axis.upper = c.m.tendon_range[2 * t + 1];
    }
    axis.target = made.length;
    if (isSpring) {
        axis.stiffness = c.m.tendon_stiffness[t];
        axis.damping = c.m.tendon_damping[t];
        axis.target = c.m.tendon_lengthspring[t];
    }
    c.report.changed("<spatial>", place, "a tendon of two sites is a distance joint");
}

PairCoefficients lawOf(const Vec3& friction, int dimension) {
    return {dimension > 1 ? friction.x : 0.0, 0.0, 0.0, dimension > 4 ? friction.z : 0.0,
            dimension > 3 ? friction.y : 0.0};
}

PairCoefficients largerOf(const Surface& a, const Surface& b) {
    if (a.priority != b.priority) {
        const Surface& s = a.priority > b.priority ? a : b;
        return lawOf({s.friction, s.torsional, s.rolling}, s.contactDimension);
    }
    return lawOf({std::max(a.friction, b.friction), std::max(a.torsional, b.torsional),
                  std::max(a.rolling, b.rolling)},
                 std::max(a.contactDimension, b.contactDimension));
}

/// Pairs of bodies that never touch in MuJoCo: those welded together, a body and the one above it, excluded ones.
std::set<std::pair<int, int>> apartBodies(const CompiledModel& m, bool filtersParents) {
    std::map<int, std::vector<int>> groups;
    for (int body = 0; body < m.nbody; ++body) groups[m.body_weldid[body]].push_back(body);
    std::set<std::pair<int, int>> apart;
    const auto add = [&](const std::vector<int>& some, const std::vector<int>& others) {
        for (const int a : some)
            for (const int b : others)
                if (a != b) apart.insert(std::minmax(a, b));
    };
    for (const auto& [weld, bodies] : groups) {
        add(bodies, bodies);
        const int above = m.body_weldid[m.body_parentid[weld]];
        if (weld != 0 && above != 0 && filtersParents) add(bodies, groups[above]);
    }
    for (int e = 0; e < m.nexclude; ++e)
        apart.insert(std::minmax((m.exclude_signature[e] >> 16) - 1, (m.exclude_signature[e] & 0xFFFF) - 1));
    return apart;
}

}  // namespace

void addConstraints(Conversion& c) {
    for (int e = 0; e < c.m.neq; ++e) addEquality(c, e);
    for (int t = 0; t < c.m.ntendon; ++t) addTendon(c, t);
}

void addContactRules(Conversion& c) {
    c.builder.setMixing(largerOf, "MuJoCo's rule, the larger value of each");
    std::set<std::pair<int, int>> pairs;
    for (int p = 0; p < c.m.npair && !c.m.onlyDynamic; ++p) {
        const auto ends = std::minmax(c.m.pair_geom1[p], c.m.pair_geom2[p]);
        const double* f = c.m.pair_friction.from(5 * p);
        if (c.m.pair_dim[p] > 1 && f[0] != f[1])
            c.report.leavesOut("anisotropic_friction", "<pair> friction",
                               {c.options.file.filename().string(), 0},
                               "friction that depends on the direction has no counterpart");
        pairs.insert(ends);
        c.builder.setPair(ends.first + 1, ends.second + 1, lawOf({f[0], f[2], f[3]}, c.m.pair_dim[p]));
    }
    if (c.isOff("contact")) return;
    auto apart = apartBodies(c.m, !c.isOff("filterparent"));
    // Bodies that a joint connects do not touch in a scenario: they need no layers.
    std::set<std::pair<int, int>> joined;
    for (const Joint& j : c.builder.scene.joints)
        if (!j.collideConnected) joined.insert(std::minmax(j.bodyA, j.bodyB));
    std::erase_if(apart, [&](const auto& pair) {
        const auto bodies = std::minmax(c.bodyOf[static_cast<std::size_t>(pair.first)],
                                        c.bodyOf[static_cast<std::size_t>(pair.second)]);
        return bodies.first == kNone || joined.contains(bodies);
    });
    const CompiledModel* m = &c.m;
    c.builder.setContacts([m, pairs, apart](int a, int b) {
        if (pairs.contains(std::minmax(a, b))) return true;
        if (m->onlyPairs) return false;
        if (apart.contains(std::minmax(m->geom_bodyid[a], m->geom_bodyid[b]))) return false;
        return (m->geom_contype[a] & m->geom_conaffinity[b]) != 0 ||
               (m->geom_contype[b] & m->geom_conaffinity[a]) != 0;
    });
}

}  // namespace rigor::models::mjcf
