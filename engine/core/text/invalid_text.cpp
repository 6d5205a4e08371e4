// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/invalid_text.hpp"

namespace extremal {

InvalidScene invalidText(const std::string& pointer, std::string_view text, const ExpressionError& error,
                         const std::string& subject, const std::string& hint) {
    return InvalidScene(pointer, subject + error.what() + "\n" + caretLines(text, error.position),
                        error.hint.empty() ? hint : error.hint);
}

}  // namespace extremal
