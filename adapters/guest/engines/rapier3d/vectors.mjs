// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors

export const toRapier = ([x, y, z]) => ({ x, y, z });
export const quatToRapier = ([w, x, y, z]) => ({ w, x, y, z });
