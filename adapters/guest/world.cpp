// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/guest/world.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace rigor::guest {
namespace {

using namespace adapter;

constexpr std::size_t kReadBackColumns = 29, kPairColumns = 4;

Vec3 vectorAt(const Table& table, std::size_t row, std::size_t column) {
    return {table(row, column), table(row, column + 1), table(row, column + 2)};
}

BodyState stateAt(const Table& t, std::size_t row, std::size_t column) {
    return {vectorAt(t, row, column),
            {t(row, column + 3), t(row, column + 4), t(row, column + 5), t(row, column + 6)},
            vectorAt(t, row, column + 7),
            vectorAt(t, row, column + 10)};
}

void append(std::vector<double>& values, const Vec3& v) {
    values.insert(values.end(), {v.x, v.y, v.z});
}

Table tableOf(std::span<const BodyState> states) {
    Table table{states.size(), kStateColumns, {}};
    table.values.reserve(states.size() * kStateColumns);
    for (const BodyState& s : states) {
        append(table.values, s.position);
        const Quat& q = s.orientation;
        table.values.insert(table.values.end(), {q.w, q.x, q.y, q.z});
        append(table.values, s.velocity);
        append(table.values, s.angularVelocity);
    }
    return table;
}

/// A whole number in [0, count).
int indexAt(const Table& table, std::size_t row, std::size_t column, double count, const char* what) {
    const double value = table(row, column);
    if (!(value >= 0.0 && value < count) || value != std::floor(value))
        throw BadFrame(std::string(what) + ": found " + std::to_string(value) +
                       ", expected a whole number from 0, below " + std::to_string(static_cast<long>(count)));
    return static_cast<int>(value);
}

std::vector<BodyState> statesIn(const Frame& answer, std::size_t count) {
    const Table table = answer.table("states", kStateColumns);
    if (table.rows != count)
        throw BadFrame("states of " + std::to_string(table.rows) + " bodies, expected " +
                       std::to_string(count));
    return statesOf(table);
}

/// Indices in a list become true.
void mark(const Json& header, const char* key, std::vector<bool>& flags, bool value) {
    const auto list = header.find(key);
    if (list == header.end()) return;
    for (const Json& index : *list) {
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= flags.size())
            throw BadFrame(std::string("the key '") + key + "': found " + index.dump() +
                           ", expected an index");
        flags[index.get<std::size_t>()] = value;
    }
}

std::int64_t countIn(const Json& counters, const char* key) {
    const auto it = counters.find(key);
    return it == counters.end() ? -1 : it->get<std::int64_t>();
}

StepCounters countersOf(const Json& header) {
    StepCounters c;
    const auto seconds = header.find("seconds");
    if (seconds == header.end() || !seconds->is_number())
        throw BadFrame("the key 'seconds' is missing: the time of the step by the guest's own clock");
    c.stepSeconds = seconds->get<double>();
    if (!(c.stepSeconds >= 0.0))
        throw BadFrame("the key 'seconds': found " + seconds->dump() + ", expected >= 0");
    if (const auto phases = header.find("phases"); phases != header.end())
        c.phaseSeconds = phases->get<std::map<std::string, double>>();
    const auto counters = header.find("counters");
    if (counters == header.end()) return c;
    c.pairTests = countIn(*counters, "pair_tests");
    c.narrowPhaseQueries = countIn(*counters, "narrow_phase_queries");
    c.pairs = countIn(*counters, "pairs");
    c.contacts = countIn(*counters, "contacts");
    c.islands = countIn(*counters, "islands");
    c.solverIterations = countIn(*counters, "solver_iterations");
    c.residual = counters->value("residual", -1.0);
    return c;
}

LedgerEntry ledgerEntryOf(const Json& json) {
    LedgerEntry entry{json.at("topic"), json.at("requested"), json.at("resolved"), Realisation::Exact,
                      json.value("reason", "")};
    const std::string realisation = json.at("realisation");
    for (const Realisation r : {Realisation::Exact, Realisation::Approximate, Realisation::Unsupported})
        if (realisation == realisationName(r)) {
            entry.realisation = r;
            return entry;
        }
    throw BadFrame("ledger.realisation: found '" + realisation +
                   "', expected exact, approximate or unsupported");
}

