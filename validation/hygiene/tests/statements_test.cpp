// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// One statement stands on one line: no comma operator joins two of them.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "validation/hygiene/tests/comma_operators.hpp"
#include "validation/hygiene/tests/source_tree.hpp"

namespace rigor::hygiene {
namespace {

std::string lineAt(const std::string& text, std::size_t line) {
    std::istringstream stream(text);
    std::string found;
    for (std::size_t k = 0; k < line; ++k) std::getline(stream, found);
    return found;
}

/// "m << a, b, c;", the comma initialiser of Eigen's matrices, is one statement; "requires { a, b; }" is none.
bool joinsStatements(const CommaOperator& found, const std::string& text) {
    return found.statement.find(" << ") >= found.statement.find(',') &&
           lineAt(text, found.line).find("requires {") == std::string::npos;
}

TEST(Statements, AreNotJoinedByCommaOperators) {
    std::size_t read = 0;
    for (const std::string& file : sourceFiles({".cpp", ".hpp"})) {
        ++read;
        const std::string text = readFile(file);
        for (const CommaOperator& found : commaOperators(text))
            if (joinsStatements(found, text))
                ADD_FAILURE() << file << ":" << found.line
                              << ": write one statement a line: " << found.statement;
    }
    EXPECT_GT(read, 1000u);
}

std::vector<std::size_t> linesOf(const std::string& source) {
    std::vector<std::size_t> lines;
    for (const CommaOperator& found : commaOperators(source)) lines.push_back(found.line);
    return lines;
}

TEST(Statements, TheFinderKnowsCommaOperators) {
    using Lines = std::vector<std::size_t>;
    EXPECT_EQ(linesOf("void f() {\n  a = 1, b = 2;\n}"), Lines{2});
    EXPECT_EQ(linesOf("void f() {\n  if (x) g(1, 2), h<int, 3>(4);\n  else ++a, ++b;\n}"), (Lines{2, 3}));
    EXPECT_EQ(linesOf("void f() {\n  for (;;) a, b;\n  switch (x) { case 1: a, b; }\n}"), (Lines{2, 3}));
    EXPECT_EQ(linesOf("auto f = [&] {\n  run([&](int i) {\n    a += i, b -= i;\n  });\n};"), Lines{3});
    EXPECT_EQ(linesOf("int f() {\n  return a, b;\n}\nint g() { return (a, b); }"), (Lines{2, 4}));
    EXPECT_EQ(linesOf("void f() {\n  while (std::getline(in, s), in) {}\n  std::swap(a, b), c = d;\n}"),
              (Lines{2, 3}));
    EXPECT_EQ(linesOf("// a\n/* b\n */ void f() { (void)a, (void)b; }"), Lines{3});
    EXPECT_EQ(linesOf("struct S { S() : a(1), b{2} {} void f() { a = R\"x(\n)x\", b = 1; } };"), Lines{1});
}

TEST(Statements, TheFinderLeavesOtherCommasAlone) {
    EXPECT_TRUE(
        linesOf("int a = 0, b = f(1, 2);\nstd::map<int, int> c{{1, 2}}, d;\nunsigned e : 1, g : 2;").empty());
    EXPECT_TRUE(
        linesOf("enum class E { A, B };\nstruct S {\n  S() : a(1), b{2} {}\n  int a, b;\n};").empty());
    EXPECT_TRUE(linesOf("void f() { for (int i = 0, j = 1; i < j; ++i, --j) g(i, j); }").empty());
    EXPECT_TRUE(linesOf("auto [a, b] = h();\nconst auto& [c, d] = h();\nx = y ? S{1, 2} : S{3, 4};").empty());
    EXPECT_TRUE(linesOf("bool operator==(const A&, const A&) = default;\nvoid (*p)(int, int);").empty());
    EXPECT_TRUE(linesOf("template <class A, class B>\nvoid f(A, B);\n(use(values), ...);").empty());
    EXPECT_TRUE(
        linesOf("#define F(a, b) \\\n  a = 1, b = 2;\nauto s = \"a, b;\"; // a, b;\nchar c = ',';").empty());
    EXPECT_TRUE(linesOf("rigor::Vec* a = nullptr, *b = nullptr;\nstd::vector<Row>::iterator i, "
                        "j;\nalignas(8) std::array<int, n + 1> a, b;")
                    .empty());
}

}  // namespace
}  // namespace rigor::hygiene
