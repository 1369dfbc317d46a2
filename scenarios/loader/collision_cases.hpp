// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Files of collision queries: two posed shapes each, with the exact result if the file has it. Two formats:
// Rigor's format (JSON, collision.schema.json) and one query per line (JSON lines) as collections of known
// results are published.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/loader/loader.hpp"

namespace rigor::scenario {

/// Expected result in a file. Everything may be missing.
struct ExpectedContact {
    std::optional<double> signedDistance;  ///< [m]; < 0: minus the penetration depth
    std::optional<bool> overlap;           ///< none: touching, or not stated
    std::vector<Vec3> normals;             ///< unit, A to B; all that are equally good
    double accuracy = 0.0;                 ///< error bound of signedDistance [m]
    double normalTolerance = 0.0;          ///< uncertainty of the expected normal [rad]
};

struct CollisionCase {
    std::string name;
    int dimension = 3;
    Shape a, b;  ///< poses in the world; materials mean nothing here
    ExpectedContact expected;
    std::vector<std::string> tags;
    std::string unsupported;  ///< reason why the case cannot be queried (an unknown kind of shape); else ""
    int line = 0;             ///< line of the file, 1-based
    std::string text;         ///< the case by itself, JSON in its file's format: see readCollisionCase
};

struct CollisionFile {
    std::filesystem::path file;
    std::string name, title;
    std::vector<CollisionCase> cases;
};

/// Reads either format: a file whose first line is a whole JSON object is read line by line, unless that
/// object is itself a file in Rigor's format (it has the key `rigor_collision`). Throws LoadError with every
/// problem of a file in Rigor's format, with the problems of the first bad line of the other.
CollisionFile loadCollisionFile(const std::filesystem::path& file);

/// The case whose `text` this is.
CollisionCase readCollisionCase(const std::string& text);

/// The files of <library>/collision, sorted by name.
std::vector<LibraryEntry> listCollisionFiles();
/// A name of the library or a path to a file. Throws LoadError ("collision.not_found").
std::filesystem::path findCollisionFile(const std::string& nameOrPath);

}  // namespace rigor::scenario
