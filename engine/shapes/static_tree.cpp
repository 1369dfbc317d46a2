// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/shapes/static_tree.hpp"

#include <algorithm>
#include <numeric>

namespace rigor::engine {

template <class S>
void StaticTree<S>::build(std::span<const Aabb<S>> boxes) {
    nodes_.clear();
    if (boxes.empty()) return;
    nodes_.reserve(2 * boxes.size() - 1);
    std::vector<std::uint32_t> indices(boxes.size());
    std::iota(indices.begin(), indices.end(), 0u);
    split(boxes, indices);
}

template <class S>
void StaticTree<S>::split(std::span<const Aabb<S>> boxes, std::span<std::uint32_t> indices) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    Aabb<S> box = boxes[indices[0]];
    for (const std::uint32_t i : indices) {
        box.min = box.min.cwiseMin(boxes[i].min);
        box.max = box.max.cwiseMax(boxes[i].max);
    }
    nodes_[at].box = box;
    if (indices.size() == 1) {
        nodes_[at].link = indices[0];
        nodes_[at].leaf = true;
        return;
    }
    int axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    // Ties by index: the tree is a function of the boxes alone.
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const auto ca = boxes[a].min[axis] + boxes[a].max[axis], cb = boxes[b].min[axis] + boxes[b].max[axis];
        return ca < cb || (ca == cb && a < b);
    };
    const std::size_t half = indices.size() / 2;
    std::sort(indices.begin(), indices.end(), before);
    split(boxes, indices.first(half));
    nodes_[at].link = static_cast<std::uint32_t>(nodes_.size());
    split(boxes, indices.subspan(half));
}

template <class S>
typename S::Real StaticTree<S>::refit(std::span<const Aabb<S>> boxes) {
    typename S::Real size = 0;
    // Children come after their parents.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.leaf) {
            node.box = boxes[node.link];
            continue;
        }
        const Aabb<S>&a = nodes_[i + 1].box, &b = nodes_[node.link].box;
        node.box = {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
        const typename S::Vec diagonal = node.box.max - node.box.min;
        if (diagonal.minCoeff() >= 0) size += diagonal.norm();
    }
    return size;
}

RIGOR_INSTANTIATE_CLASS(StaticTree)

}  // namespace rigor::engine
