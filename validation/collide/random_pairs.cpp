// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Pairs at a given signed distance are made from the exact result for any overlap: moved by t along a
// minimising normal, B is exactly t nearer to separation, whatever t >= 0 (no other direction gains more).
#include "validation/collide/random_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "scenarios/generators/generator.hpp"
#include "scenarios/model/hull.hpp"
#include "validation/oracle/oracle.hpp"

namespace rigor::validation {
namespace {

using namespace scenario;
using Json = nlohmann::ordered_json;

constexpr double kTwoPi = 2 * std::numbers::pi;

class Maker {
  public:
    Maker(const RandomPairs& request, std::vector<std::array<std::string, 2>> pairs)
        : random_(request.seed), pairs_(std::move(pairs)), dimension_(request.dimension) {}

    CollisionCase make(const std::string& kind, int number) {
        const auto& pair = pairs_[below(pairs_.size())];
        scale_ = kind == "tiny" ? 1e-3 : (kind == "huge" ? 1e3 : 1.0);
        a_ = shape(pair[0], kind == "thin");
        b_ = shape(pair[1], kind == "thin" && below(2) == 0);
        if (kind == "identical") b_ = a_;
        Xa_ = {{}, rotation()};
        Xb_ = {{}, rotation()};
        arrange(kind);
        const Vec3 place = (kind == "far" ? 1e4 : random_.unit() * 2 * scale_) * direction();
        Xa_.position = Xa_.position + place;
        Xb_.position = Xb_.position + place;
        return written(kind + "_" + std::to_string(number), {kind, name(a_), name(b_)});
    }

  private:
    std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(random_.unit() * n)); }
    double length() { return scale_ * random_.between(0.3, 1.0); }
    Vec3 direction() {
        const double z = dimension_ == 2 ? 0.0 : random_.between(-1, 1), a = kTwoPi * random_.unit();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }
    Quat rotation() {  // uniform (Shoemake, Graphics Gems III, 1992)
        if (dimension_ == 2) return fromAxisAngle({0, 0, 1}, kTwoPi * random_.unit());
        const double u = random_.unit(), a = kTwoPi * random_.unit(), b = kTwoPi * random_.unit();
        const double s = std::sqrt(1 - u), t = std::sqrt(u);
        return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
    }

    Geometry shape(const std::string& kind, bool thin) {
        const double flat = thin ? 1e-3 : 1.0;
        if (kind == "sphere" || kind == "circle") return Sphere{flat * length()};
        if (kind == "capsule") return Capsule{flat * length(), length()};
        if (kind == "cylinder") return Cylinder{length(), flat * length()};
        if (kind == "cone") return Cone{length(), flat * length()};
        if (kind == "ellipsoid") return Ellipsoid{{length(), flat * length(), length()}};
        if (kind == "box") return Box{{length(), flat * length(), dimension_ == 2 ? 0.0 : length()}};
        const int corners =
            dimension_ == 2 ? 3 + static_cast<int>(below(6)) : 8 + static_cast<int>(below(13));
        std::vector<Vec3> points;
        const Vec3 axes{length(), flat * length(), length()};
        for (int i = 0; i < corners; ++i) {
            const Vec3 d = direction();
            points.push_back({axes.x * d.x, axes.y * d.y, axes.z * d.z});
        }
        try {
            ConvexHull hull{dimension_ == 2 ? convexHull2d(points) : convexHull3d(points).vertices};
            Vec3 middle;  // inside, where the others have their origin too
            for (const Vec3& v : hull.vertices) middle = middle + v / hull.vertices.size();
            for (Vec3& v : hull.vertices) v = v - middle;
            return hull;
        } catch (const std::invalid_argument&) {  // points nearly in a plane or on a line
            return shape(kind, thin);
        }
    }
    std::string name(const Geometry& g) const { return geometryName(g, dimension_); }

