// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The multifrontal method [DuffReid1983]: columns of L with the same rows below them form a front, a dense
// panel. A front is K's columns plus what its children in the elimination tree leave for it; its columns are
// eliminated, and what that takes from the rows below is left, dense, for its parent. Children come right
// before their parent (postorder), so the updates are on a stack, whose places are known beforehand.
//
// Columns whose rows differ little are put into one front too, with zeros: a few wide panels are faster than
// many narrow ones. Numbers do not change by it: what is zero stays zero.
//
// Cost: the products of the elimination (elimination.hpp) and of the zeros, at some 10 times the speed of
// products block by block; memory of L, and some of what the largest fronts leave.
#include "engine/solvers/joints/joint_fronts.hpp"

#include <algorithm>

namespace rigor::engine {
namespace {

constexpr std::size_t kAlignment = 16;  ///< numbers: a panel begins where a cache line does in single

constexpr std::size_t roundedUp(std::size_t n) {
    return (n + kAlignment - 1) / kAlignment * kAlignment;
}

/// Two fronts are better one where that has at most so many zeros among its blocks.
bool better(std::size_t columns, std::size_t zeros, std::size_t blocks) {
    if (columns <= 2) return true;
    if (columns <= 8) return 4 * zeros <= blocks;
    return 10 * zeros <= blocks;
}

}  // namespace

template <class R>
void JointFronts<R>::analyse(std::span<const std::size_t> start, std::span<const std::uint32_t> row,
                             std::uint32_t first, int size) {
    size_ = static_cast<std::size_t>(size);
    findFronts(start, row, first);
    layOut();
}

template <class R>
void JointFronts<R>::findFronts(std::span<const std::size_t> start, std::span<const std::uint32_t> row,
                                std::uint32_t first) {
    const auto columns = static_cast<std::uint32_t>(start.size() - 1);
    const auto below = [&](std::uint32_t k) { return static_cast<std::uint32_t>(start[k + 1] - start[k]); };
    const auto parentOf = [&](std::uint32_t k) { return below(k) == 0 ? kNullIndex : row[start[k]] - first; };
    // Every column as a front, joined to those before it that it is the parent of.
    std::vector<std::size_t> entries;  // entries of a front, in blocks without zeros
    fronts_.clear();
    for (std::uint32_t k = 0; k < columns; ++k) {
        Front front{};
        front.first = k;
        front.width = 1;
        std::size_t own = below(k) + 1;
        while (!fronts_.empty()) {
            const Front& last = fronts_.back();
            const std::uint32_t end = last.first + last.width - 1, parent = parentOf(end);
            if (parent < front.first || parent > k) break;
            const std::size_t width = last.width + front.width, rows = below(k);
            const std::size_t blocks = width * (width + 1) / 2 + width * rows;
            const std::size_t zeros = blocks - own - entries.back();
            if (zeros > 0 && !better(width, zeros, blocks)) break;
            front.first = last.first;
            front.width += last.width;
            own += entries.back();
            fronts_.pop_back();
            entries.pop_back();
        }
        fronts_.push_back(front);
        entries.push_back(own);
    }
    front_.resize(columns);
    rows_.clear();
    for (std::uint32_t f = 0; f < fronts_.size(); ++f) {
        Front& front = fronts_[f];
        const std::uint32_t end = front.first + front.width - 1;
        std::fill_n(front_.begin() + front.first, front.width, f);
        front.row = static_cast<std::uint32_t>(rows_.size());
        front.rows = below(end);
        for (std::size_t e = start[end]; e < start[end + 1]; ++e) rows_.push_back(row[e] - first);
    }
}

/// Assigns the memory layout.
template <class R>
void JointFronts<R>::layOut() {
    std::size_t panels = 0, top = 0, most = 0, tallest = 0;
    runs_.clear();
    for (Front& front : fronts_) front.child = front.sibling = kNullIndex;
    for (std::uint32_t f = 0; f < fronts_.size(); ++f) {
        Front& front = fronts_[f];
        const std::size_t height = (front.width + front.rows) * size_;
        front.stride = height;
        front.panel = panels;
        panels += roundedUp(height * front.width * size_);
        tallest = std::max(tallest, height);
        front.parent = front.rows == 0 ? kNullIndex : front_[rows_[front.row]];
        findRuns(front);
        // Its children's updates are on top of the stack, and go when it has been made.
        const std::size_t square = roundedUp(front.rows * size_ * front.rows * size_);
        front.work = front.update = top;
        for (std::uint32_t c = front.child; c != kNullIndex; c = fronts_[c].sibling)
            front.update = std::min(front.update, fronts_[c].update);
        most = std::max(most, front.work + square);
        top = front.update + square;
        if (front.parent == kNullIndex) continue;
        front.sibling = fronts_[front.parent].child;
        fronts_[front.parent].child = f;
    }
    panels_.assign(panels + kFrontSlack, R(0));
    updates_.assign(most, R(0));
    gathered_.assign(tallest + kFrontSlack, R(0));
}

/// The place of a row among the columns and rows of a front, in blocks.
template <class R>
std::uint32_t JointFronts<R>::placeIn(const Front& front, std::uint32_t row) const {
    if (row < front.first + front.width) return row - front.first;
    const auto begin = rows_.begin() + front.row, end = begin + front.rows;
    return front.width + static_cast<std::uint32_t>(std::lower_bound(begin, end, row) - begin);
}

template <class R>
void JointFronts<R>::findRuns(Front& front) {
    front.run = static_cast<std::uint32_t>(runs_.size());
    front.runs = 0;
    if (front.parent == kNullIndex) return;
    for (std::uint32_t i = 0; i < front.rows; ++i) {
        const std::uint32_t to = placeIn(fronts_[front.parent], rows_[front.row + i]);
        if (front.runs > 0 && runs_.back().to + runs_.back().count == to) {
            ++runs_.back().count;
        } else {
            runs_.push_back({i, to, 1});
            ++front.runs;
        }
    }
}

template <class R>
std::size_t JointFronts<R>::placeOf(std::uint32_t row, std::uint32_t column) const {
    const Front& front = fronts_[front_[column]];
    return front.panel + (column - front.first) * size_ * front.stride + placeIn(front, row) * size_;
}

template <class R>
void JointFronts<R>::clear() {
    std::fill(panels_.begin(), panels_.end(), R(0));
}

template <class R>
FrontPanel<R> JointFronts<R>::panelOf(const Front& front) {
    return {panels_.data() + front.panel, front.stride, front.stride, front.width * size_};
}

template <class R>
void JointFronts<R>::factor(const R* floor) {
    for (const Front& front : fronts_) {
        const std::size_t n = front.rows * size_;
        R* const work = updates_.data() + front.work;
        std::fill_n(work, n * n, R(0));
        for (std::uint32_t c = front.child; c != kNullIndex; c = fronts_[c].sibling)
            extend(fronts_[c], front);
        const FrontPanel<R> panel = panelOf(front);
        factorPanel(panel, floor + front.first * size_);
        subtractSquare(panel, work, n);
        if (front.update != front.work) std::copy_n(work, n * n, updates_.data() + front.update);
    }
}

/// Adds what a child has left to the columns of its parent and to what that will leave.
template <class R>
void JointFronts<R>::extend(const Front& child, const Front& parent) {
    const std::size_t n = child.rows * size_, width = parent.width * size_, left = parent.rows * size_;
    const std::span<const Run> runs(runs_.data() + child.run, child.runs);
    for (std::size_t r = 0; r < runs.size(); ++r)
        for (std::size_t j = 0; j < runs[r].count * size_; ++j) {
            const std::size_t column = runs[r].to * size_ + j;
            const bool inPanel = column < width;
            // Rows are counted from the first of the parent's front, or from the first of what it leaves.
            R* const to = inPanel ? panels_.data() + parent.panel + column * parent.stride
                                  : updates_.data() + parent.work + (column - width) * left;
            const R* const from = updates_.data() + child.update + (runs[r].from * size_ + j) * n;
            for (std::size_t s = r; s < runs.size(); ++s) {
                const std::size_t skip = s == r ? j : 0, count = runs[s].count * size_ - skip;
                const R* __restrict source = from + runs[s].from * size_ + skip;
                R* __restrict target = to + (runs[s].to * size_ + skip - (inPanel ? 0 : width));
                for (std::size_t i = 0; i < count; ++i) target[i] += source[i];
            }
        }
}

template <class R>
void JointFronts<R>::solve(R* x) {
    R* const y = gathered_.data();
    const auto gather = [&](const Front& front, const FrontPanel<R>& panel) {
        std::copy_n(x + front.first * size_, panel.columns, y);
        for (std::uint32_t i = 0; i < front.rows; ++i)
            std::copy_n(x + rows_[front.row + i] * size_, size_, y + panel.columns + i * size_);
    };
    for (const Front& front : fronts_) {
        const FrontPanel<R> panel = panelOf(front);
        gather(front, panel);
        solveForward(panel, y);
        std::copy_n(y, panel.columns, x + front.first * size_);
        for (std::uint32_t i = 0; i < front.rows; ++i)
            std::copy_n(y + panel.columns + i * size_, size_, x + rows_[front.row + i] * size_);
    }
    for (std::size_t f = fronts_.size(); f-- > 0;) {
        const Front& front = fronts_[f];
        const FrontPanel<R> panel = panelOf(front);
        gather(front, panel);
        solveBackward(panel, y);
        std::copy_n(y, panel.columns, x + front.first * size_);
    }
}

template class JointFronts<float>;
template class JointFronts<double>;

}  // namespace rigor::engine
