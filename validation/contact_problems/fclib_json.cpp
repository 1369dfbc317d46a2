// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Contact problems as JSON: {"form": "local", "dim", "nc", "mu", "q", "W"} or {"form": "global", ..., "f",
// "w", "M", "H"}, "solution": {"r"}; a matrix is {"n": [rows, columns], "rows", "cols", "vals"}, triplets
// from 0.
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "validation/contact_problems/problem.hpp"

namespace rigor::validation {
namespace {

using nlohmann::json;

/// An int of the file; the JSON library would convert a number that no int can hold without a word.
int integerFrom(const json& j, const std::string& key) {
    const bool isInt = j.is_number_integer() && j.get<double>() >= std::numeric_limits<int>::min() &&
                       j.get<double>() <= std::numeric_limits<int>::max();
    if (!isInt) throw adapter::BadInput(key + ": found " + j.dump() + ", expected an integer");
    return j.get<int>();
}

std::vector<int> integers(const json& j, const char* key) {
    std::vector<int> values;
    for (const json& value : j.at(key)) values.push_back(integerFrom(value, key));
    return values;
}

SparseMatrix matrixFrom(const json& j) {
    const auto rows = integers(j, "rows"), columns = integers(j, "cols");
    const auto values = j.at("vals").get<std::vector<double>>();
    if (rows.size() != values.size() || columns.size() != values.size())
        throw adapter::BadInput("rows, cols and vals differ in length");
    std::vector<Triplet> entries;
    for (std::size_t k = 0; k < values.size(); ++k) entries.push_back({rows[k], columns[k], values[k]});
    return fromTriplets(integerFrom(j.at("n").at(0), "n"), integerFrom(j.at("n").at(1), "n"),
                        std::move(entries));
}

std::vector<double> numbers(const json& j, const char* key) {
    return j.at(key).get<std::vector<double>>();
}

ExportedProblem fromJson(const json& j) {
    ExportedProblem exported;
    ContactProblem& p = exported.problem;
    exported.title = j.value("name", "");
    exported.description = j.value("source", "");
    p.dimension = integerFrom(j.at("dim"), "dim");
    p.mu = numbers(j, "mu");
    const std::string form = j.at("form");
    if (form != "local" && form != "global")
        throw adapter::BadInput("/form: found \"" + form + "\", expected \"local\" or \"global\"");
    exported.isGlobal = form == "global";
    if (exported.isGlobal) {
        p.f = numbers(j, "f");
        p.w = numbers(j, "w");
        p.M = matrixFrom(j.at("M"));
        p.H = matrixFrom(j.at("H"));
    } else {
        p.q = numbers(j, "q");
        const SparseMatrix W = matrixFrom(j.at("W"));
        const std::size_t n = p.q.size();
        checkDenseSize(n);
        if (static_cast<std::size_t>(W.rows) != n || static_cast<std::size_t>(W.columns) != n)
            throw adapter::BadInput("/W/n: found " + std::to_string(W.rows) + " x " +
                                    std::to_string(W.columns) + ", expected " + std::to_string(n));
        p.W.assign(n * n, 0.0);
        for (const Triplet& e : toTriplets(W)) p.W[e.row * n + e.column] = e.value;
    }
    if (j.contains("solution")) {
        const json& s = j.at("solution");
        if (s.contains("r")) exported.storedR = numbers(s, "r");
        if (s.contains("v")) exported.storedV = numbers(s, "v");
    }
    return exported;
}

}  // namespace

ExportedProblem readJsonProblem(const std::filesystem::path& file) {
    const std::string name = file.string();
    std::ifstream in(file, std::ios::binary);
    if (!in) throw adapter::BadInput(name + ": cannot be read");
    return parseJsonProblem({std::istreambuf_iterator<char>(in), {}}, name);
}

ExportedProblem parseJsonProblem(const std::string& text, const std::string& name) {
    ExportedProblem exported;
    try {
        exported = fromJson(json::parse(text));
    } catch (const json::exception& error) {
        throw adapter::BadInput(name + ": " + error.what());
    } catch (const adapter::BadInput& error) {
        throw adapter::BadInput(name + ": " + error.what());
    }
    complete(exported, name);
    return exported;
}

ExportedProblem readContactProblem(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw adapter::BadInput(file.string() + ": there is no such file");
    const std::string ending = file.extension();
    if (ending == ".json") return readJsonProblem(file);
    if (ending == ".hdf5" || ending == ".h5") return readFclib(file);
    throw adapter::BadInput(file.string() + ": expected a contact problem, .hdf5, .h5 or .json");
}

}  // namespace rigor::validation
