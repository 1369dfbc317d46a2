// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include "validation/studies/study.hpp"

namespace rigor::validation {

/// A field of the audit of what a run acted upon; no value where it was not audited.
StudyValue auditValue(const results::CaseRow& row, const std::string& field);

}  // namespace rigor::validation