    /// Moves B out of an overlap to the signed distance `target`.
    void moveTo(double target) {
        for (const double reach : {0.7, 0.4, 0.1, 0.0}) {
            Xb_.position = reach * random_.unit() * scale_ * direction();
            const auto exact = exactContact(a_, Xa_, b_, Xb_, dimension_);
            if (exact->signedDistance > target) continue;
            const Vec3 n = exact->normals[below(exact->normals.size())];
            Xb_.position = Xb_.position + (target - exact->signedDistance) * n;
            return;
        }
    }
    double signedPower(double low, double high) {
        return (below(2) == 0 ? 1 : -1) * scale_ * std::pow(10.0, random_.between(low, high));
    }

    void arrange(const std::string& kind) {
        if (kind == "touching") {
            moveTo(below(3) == 0 ? 0.0 : signedPower(-12, -8));
        } else if (kind == "grazing") {
            moveTo(signedPower(-8, -3));
        } else if (kind == "parallel") {
            parallel();
        } else if (kind == "deep") {
            Xb_.position = 0.2 * random_.unit() * scale_ * direction();
        } else if (kind == "concentric") {
            if (below(2) == 0) Xb_.orientation = Xa_.orientation;
        } else if (kind == "identical") {
            Xb_ = Xa_;
        } else if (kind == "thin" && below(2) == 0) {
            moveTo(signedPower(-6, -3));
        } else {
            Xb_.position = 2.2 * random_.unit() * scale_ * direction();
        }
    }

    /// Quarter turns of each other and little more, so that faces and edges are parallel or nearly so.
    void parallel() {
        const double quarter = std::numbers::pi / 2;
        Quat turn = fromAxisAngle({0, 0, 1}, quarter * below(4));
        if (dimension_ == 3) turn = fromAxisAngle({1, 0, 0}, quarter * below(4)) * turn;
        const double tilts[] = {0.0, 0.0, 1e-12, 1e-9, 1e-6, 1e-3};
        const Vec3 axis = dimension_ == 2 ? Vec3{0, 0, 1} : direction();
        Xb_.orientation = Xa_.orientation * fromAxisAngle(axis, tilts[below(6)]) * turn;
        moveTo(below(2) == 0 ? signedPower(-9, -3) : -0.2 * random_.unit() * scale_);
    }

    // -------------------------------------------------------------------------------------------- as a file
    Json vector(const Vec3& v) const { return dimension_ == 2 ? Json{v.x, v.y} : Json{v.x, v.y, v.z}; }
    Json posed(const Geometry& g, const Pose& X) const {
        Json out, inner;
        if (const auto* s = std::get_if<Sphere>(&g)) inner = {{"radius", s->radius}};
        if (const auto* s = std::get_if<Capsule>(&g))
            inner = {{"radius", s->radius}, {"half_length", s->halfLength}};
        if (const auto* s = std::get_if<Cylinder>(&g))
            inner = {{"radius", s->radius}, {"half_length", s->halfLength}};
        if (const auto* s = std::get_if<Cone>(&g))
            inner = {{"radius", s->radius}, {"half_length", s->halfLength}};
        if (const auto* s = std::get_if<Ellipsoid>(&g)) inner = {{"half_axes", vector(s->halfAxes)}};
        if (const auto* s = std::get_if<Box>(&g)) inner = {{"half_extents", vector(s->halfExtents)}};
        if (const auto* s = std::get_if<ConvexHull>(&g)) {
            inner["vertices"] = Json::array();
            for (const Vec3& v : s->vertices) inner["vertices"].push_back(vector(v));
        }
        out[name(g)] = inner;
        out["position"] = vector(X.position);
        const Quat& q = X.orientation;
        if (dimension_ == 2)
            out["angle"] = 2 * std::atan2(q.z, q.w);
        else
            out["orientation"] = {q.w, q.x, q.y, q.z};
        return out;
    }
    CollisionCase written(const std::string& caseName, const std::vector<std::string>& tags) const {
        const Json text{{"name", caseName},
                        {"dimension", dimension_},
                        {"a", posed(a_, Xa_)},
                        {"b", posed(b_, Xb_)},
                        {"tags", tags}};
        CollisionCase made = readCollisionCase(text.dump());
        made.text = text.dump();
        return made;
    }

