// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Results as they pass between this program and the children that load engines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "validation/collide/collide.hpp"

namespace rigor::validation {

/// A result without its judgement.
nlohmann::json answerToJson(const CollideAnswer& answer);
CollideAnswer answerFromJson(const nlohmann::json& json);

/// The child's side: `__collide <request.json>`.
int collideChild(const std::filesystem::path& request);

}  // namespace rigor::validation
