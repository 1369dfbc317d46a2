// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A ball on a plane that slides and rolls along one line under sliding and rolling friction, phase by phase. With v
// its velocity, q = r w its rolling speed, s = v - q the slip, and all forces over m:
//     v' = p + f,   k q' = -f + c,   k = I/(m r^2)
//     f = -mu g_n sgn s,   any |f| <= mu_s g_n that keeps s = 0
//     c = -(rho/r) g_n sgn q,   any |c| <= (rho/r) g_n that keeps q = 0
// p the pull along the line, g_n the load, rho the rolling friction [m]. Every phase has constant accelerations:
//     rolls        v' = q' = (p - (rho/r) g_n sgn q)/(1 + k)
//     slides       v' = p - mu g_n sgn s,   q' = (mu g_n sgn s - (rho/r) g_n sgn q)/k
//     slides only  q = 0 where mu g_n <= (rho/r) g_n;   rests where |p| <= both bounds
// and ends where s or q becomes zero.
#pragma once

#include <optional>
#include <vector>

namespace rigor::validation {

class LineRoll {
  public:
    struct Setup {
        double pull = 0.0;                    ///< p [m/s^2]
        double sliding = 0.0, holding = 0.0;  ///< mu g_n of sliding and of sticking [m/s^2]
        double resistance = 0.0;              ///< (rho/r) g_n [m/s^2]
        double k = 0.4;                       ///< I/(m r^2), > 0
    };
    struct State {
        double way = 0.0, velocity = 0.0;  ///< [m], [m/s]
        double turned = 0.0, roll = 0.0;   ///< r times the angle and its rate: [m], [m/s]
    };
    /// Motion from the origin at t = 0. Speeds below `still` times the scale of the motion count as zero at the start.
    LineRoll(const Setup& setup, double velocity, double roll);

    State at(double t) const;
    /// Time from which the ball stays at rest; empty if it does not.
    std::optional<double> restTime() const;
    /// Time from which it does not slip; empty if it slips for ever.
    std::optional<double> rollTime() const;

  private:
    struct Phase {
        double begin = 0.0;
        State start;
        double acceleration = 0.0, rollAcceleration = 0.0;
        bool slips = false;
    };
    Phase phaseFrom(double t, const State& state) const;

    Setup setup_;
    std::vector<Phase> phases_;
};

}  // namespace rigor::validation