    PortableRandom random_;
    std::vector<std::array<std::string, 2>> pairs_;
    int dimension_;
    double scale_ = 1;
    Geometry a_, b_;
    Pose Xa_, Xb_;
};

void checkKnown(const std::string& found, const std::vector<std::string>& known, const char* what) {
    if (std::find(known.begin(), known.end(), found) != known.end()) return;
    std::string list;
    for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
    throw std::invalid_argument(std::string(what) + ": found '" + found + "', expected one of " + list);
}

std::vector<std::array<std::string, 2>> pairsOf(const RandomPairs& request) {
    const auto& known = randomPairShapes(request.dimension);
    std::vector<std::array<std::string, 2>> pairs;
    for (const std::string& text : request.pairs) {
        const auto dash = text.find('-');
        if (dash == std::string::npos)
            throw std::invalid_argument("pairs: found '" + text + "', expected two shapes, e.g. box-hull");
        pairs.push_back({text.substr(0, dash), text.substr(dash + 1)});
        for (const std::string& shape : pairs.back()) checkKnown(shape, known, "pairs");
    }
    if (!pairs.empty() && !request.shapes.empty())
        throw std::invalid_argument("pairs: give either shapes or pairs");
    for (const std::string& shape : request.shapes) checkKnown(shape, known, "shapes");
    const auto& shapes = request.shapes.empty() ? known : request.shapes;
    if (pairs.empty())
        for (const std::string& a : shapes)
            for (const std::string& b : shapes) pairs.push_back({a, b});
    return pairs;
}

}  // namespace

const std::vector<std::string>& randomPairKinds() {
    static const std::vector<std::string> kinds{"generic", "touching",   "grazing",  "parallel",
                                                "deep",    "thin",       "tiny",     "huge",
                                                "far",     "concentric", "identical"};
    return kinds;
}

const std::vector<std::string>& randomPairShapes(int dimension) {
    static const std::vector<std::string> planar{"circle", "box", "capsule", "polygon"},
        solid{"sphere", "box", "capsule", "hull", "cylinder", "cone"};
    return dimension == 2 ? planar : solid;
}

CollisionFile makeRandomPairs(const RandomPairs& request) {
    for (const std::string& kind : request.kinds) checkKnown(kind, randomPairKinds(), "kinds");
    const auto& kinds = request.kinds.empty() ? randomPairKinds() : request.kinds;
    Maker maker(request, pairsOf(request));
    CollisionFile file;
    file.name = "random_" + std::to_string(request.dimension) + "d_seed_" + std::to_string(request.seed);
    file.file = file.name + ".json";
    file.title = std::to_string(request.count) + " random pairs, seed " + std::to_string(request.seed);
    for (int i = 0; i < request.count; ++i) {
        file.cases.push_back(maker.make(kinds[static_cast<std::size_t>(i) % kinds.size()], i));
        file.cases.back().line = i + 4;  // line at which writeCollisionFile writes it
    }
    return file;
}

void writeCollisionFile(const CollisionFile& file, const std::filesystem::path& path) {
    std::ofstream out(path, std::ios::trunc);
    out << "{\"rigor_collision\": 1, \"name\": " << Json(file.name).dump()
        << ",\n \"title\": " << Json(file.title).dump() << ",\n \"cases\": [\n";
    for (std::size_t i = 0; i < file.cases.size(); ++i)
        out << file.cases[i].text << (i + 1 < file.cases.size() ? ",\n" : "\n");
    out << "]}\n";
    if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace rigor::validation
