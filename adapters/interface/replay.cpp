// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// A log is a sequence of entries, each one byte that gives its kind and then its numbers as they stand in
// memory: 'S' and how many steps, 'F' (force) or 'I' (impulse) with body and two vectors, 'P' with the number
// of bodies and their states.
#include "adapters/interface/replay.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace rigor::adapter {
namespace {

constexpr unsigned char kSteps = 'S', kForce = 'F', kImpulse = 'I', kStates = 'P';

class Reader {
  public:
    explicit Reader(const std::vector<unsigned char>& bytes) : bytes_(bytes) {}
    bool atEnd() const { return at_ == bytes_.size(); }
    template <class T>
    T get() {
        T value;
        read(&value, sizeof value);
        return value;
    }
    Vec3 vector() {
        const double x = get<double>(), y = get<double>();
        return {x, y, get<double>()};
    }
    std::vector<BodyState> states() {
        const auto count = get<std::uint64_t>();
        if (count > (bytes_.size() - at_) / sizeof(BodyState)) damaged();
        std::vector<BodyState> states(count);
        read(states.data(), count * sizeof(BodyState));
        return states;
    }
    [[noreturn]] static void damaged() { throw std::runtime_error("a snapshot that is damaged"); }

  private:
    void read(void* to, std::size_t size) {
        if (size > bytes_.size() - at_) damaged();
        if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
    }
    const std::vector<unsigned char>& bytes_;
    std::size_t at_ = 0;
};

/// Applies the calls of the log to a world; returns the offset of the count of the steps that end the log.
std::size_t replay(const std::vector<unsigned char>& log, World& world, StateSetting& setter) {
    Reader in(log);
    std::size_t at = 0, stepsAt = log.size();
    while (!in.atEnd()) {
        const auto kind = in.get<unsigned char>();
        stepsAt = log.size();
        if (kind == kSteps) {
            stepsAt = at + 1;
            for (auto left = in.get<std::uint64_t>(); left > 0; --left) world.step();
            at += 1 + sizeof(std::uint64_t);
        } else if (kind == kForce || kind == kImpulse) {
            const auto body = static_cast<int>(in.get<std::int64_t>());
            const Vec3 linear = in.vector(), angular = in.vector();
            if (kind == kForce)
                world.applyForce(body, linear, angular);
            else
                world.applyImpulse(body, linear, angular);
            at += 1 + sizeof(std::int64_t) + 6 * sizeof(double);
        } else if (kind == kStates) {
            const std::vector<BodyState> states = in.states();
            setter.setStates(states);
            at += 1 + sizeof(std::uint64_t) + states.size() * sizeof(BodyState);
        } else {
            Reader::damaged();
        }
    }
    return stepsAt;
}

StateSetting& setterOf(World& world) {
    auto* const setter = dynamic_cast<StateSetting*>(&world);
    if (setter == nullptr || world.staged() != nullptr)
        throw std::logic_error("a world that is replayed must take states and have no stages");
    return *setter;
}

}  // namespace

ReplayWorld::ReplayWorld(Build build) : build_(std::move(build)) {
    adopt(build_());
}

void ReplayWorld::adopt(std::unique_ptr<World> world) {
    setter_ = &setterOf(*world);
    world_ = std::move(world);
}

void ReplayWorld::put(const void* data, std::size_t size) {
    const std::size_t at = log_.size();
    log_.resize(at + size);
    if (size > 0) std::memcpy(log_.data() + at, data, size);
}

/// Called before an entry other than steps; true if the entry is to be recorded.
bool ReplayWorld::recording() {
    if (!records_) lost_ = true;
    return records_;
}

void ReplayWorld::putPush(unsigned char kind, int body, const Vec3& linear, const Vec3& angular) {
    const std::int64_t index = body;
    const double numbers[] = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
    put(&kind, 1);
    put(&index, sizeof index);
    put(numbers, sizeof numbers);
    stepsAt_ = log_.size();
}

void ReplayWorld::applyForce(int body, const Vec3& force, const Vec3& torque) {
    world_->applyForce(body, force, torque);
    if (recording()) putPush(kForce, body, force, torque);
}

bool ReplayWorld::applyImpulse(int body, const Vec3& impulse, const Vec3& angularImpulse) {
    if (!world_->applyImpulse(body, impulse, angularImpulse)) return false;
    if (recording()) putPush(kImpulse, body, impulse, angularImpulse);
    return true;
}

void ReplayWorld::setStates(std::span<const BodyState> states) {
    setter_->setStates(states);
    if (!recording()) return;
    const std::uint64_t count = states.size();
    put(&kStates, 1);
    put(&count, sizeof count);
    put(states.data(), states.size_bytes());
    stepsAt_ = log_.size();
}

void ReplayWorld::step() {
    world_->step();
    std::uint64_t count = 0;
    if (stepsAt_ == log_.size()) {
        put(&kSteps, 1);
        stepsAt_ = log_.size();
        put(&count, sizeof count);
    }
    std::memcpy(&count, log_.data() + stepsAt_, sizeof count);
    ++count;
    std::memcpy(log_.data() + stepsAt_, &count, sizeof count);
}

Snapshots* ReplayWorld::snapshots() {
    if (lost_) return nullptr;
    records_ = true;
    return this;
}

bool ReplayWorld::restore(const std::vector<unsigned char>& bytes) {
    std::unique_ptr<World> fresh = build_();
    const std::size_t stepsAt = replay(bytes, *fresh, setterOf(*fresh));
    adopt(std::move(fresh));
    log_ = bytes;
    stepsAt_ = stepsAt;
    return true;
}

}  // namespace rigor::adapter