Scheme schemeOf(const Json& header) {
    const std::string name = header.at("scheme");
    for (const Scheme s : {Scheme::Unknown, Scheme::SymplecticEuler, Scheme::ExplicitEuler,
                           Scheme::MoreauMidpoint, Scheme::VelocityVerlet, Scheme::RungeKutta4})
        if (name == schemeName(s)) return s;
    throw BadFrame("the key 'scheme': found '" + name + "', which is none of the page's schemes");
}

GuestWorld::Abilities abilitiesOf(const Json& header) {
    GuestWorld::Abilities a;
    a.scheme = schemeOf(header);
    a.impulses = header.value("impulses", false);
    a.snapshots = header.value("snapshots", false);
    a.warmStart = header.value("set_states", "");
    if (!a.warmStart.empty() && a.warmStart != "kept" && a.warmStart != "discarded" &&
        a.warmStart != "contacts discarded")
        throw BadFrame("the key 'set_states': found '" + a.warmStart +
                       "', expected kept, discarded or contacts discarded");
    return a;
}

}  // namespace

std::vector<BodyState> statesOf(const Table& table) {
    std::vector<BodyState> states;
    states.reserve(table.rows);
    for (std::size_t i = 0; i < table.rows; ++i) states.push_back(stateAt(table, i, 0));
    return states;
}

std::vector<ContactPoint> contactsOf(const Table& t, std::size_t bodies) {
    std::vector<ContactPoint> contacts(t.rows);
    for (std::size_t i = 0; i < t.rows; ++i) {
        ContactPoint& c = contacts[i];
        c.bodyA = indexAt(t, i, 0, static_cast<double>(bodies), "contact, body A");
        c.bodyB = indexAt(t, i, 1, static_cast<double>(bodies), "contact, body B");
        if (c.bodyA >= c.bodyB)
            throw BadFrame("a contact of bodies " + std::to_string(c.bodyA) + " and " +
                           std::to_string(c.bodyB) + ": A is the one of lower index");
        c.shapeA = indexAt(t, i, 2, 1e6, "contact, shape of A");
        c.shapeB = indexAt(t, i, 3, 1e6, "contact, shape of B");
        c.pointA = vectorAt(t, i, 4);
        c.pointB = vectorAt(t, i, 7);
        c.normal = vectorAt(t, i, 10);
        c.depth = t(i, 13);
        c.hasImpulse = t(i, 14) != 0.0;
        c.normalImpulse = t(i, 15);
        c.frictionImpulse = vectorAt(t, i, 16);
    }
    return contacts;
}

GuestWorld::GuestWorld(std::shared_ptr<Connection> connection, std::int64_t number, std::size_t joints,
                       Abilities abilities, std::vector<BodyState> states)
    : connection_(std::move(connection)),
      number_(number),
      abilities_(std::move(abilities)),
      states_(std::move(states)),
      holds_(joints, true),
      asleep_(states_.size(), false) {}

GuestWorld::~GuestWorld() {
    try {
        connection_->call("destroy", request());
    } catch (const std::exception&) {
        // A guest that has died has no worlds any more.
    }
}

Frame GuestWorld::request() const {
    Frame frame;
    frame.header["world"] = number_;
    return frame;
}

void GuestWorld::takeStates(const std::string& request, const Frame& answer) {
    states_ = connection_->take(request, [&] { return statesIn(answer, states_.size()); });
}

void GuestWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    forces_.push_back(body);
    append(forces_, force);
    append(forces_, torque);
}

bool GuestWorld::applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) {
    if (!abilities_.impulses) return false;
    Frame frame = request();
    frame.header["body"] = body;
    Table table{1, 6, {}};
    append(table.values, impulse);
    append(table.values, angularImpulse);
    frame.addTable("impulse", table);
    takeStates("impulse", connection_->call("impulse", std::move(frame)));
    return true;
}

void GuestWorld::step() {
    Frame frame = request();
    frame.addTable("forces", {forces_.size() / 7, 7, std::move(forces_)});
    forces_.clear();
    takeStep(connection_->call("step", std::move(frame)));
}

void GuestWorld::takeStep(const Frame& answer) {
    connection_->take("step", [&] {
        counters_ = countersOf(answer.header);
        asleep_.assign(asleep_.size(), false);
        mark(answer.header, "asleep", asleep_, true);
        mark(answer.header, "broken", holds_, false);
        states_ = statesIn(answer, states_.size());
        return 0;
    });
}

