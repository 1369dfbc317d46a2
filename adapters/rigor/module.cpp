// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/rigor/parts.hpp"

RIGOR_ADAPTER_MODULE(rigor::adapter::makeRigorEngine)
