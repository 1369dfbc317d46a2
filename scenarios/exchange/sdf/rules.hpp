// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <span>

#include "scenarios/exchange/common/xml_file.hpp"

namespace rigor::models {

/// Elements and attributes of SDF.
std::span<const ElementRule> sdfRules();

}  // namespace rigor::models