void GuestWorld::readStates(std::span<BodyState> states) const {
    std::copy_n(states_.begin(), std::min(states.size(), states_.size()), states.begin());
}

void GuestWorld::readContacts(std::vector<ContactPoint>& contacts) const {
    const Frame answer = connection_->call("contacts", request());
    contacts = connection_->take(
        "contacts", [&] { return contactsOf(answer.table("contacts", kContactColumns), states_.size()); });
}

ReadBack GuestWorld::readBack() const {
    const Frame answer = connection_->call("read_back", request());
    return connection_->take("read_back", [&] {
        const Table t = answer.table("bodies", kReadBackColumns), pairs = answer.table("pairs", kPairColumns);
        if (t.rows != states_.size()) throw BadFrame("read back of " + std::to_string(t.rows) + " bodies");
        ReadBack all;
        for (std::size_t i = 0; i < t.rows; ++i) {
            BodyReadBack body{t(i, 0), vectorAt(t, i, 1), {}, stateAt(t, i, 13), vectorAt(t, i, 26)};
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) body.inertia(r, c) = t(i, 4 + 3 * r + c);
            all.bodies.push_back(body);
        }
        for (std::size_t i = 0; i < pairs.rows; ++i)
            all.pairs.push_back({indexAt(pairs, i, 0, 1e6, "pair, material A"),
                                 indexAt(pairs, i, 1, 1e6, "pair, material B"), pairs(i, 2), pairs(i, 3)});
        return all;
    });
}

std::vector<LedgerEntry> GuestWorld::ledger() const {
    const Frame answer = connection_->call("ledger", request());
    return connection_->take("ledger", [&] {
        std::vector<LedgerEntry> lines;
        for (const Json& line : answer.header.at("lines")) lines.push_back(ledgerEntryOf(line));
        return lines;
    });
}

void GuestWorld::setAll(std::span<const BodyState> states) {
    Frame frame = request();
    frame.addTable("states", tableOf(states));
    takeStates("set_states", connection_->call("set_states", std::move(frame)));
}

void GuestWorld::save(std::vector<unsigned char>& bytes) const {
    const Frame answer = connection_->call("save", request());
    const auto guests = connection_->take("save", [&] { return answer.bytes("snapshot"); });
    // Forces of the next step have not been sent yet: their count and they stand before the guest's own bytes.
    const std::uint64_t count = forces_.size();
    bytes.resize(sizeof count + count * sizeof(double));
    std::memcpy(bytes.data(), &count, sizeof count);
    if (count > 0) std::memcpy(bytes.data() + sizeof count, forces_.data(), count * sizeof(double));
    bytes.insert(bytes.end(), guests.begin(), guests.end());
}

bool GuestWorld::restore(const std::vector<unsigned char>& bytes) {
    std::uint64_t count = 0;
    if (bytes.size() < sizeof count) throw std::runtime_error("a snapshot that is damaged");
    std::memcpy(&count, bytes.data(), sizeof count);
    if (count > (bytes.size() - sizeof count) / sizeof(double) || count % 7 != 0)
        throw std::runtime_error("a snapshot that is damaged");
    std::vector<double> forces(count);
    if (count > 0) std::memcpy(forces.data(), bytes.data() + sizeof count, count * sizeof(double));
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(sizeof count + count * sizeof(double));
    Frame frame = request();
    frame.addBytes("snapshot", {begin, bytes.end()});
    const Frame answer = connection_->call("restore", std::move(frame));
    if (!connection_->take("restore", [&] { return answer.header.at("restored").get<bool>(); })) return false;
    forces_ = std::move(forces);
    takeStates("restore", answer);
    return true;
}

std::unique_ptr<World> buildWorld(std::shared_ptr<Connection> connection, std::int64_t number,
                                  const Scenario& scenario, Frame request) {
    request.header["world"] = number;
    const Frame answer = connection->call("build", std::move(request));
    return connection->take("build", [&]() -> std::unique_ptr<World> {
        const auto abilities = abilitiesOf(answer.header);
        auto states = statesIn(answer, scenario.bodies.size());
        const std::size_t joints = scenario.joints.size();
        if (abilities.warmStart.empty())
            return std::make_unique<GuestWorld>(connection, number, joints, abilities, std::move(states));
        return std::make_unique<SettableGuestWorld>(connection, number, joints, abilities, std::move(states));
    });
}

}  // namespace rigor::guest
