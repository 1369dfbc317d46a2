// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include <cctype>
#include <cmath>

#include "scenarios/exchange/mjcf/mjcf.hpp"

namespace rigor::models::mjcf {
namespace {

using scenario::Quat;
using scenario::Vec3;

constexpr double kPi = 3.14159265358979323846;

/// Rotation whose matrix has these orthonormal columns.
Quat fromAxes(const Vec3& x, const Vec3& y, const Vec3& z) {
    const double trace = x.x + y.y + z.z;
    Quat q;
    if (trace > 0.0)
        q = {1.0 + trace, y.z - z.y, z.x - x.z, x.y - y.x};
    else if (x.x >= y.y && x.x >= z.z)
        q = {y.z - z.y, 1.0 + x.x - y.y - z.z, x.y + y.x, z.x + x.z};
    else if (y.y >= z.z)
        q = {z.x - x.z, x.y + y.x, 1.0 - x.x + y.y - z.z, y.z + z.y};
    else
        q = {x.y - y.x, z.x + x.z, y.z + z.y, 1.0 - x.x - y.y + z.z};
    return normalized(q);
}

/// Shortest turn of the z axis to a direction.
Quat turnOfZ(const Vec3& direction) {
    const Vec3 z = direction / norm(direction);
    const Vec3 axis = cross({0.0, 0.0, 1.0}, z);
    const double sine = norm(axis);
    if (sine < 1e-10) return z.z > 0.0 ? Quat{} : Quat{0.0, 1.0, 0.0, 0.0};
    return scenario::fromAxisAngle(axis / sine, std::atan2(sine, z.z));
}

}  // namespace

Compiler compilerOf(XmlFile& file) {
    Compiler compiler;
    for (auto* e = file.root()->FirstChildElement("compiler"); e; e = e->NextSiblingElement("compiler")) {
        if (const char* angle = e->Attribute("angle")) compiler.degrees = std::string_view(angle) == "degree";
        if (const char* sequence = e->Attribute("eulerseq")) compiler.eulerSequence = sequence;
    }
    return compiler;
}

scenario::Pose poseOf(const XmlFile& file, const tinyxml2::XMLElement& element, const Compiler& compiler) {
    const auto numbers = [&](const char* name, std::size_t count) {
        std::vector<double> values;
        if (const char* text = element.Attribute(name))
            if (!readNumbers(text, values) || values.size() != count)
                throw Refusal(file.place(element), std::string("<") + element.Name() + "> " + name +
                                                       ": found '" + text + "', expected " +
                                                       std::to_string(count) + " numbers");
        return values;
    };
    const double unit = compiler.degrees ? kPi / 180.0 : 1.0;
    scenario::Pose pose;
    if (const auto p = numbers("pos", 3); !p.empty()) pose.position = {p[0], p[1], p[2]};
    if (const auto q = numbers("quat", 4); !q.empty())
        pose.orientation = normalized(Quat{q[0], q[1], q[2], q[3]});
    if (const auto a = numbers("axisangle", 4); !a.empty()) {
        const Vec3 axis{a[0], a[1], a[2]};
        pose.orientation = scenario::fromAxisAngle(axis / norm(axis), a[3] * unit);
    }
    if (const auto e = numbers("euler", 3); !e.empty()) {
        Quat q;
        for (std::size_t i = 0; i < 3 && i < compiler.eulerSequence.size(); ++i) {
            const char c = compiler.eulerSequence[i];
            const char axis = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            const Quat turn = scenario::fromAxisAngle(
                {axis == 'x' ? 1.0 : 0.0, axis == 'y' ? 1.0 : 0.0, axis == 'z' ? 1.0 : 0.0}, e[i] * unit);
            q = c == axis ? q * turn : turn * q;
        }
        pose.orientation = q;
    }
    if (const auto v = numbers("xyaxes", 6); !v.empty()) {
        const Vec3 given{v[0], v[1], v[2]}, second{v[3], v[4], v[5]};
        const Vec3 x = given / norm(given);
        const Vec3 across = second - dot(second, x) * x;
        const Vec3 y = across / norm(across);
        pose.orientation = fromAxes(x, y, cross(x, y));
    }
    if (const auto z = numbers("zaxis", 3); !z.empty()) pose.orientation = turnOfZ({z[0], z[1], z[2]});
    if (!isFinite(pose.orientation)) throw Refusal(file.place(element), "an orientation without a direction");
    return pose;
}

}  // namespace rigor::models::mjcf
