// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The contact audit as the page shows it.
#pragma once

#include "reports/encoding/json.hpp"
#include "validation/results/types.hpp"

namespace rigor::report {

/// The audit of a case; of what its run acted upon (null if that was not requested); per scenario and auditor
/// over all cases of a run.
Json auditJson(const results::CaseRow& row);
Json inRunJson(const results::CaseRow& row);
Json gatheredAudit(const results::Run& run);

}  // namespace rigor::report
