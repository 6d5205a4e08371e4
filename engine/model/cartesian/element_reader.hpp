// SPDX-License-Identifier: GPL-3.0-or-later
/// One element of a mechanism, read by the fields of its kind. Internal to engine/model/cartesian.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/cartesian/element_kinds.hpp"
#include "engine/model/cartesian/elements.hpp"

namespace extremal::cartesian {

using Parameters = std::vector<std::pair<std::string, double>>;

/// The value of a number or of a formula in parameters; what is wrong goes to `problems`, at the pointer.
/// `hasTime`: a formula may have t in it, and is then worth nothing.
std::optional<Amount> amountOf(const Value& value, const std::string& pointer, const Parameters& parameters,
                               std::vector<Problem>& problems, bool hasTime = false);

class ElementReader {
public:
    /// Finds keys that the kind does not have, and those that are missing.
    ElementReader(const ElementKind& kind, std::string name, const Value& given, const Parameters& parameters,
                  std::vector<Problem>& problems);

    const std::string& name() const { return name_; }
    std::string pointer(std::string_view key = {}) const;
    bool has(std::string_view key) const;
    /// The default where it is left out.
    Amount number(std::string_view key) const;
    std::optional<Amount> numberIfGiven(std::string_view key) const;
    /// As many numbers as the field has components, or `orCount` of them; nothing where it is left out and
    /// has no default.
    std::vector<Amount> amounts(std::string_view key, std::size_t orCount = 0) const;
    Vector vector(std::string_view key) const;
    bool flag(std::string_view key) const;
    std::string text(std::string_view key) const;
    std::vector<std::string> names(std::string_view key) const;
    /// A number, or a formula in parameters and t.
    Amount drive(std::string_view key) const;
    void error(std::string_view key, std::string message, std::string hint = {}) const;

private:
    const FieldInfo& field(std::string_view key) const;
    const Value* value(std::string_view key) const;
    Amount inRange(const Value& value, const std::string& pointer, const FieldInfo& field) const;

    const ElementKind& kind_;
    std::string name_;
    const Value& given_;
    const Parameters& parameters_;
    std::vector<Problem>& problems_;
};

}  // namespace extremal::cartesian
