// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// An XML file with the place of every element, and rules that say of each element and attribute whether a reader
// maps it. What no rule names is refused, so that nothing is dropped unseen.
#pragma once

#include <tinyxml2.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenarios/exchange/common/report.hpp"

namespace rigor::models {

/// The treatment of an element or attribute by a reader.
enum class Verdict {
    Read,       ///< the reader maps it
    NoPhysics,  ///< it changes nothing that moves
    Numerics,   ///< a setting of a simulator's numerical method
    Feature,    ///< no counterpart: refused unless `--without` names the feature
    Subtree,    ///< the whole element has no physics
};

/// `element` is "name" or "parent/name", with "*" for any name; `attribute` "" is the element itself (in SDF
/// and URDF also its text). A value equal to `harmless`, number by number, changes nothing
/// (several with | between).
struct ElementRule {
    const char* element;
    const char* attribute;
    Verdict verdict;
    const char* feature = "";
    const char* why = "";
    const char* harmless = "";
};

class XmlFile {
  public:
    /// Throws Refusal for a file that can not be read, is too large or is not well-formed.
    explicit XmlFile(const std::filesystem::path& file, const std::string& shownName = "");

    tinyxml2::XMLElement* root() { return document_.RootElement(); }
    tinyxml2::XMLDocument& document() { return document_; }
    Place place(const tinyxml2::XMLElement& element) const;
    Place place(int line) const { return {shown_, line}; }
    const std::string& shownName() const { return shown_; }
    /// Replaces every <include file="..."/> by what is in the named file, found by `resolve`.
    void expandIncludes(
        const std::function<std::filesystem::path(const std::string& name, const Place& place)>& resolve);
    /// A copy of an element that keeps the places of all its parts; it belongs to the document and has no parent.
    /// `placeOf` gives the places of elements of another document.
    tinyxml2::XMLElement* copy(const tinyxml2::XMLElement& element,
                               const std::function<Place(const tinyxml2::XMLElement&)>& placeOf);
    tinyxml2::XMLElement* copy(const tinyxml2::XMLElement& element) {
        return copy(element, [this](const tinyxml2::XMLElement& e) { return place(e); });
    }

  private:
    using Resolve = std::function<std::filesystem::path(const std::string&, const Place&)>;
    void expandIn(tinyxml2::XMLElement& parent, const Resolve& resolve);
    tinyxml2::XMLElement* replaceInclude(tinyxml2::XMLElement& parent, tinyxml2::XMLElement& include,
                                         const Resolve& resolve);
    tinyxml2::XMLDocument document_;
    std::string shown_;
    std::deque<Place> places_;  ///< places that the user data of copied elements point to
    int includes_ = 0;
};

/// Judges every element below `root` by the rules; what is left out, and what has no physics, is removed from the
/// document. `unread`, where given, returns why a thing to be read can not be (attribute "" is the element), "" where it can.
void applyRules(
    XmlFile& file, std::span<const ElementRule> rules, Report& report,
    const std::function<std::string(const std::string& element, const std::string& attribute)>& unread = {});

/// The document as text in which every element stands on its line of the file, where the order allows it.
std::string textOnSameLines(const tinyxml2::XMLElement& root);

/// The numbers of a text; false where a token is not a finite number.
bool readNumbers(const std::string& text, std::vector<double>& numbers);

}  // namespace rigor::models
