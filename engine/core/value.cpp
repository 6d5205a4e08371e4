// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/value.hpp"

namespace extremal {

Value::Value() noexcept : data_(nullptr) {}
Value::Value(std::nullptr_t) noexcept : data_(nullptr) {}
Value::Value(bool b) noexcept : data_(b) {}
Value::Value(double d) noexcept : data_(d) {}
Value::Value(int i) noexcept : data_(static_cast<double>(i)) {}
Value::Value(const char* s) : data_(std::string(s)) {}
Value::Value(std::string s) noexcept : data_(std::move(s)) {}
Value::Value(Array a) noexcept : data_(std::move(a)) {}
Value::Value(Object o) noexcept : data_(std::move(o)) {}
Value::Value(const Value&) = default;
Value::Value(Value&&) noexcept = default;
Value& Value::operator=(const Value&) = default;
Value& Value::operator=(Value&&) noexcept = default;
Value::~Value() = default;

bool Value::operator==(const Value& other) const { return data_ == other.data_; }

const Value* Value::find(std::string_view key) const {
    if (const auto* object = std::get_if<Object>(&data_))
        for (const Member& m : *object)
            if (m.first == key) return &m.second;
    return nullptr;
}

Value* Value::find(std::string_view key) {
    return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
}

Value& Value::set(std::string_view key, Value value) {
    if (isNull()) data_ = Object{};
    if (Value* there = find(key)) return *there = std::move(value);
    return std::get<Object>(data_).emplace_back(std::string(key), std::move(value)).second;
}

}  // namespace extremal
