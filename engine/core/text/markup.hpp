// SPDX-License-Identifier: GPL-3.0-or-later
/// Foreign text inside other languages: titles, labels and formulas of a scene in what the program exports.
///
/// There is one function per format, and every exporter uses it for every text that is not its own, so that a
/// text never ends the place it stands in and never becomes code, a link or a picture. Characters that cannot
/// be seen, or that change the direction of what follows, are written as their numbers ("U+202E").
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace extremal {

using Replacement = std::pair<std::string_view, std::string_view>;

/// The text from left to right, where each place is replaced by the first pair whose first part it begins
/// with.
std::string replaced(std::string_view text, std::span<const Replacement> by);

/// One line of visible characters: tabs and line ends of every kind (also U+0085, U+2028 and U+2029) become
/// spaces; control characters, marks of direction, noncharacters and bytes that are not UTF-8 their numbers.
std::string visibleLine(std::string_view text);
/// The same, but tabs, line feeds and carriage returns stay.
std::string visibleText(std::string_view text);

/// As it is written between tags and in attributes, between double quotes, of HTML and XML. Line ends stay.
std::string markupText(std::string_view text);

/// In a line of Markdown: no emphasis, code, table cell, tag, entity, link or picture begins. "_" between
/// letters is a subscript and stays one.
std::string markdownText(std::string_view text);

/// In the text of LaTeX; letters that it has no input for are written as their numbers.
std::string latexText(std::string_view text);

/// Lines of fixed width as Markdown, between fences that are longer than any of the lines has, and as LaTeX.
std::string markdownListing(const std::vector<std::string>& lines);
std::string latexListing(const std::vector<std::string>& lines);

/// Behind "//" of C++ or "#" of Python, up to the end of the line. Nothing continues on the next line: a
/// backslash at the end, also as a trigraph, is followed by a full stop.
std::string commentText(std::string_view text);

/// A literal of C++, in double quotes; every byte that is not a visible ASCII character is an octal escape.
std::string cppString(std::string_view text);
/// A literal of Python, in single quotes; a source in UTF-8.
std::string pythonString(std::string_view text);

}  // namespace extremal
