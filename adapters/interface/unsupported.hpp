// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Refusals of an adapter, of two kinds: a feature that is not in the adapter yet, or one that the library
// does not have. Only the library's own documentation can prove the second.
#pragma once

#include <stdexcept>
#include <string>

namespace rigor::adapter {

enum class Refusal { NotInAdapter, NotInLibrary };
const char* refusalName(Refusal refusal);  ///< "adapter" or "library", as results store it
const char* refusalText(Refusal refusal);  ///< "not in the adapter yet" or "not in the library"

/// A scenario requires a feature that is not available here. It is not an error but a recorded outcome. Made
/// by notInAdapter and notInLibrary; what is thrown with a text of its own counts as not in the adapter.
class Unsupported : public std::runtime_error {
  public:
    explicit Unsupported(const std::string& message) : std::runtime_error(message), lacking_(message) {}
    Unsupported(const std::string& message, Refusal refusal, std::string lacking, std::string documentation)
        : std::runtime_error(message),
          refusal_(refusal),
          lacking_(std::move(lacking)),
          documentation_(std::move(documentation)) {}

    Refusal refusal() const { return refusal_; }
    const std::string& lacking() const { return lacking_; }              ///< "joint 'six_dof'"
    const std::string& documentation() const { return documentation_; }  ///< document of the library, or ""

  private:
    Refusal refusal_ = Refusal::NotInAdapter;
    std::string lacking_, documentation_;
};

/// "bullet: not in the adapter yet: joint 'six_dof' for joint 'knee'". `user` is what needs it, may be empty.
Unsupported notInAdapter(const std::string& engine, const std::string& lacking, const std::string& user = "");

/// "ode: the library has no shape 'cone' for body 'tip' (its documentation: ode/collision.h, geom classes)".
/// Throws std::logic_error without a documentation: such a statement could not be checked.
Unsupported notInLibrary(const std::string& engine, const std::string& lacking,
                         const std::string& documentation, const std::string& user = "");

}  // namespace rigor::adapter
