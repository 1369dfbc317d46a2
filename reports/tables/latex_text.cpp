// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Plain text for LaTeX. pdflatex reads UTF-8 but knows few of its characters: Latin letters are left to it,
// what physics writes is replaced by its command, everything else is named by its number.
#include <array>
#include <cstdio>
#include <utility>

#include "reports/encoding/text.hpp"
#include "reports/tables/table.hpp"

namespace rigor::report {
namespace {

using Replacement = std::pair<char32_t, const char*>;

constexpr std::array<Replacement, 10> kSpecial{{{'\\', "\\textbackslash{}"},
                                                {'{', "\\{"},
                                                {'}', "\\}"},
                                                {'$', "\\$"},
                                                {'&', "\\&"},
                                                {'#', "\\#"},
                                                {'%', "\\%"},
                                                {'_', "\\_"},
                                                {'^', "\\textasciicircum{}"},
                                                {'~', "\\textasciitilde{}"}}};

constexpr std::array<Replacement, 43> kSymbols{
    {{U'µ', "$\\mu$"},     {U'²', "$^2$"},       {U'³', "$^3$"},
     {U'°', "$^\\circ$"},  {U'·', "$\\cdot$"},   {U'×', "$\\times$"},
     {U'±', "$\\pm$"},     {U'½', "$\\frac12$"}, {U'¼', "$\\frac14$"},
     {U'α', "$\\alpha$"},  {U'β', "$\\beta$"},   {U'γ', "$\\gamma$"},
     {U'δ', "$\\delta$"},  {U'Δ', "$\\Delta$"},  {U'ε', "$\\varepsilon$"},
     {U'ζ', "$\\zeta$"},   {U'θ', "$\\theta$"},  {U'κ', "$\\kappa$"},
     {U'λ', "$\\lambda$"}, {U'μ', "$\\mu$"},     {U'ν', "$\\nu$"},
     {U'π', "$\\pi$"},     {U'ρ', "$\\rho$"},    {U'σ', "$\\sigma$"},
     {U'τ', "$\\tau$"},    {U'φ', "$\\varphi$"}, {U'ψ', "$\\psi$"},
     {U'ω', "$\\omega$"},  {U'Ω', "$\\Omega$"},  {U'–', "--"},
     {U'—', "---"},        {U'’', "'"},          {U'‘', "`"},
     {U'“', "``"},         {U'”', "''"},         {U'…', "\\ldots{}"},
     {U'→', "$\\to$"},     {U'−', "$-$"},        {U'√', "$\\surd$"},
     {U'∞', "$\\infty$"},  {U'≈', "$\\approx$"}, {U'≤', "$\\le$"},
     {U'≥', "$\\ge$"}}};

std::string latexOf(char32_t point, std::string_view bytes) {
    for (const auto& [from, to] : kSpecial)
        if (point == from) return to;
    for (const auto& [from, to] : kSymbols)
        if (point == from) return to;
    if (point < 0x20 || point == 0x7F || point == 0xA0) return " ";
    const bool isLatinLetter = point >= 0xC0 && point <= 0x17E;
    if (point < 0x7F || isLatinLetter) return std::string(bytes);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "\\texttt{U+%04X}", static_cast<unsigned>(point));
    return text.data();
}

}  // namespace

std::string latexText(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Utf8Character c = firstCharacter(text);
        out += latexOf(c.length > 0 ? c.point : U'\uFFFD', text.substr(0, c.length));
        text.remove_prefix(std::max<std::size_t>(1, c.length));
    }
    return out;
}

}  // namespace rigor::report
