// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#pragma once

#include <span>

#include "scenarios/exchange/common/xml_file.hpp"

namespace rigor::models {

/// Elements and attributes of URDF, with the extensions of Bullet and Drake that the reader maps.
std::span<const ElementRule> urdfRules();

}  // namespace rigor::models
