// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "cli/view/run_site.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/results/array_bundle.hpp"

namespace rigor::view {
namespace {

namespace fs = std::filesystem;
using results::ArrayBundle;
using results::BodyChannels;
using results::Channel;
using results::ContactSample;
using results::TrajectoryFile;

constexpr std::size_t kMostNumbers = 2 << 20;  ///< size limit of a response: 16 MiB

/// Types of the files of a report; everything else of the folder (the store, trajectories) stays where it is.
constexpr std::array<std::pair<const char*, const char*>, 11> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".pdf", "application/pdf"},
    {".csv", "text/csv; charset=utf-8"},
    {".gz", "application/gzip"},
    {".md", "text/markdown; charset=utf-8"},
    {".xml", "application/xml"},
    {".json", "application/json"},
    {".tex", "text/plain; charset=utf-8"},
}};

bool isInside(const fs::path& file, const fs::path& folder) {
    const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

/// Frames from .. from + count - 1 of one channel of all bodies, frame by frame; NaN where a body has none.
std::vector<double> gather(const std::vector<BodyChannels>& bodies, Channel BodyChannels::*channel,
                           std::size_t columns, std::size_t from, std::size_t count) {
    std::vector<double> out;
    out.reserve(count * bodies.size() * columns);
    for (std::size_t frame = from; frame < from + count; ++frame)
        for (const BodyChannels& body : bodies) {
            const std::vector<double>& values = (body.*channel).values;
            for (std::size_t c = 0; c < columns; ++c) {
                const std::size_t at = frame * columns + c;
                out.push_back(at < values.size() ? values[at] : std::numeric_limits<double>::quiet_NaN());
            }
        }
    return out;
}

/// Contacts of these frames; `contacts/frame` says which, counted from the first of all frames.
void addContacts(ArrayBundle& bundle, const TrajectoryFile& t, std::size_t from, std::size_t count) {
    std::vector<std::int32_t> frames, bodyA, bodyB, shapeA, shapeB;
    std::vector<double> pointA, pointB, normal, depth, impulse, friction;
    for (const ContactSample& c : t.contacts) {
        const auto it = std::lower_bound(t.times.begin(), t.times.end(), c.time - 1e-9 * t.dt);
        const auto frame = static_cast<std::size_t>(it - t.times.begin());
        if (frame < from || frame >= from + count) continue;
        frames.push_back(frame);
        bodyA.push_back(c.bodyA);
        bodyB.push_back(c.bodyB);
        shapeA.push_back(c.shapeA);
        shapeB.push_back(c.shapeB);
        pointA.insert(pointA.end(), c.pointA, c.pointA + 3);
        pointB.insert(pointB.end(), c.pointB, c.pointB + 3);
        normal.insert(normal.end(), c.normal, c.normal + 3);
        friction.insert(friction.end(), c.frictionImpulse, c.frictionImpulse + 3);
        depth.push_back(c.depth);
        impulse.push_back(c.normalImpulse);
    }
    bundle.add("contacts/frame", std::span(frames));
    bundle.add("contacts/body_a", std::span(bodyA));
    bundle.add("contacts/body_b", std::span(bodyB));
    bundle.add("contacts/shape_a", std::span(shapeA));
    bundle.add("contacts/shape_b", std::span(shapeB));
    bundle.add("contacts/point_a", std::span(pointA));
    bundle.add("contacts/point_b", std::span(pointB));
    bundle.add("contacts/normal", std::span(normal));
    bundle.add("contacts/depth", std::span(depth));
    bundle.add("contacts/normal_impulse", std::span(impulse));
    bundle.add("contacts/friction_impulse", std::span(friction));
}

}  // namespace

RunSite::RunSite(const fs::path& folder) {
    std::error_code error;
    folder_ = fs::canonical(folder, error);
    if (error || !fs::is_regular_file(folder_ / "index.html"))
        throw std::invalid_argument("'" + folder.string() +
                                    "' holds no run with a report; `rigor report` writes it");
}

