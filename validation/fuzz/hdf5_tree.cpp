// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/fuzz/hdf5_tree.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "validation/contact_problems/problem.hpp"
#include "validation/fuzz/targets.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/results/trajectory_file.hpp"

namespace rigor::fuzz {
namespace {

template <class T>
std::vector<T> valuesOf(std::istream& in) {
    std::vector<T> values;
    for (std::string word; in >> word;) {
        std::istringstream number(word);
        T value{};
        number >> value;
        if constexpr (std::numeric_limits<T>::has_quiet_NaN)
            if (word == "nan") value = std::numeric_limits<T>::quiet_NaN();
        values.push_back(value);
    }
    return values;
}

std::string restOf(std::istream& in) {
    std::string rest;
    std::getline(in >> std::ws, rest);
    return rest;
}

void add(results::Hdf5File& file, const std::string& line) {
    std::istringstream in(line);
    std::string kind, path, name;
    in >> kind >> path;
    if (kind == "group") {
        file.createGroup(path);
    } else if (kind == "doubles" || kind == "integers") {
        int columns = 0;
        in >> columns;
        if (kind == "doubles")
            file.writeDoubles(path, valuesOf<double>(in), columns, "1");
        else
            file.writeIntegers(path, valuesOf<int>(in), columns, "1");
    } else if (kind == "string") {
        file.writeText(path, restOf(in));
    } else if (kind == "text") {
        in >> name;
        file.setText(path, name.c_str(), restOf(in));
    } else if (kind == "integer") {
        int value = 0;
        in >> name >> value;
        file.setInteger(path, name.c_str(), value);
    } else if (kind == "number") {
        double value = 0.0;
        in >> name >> value;
        file.setDouble(path, name.c_str(), value);
    }
}

}  // namespace

std::string hdf5From(const std::string& text) {
    results::Hdf5File file = results::Hdf5File::create();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        try {
            add(file, line);
        } catch (const std::exception&) {
            // A line that cannot be written is left out.
        }
    }
    return file.finish();
}

void readTrajectoryTree(const std::string& bytes) {
    const std::string image = hdf5From(bytes);
    try {
        const results::TrajectoryFile file = results::parseTrajectory(image);
        results::requireStates(file);
        // Readers go through all frames and contacts without a look at the sizes.
        double sum = 0.0;
        for (const auto& body : file.bodies)
            for (std::size_t f = 0; f < file.times.size(); ++f)
                sum += body.position.values.at(3 * f + 2) + body.orientation.values.at(4 * f + 3) +
                       body.velocity.values.at(3 * f + 2) + body.angularVelocity.values.at(3 * f + 2);
        for (const auto& contact : file.contacts)
            sum += static_cast<double>(file.bodies.at(static_cast<std::size_t>(contact.bodyA)).name.size() +
                                       file.bodies.at(static_cast<std::size_t>(contact.bodyB)).name.size());
        for (const auto& series : file.series)
            for (std::size_t f = 0; f < file.times.size(); ++f) sum += series.channel.values.at(f);
        volatile double used = sum;
        (void)used;
    } catch (const std::out_of_range&) {
        throw;
    } catch (const std::runtime_error&) {
        // The file was refused.
    }
}

void readFclibTree(const std::string& bytes) {
    const std::string image = hdf5From(bytes);
    try {
        (void)validation::parseFclib(image, "input");
    } catch (const adapter::BadInput&) {
        // The file was refused.
    }
}

void readFclibJson(const std::string& bytes) {
    try {
        (void)validation::parseJsonProblem(bytes, "input");
    } catch (const adapter::BadInput&) {
        // The file was refused.
    }
}

}  // namespace rigor::fuzz
