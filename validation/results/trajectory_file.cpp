// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "validation/results/trajectory_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "validation/results/files.hpp"
#include "validation/results/hdf5_file.hpp"
#include "validation/results/trial.hpp"

namespace rigor::results {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 4;  ///< format of files whose contacts stand at the ends of their steps
constexpr int kFormatOfStarts = 3;
constexpr int kLastWithoutInstants = 2;
constexpr const char* kScene = "_";  ///< dataset name of a series without a subject

/// Names become HDF5 links: '/' and '.' have a meaning there, and "_" marks the escape.
std::string linkName(const std::string& name) {
    if (name == kScene) return "%5F";
    if (name.empty()) return kScene;
    std::string link;
    for (const char c : name) {
        if (c == '%' || c == '/' || c == '.') {
            constexpr const char* digits = "0123456789ABCDEF";
            const auto code = static_cast<unsigned char>(c);
            link += '%';
            link += digits[code >> 4];
            link += digits[code & 15];
        } else {
            link += c;
        }
    }
    return link;
}

struct ChannelName {
    const char* name;
    Channel BodyChannels::*channel;
};
constexpr ChannelName kChannels[]{{"position", &BodyChannels::position},
                                  {"orientation", &BodyChannels::orientation},
                                  {"velocity", &BodyChannels::velocity},
                                  {"angular_velocity", &BodyChannels::angularVelocity}};

void writeBodies(Hdf5File& file, const std::string& folder, const std::vector<BodyChannels>& bodies) {
    file.createGroup(folder);
    int index = 0;
    for (const BodyChannels& body : bodies) {
        const std::string group = folder + "/" + linkName(body.name);
        file.createGroup(group);
        file.setText(group, "name", body.name);
        file.setInteger(group, "index", index++);
        for (const auto& [name, channel] : kChannels)
            if (const Channel& c = body.*channel; c.columns > 0)
                file.writeDoubles(group + "/" + name, c.values, c.columns, c.unit);
    }
}

std::vector<BodyChannels> readBodies(Hdf5File& file, const std::string& folder) {
    std::vector<BodyChannels> bodies;
    const auto groups = file.children(folder);
    bodies.resize(groups.size());
    for (const std::string& child : groups) {
        const std::string group = folder + "/" + child;
        const auto index = static_cast<std::size_t>(file.integer(group, "index"));
        if (index >= bodies.size()) throw std::runtime_error("index of " + group + " is out of range");
        BodyChannels& body = bodies[index];
        body.name = file.text(group, "name");
        for (const auto& [name, channel] : kChannels) {
            const std::string dataset = group + "/" + name;
            if (!file.exists(dataset)) continue;
            Channel& c = body.*channel;
            c.values = file.readDoubles(dataset, c.columns);
            c.unit = file.text(dataset, "unit");
        }
    }
    return bodies;
}

void writeSeries(Hdf5File& file, const std::vector<SeriesChannel>& series) {
    file.createGroup("/series");
    int index = 0;
    for (const SeriesChannel& s : series) {
        const std::string group = "/series/" + linkName(s.name);
        if (!file.exists(group)) {
            file.createGroup(group);
            file.setText(group, "name", s.name);
        }
        const std::string dataset = group + "/" + linkName(s.subject);
        file.writeDoubles(dataset, s.channel.values, s.channel.columns, s.channel.unit);
        file.setText(dataset, "subject", s.subject);
        file.setInteger(dataset, "index", index++);
    }
}

std::vector<SeriesChannel> readSeries(Hdf5File& file) {
    std::vector<std::pair<int, SeriesChannel>> found;
    for (const std::string& child : file.children("/series")) {
        const std::string group = "/series/" + child;
        for (const std::string& subject : file.children(group)) {
            const std::string dataset = group + "/" + subject;
            auto& [index, s] = found.emplace_back();
            index = file.integer(dataset, "index");
            s.name = file.text(group, "name");
            s.subject = file.text(dataset, "subject");
            s.channel.values = file.readDoubles(dataset, s.channel.columns);
            s.channel.unit = file.text(dataset, "unit");
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SeriesChannel> series;
    for (auto& entry : found) series.push_back(std::move(entry.second));
    return series;
}

// ------------------------------------------------------------------------------------------- contacts
struct ContactField {
    const char* name;
    const char* unit;
    int columns;
    double* (*at)(ContactSample&);  ///< first of `columns` consecutive values
};
constexpr ContactField kContactFields[]{
    {"time", "s", 1, [](ContactSample& c) { return &c.time; }},
    {"point_a", "m", 3, [](ContactSample& c) { return c.pointA; }},
    {"point_b", "m", 3, [](ContactSample& c) { return c.pointB; }},
    {"normal", "1", 3, [](ContactSample& c) { return c.normal; }},
    {"depth", "m", 1, [](ContactSample& c) { return &c.depth; }},
    {"normal_impulse", "N s", 1, [](ContactSample& c) { return &c.normalImpulse; }},
    {"friction_impulse", "N s", 3, [](ContactSample& c) { return c.frictionImpulse; }}};

void writeContacts(Hdf5File& file, const std::vector<ContactSample>& contacts) {
    file.createGroup("/contacts");
    std::vector<int> indices;
    indices.reserve(4 * contacts.size());
    for (const ContactSample& c : contacts)
        indices.insert(indices.end(), {c.bodyA, c.bodyB, c.shapeA, c.shapeB});
    file.writeIntegers("/contacts/body_a_body_b_shape_a_shape_b", indices, 4, "1");
    for (const ContactField& field : kContactFields) {
        std::vector<double> values;
        values.reserve(contacts.size() * field.columns);
        for (ContactSample c : contacts) {
            const double* first = field.at(c);
            values.insert(values.end(), first, first + field.columns);
        }
        file.writeDoubles(std::string("/contacts/") + field.name, values, field.columns, field.unit);
    }
}

std::vector<ContactSample> readContacts(Hdf5File& file) {
    int columns = 0;
    const auto indices = file.readIntegers("/contacts/body_a_body_b_shape_a_shape_b", columns);
    if (columns != 4) throw std::runtime_error("the contact indices have not four columns");
    std::vector<ContactSample> contacts(indices.size() / 4);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        ContactSample& c = contacts[i];
        c.bodyA = indices[4 * i];
        c.bodyB = indices[4 * i + 1];
        c.shapeA = indices[4 * i + 2];
        c.shapeB = indices[4 * i + 3];
    }
    for (const ContactField& field : kContactFields) {
        const auto values = file.readDoubles(std::string("/contacts/") + field.name, columns);
        const auto width = static_cast<std::size_t>(field.columns);
        if (columns != field.columns || values.size() != contacts.size() * width)
            throw std::runtime_error(std::string("/contacts/") + field.name + " has the wrong size");
        for (std::size_t i = 0; i < contacts.size(); ++i)
            std::copy_n(values.begin() + (i * width), width, field.at(contacts[i]));
    }
    return contacts;
}

std::string imageOf(const TrajectoryFile& data) {
    Hdf5File file = Hdf5File::create();
    file.setInteger("/", "rigor_trajectory",
                    !data.contactInstantsKnown ? kLastWithoutInstants
                    : data.contactsAtStepEnd   ? kFormat
                                               : kFormatOfStarts);
    file.setText("/", "scenario", data.scenario);
    file.setText("/", "spec", data.spec);
    file.setText("/", "case_id", data.caseId);
    file.setDouble("/", "dt", data.dt);
    file.setInteger("/", "stride", data.stride);
    file.setInteger("/", "contact_stride", data.contactStride);
    file.writeDoubles("/time", data.times, 1, "s");
    writeBodies(file, "/bodies", data.bodies);
    writeBodies(file, "/reference", data.reference);
    writeSeries(file, data.series);
    writeContacts(file, data.contacts);
    return file.finish();
}

/// Readers index the arrays by frame and body: a channel has its columns, and a row for each frame.
void checkChannel(const std::string& what, const Channel& channel, int columns, std::size_t frames) {
    if (channel.columns != columns || channel.values.size() != static_cast<std::size_t>(columns) * frames)
        throw std::runtime_error(what + ": found " + std::to_string(channel.values.size()) + " values in " +
                                 std::to_string(channel.columns) + " columns, expected " +
                                 std::to_string(frames) + " rows of " + std::to_string(columns));
}

void checkBodies(const std::string& folder, const TrajectoryFile& data,
                 const std::vector<BodyChannels>& bodies, bool whole) {
    constexpr int kColumns[] = {3, 4, 3, 3};
    for (const BodyChannels& body : bodies)
        for (std::size_t i = 0; i < std::size(kChannels); ++i) {
            const Channel& channel = body.*kChannels[i].channel;
            if (whole || channel.columns != 0)
                checkChannel(folder + "/" + body.name + "/" + kChannels[i].name, channel, kColumns[i],
                             data.times.size());
        }
}

void checkContacts(const TrajectoryFile& data) {
    const auto bodies = static_cast<int>(data.bodies.size());
    for (std::size_t i = 0; i < data.contacts.size(); ++i) {
        const ContactSample& c = data.contacts[i];
        for (const int body : {c.bodyA, c.bodyB})
            if (body < 0 || body >= bodies)
                throw std::runtime_error("contact " + std::to_string(i) + ": found body " +
                                         std::to_string(body) + ", expected one of " +
                                         std::to_string(bodies));
        if (c.shapeA < 0 || c.shapeB < 0)
            throw std::runtime_error("contact " + std::to_string(i) + ": found a shape below 0");
    }
}

void checkWhole(const TrajectoryFile& data) {
    if (!(data.dt >= 0.0) || !std::isfinite(data.dt))
        throw std::runtime_error("dt: found " + std::to_string(data.dt) + ", expected seconds");
    for (const auto& [name, stride] :
         {std::pair{"stride", data.stride}, {"contact_stride", data.contactStride}})
        if (stride < 1)
            throw std::runtime_error(std::string(name) + ": found " + std::to_string(stride) +
                                     ", expected at least 1");
    checkBodies("/bodies", data, data.bodies, false);
    checkBodies("/reference", data, data.reference, false);
    for (const SeriesChannel& s : data.series)
        checkChannel("/series/" + s.name, s.channel, 1, data.times.size());
    checkContacts(data);
}

}  // namespace

TrajectoryFile parseTrajectory(const std::string& bytes, bool withContacts) {
    Hdf5File file = Hdf5File::fromImage(bytes);
    const int format = file.integer("/", "rigor_trajectory");
    if (format > kFormat)
        throw std::runtime_error("written by a newer rigor: found format " + std::to_string(format) +
                                 ", expected at most " + std::to_string(kFormat));
    TrajectoryFile data;
    data.scenario = file.text("/", "scenario");
    data.spec = file.text("/", "spec");
    data.caseId = file.text("/", "case_id");
    data.dt = file.number("/", "dt");
    data.stride = file.integer("/", "stride");
    if (format > 1) data.contactStride = file.integer("/", "contact_stride");
    int columns = 0;
    data.times = file.readDoubles("/time", columns);
    if (columns != 1) throw std::runtime_error("/time has not one column");
    data.bodies = readBodies(file, "/bodies");
    data.reference = readBodies(file, "/reference");
    data.series = readSeries(file);
    data.contactInstantsKnown = format > kLastWithoutInstants;
    data.contactsAtStepEnd = format > kFormatOfStarts;
    if (withContacts) data.contacts = readContacts(file);
    checkWhole(data);
    return data;
}

void requireStates(const TrajectoryFile& file) {
    checkBodies("/bodies", file, file.bodies, true);
}

bool contactsStored(const TrajectoryFile& file, std::size_t frame) {
    if (frame % static_cast<std::size_t>(std::max(1, file.contactStride)) != 0) return false;
    if (file.contactsAtStepEnd) return frame > 0 && frame < file.times.size();
    return file.contactInstantsKnown ? frame + 1 < file.times.size() : frame < file.times.size();
}

void writeTrajectory(const fs::path& target, const TrajectoryFile& data) {
    std::string bytes;
    try {
        bytes = imageOf(data);
    } catch (const std::exception& error) {
        throw std::runtime_error(target.string() + ": cannot be written: " + error.what());
    }
    replaceFile(target, sealed(std::move(bytes)));
}

TrajectoryFile readTrajectory(const fs::path& source, bool withContacts) {
    std::string bytes = readFile(source);
    const Seal seal = removeSeal(bytes);
    if (seal == Seal::Bad)
        throw EnvironmentError(source, "is damaged: its checksum does not fit its content", 0);
    // A file of an older version has no seal. If it is damaged, the HDF5 library may crash on it.
    if (seal == Seal::Absent)
        if (const auto failure = failureInChild([&] { (void)parseTrajectory(bytes, withContacts); });
            !failure.empty())
            throw EnvironmentError(source, "cannot be read as a trajectory: " + failure, 0);
    try {
        return parseTrajectory(bytes, withContacts);
    } catch (const std::exception& error) {
        throw EnvironmentError(source, std::string("cannot be read as a trajectory: ") + error.what(), 0);
    }
}

std::string trajectoryProblem(const fs::path& file) {
    try {
        std::string bytes = readFile(file);
        const Seal seal = removeSeal(bytes);
        if (seal == Seal::Bad) return file.string() + ": is damaged: its checksum does not fit its content";
        if (seal == Seal::Absent) (void)readTrajectory(file);
        return "";
    } catch (const EnvironmentError& error) {
        return error.what();
    }
}

}  // namespace rigor::results