std::string RunSite::contentSecurityPolicy() const {
    return "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; img-src "
           "'self' data: blob:; font-src 'self' data:; connect-src 'self'; worker-src blob:; base-uri "
           "'none'; "
           "form-action 'none'; frame-ancestors 'none'";
}

Reply RunSite::answer(const Request& request) {
    if (request.method != "GET") return problem(405, "a recorded run can only be read");
    constexpr std::string_view kTrajectory = "/trajectory/";
    if (request.path == "/") return file("/index.html");
    if (request.path.starts_with(kTrajectory))
        return trajectory(request.path.substr(kTrajectory.size()), request);
    return file(request.path);
}

Reply RunSite::file(const std::string& path) const {
    const fs::path relative = fs::path(path).relative_path();
    for (const fs::path& part : relative)
        if (part.empty() || part.string().starts_with('.')) return notFound();
    if (path.find('\0') != std::string::npos || path.find('\\') != std::string::npos) return notFound();
    std::error_code error;
    const fs::path found = fs::canonical(folder_ / relative, error);
    if (error || !isInside(found, folder_) || !fs::is_regular_file(found)) return notFound();
    const auto type = std::find_if(kTypes.begin(), kTypes.end(),
                                   [&](const auto& t) { return found.extension() == t.first; });
    if (type == kTypes.end()) return notFound();
    std::ifstream in(found, std::ios::binary);
    std::string body((std::istreambuf_iterator<char>(in)), {});
    if (!in) return problem(500, "could not be read");
    return {200, type->second, std::move(body)};
}

std::shared_ptr<const TrajectoryFile> RunSite::read(const std::string& id) {
    const bool legal = !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
               c == '-';
    });
    const fs::path path = folder_ / "trajectories" / (id + ".h5");
    std::error_code error;
    if (!legal || !fs::is_regular_file(path, error)) return nullptr;
    const std::lock_guard lock(reading_);
    if (lastId_ != id) {
        last_ = std::make_shared<const TrajectoryFile>(results::readTrajectory(path));
        lastId_ = id;
    }
    return last_;
}

Reply RunSite::trajectory(const std::string& id, const Request& request) {
    const auto t = read(id);
    if (t == nullptr) return notFound();
    const std::size_t frames = t->times.size(), bodies = t->bodies.size();
    const std::size_t most = std::max<std::size_t>(1, kMostNumbers / std::max<std::size_t>(1, 13 * bodies));
    const auto from = std::min(frames, static_cast<std::size_t>(request.number("from", 0, 0, 1e15)));
    const auto requested = static_cast<std::size_t>(request.number("count", 1e15, 1, 1e15));
    const std::size_t count = std::min({requested, most, frames - from});
    ArrayBundle bundle;
    bundle.add("time", std::span(t->times).subspan(from, count));
    const auto add = [&](const char* name, Channel BodyChannels::*channel, std::size_t columns) {
        bundle.add(name, std::span<const double>(gather(t->bodies, channel, columns, from, count)));
    };
    add("position", &BodyChannels::position, 3);
    add("orientation", &BodyChannels::orientation, 4);
    add("velocity", &BodyChannels::velocity, 3);
    add("angular_velocity", &BodyChannels::angularVelocity, 3);
    addContacts(bundle, *t, from, count);
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const BodyChannels& body : t->bodies) names.push_back(body.name);
    const nlohmann::ordered_json meta{{"case", t->caseId},
                                      {"scenario", t->scenario},
                                      {"spec", t->spec},
                                      {"dt", t->dt},
                                      {"stride", t->stride},
                                      {"contact_stride", t->contactStride},
                                      {"contact_instants", t->contactInstantsKnown},
                                      {"contacts_at_step_end", t->contactsAtStepEnd},
                                      {"frames", frames},
                                      {"from", from},
                                      {"count", count},
                                      {"bodies", std::move(names)}};
    return {200, "application/octet-stream", bundle.bytes(meta)};
}

}  // namespace rigor::view
