// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The HDF5 layout of FCLIB (github.com/FrictionalContactLibrary/fclib, documentation of version 3):
//     /fclib_local    spacedim, W/, vectors/{q, mu}, info/             (V/, R/, s: mixed problems, not read)
//     /fclib_global   spacedim, M/, H/, G/, vectors/{f, w, mu, b}, info/
//     /solution       v, u, r, l
//     info/           title, description, math_info
//     a matrix        nzmax, m rows, n columns, nz, p, i, x; by nz
//                     -1  columns: those of j at p[j] .. p[j + 1] - 1, i their rows
//                     -2  rows:    those of r at p[r] .. p[r + 1] - 1, i their columns
//                     else nz triplets, i the rows and p the columns (CSparse's habit, which the files
//                     follow)
// Every number is a one-dimensional dataset.
#include <algorithm>

#include "validation/contact_problems/problem.hpp"
#include "validation/results/files.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/results/trial.hpp"

namespace rigor::validation {
namespace {

using adapter::BadInput;
using results::Hdf5File;

// ------------------------------------------------------------------------------------------- reading
int integerAt(const Hdf5File& file, const std::string& path) {
    int columns = 0;
    const auto values = file.readIntegers(path, columns);
    if (values.size() != 1)
        throw BadInput(path + " has " + std::to_string(values.size()) + " values, expected 1");
    return values[0];
}
std::vector<double> doublesAt(const Hdf5File& file, const std::string& path) {
    int columns = 0;
    return file.readDoubles(path, columns);
}
std::vector<double> optionalDoubles(const Hdf5File& file, const std::string& path) {
    return file.exists(path) ? doublesAt(file, path) : std::vector<double>{};
}
std::string optionalText(const Hdf5File& file, const std::string& path) {
    return file.exists(path) ? file.readText(path) : "";
}

SparseMatrix readMatrix(const Hdf5File& file, const std::string& group) {
    int columns = 0;
    const int m = integerAt(file, group + "/m"), n = integerAt(file, group + "/n");
    const int nz = integerAt(file, group + "/nz");
    const std::vector<int> p = file.readIntegers(group + "/p", columns);
    const std::vector<int> i = file.readIntegers(group + "/i", columns);
    const std::vector<double> x = file.readDoubles(group + "/x", columns);
    const auto refuse = [&group](const std::string& why) -> void { throw BadInput(group + ": " + why); };
    if (m < 0 || n < 0 || m > kMostRows || n > kMostRows)
        refuse("is " + std::to_string(m) + " x " + std::to_string(n) + ", expected 0 to " +
               std::to_string(kMostRows) + " rows and columns");
    std::vector<Triplet> entries;
    if (nz >= 0) {
        const auto count = static_cast<std::size_t>(nz);
        if (p.size() < count || i.size() < count || x.size() < count)
            refuse("has fewer than nz = " + std::to_string(nz) + " triplets");
        for (std::size_t k = 0; k < count; ++k) entries.push_back({i[k], p[k], x[k]});
    } else if (nz == -1 || nz == -2) {
        const int lines = nz == -1 ? n : m;
        if (p.size() != static_cast<std::size_t>(lines) + 1)
            refuse("p has " + std::to_string(p.size()) + " values, expected " + std::to_string(lines + 1));
        for (int line = 0; line < lines; ++line) {
            const int from = p[line], to = p[line + 1];
            if (from < 0 || to < from || static_cast<std::size_t>(to) > std::min(i.size(), x.size()))
                refuse("p[" + std::to_string(line) + "] points outside of i and x");
            for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k)
                entries.push_back(nz == -1 ? Triplet{i[k], line, x[k]} : Triplet{line, i[k], x[k]});
        }
    } else {
        refuse("nz is " + std::to_string(nz) + ", expected -1, -2 or a count");
    }
    try {
        return fromTriplets(m, n, std::move(entries));
    } catch (const BadInput& error) {
        throw BadInput(group + ": " + error.what());
    }
}

void readLocal(const Hdf5File& file, ExportedProblem& exported) {
    const std::string root = "/fclib_local";
    if (file.exists(root + "/V") || file.exists(root + "/R"))
        throw BadInput(root + ": mixed problems with V and R are not read");
    ContactProblem& p = exported.problem;
    p.q = doublesAt(file, root + "/vectors/q");
    const SparseMatrix W = readMatrix(file, root + "/W");
    const std::size_t n = p.q.size();
    checkDenseSize(n);
    if (static_cast<std::size_t>(W.rows) != n || static_cast<std::size_t>(W.columns) != n)
        throw BadInput(root + "/W is " + std::to_string(W.rows) + " x " + std::to_string(W.columns) +
                       ", expected the size of q, " + std::to_string(n));
    p.W.assign(n * n, 0.0);
    for (const Triplet& e : toTriplets(W)) p.W[e.row * n + e.column] = e.value;
}

void readGlobal(const Hdf5File& file, ExportedProblem& exported) {
    const std::string root = "/fclib_global";
    ContactProblem& p = exported.problem;
    p.M = readMatrix(file, root + "/M");
    p.H = readMatrix(file, root + "/H");
    p.f = doublesAt(file, root + "/vectors/f");
    p.w = doublesAt(file, root + "/vectors/w");
    if (!file.exists(root + "/G")) return;
    exported.G = readMatrix(file, root + "/G");
    exported.b = doublesAt(file, root + "/vectors/b");
}

/// Files that carry a solution of nothing but zeros have none.
std::vector<double> solution(const Hdf5File& file, const char* name) {
    std::vector<double> values = optionalDoubles(file, std::string("/solution/") + name);
    const bool any = std::any_of(values.begin(), values.end(), [](double x) { return x != 0.0; });
    return any ? values : std::vector<double>{};
}

// ------------------------------------------------------------------------------------------- writing
void writeMatrix(Hdf5File& file, const std::string& group, const SparseMatrix& A, SparseLayout layout) {
    file.createGroup(group);
    std::vector<Triplet> entries = toTriplets(A);
    const bool byRows = layout == SparseLayout::Rows;
    if (byRows)
        std::stable_sort(entries.begin(), entries.end(),
                         [](const Triplet& a, const Triplet& b) { return a.row < b.row; });
    std::vector<int> p, i;
    std::vector<double> x;
    for (const Triplet& e : entries) {
        i.push_back(byRows ? e.column : e.row);
        x.push_back(e.value);
        if (layout == SparseLayout::Triplets) p.push_back(e.column);
    }
    if (layout != SparseLayout::Triplets) {
        p.assign(static_cast<std::size_t>(byRows ? A.rows : A.columns) + 1, 0);
        for (const Triplet& e : entries) ++p[static_cast<std::size_t>(byRows ? e.row : e.column) + 1];
        for (std::size_t k = 1; k < p.size(); ++k) p[k] += p[k - 1];
    }
    const int count = entries.size();
    const int nz = layout == SparseLayout::Triplets ? count : byRows ? -2 : -1;
    const auto number = [&](const char* name, int value) {
        file.writeIntegers(group + "/" + name, {value}, 1, "");
    };
    number("nzmax", count);
    number("m", A.rows);
    number("n", A.columns);
    number("nz", nz);
    file.writeIntegers(group + "/p", p, 1, "");
    file.writeIntegers(group + "/i", i, 1, "");
    file.writeDoubles(group + "/x", x, 1, "");
}

void writeVectors(Hdf5File& file, const std::string& group,
                  const std::vector<std::pair<const char*, const std::vector<double>*>>& vectors) {
    file.createGroup(group);
    for (const auto& [name, values] : vectors)
        if (!values->empty()) file.writeDoubles(group + "/" + name, *values, 1, "");
}

SparseMatrix sparse(const std::vector<double>& W, std::size_t n) {
    std::vector<Triplet> entries;
    for (std::size_t k = 0; k < W.size(); ++k)
        if (W[k] != 0.0) entries.push_back({static_cast<int>(k / n), static_cast<int>(k % n), W[k]});
    return fromTriplets(n, n, std::move(entries));
}

}  // namespace

