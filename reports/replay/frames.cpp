// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "reports/replay/frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "validation/statistics/quantile.hpp"

namespace rigor::report {
namespace {

using results::BodyChannels;
using results::Channel;
using results::ContactSample;
using results::TrajectoryFile;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kVelocityBits = 12, kDepthBits = 10, kImpulseBits = 10;
/// Bits of a normal. The drawn normal and the audited one agree to 1e-6 rad: rounding turns a normal by at
/// most sqrt(3) / 2^22 = 4e-7, single precision in the page by 1e-7 more.
constexpr int kNormalBits = 21;
constexpr double kLeastVelocity = 1e-9, kLeastDepth = 1e-12, kLeastImpulse = 1e-12;

using Indices = std::vector<std::size_t>;

/// The value that nine of ten finite, non-zero magnitudes stay below: one explosion does not coarsen all
/// else.
double typicalMagnitude(std::vector<double> magnitudes) {
    std::erase_if(magnitudes, [](double m) { return !std::isfinite(m) || m == 0.0; });
    if (magnitudes.empty()) return 0.0;
    return validation::quantile(std::move(magnitudes), 0.9);
}

/// Samples of the kept frames; NaN where the channel has none.
std::vector<double> pick(const Channel& channel, std::size_t columns, const Indices& kept) {
    std::vector<double> out;
    out.reserve(kept.size() * columns);
    for (const std::size_t f : kept)
        for (std::size_t c = 0; c < columns; ++c)
            out.push_back((f + 1) * columns <= channel.values.size() ? channel.values[f * columns + c]
                                                                     : kNaN);
    return out;
}

bool isMoving(const BodyChannels& body) {
    const auto changes = [](const std::vector<double>& values, std::size_t columns) {
        for (std::size_t i = columns; i < values.size(); ++i)
            if (!(values[i] == values[i % columns])) return true;
        return false;
    };
    return changes(body.position.values, 3) || changes(body.orientation.values, 4);
}

/// q and -q turn alike; the nearer one to the frame before predicts better.
void unwrap(std::vector<double>& q) {
    for (std::size_t i = 4; i + 4 <= q.size(); i += 4) {
        double dot = 0.0;
        for (std::size_t k = 0; k < 4; ++k) dot += q[i + k] * q[i - 4 + k];
        if (dot < 0.0)
            for (std::size_t k = 0; k < 4; ++k) q[i + k] = -q[i + k];
    }
}

/// Speeds of all moving bodies, for their quantum.
double typicalOf(const std::vector<BodyChannels>& bodies, const std::vector<int>& moving,
                 const Channel BodyChannels::*channel) {
    std::vector<double> all;
    for (const int b : moving) {
        const auto& values = (bodies[b].*channel).values;
        all.reserve(all.size() + values.size());
        for (const double v : values) all.push_back(std::abs(v));
    }
    return typicalMagnitude(std::move(all));
}

void encodeBodies(const std::vector<BodyChannels>& bodies, const std::vector<int>& moving, double length,
                  const Indices& kept, const Thinning& thinning, EncodedFrames& out) {
    const double p = quantumOf(length, thinning.positionBits, 1e-12);
    const double q = std::exp2(-thinning.orientationBits);
    const double v =
        quantumOf(typicalOf(bodies, moving, &BodyChannels::velocity), kVelocityBits, kLeastVelocity);
    const double w =
        quantumOf(typicalOf(bodies, moving, &BodyChannels::angularVelocity), kVelocityBits, kLeastVelocity);
    bool turns = true;
    for (const int index : moving) turns = turns && !bodies[index].orientation.values.empty();
    for (const int index : moving) {
        const auto& body = bodies[index];
        appendSeries(out.position, pick(body.position, 3, kept), 3, p);
        if (turns) {
            auto orientation = pick(body.orientation, 4, kept);
            unwrap(orientation);
            appendSeries(out.orientation, orientation, 4, q);
        }
        if (!thinning.velocities) continue;
        appendSeries(out.velocity, pick(body.velocity, 3, kept), 3, v);
        appendSeries(out.angularVelocity, pick(body.angularVelocity, 3, kept), 3, w);
    }
    out.meta["quantum"] = {{"position", p}, {"orientation", q}, {"velocity", v}, {"angularVelocity", w}};
    out.meta["turns"] = turns;
    out.meta["velocities"] = thinning.velocities;
}

// ---- contacts ----

/// Contacts of the kept frames that have them, in frame order, and how many each frame has (-1: not stored).
struct Picked {
    std::vector<const ContactSample*> contacts;
    std::vector<double> counts;
};

Picked pickContacts(const TrajectoryFile& file, const Indices& kept, const Indices& marked,
                    std::size_t every) {
    Picked out;
    std::size_t stored = 0;
    for (const std::size_t f : kept) {
        const bool has = results::contactsStored(file, f);
        const bool wanted = std::binary_search(marked.begin(), marked.end(), f) ||
                            (has && every > 0 && stored++ % every == 0);
        if (!has || !wanted) {
            out.counts.push_back(-1.0);
            continue;
        }
        const double t = file.times[f];
        auto it = std::lower_bound(file.contacts.begin(), file.contacts.end(), t,
                                   [](const ContactSample& c, double time) { return c.time < time; });
        const std::size_t before = out.contacts.size();
        for (; it != file.contacts.end() && it->time == t; ++it) out.contacts.push_back(&*it);
        out.counts.push_back(static_cast<double>(out.contacts.size() - before));
    }
    return out;
}

/// Predecessor of each contact: the one before with the same bodies and the same place among theirs, or -1.
std::vector<std::int64_t> predecessors(const Picked& picked) {
    std::map<std::array<int, 3>, std::int64_t> latest;
    std::vector<std::int64_t> out;
    std::size_t next = 0;
    for (const double count : picked.counts) {
        std::map<std::array<int, 2>, int> seen;
        for (double k = 0; k < count; ++k, ++next) {
            const auto& c = *picked.contacts[next];
            const int place = seen[{c.bodyA, c.bodyB}]++;
            const auto [it, isNew] = latest.try_emplace({c.bodyA, c.bodyB, place}, -1);
            out.push_back(it->second);
            it->second = static_cast<std::int64_t>(next);
        }
    }
    return out;
}

using Number = double (*)(const ContactSample&);
constexpr std::array<Number, 3> kPoint{[](const ContactSample& c) { return c.pointA[0]; },
                                       [](const ContactSample& c) { return c.pointA[1]; },
                                       [](const ContactSample& c) { return c.pointA[2]; }};
constexpr std::array<Number, 3> kOffset{[](const ContactSample& c) { return c.pointB[0] - c.pointA[0]; },
                                        [](const ContactSample& c) { return c.pointB[1] - c.pointA[1]; },
                                        [](const ContactSample& c) { return c.pointB[2] - c.pointA[2]; }};
constexpr std::array<Number, 3> kNormal{[](const ContactSample& c) { return c.normal[0]; },
                                        [](const ContactSample& c) { return c.normal[1]; },
                                        [](const ContactSample& c) { return c.normal[2]; }};
constexpr std::array<Number, 1> kDepth{[](const ContactSample& c) { return c.depth; }};
constexpr std::array<Number, 4> kImpulse{[](const ContactSample& c) { return c.normalImpulse; },
                                         [](const ContactSample& c) { return c.frictionImpulse[0]; },
                                         [](const ContactSample& c) { return c.frictionImpulse[1]; },
                                         [](const ContactSample& c) { return c.frictionImpulse[2]; }};

std::vector<double> columnOf(const Picked& picked, Number number) {
    std::vector<double> out;
    out.reserve(picked.contacts.size());
    for (const auto* c : picked.contacts) out.push_back(number(*c));
    return out;
}

void encodeContacts(const TrajectoryFile& file, double pointQuantum, const Indices& kept,
                    const Indices& marked, std::size_t every, EncodedFrames& out) {
    const Picked picked = pickContacts(file, kept, marked, every);
    appendSeries(out.contactCounts, picked.counts, 1, 1.0);
    constexpr std::array<Number, 4> ids{[](const ContactSample& c) { return static_cast<double>(c.bodyA); },
                                        [](const ContactSample& c) { return static_cast<double>(c.bodyB); },
                                        [](const ContactSample& c) { return static_cast<double>(c.shapeA); },
                                        [](const ContactSample& c) { return static_cast<double>(c.shapeB); }};
    std::vector<std::int64_t> chain(picked.contacts.size());
    for (std::size_t i = 0; i < chain.size(); ++i) chain[i] = static_cast<std::int64_t>(i) - 1;
    for (const Number id : ids) appendLinked(out.contactIds, columnOf(picked, id), chain, 1.0);

    const auto previous = predecessors(picked);
    const auto magnitude = [&](Number number) {
        auto values = columnOf(picked, number);
        for (double& v : values) v = std::abs(v);
        return typicalMagnitude(std::move(values));
    };
    const double depth = quantumOf(magnitude(kDepth[0]), kDepthBits, kLeastDepth);
    const double impulse = quantumOf(magnitude(kImpulse[0]), kImpulseBits, kLeastImpulse);
    const auto append = [&](const auto& numbers, double quantum) {
        for (const Number number : numbers)
            appendLinked(out.contactNumbers, columnOf(picked, number), previous, quantum);
    };
    append(kPoint, pointQuantum);
    append(kOffset, std::min(depth, pointQuantum));
    append(kNormal, std::exp2(-kNormalBits));
    append(kDepth, depth);
    append(kImpulse, impulse);
    out.meta["contacts"] = picked.contacts.size();
    out.meta["contactInstants"] = file.contactInstantsKnown;
    out.meta["contactQuantum"] = {{"point", pointQuantum},
                                  {"offset", std::min(depth, pointQuantum)},
                                  {"normal", std::exp2(-kNormalBits)},
                                  {"depth", depth},
                                  {"impulse", impulse}};
}

}  // namespace

std::vector<std::size_t> keptFrames(std::size_t frames, std::size_t atMost, std::size_t multiple,
                                    const std::vector<std::size_t>& marked) {
    if (frames == 0) return {};
    std::vector<std::size_t> out{0, frames - 1};
    atMost = std::max<std::size_t>(2, atMost);
    std::size_t every = std::max<std::size_t>(1, (frames - 1 + atMost - 2) / (atMost - 1));
    if (every > 1 && multiple > 1 && frames / multiple >= 2)
        every = (every + multiple - 1) / multiple * multiple;
    for (std::size_t f = every; f + 1 < frames; f += every) out.push_back(f);
    for (const std::size_t f : marked)
        if (f < frames) out.push_back(f);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

EncodedFrames encodeFrames(const TrajectoryFile& file, bool ofReference, double length, const Indices& kept,
                           const Indices& marked, const Thinning& thinning) {
    const auto& bodies = ofReference ? file.reference : file.bodies;
    EncodedFrames out;
    std::vector<int> moving, names;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!ofReference && !isMoving(bodies[i])) continue;
        const auto at = std::find_if(file.bodies.begin(), file.bodies.end(),
                                     [&](const auto& b) { return b.name == bodies[i].name; });
        if (at == file.bodies.end()) continue;
        moving.push_back(static_cast<int>(i));
        names.push_back(static_cast<int>(at - file.bodies.begin()));
    }
    std::vector<double> steps;
    for (const std::size_t f : kept) steps.push_back(static_cast<double>(f) * file.stride);
    appendSeries(out.steps, steps, 1, 1.0);
    out.meta = {{"frames", kept.size()}, {"moving", names}};
    encodeBodies(bodies, moving, length, kept, thinning, out);
    out.meta["contacts"] = nullptr;
    if (!ofReference)
        encodeContacts(file, 4.0 * quantumOf(length, thinning.positionBits, 1e-12), kept, marked,
                       thinning.contactEvery, out);
    return out;
}

}  // namespace rigor::report
