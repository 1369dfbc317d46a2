// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "scenarios/exchange/write/write.hpp"

namespace rigor::models {

using scenario::BodyType;
using scenario::kNone;
using scenario::Mat3;
using scenario::Scenario;
using scenario::Vec3;

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) < 32)
            out += ' ';
        else
            out += c;
    }
    return out;
}

std::string besideName(const Scenario& s, const std::string& part) {
    std::string out = s.name + "_" + part;
    for (char& c : out)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
    return out;
}

std::string heightBytes(const scenario::HeightField& field, double lowest, double range) {
    const std::int32_t size[2] = {field.columns, field.rows};
    std::vector<float> heights;
    for (int i = 0; i < field.columns; ++i)
        for (int k = 0; k < field.rows; ++k) {
            const double height = field.heights[static_cast<std::size_t>(k * field.columns + i)];
            heights.push_back(static_cast<float>((height - lowest) / range));
        }
    std::string bytes(sizeof size + heights.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), size, sizeof size);
    std::memcpy(bytes.data() + sizeof size, heights.data(), heights.size() * sizeof(float));
    return bytes;
}

Principal principalOf(const Mat3& tensor) {
    Mat3 a = tensor, axes = Mat3::diagonal(1.0, 1.0, 1.0);
    for (int sweep = 0; sweep < 50; ++sweep) {
        double off = 0.0;
        for (int p = 0; p < 3; ++p)
            for (int q = p + 1; q < 3; ++q) {
                off = std::max(off, std::abs(a(p, q)));
                if (a(p, q) == 0.0) continue;
                const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
                const double t =
                    (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                Mat3 turn = Mat3::diagonal(1.0, 1.0, 1.0);
                turn(p, p) = turn(q, q) = c;
                turn(p, q) = s;
                turn(q, p) = -s;
                a = transpose(turn) * a * turn;
                axes = axes * turn;
            }
        if (off == 0.0) break;
    }
    scenario::Quat q;
    const double trace = axes(0, 0) + axes(1, 1) + axes(2, 2);
    // Jacobi rotations of small angles: the axes are never half a turn away, so that w is largest or a column decides.
    if (trace > 0.0)
        q = {1.0 + trace, axes(2, 1) - axes(1, 2), axes(0, 2) - axes(2, 0), axes(1, 0) - axes(0, 1)};
    else if (axes(0, 0) >= axes(1, 1) && axes(0, 0) >= axes(2, 2))
        q = {axes(2, 1) - axes(1, 2), 1.0 + axes(0, 0) - axes(1, 1) - axes(2, 2), axes(0, 1) + axes(1, 0),
             axes(0, 2) + axes(2, 0)};
    else if (axes(1, 1) >= axes(2, 2))
        q = {axes(0, 2) - axes(2, 0), axes(0, 1) + axes(1, 0), 1.0 - axes(0, 0) + axes(1, 1) - axes(2, 2),
             axes(1, 2) + axes(2, 1)};
    else
        q = {axes(1, 0) - axes(0, 1), axes(0, 2) + axes(2, 0), axes(1, 2) + axes(2, 1),
             1.0 - axes(0, 0) - axes(1, 1) + axes(2, 2)};
    return {{a(0, 0), a(1, 1), a(2, 2)}, normalized(q)};
}

JointTree treeOf(const Scenario& s, const std::vector<bool>& mayBeEdge) {
    JointTree tree;
    tree.above.resize(s.bodies.size());
    const auto isDynamic = [&](int body) {
        return body != kNone && s.bodies[static_cast<std::size_t>(body)].type == BodyType::Dynamic;
    };
    const auto above = [&](int body) -> TreeJoint& { return tree.above[static_cast<std::size_t>(body)]; };
    const auto isBelow = [&](int body, int ancestor) {
        for (int b = body; b != kNone; b = above(b).joint == kNone ? kNone : above(b).parent)
            if (b == ancestor) return true;
        return false;
    };
    for (std::size_t i = 0; i < s.joints.size(); ++i) {
        const scenario::Joint& j = s.joints[i];
        const int index = static_cast<int>(i);
        const bool forwards =
            isDynamic(j.bodyB) && above(j.bodyB).joint == kNone && !isBelow(j.bodyA, j.bodyB);
        const bool backwards =
            isDynamic(j.bodyA) && above(j.bodyA).joint == kNone && !isBelow(j.bodyB, j.bodyA);
        if (mayBeEdge[i] && forwards)
            above(j.bodyB) = {index, j.bodyA, false};
        else if (mayBeEdge[i] && backwards)
            above(j.bodyA) = {index, j.bodyB, true};
        else
            tree.loops.push_back(index);
    }
    std::vector<bool> done(s.bodies.size(), false);
    while (tree.order.size() < s.bodies.size())
        for (std::size_t b = 0; b < s.bodies.size(); ++b) {
            const TreeJoint& t = tree.above[b];
            const bool ready =
                t.joint == kNone || t.parent == kNone || done[static_cast<std::size_t>(t.parent)];
            if (done[b] || !ready) continue;
            done[b] = true;
            tree.order.push_back(static_cast<int>(b));
        }
    return tree;
}

void refuseCommon(const Scenario& s, Report& report) {
    const Place place{s.name, 0};
    if (s.dimension != 3) throw Refusal(place, "a scenario of two dimensions");
    if (!s.forces.empty())
        report.leavesOut("forces", "forces", place, "forces of a scenario have no counterpart");
    if (!s.events.empty())
        report.leavesOut("events", "events", place, "events of a scenario have no counterpart");
    for (const scenario::Body& b : s.bodies) {
        if (b.linearVelocityKept != 1.0 || b.angularVelocityKept != 1.0)
            report.leavesOut("damping", "damping", place, "damping of the body '" + b.name + "'");
        if (b.gravityScale != 1.0)
            report.leavesOut("gravity_scale", "gravity_scale", place,
                             "a gravity of its own for '" + b.name + "'");
        for (const scenario::Shape& shape : b.shapes)
            if (shape.surfaceVelocity.moves())
                report.leavesOut("surface_velocity", "surface_velocity", place,
                                 "a moving surface of '" + b.name + "'");
    }
    for (const scenario::Joint& j : s.joints)
        if (j.breakForce < 1e299 || j.breakTorque < 1e299)
            report.leavesOut("breaking", "break_force", place, "the joint '" + j.name + "' breaks");
}

}  // namespace rigor::models
