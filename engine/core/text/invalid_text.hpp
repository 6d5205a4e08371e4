// SPDX-License-Identifier: GPL-3.0-or-later
/// What is wrong in a text that a user has typed, at its place in the scene: the message, the text, and a
/// caret under the character.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"

namespace extremal {

/// `subject` begins the message: "the expression ". `hint`: for errors that have none of their own.
InvalidScene invalidText(const std::string& pointer, std::string_view text, const ExpressionError& error,
                         const std::string& subject = {}, const std::string& hint = {});

/// What make() gives, or InvalidScene for an ExpressionError in this text.
template <class Make>
auto atPlace(const std::string& pointer, std::string_view text, Make&& make,
             const std::string& subject = "the expression ", const std::string& hint = {}) {
    try {
        return make();
    } catch (const ExpressionError& e) {
        throw invalidText(pointer, text, e, subject, hint);
    }
}

}  // namespace extremal
