// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/tools/filon_table.hpp"

namespace extremal::tools {
namespace {

std::string formatted(const char* format, double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// "8.24e-7"
std::string errorText(double value) {
    if (value < filonFloor) return "< 1e-15";
    std::string text = formatted("%.2e", value);
    const std::size_t digit = text.find("e-0");
    return digit == std::string::npos ? text : text.erase(digit + 2, 1);
}

/// "0.01", "1000", "10⁴"
std::string powerText(double z) {
    const int exponent = static_cast<int>(std::lround(std::log10(z)));
    constexpr const char* raised[] = {"⁴", "⁵", "⁶"};
    return exponent < 4 ? formatted("%g", z) : std::string("10") + raised[exponent - 4];
}

constexpr const char* head = R"(# Filon's rules, measured

This page is generated: `ninja handbook.filon` repeats all measurements and draws the picture, and a test compares every number.

The integral of a smooth function times a fast oscillation, with u nodes c_i of the Gauss or Lobatto rule:

```
∫₀ʰ f(x) e^(iωx) dx ≈ h Σ_i b_i(hω) f(c_i h),   b_i(z) = ∫₀¹ l_i(x) e^(izx) dx
```

The function f is replaced by its interpolation polynomial at the nodes, and the oscillation is integrated exactly: only the interpolation error remains,
however fast the oscillation is. The program computes the weights from spherical Bessel functions ([Multiscale](multiscale.md)) with an error below 10⁻¹⁵ for every hω.
The rules `filon-gauss` and `filon-lobatto` ([quadratures](quadratures.md)) apply them to each harmonic of an action.

## Four regimes

Exponents of the error for f(x) = eˣ: in the step h for a fixed hω, and in hω for h = 1. The theoretical values are in parentheses: for a slow oscillation the order of
the classical rule plus one, and otherwise the number of nodes plus one. The nodes of the Lobatto rule include the ends of the step; the boundary terms of integration by parts
are then exact, and the error decreases like 1/(hω)² instead of 1/(hω).

| rule | h, hω → 0 | h, hω = 1 | h, hω = 1000 | hω, from 10³ to 10⁵ |
| --- | --- | --- | --- | --- |
)";

constexpr const char* middle = R"(
Measured in quadruple precision from h = 1/16 and 1/32, with independently computed weights: expanded cardinal polynomials, and integrals of powers by series or
by parts. The last column compares the largest errors over one period of the phase.

## The error against hω

|Q - I| for f(x) = eˣ and h = 1, by the rule of the program in double precision; values below 10⁻¹⁵ are round-off. The values vary with the phase of the
oscillation.

)";

constexpr const char* after = R"(
![Error of six Filon rules against h times omega, double logarithmic](filon.svg)

In the picture each error is the largest within 15 % of hω, so that the dependence on the phase is not visible. Up to hω of about 0.3 the errors are those of the classical rules: Gauss
is more accurate with the same number of nodes. Then the interpolation error dominates, and all rules lose accuracy as hω grows, most at about hω = 10. Beyond that their accuracy increases
with hω, and that of Lobatto twice as fast: with five nodes its error is at round-off level at hω = 10⁶. A rule that resolves the
oscillation would need a thousand times more nodes at hω = 10⁵ than at 100.
)";

}  // namespace

std::string filonPage() {
    std::string text = head;
    for (const FilonNodes nodes : {FilonNodes::gauss, FilonNodes::lobatto})
        for (int count = 2; count <= 5; ++count) {
            const bool isGauss = nodes == FilonNodes::gauss;
            const FilonSlopes s = measureSlopes(nodes, count);
            const auto cell = [](double measured, int expected) {
                return formatted("%.2f", measured) + " (" + std::to_string(expected) + ") | ";
            };
            text += std::string("| ") + (isGauss ? "Gauss " : "Lobatto ") + std::to_string(count) + " | " +
                    cell(s.still, 2 * count + (isGauss ? 1 : -1)) + cell(s.one, count + 1) +
                    cell(s.fast, count + 1) + cell(s.inFrequency, isGauss ? -1 : -2);
            text.back() = '\n';
        }
    text += middle;
    text += "| hω |";
    std::string rule = "| --- |";
    for (const FilonColumn& column : filonColumns()) {
        text += " " + column.name + " |";
        rule += " --- |";
    }
    text += "\n" + rule + "\n";
    for (const double z : filonRows()) {
        text += "| " + powerText(z) + " |";
        for (const FilonColumn& column : filonColumns()) {
            text += " " + errorText(filonError(column.nodes, column.count, 1, z)) + " |";
        }
        text += "\n";
    }
    return text + after;
}

}  // namespace extremal::tools
