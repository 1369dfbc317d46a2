// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/pair_table.hpp"

#include <algorithm>
#include <map>

namespace rigor::adapter {

PairTable::PairTable(const Scenario& scenario) : materials_(scenario.materials.size()) {
    for (std::size_t a = 0; a < materials_; ++a)
        for (std::size_t b = 0; b < materials_; ++b) table_.push_back(pairCoefficients(scenario, a, b));
    for (const auto& body : scenario.bodies) {
        collides_.push_back(body.collides && !body.shapes.empty());
        dynamic_.push_back(body.type == scenario::BodyType::Dynamic);
        materialsOf_.emplace_back();
        filtersOf_.emplace_back();
        for (const auto& shape : body.shapes) {
            materialsOf_.back().push_back(shape.material);
            filtersOf_.back().push_back(shape.filter);
            filtered_ = filtered_ || shape.filter != scenario::ContactFilter{};
            filtersByBody_ = filtersByBody_ && shape.filter == filtersOf_.back().front();
        }
    }
    keepApart(scenario, [](std::size_t) { return true; });
}

void PairTable::keepApart(const Scenario& scenario, const std::function<bool(std::size_t joint)>& holds) {
    connected_.clear();
    for (std::size_t j = 0; j < scenario.joints.size(); ++j) {
        const auto& joint = scenario.joints[j];
        if (!joint.collideConnected && joint.bodyA != scenario::kNone && holds(j))
            connected_.emplace_back(std::minmax(joint.bodyA, joint.bodyB));
    }
    std::sort(connected_.begin(), connected_.end());
}

bool PairTable::mayCollide(int bodyA, int bodyB) const {
    const auto a = static_cast<std::size_t>(bodyA), b = static_cast<std::size_t>(bodyB);
    if (!collides_[a] || !collides_[b] || !(dynamic_[a] || dynamic_[b])) return false;
    if (filtered_ && !someShapesMayTouch(a, b)) return false;
    const std::pair<int, int> key = std::minmax(bodyA, bodyB);
    return !std::binary_search(connected_.begin(), connected_.end(), key);
}

bool PairTable::someShapesMayTouch(std::size_t a, std::size_t b) const {
    for (const auto& ofA : filtersOf_[a])
        for (const auto& ofB : filtersOf_[b])
            if (mayTouch(ofA, ofB)) return true;
    return false;
}

std::vector<PairTable::Example> PairTable::examples() const {
    std::map<std::pair<int, int>, Example> found;
    const int count = materialsOf_.size();
    const auto addShapes = [&](int a, int b) {
        const auto& ofA = materialsOf_[a];
        const auto& ofB = materialsOf_[b];
        for (std::size_t i = 0; i < ofA.size(); ++i)
            for (std::size_t j = 0; j < ofB.size(); ++j) {
                if (!shapesMayTouch(a, static_cast<int>(i), b, static_cast<int>(j))) continue;
                Example example{ofA[i], ofB[j], {a, static_cast<int>(i)}, {b, static_cast<int>(j)}};
                if (example.materialA > example.materialB) {
                    std::swap(example.materialA, example.materialB);
                    std::swap(example.a, example.b);
                }
                found.try_emplace({example.materialA, example.materialB}, example);
            }
    };
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b)
            if (mayCollide(a, b)) addShapes(a, b);
    std::vector<Example> all;
    for (const auto& [materials, example] : found) all.push_back(example);
    return all;
}

bool PairTable::mayBounce(int body) const {
    for (int other = 0; other < static_cast<int>(materialsOf_.size()); ++other) {
        if (other == body || !mayCollide(body, other)) continue;
        const auto &mine = materialsOf_[body], &theirs = materialsOf_[other];
        for (int i = 0; i < static_cast<int>(mine.size()); ++i)
            for (int j = 0; j < static_cast<int>(theirs.size()); ++j)
                if (shapesMayTouch(body, i, other, j) && coefficients(mine[i], theirs[j]).restitution > 0.0)
                    return true;
    }
    return false;
}

}  // namespace rigor::adapter
