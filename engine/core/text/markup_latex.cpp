// SPDX-License-Identifier: GPL-3.0-or-later
/// Foreign text in LaTeX.
#include "engine/core/text/markup.hpp"

#include <cstdio>

namespace extremal {
namespace {

/// Letters that LaTeX has no input for are written as their numbers: U+2713.
std::string withoutUnknown(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
        unsigned point = lead < 0x80 ? lead : lead & (0xffu >> (length + 1));
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
            point = point << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3fu);
        if (point < 0x180) {
            out += text.substr(i, length);
        } else {
            char number[16];
            std::snprintf(number, sizeof number, "U+%04X", point);
            out += number;
        }
        i += length;
    }
    return out;
}

/// What LaTeX reads as commands, and letters that it has commands for.
constexpr Replacement specialLetters[] = {{"\\", "\\textbackslash{}"},
                                          {"{", "\\{"},
                                          {"}", "\\}"},
                                          {"_", "\\_"},
                                          {"^", "\\textasciicircum{}"},
                                          {"#", "\\#"},
                                          {"%", "\\%"},
                                          {"&", "\\&"},
                                          {"$", "\\$"},
                                          {"~", "\\textasciitilde{}"},
                                          {"…", "\\dots{}"},
                                          {"−", "$-$"},
                                          {"×", "$\\times$"},
                                          {"·", "$\\cdot$"},
                                          {"≤", "$\\le$"},
                                          {"′", "$'$"},
                                          {"″", "$''$"},
                                          {"⁻¹", "$^{-1}$"},
                                          {"⁻", "$^{-}$"},
                                          {"½", "$\\tfrac12$"},
                                          {"∂", "$\\partial$"},
                                          {"≥", "$\\ge$"},
                                          {"∞", "$\\infty$"},
                                          {"≈", "$\\approx$"},
                                          {"→", "$\\to$"},
                                          {"–", "--"},
                                          {"’", "'"},
                                          {"“", "``"},
                                          {"”", "''"},
                                          {"η", "$\\eta$"},
                                          {"κ", "$\\kappa$"},
                                          {"ν", "$\\nu$"},
                                          {"χ", "$\\chi$"},
                                          {"Δ", "$\\Delta$"},
                                          {"⁴", "$^4$"},
                                          {"²", "$^2$"},
                                          {"³", "$^3$"},
                                          {"Σ", "$\\Sigma$"},
                                          {"√", "$\\sqrt{}$"},
                                          {"α", "$\\alpha$"},
                                          {"β", "$\\beta$"},
                                          {"γ", "$\\gamma$"},
                                          {"δ", "$\\delta$"},
                                          {"ε", "$\\varepsilon$"},
                                          {"θ", "$\\theta$"},
                                          {"λ", "$\\lambda$"},
                                          {"μ", "$\\mu$"},
                                          {"ξ", "$\\xi$"},
                                          {"π", "$\\pi$"},
                                          {"ρ", "$\\rho$"},
                                          {"σ", "$\\sigma$"},
                                          {"τ", "$\\tau$"},
                                          {"φ", "$\\varphi$"},
                                          {"ψ", "$\\psi$"},
                                          {"ω", "$\\omega$"},
                                          {"Ω", "$\\Omega$"},
                                          {"ħ", "$\\hbar$"},
                                          {"₀", "$_0$"},
                                          {"₁", "$_1$"},
                                          {"₂", "$_2$"},
                                          {"₃", "$_3$"},
                                          {"₄", "$_4$"},
                                          {"ℓ", "$\\ell$"},
                                          {"ℒ", "$\\mathcal{L}$"}};

}  // namespace

std::string latexText(std::string_view text) {
    return withoutUnknown(replaced(visibleLine(text), specialLetters));
}

std::string latexListing(const std::vector<std::string>& lines) {
    static constexpr Replacement end[] = {{"\\end{verbatim}", "\\end {verbatim}"}};
    std::string text = "\\begin{verbatim}\n";
    for (const std::string& line : lines) text += withoutUnknown(replaced(visibleLine(line), end)) + "\n";
    return text + "\\end{verbatim}\n";
}

}  // namespace extremal
