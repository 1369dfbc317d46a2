// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "adapters/interface/unsupported.hpp"

namespace rigor::adapter {
namespace {

std::string forUser(const std::string& user) {
    return user.empty() ? "" : " for " + user;
}

}  // namespace

const char* refusalName(Refusal refusal) {
    return refusal == Refusal::NotInLibrary ? "library" : "adapter";
}

const char* refusalText(Refusal refusal) {
    return refusal == Refusal::NotInLibrary ? "not in the library" : "not in the adapter yet";
}

Unsupported notInAdapter(const std::string& engine, const std::string& lacking, const std::string& user) {
    return {engine + ": not in the adapter yet: " + lacking + forUser(user), Refusal::NotInAdapter, lacking,
            ""};
}

Unsupported notInLibrary(const std::string& engine, const std::string& lacking,
                         const std::string& documentation, const std::string& user) {
    if (documentation.empty())
        throw std::logic_error(engine + ": no documentation is named for the lack of " + lacking);
    return {engine + ": the library has no " + lacking + forUser(user) +
                " (its documentation: " + documentation + ")",
            Refusal::NotInLibrary, lacking, documentation};
}

}  // namespace rigor::adapter
