// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/narrowphase/3d/feature.hpp"

#include "engine/math/portable.hpp"
#include "engine/narrowphase/3d/clip.hpp"

namespace rigor::engine {
namespace {

template <class R>
using S3 = Space<R, 3>;

template <class R>
void featureOf(const Sphere<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    out.add(s.radius * d, 0);
}
template <class R>
void featureOf(const HalfSpace<S3<R>>&, const Vec3<R>&, SupportFeature<R>&) {}

template <class R>
void featureOf(const Capsule<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    const Vec3<R> end(0, s.halfLength, 0), out1 = s.radius * d;
    const bool lying = std::abs(d.y()) < kFeatureSlope<R>;
    if (lying || d.y() < 0) out.add(out1 - end, 0);
    if (lying || d.y() >= 0) out.add(out1 + end, 1);
}

template <class R>
void addFace(const Polytope<R>& p, const HullFace<R>& f, SupportFeature<R>& out) {
    const int n = std::min(f.count, SupportFeature<R>::kMost);
    for (int k = 0; k < n; ++k) {
        const int i = f.count <= n ? k : k * f.count / n;
        out.add(p.loopVertex(f, i), p.loops[f.first + i]);
    }
    out.normal = f.normal;
}

/// The face that looks along d; else the edge at the extreme vertex that is most nearly perpendicular to d.
template <class R>
void polytopeFeature(const Polytope<R>& p, const Vec3<R>& d, SupportFeature<R>& out) {
    int face = 0, vertex = 0;
    for (int i = 1; i < p.faceCount; ++i)
        if (p.faces[i].normal.dot(d) > p.faces[face].normal.dot(d)) face = i;
    const HullFace<R>& f = p.faces[face];
    if (f.normal.dot(d) > kFeatureFlat<R>) {
        addFace(p, f, out);
        return;
    }
    for (int i = 1; i < p.vertexCount; ++i)
        if (p.vertices[i].dot(d) > p.vertices[vertex].dot(d)) vertex = i;
    int best = -1;
    R slope = kFeatureSlope<R>;
    for (int i = 0; i < p.edgeCount; ++i) {
        const HullEdge& e = p.edges[i];
        if (e.v0 != vertex && e.v1 != vertex) continue;
        const Vec3<R> along = p.vertices[e.v1] - p.vertices[e.v0];
        if (const R s = std::abs(along.dot(d)) / along.norm(); s < slope) {
            slope = s;
            best = i;
        }
    }
    if (best < 0) {
        out.add(p.vertices[vertex], vertex);
        return;
    }
    out.add(p.vertices[p.edges[best].v0], p.edges[best].v0);
    out.add(p.vertices[p.edges[best].v1], p.edges[best].v1);
}
template <class R>
void featureOf(const Box<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    BoxStorage<R> store;
    polytopeFeature(polytopeOf<R>(s, store), d, out);
}
template <class R>
void featureOf(const Hull<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    BoxStorage<R> unused;
    polytopeFeature(polytopeOf<R>(s, unused), d, out);
}

/// Sixteen vertices fixed in the body, on the rim of the disc at height y; counter-clockwise seen from
/// `outward` = +-1 times y. The rim's own extreme point along d takes the place of the nearest of them once
/// it is further out by more than kRimNoise.
template <class R>
void addDisc(R radius, R y, R outward, const Vec3<R>& d, int firstName, SupportFeature<R>& out) {
    static constexpr std::array<double, 4> kCos{1.0, 0.92387953251128675613, 0.70710678118654752440,
                                                0.38268343236508977173};
    const auto cosine = [](int k) {  // cosine of k pi / 8
        const int quarter = (k / 4) % 4, rest = k % 4;
        const double c = kCos[rest];
        const double s = rest == 0 ? 0.0 : kCos[4 - rest];
        return R(quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s);
    };
    const R across = portable::hypot(d.x(), d.z());
    int nearest = -1;
    R reach = 0;
    for (int k = 0; k < 16; ++k) {
        const int turn = outward < 0 ? k : 16 - k;  // x to z is clockwise seen from +y
        const Vec3<R> x(radius * cosine(turn), y, radius * cosine(turn + 12));
        if (const R r = x.x() * d.x() + x.z() * d.z(); nearest < 0 || r > reach) {
            reach = r;
            nearest = out.count;
        }
        out.add(x, firstName + turn % 16);
    }
    if (radius * across > reach + std::max(kRimNoise<R>, kRounding<R>) * radius)
        out.at[nearest] = Vec3<R>(radius * d.x() / across, y, radius * d.z() / across);
    out.normal = {0, outward, 0};
}

template <class R>
void featureOf(const Cylinder<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    if (std::abs(d.y()) > kFeatureFlat<R>) {
        const R up = d.y() < 0 ? R(-1) : R(1);
        addDisc<R>(s.radius, up * s.halfLength, up, d, up < 0 ? 0 : 16, out);
        return;
    }
    const R across = portable::hypot(d.x(), d.z()), k = s.radius / across;
    const bool lying = std::abs(d.y()) < kFeatureSlope<R>;
    if (lying || d.y() < 0) out.add({k * d.x(), -s.halfLength, k * d.z()}, 32);
    if (lying || d.y() >= 0) out.add({k * d.x(), s.halfLength, k * d.z()}, 33);
}

/// The cap or the line of the side, whichever is more nearly perpendicular to d.
template <class R>
void facingOf(const Cylinder<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    const R across = portable::hypot(d.x(), d.z()), up = d.y() < 0 ? R(-1) : R(1);
    if (std::abs(d.y()) >= across) {
        addDisc<R>(s.radius, up * s.halfLength, up, d, up < 0 ? 0 : 16, out);
        return;
    }
    const R k = s.radius / across;
    out.add({k * d.x(), -s.halfLength, k * d.z()}, 32);
    out.add({k * d.x(), s.halfLength, k * d.z()}, 33);
    out.radius = s.radius;
}
template <class R>
void facingOf(const Capsule<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    const Vec3<R> end(0, s.halfLength, 0), out1 = s.radius * d;
    out.add(out1 - end, 0);
    out.add(out1 + end, 1);
    out.radius = s.radius;
}
template <class R>
void facingOf(const Box<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    BoxStorage<R> store;
    const Polytope<R> p = polytopeOf<R>(s, store);
    addFace(p, p.faces[incidentFace<R>(p, d)], out);
}
template <class R>
void facingOf(const Hull<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    BoxStorage<R> unused;
    const Polytope<R> p = polytopeOf<R>(s, unused);
    addFace(p, p.faces[incidentFace<R>(p, d)], out);
}

template <class R>
void featureOf(const Ellipsoid<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    out.add(support<S3<R>>(Shape<S3<R>>(s), d), 0);
}

template <class R>
void featureOf(const Cone<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    if (d.y() < -kFeatureFlat<R>) {
        addDisc<R>(s.radius, -s.halfLength, R(-1), d, 0, out);
        return;
    }
    const R across = portable::hypot(d.x(), d.z());
    const Vec3<R> apex(0, s.halfLength, 0);
    const Vec3<R> rim = across > 0
                            ? Vec3<R>(s.radius * d.x() / across, -s.halfLength, s.radius * d.z() / across)
                            : Vec3<R>(s.radius, -s.halfLength, 0);
    const R rise = (apex - rim).dot(d), lying = kFeatureSlope<R> * (apex - rim).norm();
    if (rise < lying) out.add(rim, 32);
    if (rise > -lying) out.add(apex, 33);
}

/// The base, or the line from its rim to the apex.
template <class R>
void facingOf(const Cone<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    const R across = portable::hypot(d.x(), d.z());
    const Vec3<R> apex(0, s.halfLength, 0);
    const Vec3<R> rim = across > 0
                            ? Vec3<R>(s.radius * d.x() / across, -s.halfLength, s.radius * d.z() / across)
                            : Vec3<R>(s.radius, -s.halfLength, 0);
    const R rise = (apex - rim).dot(d) / (apex - rim).norm();
    if (d.y() < 0 && d.y() * d.y() >= R(1) - rise * rise) {
        addDisc<R>(s.radius, -s.halfLength, R(-1), d, 0, out);
        return;
    }
    out.add(rim, 32);
    out.add(apex, 33);
}
template <class R>
void facingOf(const Sphere<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    featureOf(s, d, out);
}
template <class R>
void facingOf(const Ellipsoid<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    featureOf(s, d, out);
}
template <class R>
void facingOf(const HalfSpace<S3<R>>&, const Vec3<R>&, SupportFeature<R>&) {}
/// A triangle is a piece of a surface, whose neighbours decide what it holds.
template <class R>
void facingOf(const Triangle<S3<R>>&, const Vec3<R>&, SupportFeature<R>&) {}

/// The feature is the face on the side of d, or a side or a corner where d lies in the triangle's plane.
template <class R>
void featureOf(const Triangle<S3<R>>& s, const Vec3<R>& d, SupportFeature<R>& out) {
    const Vec3<R> n = (s.v[1] - s.v[0]).cross(s.v[2] - s.v[0]).normalized();
    if (const R c = n.dot(d); std::abs(c) > kFeatureFlat<R>) {
        for (int i = 0; i < 3; ++i) {
            const int k = c > 0 ? i : 2 - i;
            out.add(s.v[k], k);
        }
        out.normal = c > 0 ? n : Vec3<R>(-n);
        return;
    }
    std::size_t top = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (s.v[i].dot(d) > s.v[top].dot(d)) top = i;
    std::size_t end = top;
    R slope = kFeatureSlope<R>;
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == top) continue;
        const Vec3<R> along = s.v[i] - s.v[top];
        if (const R c = std::abs(along.dot(d)) / along.norm(); c < slope) {
            slope = c;
            end = i;
        }
    }
    out.add(s.v[std::min(top, end)], static_cast<int>(std::min(top, end)));
    if (end != top) out.add(s.v[std::max(top, end)], static_cast<int>(std::max(top, end)));
}

}  // namespace

template <class R>
void supportingFeature(const Shape<Space<R, 3>>& shape, const Vec3<R>& d, SupportFeature<R>& out) {
    out.count = 0;
    std::visit(
        [&]<class Kind>(const Kind& s) {
            if constexpr (!kComposite<Kind>) featureOf<R>(s, d, out);
        },
        shape);
}

template <class R>
void facingFeature(const Shape<Space<R, 3>>& shape, const Vec3<R>& d, SupportFeature<R>& out) {
    out.count = 0;
    out.radius = 0;
    std::visit(
        [&]<class Kind>(const Kind& s) {
            if constexpr (!kComposite<Kind>) facingOf<R>(s, d, out);
        },
        shape);
}

template void facingFeature<float>(const Shape<Space3f>&, const Vec3<float>&, SupportFeature<float>&);
template void facingFeature<double>(const Shape<Space3d>&, const Vec3<double>&, SupportFeature<double>&);
template void supportingFeature<float>(const Shape<Space3f>&, const Vec3<float>&, SupportFeature<float>&);
template void supportingFeature<double>(const Shape<Space3d>&, const Vec3<double>&, SupportFeature<double>&);

}  // namespace rigor::engine
