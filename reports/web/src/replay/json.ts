// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A value of a JSON file whose shape the program has checked before it wrote the page.

// biome-ignore lint/suspicious/noExplicitAny: files are checked by the loader, not here
export type Json = any;
