// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/document.hpp"

#include <algorithm>

namespace extremal {

namespace {

/// The child to write into, made where an object lacks it; null where it cannot be.
Value* childToWrite(Value& parent, const std::string& token) {
    if (parent.isArray()) {
        if (token == "-") return &parent.asArray().emplace_back();
        return const_cast<Value*>(childOf(parent, token));
    }
    if (!parent.isObject() && !parent.isNull()) return nullptr;
    if (Value* there = parent.find(token)) return there;
    return &parent.set(token, Value());
}

void removeChild(Value& parent, const std::string& token) {
    if (parent.isArray()) {
        const auto index = arrayIndex(token);
        if (index && *index < parent.asArray().size())
            parent.asArray().erase(parent.asArray().begin() + static_cast<std::ptrdiff_t>(*index));
    } else if (parent.isObject()) {
        std::erase_if(parent.asObject(), [&](const Value::Member& m) { return m.first == token; });
    }
}

void apply(Value& root, const Edit& edit) {
    const auto tokens = splitPointer(edit.pointer);
    if (!tokens) return;
    if (tokens->empty()) {
        root = edit.value.value_or(Value());
        return;
    }
    Value* place = &root;
    for (std::size_t i = 0; i + 1 < tokens->size() && place; ++i)
        place = edit.value ? childToWrite(*place, (*tokens)[i])
                           : const_cast<Value*>(childOf(*place, (*tokens)[i]));
    if (!place) return;
    if (!edit.value) return removeChild(*place, tokens->back());
    if (Value* target = childToWrite(*place, tokens->back())) *target = *edit.value;
}

}  // namespace

Value withEdits(Value root, const std::vector<Edit>& edits) {
    for (const Edit& edit : edits) apply(root, edit);
    return root;
}

}  // namespace extremal
