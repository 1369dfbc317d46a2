// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The common part of all readers: a reader states bodies, shapes, surfaces and joints in the world at the start, and
// the builder makes a scenario of them: names, materials and the table of their pairs, layers, the source. Axes
// are those of the model (z up); gravity is a vector.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scenarios/exchange/common/options.hpp"
#include "scenarios/model/scenario.hpp"

namespace rigor::models {

/// Limits of joints beyond it are none, in formats in which every joint has limits [m, rad].
constexpr double kUnlimited = 1e6;

/// Contact law of a surface as a file states it.
struct Surface {
    double friction = 0.0;
    double restitution = 0.0;
    double rolling = 0.0, torsional = 0.0;  ///< [m]
    int contactDimension = 3;               ///< MJCF: 1 no friction, 3 sliding, 4 and torsion, 6 and rolling
    int priority = 0;                       ///< MJCF: the surface of higher priority gives the pair's law
    int own = 0;                            ///< not 0: a surface that explicit pairs name
    double staticFriction = 0.0;            ///< 0: the same as friction
    friend bool operator==(const Surface&, const Surface&) = default;
};

class SceneBuilder {
  public:
    SceneBuilder(const ReadOptions& options, Report& report, const std::string& format,
                 const std::string& reader);

    scenario::Scenario scene;
    std::vector<Place> bodyPlaces, jointPlaces;

    /// Adds a body under a valid, unique name made of `name`.
    int addBody(const std::string& name, scenario::Body body, const Place& place);
    /// Adds a shape; two shapes of classes a and b may touch if the function of `setContacts` says so.
    void addShape(int body, scenario::Geometry geometry, const scenario::Pose& pose, const Surface& surface,
                  int contactClass = 0);
    /// Capsule, cylinder or cone along local z of `pose`.
    template <class Round>
    void addRoundZ(int body, const Round& round, const scenario::Pose& pose, const Surface& surface,
                   int contactClass = 0) {
        addShape(body, round, pose * fromZ(), surface, contactClass);
    }
    /// A joint of two bodies at a point and along directions of the world.
    scenario::Joint& addJoint(const std::string& name, scenario::JointType type, int a, int b,
                              const scenario::Vec3& anchor, const scenario::Vec3& axis, const Place& place,
                              const scenario::Vec3& normal = {1.0, 0.0, 0.0});
    /// Law of a pair of surfaces; the table of pairs states the result for any two of the scene.
    void setMixing(std::function<scenario::PairCoefficients(const Surface&, const Surface&)> law,
                   const std::string& inWords);
    void setPair(int ownA, int ownB, const scenario::PairCoefficients& law);
    /// Symmetric: whether shapes of two classes may touch. Classes become layers.
    void setContacts(std::function<bool(int, int)> mayTouch) { mayTouch_ = std::move(mayTouch); }
    void setTimeStep(double seconds) { timeStep_ = seconds; }
    /// The scenario's text, checked by the loader; problems become refusals at the place of the body or joint.
    Answer finish();

    /// Turns local y, the axis of round shapes in scenarios, to z.
    static scenario::Pose fromZ() { return {{}, {std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0}}; }

  private:
    std::string nameFor(const std::string& wanted, std::map<std::string, int>& taken, const Place& place);
    int material(const Surface& surface);
    void writeMaterials();
    void writeLayers();
    void addFloor();
    void header();

    const ReadOptions& options_;
    Report& report_;
    std::string format_, reader_;
    std::map<std::string, int> bodyNames_, jointNames_;
    std::vector<Surface> surfaces_;
    std::map<std::pair<int, int>, scenario::PairCoefficients> pairs_;
    std::function<scenario::PairCoefficients(const Surface&, const Surface&)> mixing_;
    std::string mixingText_;
    std::function<bool(int, int)> mayTouch_;
    struct ShapeClass {
        int body, shape, kind;
    };
    std::vector<ShapeClass> classes_;
    double timeStep_ = 0.0;
};

/// Pairs of materials by a rule for each coefficient.
scenario::PairCoefficients smaller(const Surface& a, const Surface& b);
scenario::PairCoefficients product(const Surface& a, const Surface& b);

}  // namespace rigor::models
