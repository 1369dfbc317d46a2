// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
#include "scenarios/exchange/common/xml_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace rigor::models {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

constexpr std::uintmax_t kMaxBytes = 64u << 20;
constexpr int kMaxIncludes = 256;  ///< more are taken for files that include each other

std::string readWhole(const std::filesystem::path& file, const std::string& shown) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) throw Refusal({shown, 0}, "there is no such file");
    if (std::filesystem::file_size(file, error) > kMaxBytes || error)
        throw Refusal({shown, 0}, "larger than 64 MiB");
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.good() && !in.eof()) throw Refusal({shown, 0}, "the file can not be read");
    if (text.find('\0') != std::string::npos)
        throw Refusal({shown, 0}, "not a text file: it has a zero byte");
    return text;
}

void parse(tinyxml2::XMLDocument& document, const std::filesystem::path& file, const std::string& shown) {
    const std::string text = readWhole(file, shown);
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS || !document.RootElement())
        throw Refusal({shown, document.ErrorLineNum()},
                      std::string("not well-formed XML (") + document.ErrorName() + ")");
    for (const auto* node = document.FirstChild(); node; node = node->NextSibling())
        if (node->ToUnknown())
            throw Refusal({shown, node->GetLineNum()}, "a document type definition is not read");
}

bool matches(const char* pattern, const std::string& name) {
    return std::string_view(pattern) == "*" || name == pattern;
}

bool elementMatches(const char* pattern, const std::string& parent, const std::string& name) {
    const std::string_view text(pattern);
    const auto slash = text.find('/');
    if (slash == std::string_view::npos) return matches(pattern, name);
    return matches(std::string(text.substr(0, slash)).c_str(), parent) &&
           matches(std::string(text.substr(slash + 1)).c_str(), name);
}

bool isHarmless(const ElementRule& rule, const std::string& value) {
    std::istringstream alternatives(rule.harmless);
    for (std::string one; std::getline(alternatives, one, '|');) {
        if (value == one) return true;
        std::vector<double> given, expected;
        if (readNumbers(value, given) && readNumbers(one, expected) && !given.empty() &&
            given.size() <= expected.size() && std::equal(given.begin(), given.end(), expected.begin()))
            return true;
    }
    return false;
}

bool isNotANumber(const std::string& value) {
    std::istringstream words(value);
    for (std::string word; words >> word;) {
        std::transform(word.begin(), word.end(), word.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (word == "nan" || word == "-nan" || word == "+nan" || word.starts_with("nan(")) return true;
    }
    return false;
}

class Judge {
  public:
    Judge(XmlFile& file, std::span<const ElementRule> rules, Report& report,
          const std::function<std::string(const std::string&, const std::string&)>& unread)
        : file_(file), rules_(rules), report_(report), unread_(unread) {}

    /// True if the element must be removed.
    bool element(XMLElement& e, const std::string& parent) {
        const std::string name = e.Name();
        const Place place = file_.place(e);
        const ElementRule* rule = find(parent, name, "");
        const std::string shown = "<" + name + ">";
        if (!rule) return unknown(name, shown, place);
        if (rule->verdict == Verdict::Subtree || rule->verdict == Verdict::NoPhysics ||
            rule->verdict == Verdict::Numerics) {
            report_.noPhysics(shown, place, whyOf(*rule));
            return true;
        }
        const char* text = e.GetText();
        if (rule->verdict == Verdict::Feature && !isHarmless(*rule, text ? text : ""))
            return report_.leavesOut(rule->feature, shown, place, rule->why) || true;
        if (rule->verdict == Verdict::Feature) return true;
        if (text && isNotANumber(text)) report_.refuse(shown, place, "the value is not a number");
        if (const std::string why = unread_ ? unread_(name, "") : ""; !why.empty()) {
            report_.refuse(shown, place, why);
            return true;
        }
        attributes(e, parent, name, place);
        for (XMLElement* child = e.FirstChildElement(); child;) {
            XMLElement* next = child->NextSiblingElement();
            if (element(*child, name)) e.DeleteChild(child);
            child = next;
        }
        return false;
    }

  private:
    const ElementRule* find(const std::string& parent, const std::string& name,
                            const std::string& attribute) const {
        const ElementRule* best = nullptr;
        const auto weight = [](const ElementRule& r) {
            const std::string_view e(r.element);
            return (e.find('*') == std::string_view::npos ? 4 : 0) +
                   (e.find('/') != std::string_view::npos ? 2 : 0) +
                   (std::string_view(r.attribute) != "*" ? 1 : 0);
        };
        for (const ElementRule& r : rules_) {
            const bool same = std::string_view(r.attribute) == attribute ||
                              (std::string_view(r.attribute) == "*" && !attribute.empty());
            if (same && elementMatches(r.element, parent, name) && (!best || weight(r) > weight(*best)))
                best = &r;
        }
        return best;
    }
    static std::string whyOf(const ElementRule& rule) {
        if (*rule.why) return rule.why;
        return rule.verdict == Verdict::Numerics ? "a setting of the simulator's numerical method"
                                                 : "it moves nothing";
    }
    bool unknown(const std::string& name, const std::string& shown, const Place& place) {
        return report_.leavesOut(name, shown, place, "this reader has no counterpart for it");
    }
    void attributes(XMLElement& e, const std::string& parent, const std::string& name, const Place& place) {
        for (const XMLAttribute* a = e.FirstAttribute(); a;) {
            const std::string attribute = a->Name(), value = a->Value();
            a = a->Next();
            const std::string shown = "<" + name + "> " + attribute;
            const ElementRule* rule = find(parent, name, attribute);
            bool remove = false;
            if (!rule) {
                remove = attribute.starts_with("xmlns") || unknown(attribute, shown, place);
            } else if (rule->verdict == Verdict::Feature) {
                remove = isHarmless(*rule, value) ||
                         report_.leavesOut(rule->feature, shown, place, rule->why) || true;
            } else if (rule->verdict == Verdict::Read) {
                if (attribute != "name" && attribute != "class" && isNotANumber(value))
                    report_.refuse(shown, place, "the value is not a number");
                const std::string why = unread_ ? unread_(name, attribute) : "";
                if (!why.empty()) report_.refuse(shown, place, why);
            } else {
                if (rule->verdict == Verdict::Numerics) report_.noPhysics(shown, place, whyOf(*rule));
                remove = true;
            }
            if (remove) e.DeleteAttribute(attribute.c_str());
        }
    }

    XmlFile& file_;
    std::span<const ElementRule> rules_;
    Report& report_;
    const std::function<std::string(const std::string&, const std::string&)>& unread_;
};

void appendEscaped(std::string& out, const char* text) {
    for (; *text; ++text) {
        if (*text == '<')
            out += "&lt;";
        else if (*text == '&')
            out += "&amp;";
        else if (*text == '"')
            out += "&quot;";
        else if (*text == '\n')
            out += ' ';
        else
            out += *text;
    }
}

void appendElement(std::string& out, int& line, const XMLElement& e) {
    for (; line < e.GetLineNum(); ++line) out += '\n';
    out += std::string("<") + e.Name();
    for (const XMLAttribute* a = e.FirstAttribute(); a; a = a->Next()) {
        out += std::string(" ") + a->Name() + "=\"";
        appendEscaped(out, a->Value());
        out += '"';
    }
    out += '>';
    if (const char* text = e.GetText()) appendEscaped(out, text);
    for (const XMLElement* child = e.FirstChildElement(); child; child = child->NextSiblingElement())
        appendElement(out, line, *child);
    out += std::string("</") + e.Name() + ">";
}

}  // namespace

