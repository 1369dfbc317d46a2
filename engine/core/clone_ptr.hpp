// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An owning pointer that copies what it points to, so that classes holding polymorphic parts stay copyable.
#pragma once

#include <memory>
#include <utility>

namespace rigor::engine {

/// T has `std::unique_ptr<T> clone() const`.
template <class T>
class ClonePtr {
  public:
    ClonePtr() = default;
    ClonePtr(std::unique_ptr<T> object) : object_(std::move(object)) {}
    ClonePtr(const ClonePtr& other) : object_(other.object_ ? other.object_->clone() : nullptr) {}
    ClonePtr(ClonePtr&&) noexcept = default;
    ClonePtr& operator=(ClonePtr other) noexcept {
        object_ = std::move(other.object_);
        return *this;
    }
    T& operator*() const { return *object_; }
    T* operator->() const { return object_.get(); }
    explicit operator bool() const { return object_ != nullptr; }

  private:
    std::unique_ptr<T> object_;
};

}  // namespace rigor::engine
