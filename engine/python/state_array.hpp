// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An array of states that the engine fills and NumPy shows without a copy.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/python/numbers.hpp"

namespace rigor::engine::python {

/// The numbers belong to both sides: a view that Python keeps outlives the world, and then no longer changes.
template <class R>
class StateArray {
  public:
    /// Numbers for another shape. Views that were given before keep theirs.
    void resize(const std::vector<py::ssize_t>& shape) {
        std::size_t size = 1;
        for (const py::ssize_t n : shape) size *= static_cast<std::size_t>(n);
        numbers_ = std::make_shared<std::vector<R>>(size);
        const auto keep = new std::shared_ptr<std::vector<R>>(numbers_);
        const py::capsule owner(keep,
                                [](void* p) { delete static_cast<std::shared_ptr<std::vector<R>>*>(p); });
        view_ = py::array_t<R>(shape, numbers_->data(), owner);
        // Writing into the view would not move a body: worlds have setStates().
        py::detail::array_proxy(view_.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    }
    std::span<R> numbers() const { return *numbers_; }
    py::array view() const { return view_; }

  private:
    std::shared_ptr<std::vector<R>> numbers_ = std::make_shared<std::vector<R>>();
    py::array_t<R> view_;
};

}  // namespace rigor::engine::python