ExportedProblem readFclib(const std::filesystem::path& path) {
    const std::string name = path.string();
    try {
        // These files come from elsewhere, and the HDF5 library may crash on a damaged one.
        const std::string bytes = results::readFile(path);
        if (const auto failure = results::failureInChild([&] { (void)parseFclib(bytes, name); });
            !failure.empty())
            throw BadInput(failure.starts_with(name + ": ") ? failure.substr(name.size() + 2) : failure);
        return parseFclib(bytes, name);
    } catch (const results::EnvironmentError&) {
        throw;
    } catch (const BadInput&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw BadInput(name + ": " + error.what());
    }
}

ExportedProblem parseFclib(const std::string& bytes, const std::string& name) {
    ExportedProblem exported;
    try {
        const Hdf5File file = Hdf5File::fromImage(bytes);
        exported.isGlobal = file.exists("/fclib_global");
        if (!exported.isGlobal && !file.exists("/fclib_local"))
            throw BadInput("has neither /fclib_local nor /fclib_global");
        const std::string root = exported.isGlobal ? "/fclib_global" : "/fclib_local";
        exported.problem.dimension = integerAt(file, root + "/spacedim");
        exported.problem.mu = doublesAt(file, root + "/vectors/mu");
        exported.title = optionalText(file, root + "/info/title");
        exported.description = optionalText(file, root + "/info/description");
        exported.mathInfo = optionalText(file, root + "/info/math_info");
        if (exported.isGlobal)
            readGlobal(file, exported);
        else
            readLocal(file, exported);
        exported.storedV = solution(file, "v");
        exported.storedU = solution(file, "u");
        exported.storedR = solution(file, "r");
    } catch (const std::runtime_error& error) {
        throw BadInput(name + ": " + error.what());
    }
    complete(exported, name);
    return exported;
}

void writeFclib(const ExportedProblem& exported, const std::filesystem::path& path, SparseLayout layout) {
    const ContactProblem& p = exported.problem;
    Hdf5File file = Hdf5File::create();
    const std::string root = exported.isGlobal ? "/fclib_global" : "/fclib_local";
    file.createGroup(root);
    file.writeIntegers(root + "/spacedim", {p.dimension}, 1, "");
    if (exported.isGlobal) {
        writeMatrix(file, root + "/M", p.M, layout);
        writeMatrix(file, root + "/H", p.H, layout);
        if (!exported.b.empty()) writeMatrix(file, root + "/G", exported.G, layout);
        writeVectors(file, root + "/vectors", {{"f", &p.f}, {"w", &p.w}, {"mu", &p.mu}, {"b", &exported.b}});
    } else {
        writeMatrix(file, root + "/W", sparse(p.W, p.size()), layout);
        writeVectors(file, root + "/vectors", {{"q", &p.q}, {"mu", &p.mu}});
    }
    file.createGroup(root + "/info");
    for (const auto& [name, text] : {std::pair{"/title", &exported.title},
                                     {"/description", &exported.description},
                                     {"/math_info", &exported.mathInfo}})
        if (!text->empty()) file.writeText(root + "/info" + name, *text);
    if (!exported.storedR.empty() || !exported.storedU.empty() || !exported.storedV.empty())
        writeVectors(file, "/solution",
                     {{"v", &exported.storedV}, {"u", &exported.storedU}, {"r", &exported.storedR}});
    results::replaceFile(path, file.finish());
}

}  // namespace rigor::validation
