// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Double-precision vectors, quaternions and poses of the scenario model. They are the currency between
// scenarios, adapters and validation; no engine computes with them.
#pragma once

#include <array>
#include <cmath>

namespace rigor::scenario {

/// A vector or point in the frame its owner names. In two-dimensional scenarios z is 0.
struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
    return s * a;
}
constexpr Vec3 operator/(Vec3 a, double s) {
    return {a.x / s, a.y / s, a.z / s};
}
constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
    return a = a + b;
}
constexpr Vec3& operator-=(Vec3& a, Vec3 b) {
    return a = a - b;
}
constexpr double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) {
    return std::sqrt(dot(a, a));
}
inline bool isFinite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Unit quaternion w + xi + yj + zk, an active rotation from the body frame to the world frame.
struct Quat {
    double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
    friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quat conjugate(Quat q) {
    return {q.w, -q.x, -q.y, -q.z};
}
inline double norm(Quat q) {
    return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}
inline Quat normalized(Quat q) {
    const double n = norm(q);
    return {q.w / n, q.x / n, q.y / n, q.z / n};
}
inline bool isFinite(Quat q) {
    return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}
/// The vector v rotated by the unit quaternion q.
constexpr Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, v);
    return v + q.w * t + cross(u, t);
}
/// The vector v rotated by the inverse of the unit quaternion q.
constexpr Vec3 rotateInverse(Quat q, Vec3 v) {
    return rotate(conjugate(q), v);
}
/// Rotation by `angle` [rad] about the unit vector `axis`.
inline Quat fromAxisAngle(Vec3 axis, double angle) {
    const double s = std::sin(0.5 * angle);
    return {std::cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
}
/// The rotation angle about +z [rad, in (-pi, pi]] of a quaternion that is a rotation about z.
inline double angleAboutZ(Quat q) {
    const double angle = 2.0 * std::atan2(q.z, q.w);
    const double pi = 3.14159265358979323846;
    return angle > pi ? angle - 2.0 * pi : (angle <= -pi ? angle + 2.0 * pi : angle);
}

/// Row-major 3 x 3 matrix; inertia tensors [kg m^2].
struct Mat3 {
    std::array<std::array<double, 3>, 3> m{};
    friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
    constexpr double& operator()(int i, int j) { return m[i][j]; }
    constexpr double operator()(int i, int j) const { return m[i][j]; }
    static constexpr Mat3 diagonal(double a, double b, double c) {
        Mat3 r;
        r(0, 0) = a;
        r(1, 1) = b;
        r(2, 2) = c;
        return r;
    }
};

constexpr Vec3 operator*(const Mat3& a, Vec3 v) {
    return {a(0, 0) * v.x + a(0, 1) * v.y + a(0, 2) * v.z, a(1, 0) * v.x + a(1, 1) * v.y + a(1, 2) * v.z,
            a(2, 0) * v.x + a(2, 1) * v.y + a(2, 2) * v.z};
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    Mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    return r;
}
constexpr Mat3 operator+(const Mat3& a, const Mat3& b) {
    Mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) = a(i, j) + b(i, j);
    return r;
}
constexpr Mat3 transpose(const Mat3& a) {
    Mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r(i, j) = a(j, i);
    return r;
}
/// The rotation matrix of a unit quaternion: columns are the body axes in the world frame.
constexpr Mat3 toMatrix(Quat q) {
    Mat3 r;
    const Vec3 ex = rotate(q, {1, 0, 0}), ey = rotate(q, {0, 1, 0}), ez = rotate(q, {0, 0, 1});
    r(0, 0) = ex.x;
    r(1, 0) = ex.y;
    r(2, 0) = ex.z;
    r(0, 1) = ey.x;
    r(1, 1) = ey.y;
    r(2, 1) = ey.z;
    r(0, 2) = ez.x;
    r(1, 2) = ez.y;
    r(2, 2) = ez.z;
    return r;
}

/// Rigid transform x_W = position + orientation * x_B.
struct Pose {
    Vec3 position;     ///< origin of the body frame, world frame [m]
    Quat orientation;  ///< body to world
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};
constexpr Vec3 operator*(const Pose& X, Vec3 p) {
    return X.position + rotate(X.orientation, p);
}
/// Composition: X_AC = X_AB * X_BC.
constexpr Pose operator*(const Pose& a, const Pose& b) {
    return {a * b.position, a.orientation * b.orientation};
}
constexpr Pose inverse(const Pose& X) {
    return {-rotateInverse(X.orientation, X.position), conjugate(X.orientation)};
}

}  // namespace rigor::scenario
