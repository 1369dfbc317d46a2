// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// The table of references: complete, in order, and its TeX in one piece. That KaTeX draws every formula is
// tested where KaTeX is, with the list that `rigor list references --json` prints.
#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <string>
#include <vector>

#include "validation/references/reference.hpp"

namespace rigor::validation {
namespace {

/// Reads TeX token by token and keeps what is open.
class Scan {
  public:
    explicit Scan(const std::string& tex) : tex_(tex) {}

    /// Description of an error; "" if braces, environments and delimiters close what they open.
    std::string fault() {
        while (at_ < tex_.size() && fault_.empty()) {
            const char c = tex_[at_++];
            if (c == '\\')
                command();
            else if (c == '{')
                open_.push_back("{");
            else if (c == '}')
                close("{");
            else if (c == '&' && environments_ == 0)
                fault_ = "& outside of an environment";
            else if (c == '$' || c == '%' || c == '#' || c == '"' || static_cast<signed char>(c) < 0)
                fault_ = std::string("the character ") + c;
        }
        if (fault_.empty() && !open_.empty()) fault_ = "left open: " + open_.back();
        for (const auto& [name, count] : sized_)
            if (fault_.empty() && count != 0) fault_ = name + "l and " + name + "r differ in number";
        return fault_;
    }

  private:
    void command() {
        std::string name;
        while (at_ < tex_.size() && std::isalpha(static_cast<unsigned char>(tex_[at_]))) name += tex_[at_++];
        if (name.empty()) {
            if (at_ == tex_.size()) {
                fault_ = "ends in a backslash";
                return;
            }
            if (tex_[at_++] == '\\' && environments_ == 0) fault_ = "a new line outside of an environment";
        } else if (name == "begin" || name == "end") {
            environment(name == "begin");
        } else {
            for (const char* size : {"big", "Big", "bigg", "Bigg"}) {
                if (name == std::string(size) + "l") ++sized_[size];
                if (name == std::string(size) + "r") --sized_[size];
            }
        }
    }
    void environment(bool begins) {
        const auto end = tex_.find('}', at_);
        if (at_ >= tex_.size() || tex_[at_] != '{' || end == std::string::npos) {
            fault_ = "an environment without a name";
            return;
        }
        const std::string name = tex_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        environments_ += begins ? 1 : -1;
        if (begins)
            open_.push_back(name);
        else
            close(name);
    }
    void close(const std::string& what) {
        if (open_.empty() || open_.back() != what)
            fault_ = "closes " + what + " but " + (open_.empty() ? "nothing" : open_.back()) + " is open";
        else
            open_.pop_back();
    }

    const std::string& tex_;
    std::size_t at_ = 0;
    std::string fault_;
    std::vector<std::string> open_;
    int environments_ = 0;
    std::map<std::string, int> sized_;
};

std::string faultOf(const std::string& tex) {
    return Scan(tex).fault();
}

TEST(ReferenceTable, IsCompleteAndInOrder) {
    const auto& table = referenceTable();
    ASSERT_GT(table.size(), 50u);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto& r = table[i];
        for (const char* field : {r.title, r.formula, r.tex, r.source})
            EXPECT_GT(std::string(field).size(), 3u) << r.name;
        if (i == 0) continue;
        EXPECT_LT(std::string(table[i - 1].name), r.name);
    }
}

TEST(ReferenceTable, TexIsInOnePiece) {
    for (const auto& r : referenceTable()) EXPECT_EQ(faultOf(r.tex), "") << r.name << ": " << r.tex;
}

/// A formula is TeX, not the plain text again.
TEST(ReferenceTable, TexIsMathematics) {
    for (const auto& r : referenceTable()) {
        const std::string tex = r.tex;
        EXPECT_NE(tex, r.formula);
        EXPECT_NE(tex.find('\\'), std::string::npos) << r.name;
        EXPECT_NE(tex.find_first_of("=\\"), std::string::npos) << r.name;
        EXPECT_EQ(tex.find("''"), std::string::npos)
            << r.name << ": a second derivative is written with \\ddot";
        EXPECT_EQ(tex.find("sqrt("), std::string::npos) << r.name;
    }
}

TEST(ReferenceTable, TheScanFindsBrokenTex) {
    EXPECT_EQ(faultOf(R"(\begin{aligned} a &= \frac{1}{2} \\ b &= \bigl( c \bigr) \end{aligned})"), "");
    for (const char* broken :
         {R"(\frac{1}{2)", R"(a})", R"(\begin{aligned} a)", R"(\begin{aligned} { \end{aligned} })",
          R"(a & b)", R"(a \\ b)", R"(\begin{cases} a \end{aligned})", R"(\bigl( a \Bigr))", R"(a\)",
          R"($a$)", R"(\begin)"})
        EXPECT_NE(faultOf(broken), "") << broken;
}

}  // namespace
}  // namespace rigor::validation
