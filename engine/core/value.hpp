// SPDX-License-Identifier: GPL-3.0-or-later
/// A JSON-like tree that preserves the order of its keys, shared by scene files, descriptors and
/// forms. It is a value: comparable, copyable, cheap to include. Reading and writing text is in
/// scene/read/json.hpp.
///
/// Its copies, moves and destructions are compiled once, in value.cpp: expanded at every place that holds a
/// Value they were a tenth of all code of the program. The library exports them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace extremal {

class __attribute__((visibility("default"))) Value {
public:
    using Array = std::vector<Value>;
    using Member = std::pair<std::string, Value>;
    using Object = std::vector<Member>;

    Value() noexcept;
    Value(std::nullptr_t) noexcept;
    Value(bool b) noexcept;
    Value(double d) noexcept;
    Value(int i) noexcept;
    Value(const char* s);
    Value(std::string s) noexcept;
    Value(Array a) noexcept;
    Value(Object o) noexcept;
    Value(const Value&);
    Value(Value&&) noexcept;
    Value& operator=(const Value&);
    Value& operator=(Value&&) noexcept;
    ~Value();

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
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    /// Sets a member of an object (made from null), keeping its place if the key is there.
    Value& set(std::string_view key, Value value);
    bool operator==(const Value&) const;

private:
    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> data_;
};

}  // namespace extremal
