// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Settings of a world from a line of text: "substeps=8,contact_frequency=60".
#pragma once

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "engine/state/settings.hpp"

namespace rigor::engine {

/// Values of settings by their keys.
class SettingsText {
  public:
    /// Throws std::invalid_argument, and EngineError for keys that there are not.
    explicit SettingsText(const std::string& text) {
        std::istringstream stream(text);
        for (std::string word; std::getline(stream, word, ',');) {
            const std::size_t sign = word.find('=');
            if (sign == std::string::npos) throw std::invalid_argument("not KEY=VALUE: " + word);
            setting(word.substr(0, sign));
            values_[word.substr(0, sign)] = word.substr(sign + 1);
        }
    }
    /// Sets `member` where the text has its key.
    template <class Member>
    void set(const char* key, Member& member) const {
        const auto found = values_.find(key);
        if (found == values_.end()) return;
        if constexpr (std::is_same_v<Member, std::string>) {
            member = found->second;
        } else {
            member = static_cast<Member>(std::stod(found->second));
        }
    }

  private:
    std::map<std::string, std::string> values_;
};

/// Sets what the text has; the other settings stay.
template <class S>
void applySettings(const std::string& text, WorldDef<S>& def) {
    const SettingsText given(text);
#define CHOICE(member, key, byDefault, help) given.set(key, def.member);
#define INTEGER(member, key, byDefault, min, max, help) given.set(key, def.member);
#define REAL(member, key, byDefault, min, max, help) given.set(key, def.member);
#define SWITCH(member, key, byDefault, help) given.set(key, def.member);
#include "engine/state/settings.def"
}

}  // namespace rigor::engine
