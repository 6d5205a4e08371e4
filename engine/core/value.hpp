// SPDX-License-Identifier: GPL-3.0-or-later
/// A JSON-like tree that preserves the order of its keys, shared by scene files, descriptors and
/// forms. It is a value: comparable, copyable, cheap to include. Reading and writing text is in
/// scene/read/json.hpp.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace extremal {

class Value {
public:
    using Array = std::vector<Value>;
    using Member = std::pair<std::string, Value>;
    using Object = std::vector<Member>;

    Value() = default;
    Value(std::nullptr_t) {}
    Value(bool b) : data_(b) {}
    Value(double d) : data_(d) {}
    Value(int i) : data_(static_cast<double>(i)) {}
    Value(const char* s) : data_(std::string(s)) {}
    Value(std::string s) : data_(std::move(s)) {}
    Value(Array a) : data_(std::move(a)) {}
    Value(Object o) : data_(std::move(o)) {}

    bool isNull() const { return std::holds_alternative<std::nullptr_t>(data_); }
    bool isBool() const { return std::holds_alternative<bool>(data_); }
    bool isNumber() const { return std::holds_alternative<double>(data_); }
    bool isString() const { return std::holds_alternative<std::string>(data_); }
    bool isArray() const { return std::holds_alternative<Array>(data_); }
    bool isObject() const { return std::holds_alternative<Object>(data_); }

    bool asBool() const { return std::get<bool>(data_); }
    double asNumber() const { return std::get<double>(data_); }
    const std::string& asString() const { return std::get<std::string>(data_); }
    const Array& asArray() const { return std::get<Array>(data_); }
    Array& asArray() { return std::get<Array>(data_); }
    const Object& asObject() const { return std::get<Object>(data_); }
    Object& asObject() { return std::get<Object>(data_); }

    /// The member of an object, or null if this is not an object or has no such key.
    const Value* find(std::string_view key) const {
        if (const auto* object = std::get_if<Object>(&data_))
            for (const Member& m : *object)
                if (m.first == key) return &m.second;
        return nullptr;
    }
    Value* find(std::string_view key) {
        return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
    }
    /// Sets a member of an object (made from null), keeping its place if the key is there.
    Value& set(std::string_view key, Value value) {
        if (isNull()) data_ = Object{};
        if (Value* there = find(key)) return *there = std::move(value);
        return std::get<Object>(data_).emplace_back(std::string(key), std::move(value)).second;
    }
    bool operator==(const Value&) const = default;

private:
    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> data_ = nullptr;
};

}  // namespace extremal
