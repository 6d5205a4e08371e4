#include "engine/core/markup.hpp"

#include <algorithm>
#include <array>

namespace extremal {

std::string replaced(std::string_view text, std::span<const Replacement> by) {
    std::string out;
    while (!text.empty()) {
        const auto found = std::find_if(by.begin(), by.end(),
                                        [&](const Replacement& r) { return text.starts_with(r.first); });
        out += found == by.end() ? text.substr(0, 1) : found->second;
        text.remove_prefix(found == by.end() ? 1 : found->first.size());
    }
    return out;
}

std::string markupText(std::string_view text) {
    static constexpr std::array<Replacement, 4> special = {
        {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}}};
    return replaced(text, special);
}

}  // namespace extremal
