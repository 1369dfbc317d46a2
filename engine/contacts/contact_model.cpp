// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "engine/contacts/contact_model.hpp"

#include "engine/contacts/contact_patches.hpp"
#include "engine/contacts/contact_rows.hpp"

namespace rigor::engine {

template <class S>
std::unique_ptr<ContactModel<S>> makeContactModel(ContactForm form) {
    if (form == ContactForm::Patches) return std::make_unique<PatchContacts<S>>();
    return std::make_unique<RowContacts<S>>();
}

#define RIGOR_INSTANTIATE(S) template std::unique_ptr<ContactModel<S>> makeContactModel<S>(ContactForm);
RIGOR_FOR_ALL_SPACES(RIGOR_INSTANTIATE)
#undef RIGOR_INSTANTIATE

}  // namespace rigor::engine
