// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Finds comma operators in C++ source text. The finder reads tokens and pairs of brackets and knows no types,
// so it decides by form:
//   - a comma of a statement is an operator unless the statement starts like a declaration
//     (`int a = 0, b = 0;`);
//   - a comma of a parenthesis is an operator if nothing that can be called or declared stands before the
//     parenthesis (`return (a, b);`).
// Commas of arguments, initialiser lists, template arguments and the header of a `for` are none.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rigor::hygiene {

struct CommaOperator {
    std::size_t line = 0;   ///< line, from 1
    std::string statement;  ///< the tokens around it, separated by blanks
};

/// One entry for each statement or parenthesis of `source` that holds comma operators.
std::vector<CommaOperator> commaOperators(const std::string& source);

}  // namespace rigor::hygiene
