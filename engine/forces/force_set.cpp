// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/forces/force_set.hpp"

#include <type_traits>

#include "engine/core/error.hpp"

namespace rigor::engine {
namespace {

/// The two ends of a force; A is the world for forces on one body.
template <class S>
struct Ends {
    BodyId a, b;
    typename S::Vec anchorA = S::Vec::Zero(), anchorB = S::Vec::Zero();
};
template <class S, class Force>
Ends<S> endsOf(const Force& force) {
    if constexpr (requires { force.body; })
        return {{}, force.body};
    else
        return {force.bodyA, force.bodyB, force.anchorA, force.anchorB};
}

}  // namespace

template <class S>
ForceId ForceSet<S>::add(const ForceDef<S>& def, const BodyArrays<S>& bodies,
                         const IdTable<BodyTag>& bodyIds) {
    Ends<S> ends;
    bool one = false;
    std::visit(
        [&](const auto& force) {
            checkForce(force);
            ends = endsOf<S>(force);
            one = requires {
                force.body;
            };
        },
        def);
    Record record;
    record.def = def;
    ForcePlace<S>& place = record.place;
    place.a = ends.a ? bodyIds.dense(ends.a) : 0;
    place.b = ends.b ? bodyIds.dense(ends.b) : 0;
    if (place.a == place.b && !one) throw EngineError("force_body", "a spring needs two bodies");
    const auto dynamic = [&](std::uint32_t i) { return bodies.constants[i].type == BodyType::Dynamic; };
    if (!dynamic(place.a) && !dynamic(place.b))
        throw EngineError("force_body", "a force needs a dynamic body");
    place.armA = ends.anchorA - bodies.constants[place.a].centerOfMass;
    place.armB = ends.anchorB - bodies.constants[place.b].centerOfMass;
    record.id = ids_.add(static_cast<std::uint32_t>(records_.size()));
    records_.push_back(record);
    return record.id;
}

template <class S>
void ForceSet<S>::remove(ForceId id) {
    const std::uint32_t place = ids_.dense(id);
    ids_.remove(id);
    records_.erase(records_.begin() + place);
    for (std::uint32_t i = place; i < records_.size(); ++i) ids_.move(records_[i].id, i);
}

template <class S>
void ForceSet<S>::centerMoved(std::uint32_t body, const typename S::Vec& way) {
    for (Record& record : records_) {
        if (record.place.a == body) record.place.armA -= way;
        if (record.place.b == body) record.place.armB -= way;
    }
}

template <class S>
void ForceSet<S>::bodyRemoved(std::uint32_t gone, std::uint32_t last) {
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
        Record& record = records_[i];
        if (record.place.a == gone || record.place.b == gone) {
            ids_.remove(record.id);
            continue;
        }
        if (record.place.a == last) record.place.a = gone;
        if (record.place.b == last) record.place.b = gone;
        ids_.move(record.id, kept);
        if (kept != i) records_[kept] = record;
        ++kept;
    }
    records_.resize(kept);
}

template <class S>
void ForceSet<S>::evaluate(const ForceMoment<S>& moment) const {
    for (const Record& record : records_)
        std::visit([&](const auto& force) { addForce(force, record.place, moment); }, record.def);
}

template <class S>
void ForceSet<S>::edges(double begin, double end, std::vector<double>& times) const {
    for (const Record& record : records_)
        if (const auto* force = std::get_if<ConstantForce<S>>(&record.def))
            for (const double time : {force->start, force->end})
                if (time > begin && time < end) times.push_back(time);
}

RIGOR_INSTANTIATE_CLASS(ForceSet)

}  // namespace rigor::engine