bool readNumbers(const std::string& text, std::vector<double>& numbers) {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
        double value = 0.0;
        const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return false;
        numbers.push_back(value);
    }
    return true;
}

XmlFile::XmlFile(const std::filesystem::path& file, const std::string& shownName)
    : shown_(shownName.empty() ? file.filename().string() : shownName) {
    parse(document_, file, shown_);
}

Place XmlFile::place(const XMLElement& element) const {
    if (const auto* copied = static_cast<const Place*>(element.GetUserData())) return *copied;
    return {shown_, element.GetLineNum()};
}

XMLElement* XmlFile::copy(const XMLElement& element, const std::function<Place(const XMLElement&)>& placeOf) {
    XMLElement* out = element.ShallowClone(&document_)->ToElement();
    places_.push_back(placeOf(element));
    out->SetUserData(&places_.back());
    for (const auto* child = element.FirstChild(); child; child = child->NextSibling()) {
        if (const XMLElement* inner = child->ToElement())
            out->InsertEndChild(copy(*inner, placeOf));
        else
            out->InsertEndChild(child->ShallowClone(&document_));
    }
    return out;
}

void XmlFile::expandIncludes(const Resolve& resolve) {
    expandIn(*root(), resolve);
}

XMLElement* XmlFile::replaceInclude(XMLElement& parent, XMLElement& include, const Resolve& resolve) {
    const Place at = place(include);
    const char* given = include.Attribute("file");
    if (!given) throw Refusal(at, "<include> names no file");
    if (++includes_ > kMaxIncludes) throw Refusal(at, "more than 256 included files");
    const std::string name = given;
    tinyxml2::XMLDocument other;
    parse(other, resolve(name, at), name);
    tinyxml2::XMLNode* after = &include;
    for (const XMLElement* e = other.RootElement()->FirstChildElement(); e; e = e->NextSiblingElement()) {
        XMLElement* made = copy(*e, [&](const XMLElement& from) { return Place{name, from.GetLineNum()}; });
        parent.InsertAfterChild(after, made);
        after = made;
    }
    XMLElement* next = include.NextSiblingElement();
    parent.DeleteChild(&include);
    return next;
}

void XmlFile::expandIn(XMLElement& parent, const Resolve& resolve) {
    for (XMLElement* child = parent.FirstChildElement(); child;) {
        if (std::string_view(child->Name()) == "include") {
            child = replaceInclude(parent, *child, resolve);  // the included elements come next
        } else {
            expandIn(*child, resolve);
            child = child->NextSiblingElement();
        }
    }
}

void applyRules(XmlFile& file, std::span<const ElementRule> rules, Report& report,
                const std::function<std::string(const std::string&, const std::string&)>& unread) {
    Judge judge(file, rules, report, unread);
    if (judge.element(*file.root(), ""))
        throw Refusal(file.place(*file.root()), "nothing of the file can be read");
}

std::string textOnSameLines(const XMLElement& root) {
    std::string out;
    int line = 1;
    appendElement(out, line, root);
    return out + "\n";
}

}  // namespace rigor::models
