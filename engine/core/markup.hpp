/// Text inside other languages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace extremal {

using Replacement = std::pair<std::string_view, std::string_view>;

/// The text from left to right, where each place is replaced by the first pair whose first part it begins
/// with.
std::string replaced(std::string_view text, std::span<const Replacement> by);

/// As it is written between tags and in attributes of HTML and XML.
std::string markupText(std::string_view text);

}  // namespace extremal
