// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums and names by index, written out: what chains and lattices are typed with.
///
///     sum(i, 1..n, e)         e with i = 1, e with i = 2, .. in brackets, summed; 0 where there is none
///     x[i], x[i-1], x[2]_t    the names x1, x0, x2_t with the values of the indices
///     i                       its value
///     x[1..n]                 in a list of names: x1, x2, .., xn
///     rod[i = 2..n]           as a key: rod2, .., with i in the text that belongs to it
///
/// Ends and indices are expressions in parameters and the indices around them, and whole numbers. What is
/// written out has at most maxExpandedLength characters, in all; a range has at most maxIndexRange numbers.
/// Errors: ExpressionError with the place in the text given.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/text/expression.hpp"

namespace extremal {

inline constexpr std::size_t maxExpandedLength = 1'000'000;
inline constexpr long maxIndexRange = 10'000;

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// A name, and the index it was made with; `index` is empty where there is none.
struct IndexedName {
    std::string name, index;
    double value = 0;
};

/// Whether there is anything to write out.
bool hasIndices(std::string_view text);
/// The text written out, at most maxExpressionLength long before. `values`: parameters; `of`: the key that it
/// belongs to.
std::string writtenOut(std::string_view text, const NamedNumbers& values, const IndexedName& of = {});
/// The names that an entry of a list, or a key, stands for: itself where there is no range.
std::vector<IndexedName> namesOf(std::string_view name, const NamedNumbers& values);
/// parseExpression() of what was written out.
Expression parseWrittenOut(std::string_view text);

}  // namespace extremal
