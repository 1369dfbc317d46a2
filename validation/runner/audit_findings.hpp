// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The worst of each kind that an audit found, with what is needed to draw it: the engine's contact and the
// exact solution at the same poses.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "validation/runner/audit.hpp"

namespace rigor::validation {

class AuditFindings {
  public:
    /// Keeps the query if its error is the largest of its kind so far. `contact`: the engine's deepest one,
    /// null where it found none; `place`: its place among the stored contacts of the frame, -1 for none.
    void add(const std::string& what, double error, const AuditQuery& query,
             const adapter::ContactPoint* contact, int place);

    /// A JSON array, one object for each kind; the exact points are computed here. Empty if nothing was found.
    std::string text(const scenario::Scenario& scenario) const;

  private:
    struct Finding {
        double error = 0.0;
        AuditQuery query;
        std::optional<adapter::ContactPoint> contact;
        int place = -1;
    };
    std::map<std::string, Finding> worst_;
};

}  // namespace rigor::validation
