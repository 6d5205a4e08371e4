// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/read/pointer.hpp"

#include <charconv>

namespace extremal {

void appendToken(std::string& pointer, std::string_view token) {
    pointer += '/';
    for (const char c : token) {
        if (c == '~')
            pointer += "~0";
        else if (c == '/')
            pointer += "~1";
        else
            pointer += c;
    }
}

std::string childPointer(std::string_view pointer, std::string_view token) {
    std::string child(pointer);
    appendToken(child, token);
    return child;
}

std::string childPointer(std::string_view pointer, std::size_t index) {
    return childPointer(pointer, std::to_string(index));
}

std::optional<std::vector<std::string>> splitPointer(std::string_view pointer) {
    std::vector<std::string> tokens;
    if (!pointer.empty() && pointer.front() != '/') return {};
    for (std::size_t i = 0; i < pointer.size(); ++i) {
        const char c = pointer[i];
        if (c == '/') {
            tokens.emplace_back();
        } else if (c == '~') {
            if (++i == pointer.size() || (pointer[i] != '0' && pointer[i] != '1')) return {};
            tokens.back() += pointer[i] == '0' ? '~' : '/';
        } else {
            tokens.back() += c;
        }
    }
    return tokens;
}

std::optional<std::size_t> arrayIndex(std::string_view token) {
    if (token.empty() || token.size() > 9 || (token.size() > 1 && token.front() == '0')) return {};
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), index);
    if (error != std::errc() || end != token.data() + token.size()) return {};
    return index;
}

const Value* childOf(const Value& parent, std::string_view token) {
    if (!parent.isArray()) return parent.find(token);
    const auto index = arrayIndex(token);
    return index && *index < parent.asArray().size() ? &parent.asArray()[*index] : nullptr;
}

const Value* valueAt(const Value& root, std::string_view pointer) {
    const auto tokens = splitPointer(pointer);
    if (!tokens) return nullptr;
    const Value* place = &root;
    for (const std::string& token : *tokens)
        if (!(place = childOf(*place, token))) return nullptr;
    return place;
}

}  // namespace extremal
