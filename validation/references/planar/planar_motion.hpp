// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One rigid body that moves in a plane of space over a straight floor, from event to event: rods and blocks
// that rock, tip, slide, stick, jam, lift off and hit. In coordinates x along the floor, z above it, phi:
// corner i (a point, or the centre of a cap of radius r) is at R(phi) rho from the centre of mass, the
// contact at c = R rho - (0, r); N, F: normal and tangential contact force.
//   x'' = gx + F/m, z'' = gz + N/m, I phi'' = c_x N - c_z F + T,
//   contact holds:  z'' + phi'' (R rho)_x - phi'^2 (R rho)_z = 0,
//   slips, s = x' - phi' c_z:  F = -mu N sign(s);   sticks:  s' = 0 with |F| <= mu N.
// Events: N = 0 (flight), s = 0 (stick, or slip the other way), |F| = mu N (slip), another corner lands.
// Where both ends of a flat side touch the body rests, slides as a whole or tips over one of them. A block
// that rocks between two corners at ever shorter intervals lies flat at the limit of the geometric series,
// one that bounces ever lower touches at the limit of its own. Impacts make neighbouring motions part: a
// neighbour whose mass properties, coefficients, load and velocities differ by 1e-12 of their values is
// followed as well, and the solution ends where the two are 1e-8 of the way and the size apart. The errors of
// the solution, of its event times and of those limits are about as large as that difference or smaller, and
// grow like it. Impacts: all laws at the level of impulses at once (Newton's restitution at the corner that
// lands, Coulomb with the slip after the impact), the solution by trying every mode. Where a slipping contact
// can carry no force and not open either (Painleve), it stops in an impact without collision.
// Source: Painleve 1895; Housner, Bull. Seism. Soc. Am. 53 (1963) 403; Genot and Brogliato, Eur. J. Mech. A
// 18 (1999) 653; Brogliato, Nonsmooth Mechanics, 2016, chapters 4-5; Stronge, Impact Mechanics, 2000.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/references/numerics/ode.hpp"
#include "validation/references/parts.hpp"

namespace rigor::validation {

class PlanarMotion {
  public:
    using Real = numerics::Real;
    struct Corner {
        Real along = 0, above = 0;  ///< coordinates from the centre of mass, 2D body frame at phi = 0 [m]
        Real radius = 0;            ///< radius of a cap; 0: a point [m]
    };
    struct Setup {
        std::vector<Corner> corners;
        Real mass = 1, inertia = 1;
        Real pullAlong = 0, pullAbove = 0;  ///< acceleration by gravity and constant force [m/s^2]
        Real torque = 0;                    ///< constant [N m]
        Real friction = 0, restitution = 0;
        Real size = 1;  ///< lengths are small beside this [m]
        /// Follow the motion to the first impact alone, whose law is not applied; validUntil() is its time.
        bool stopsAtImpact = false;
    };
    struct State {
        Real x = 0, z = 0, angle = 0, vx = 0, vz = 0, rate = 0;
    };
    /// Slip: of one corner; Slide: of a flat side, along which the body does not turn.
    enum class Kind { Rest, Flight, Stick, SlipForward, SlipBackward, SlideForward, SlideBackward };
    struct Mode {
        Kind kind = Kind::Flight;
        int corner = -1;
        bool operator==(const Mode&) const = default;
    };
    enum class EventKind { Impact, Release, Stick, Slip, Jam };
    struct Event {
        double time = 0.0;
        EventKind kind = EventKind::Impact;
        int corner = -1;
        int other = -1;  ///< second corner that takes part in an impact
        State before, after;
    };
    struct Load {
        Real normal = 0, tangential = 0;  ///< [N]
    };

    /// Follows the motion for `duration`, and on to `end` as far as the laws determine it. Throws
    /// AssumptionViolated for a start inside the floor, contacts that do not fit the velocities, and impacts
    /// within `duration` and before neighbours diverge that have no solution or several.
    PlanarMotion(Setup setup, State start, double duration, double end);
    PlanarMotion(Setup setup, State start, double duration)
        : PlanarMotion(std::move(setup), start, duration, duration) {}

