// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Optional interfaces of a world beyond whole steps: steps in stages whose data can be read, and snapshots of
// its state. See World::staged and World::snapshots.
#pragma once

#include <string>
#include <vector>

#include "adapters/interface/types.hpp"

namespace rigor::adapter {

/// A shape by the body it belongs to; scenario indices.
struct ShapeName {
    int body = 0, shape = 0;
    friend auto operator<=>(const ShapeName&, const ShapeName&) = default;
};

/// Box that the broad phase compared for a shape; world frame, sides may be infinite.
struct ShapeBox {
    ShapeName of;
    Aabb box;
};
struct ShapePair {
    ShapeName a, b;  ///< a.body < b.body
};

/// Result of the narrow phase for a pair. A is the body of lower index, the normal points from A to B.
struct StagedManifold {
    ShapeName a, b;
    Vec3 normal;
    struct Point {
        Vec3 pointA, pointB;         ///< points on the surfaces [m]
        double depth = 0.0;          ///< [m], < 0: apart, found because it was near
        std::uint32_t feature = 0;   ///< names the touching features, stable from step to step
        double normalImpulse = 0.0;  ///< initial impulse, of the last step [N s]
        int row = scenario::kNone;   ///< index of its normal row; kNone: it has no rows (yet)
    };
    std::vector<Point> points;
};

/// One equation or inequality between the velocities of two bodies.
struct StagedRow {
    enum class Kind { Normal, Friction, Joint, Limit };  ///< Limit: what has bounds: stops, motors, springs
    Kind kind = Kind::Normal;
    int bodyA = scenario::kNone, bodyB = scenario::kNone;  ///< kNone: the world
    int joint = scenario::kNone;                           ///< joint that it belongs to; kNone: a contact
    double impulse = 0.0;                                  ///< accumulated [N s] or [N m s]
    double bias = 0.0;                                     ///< [m/s] or [rad/s]
    double softness = 0.0;                                 ///< [1/kg] or [1/(kg m^2)]
    double error = 0.0;  ///< position error; < 0: overlap, a limit overrun [m] or [rad]
    double effectiveMass = 0.0;
};
const char* rowKindName(StagedRow::Kind kind);  ///< "normal", "friction", "joint", "limit"

struct StagedIteration {
    int substep = 0;
    double residual = 0.0;         ///< the engine's own measure
    std::vector<double> impulses;  ///< impulses of all rows after it [N s] or [N m s]
};

/// A step in stages. World::step and these must not be mixed within a step. The data are those of the last
/// stage that made them: before the broad phase of a step the boxes are those of the last step.
class StagedWorld {
  public:
    virtual ~StagedWorld() = default;

    virtual void beginStep() = 0;  ///< begins a step of the world's time step; not while stepping()
    virtual bool stepping() const = 0;
    virtual std::string nextStage() const = 0;  ///< "broad_phase", ...; "" when not stepping()
    virtual int substep() const = 0;            ///< sub-step that the next stage belongs to, from 0
    virtual void runStage() = 0;                ///< to be called only while stepping()

    virtual std::vector<ShapeBox> boxes() const = 0;
    virtual std::vector<ShapePair> pairs() const = 0;
    virtual std::vector<StagedManifold> manifolds() const = 0;
    virtual std::vector<StagedRow> rows() const = 0;
    /// Scenario indices of the dynamic bodies of each island, ascending.
    virtual std::vector<std::vector<int>> islands() const = 0;
    /// Every iteration of the solver since beginStep; kept only while watched.
    virtual void watchIterations(bool on) = 0;
    virtual const std::vector<StagedIteration>& iterations() const = 0;
};

/// The whole state of a world, for going back.
class Snapshots {
  public:
    virtual ~Snapshots() = default;
    /// Replaces `bytes`. It must not be called between the stages of a step.
    virtual void save(std::vector<unsigned char>& bytes) const = 0;
    /// Restores the state of the same world, or one built alike; its future is the same bit for bit. False:
    /// the structure of the world has changed since (a joint is gone); then it stays as it is.
    virtual bool restore(const std::vector<unsigned char>& bytes) = 0;
};

}  // namespace rigor::adapter