    State at(double t) const;
    /// Contact force at time t; zero in flight, empty on two corners.
    std::optional<Load> loadAt(double t) const;
    Mode modeAt(double t) const;
    /// Events of the motion; those after validUntil() have no meaning.
    const std::vector<Event>& events() const { return events_; }
    /// Time until which the motion is known [s]; 1e300 if that is `end`.
    double validUntil() const { return validUntil_; }

  private:
    struct AsNeighbour {};
    /// The neighbour: ends where it cannot be followed, whatever the reason.
    PlanarMotion(Setup setup, State start, double duration, double end, AsNeighbour);

    struct Phase {
        double begin = 0.0, end = 0.0;
        Mode mode;
        State held;             ///< state at `from`: rest, and sliding on a flat side
        Real acceleration = 0;  ///< acceleration of x in the same phase
        double from = 0.0;
        numerics::DenseSolution solution;
    };
    struct Forces {
        Load load;
        Real ax = 0, az = 0, spin = 0;
    };
    struct Arm {
        Real x = 0, z = 0;    ///< R rho
        Real cx = 0, cz = 0;  ///< contact from the centre of mass
    };
    Arm armOf(int corner, Real angle) const;
    Real gapOf(int corner, const State& s) const;
    Real closingOf(int corner, const State& s) const;  ///< rate of the gap
    Real slipOf(int corner, const State& s) const;
    /// Forces and accelerations; empty where a slipping contact has no consistent force.
    std::optional<Forces> forcesIn(const Mode& mode, const State& s) const;
    Real leverOf(const Mode& mode, const State& s) const;
    Mode startMode(State& s) const;
    Mode contactMode(int corner, const State& s) const;
    std::optional<State> bothStick(const std::vector<int>& corners, const State& s,
                                   std::array<Real, 2> rates) const;
    bool restsOn(const std::vector<int>& corners, const State& s) const;
    bool slidesOn(const std::vector<int>& corners, const State& s, Real sign) const;
    Mode flatMode(const std::vector<int>& corners, State& s) const;
    std::vector<int> lowest(const State& s) const;
    void layFlat(int one, int other, State& s) const;
    bool settles(double& t, State& s) const;
    bool chatters(double& t, State& s) const;
    void bridge(double begin, const State& from, double end, const State& to);
    double pieceFrom(const State& s, const Mode& mode) const;
    Phase piece(double t, const State& s, const Mode& mode);
    Mode follow(double& t, State& s, Mode mode);
    Mode slide(double& t, State& s, Mode mode);
    Mode resolve(double& t, State& s, const Mode& mode);
    Mode impact(double& t, State& s, const std::vector<int>& touching, const std::vector<int>& landing,
                EventKind kind);
    const Phase& phaseAt(double t) const;
    void setScale(const State& start);
    void followTo(double end, double& t, State& s, Mode& mode);
    PlanarMotion neighbourOf(State start, double end) const;
    double partingFrom(const PlanarMotion& neighbour, double end) const;

    Setup setup_;
    double duration_ = 0.0, validUntil_ = 1e300;
    double end_ = 0.0;          ///< time to which it is followed [s]
    numerics::OdeState scale_;  ///< scales of x, z, angle and their rates
    std::vector<Phase> phases_;
    std::vector<Event> events_;
    std::size_t evaluations_ = 0;  ///< evaluations of the equations of motion
};

/// The body of a scenario as a planar body over a plane, with the way between the coordinates.
class PlanarFrame {
  public:
    /// Throws AssumptionViolated where the motion does not stay in a plane across the floor.
    PlanarFrame(const Scenario& scenario, int body, int floor);

    const PlanarMotion::Setup& setup() const { return setup_; }
    PlanarMotion::State start() const { return start_; }
    PartialState lift(const PlanarMotion::State& state) const;
    /// x, z, angle and their rates of a recorded state; the angle within half a turn.
    PlanarMotion::State read(const BodyState& state) const;

  private:
    void addForces(const Scenario& scenario, int body);
    void addCorners(const Scenario& scenario);
    void chooseAxis(const Scenario& scenario);

    const Body& body_;
    Plane plane_;
    Vec3 along_, above_, axis_{0, 0, 1}, origin_;  ///< axes with along_ = above_ x axis_; phi > 0 is about
                                                   ///< axis_
    PlanarMotion::Setup setup_;
    PlanarMotion::State start_;
};

}  // namespace rigor::validation
