// SPDX-License-Identifier: GPL-3.0-or-later
/// JSON for tests, with ' in place of ", which needs no raw strings: moc loses track in those that have a
/// closing bracket before a quote.
#pragma once

#include <algorithm>
#include <string>

namespace extremal::tests {

inline std::string quoted(std::string text) {
    std::replace(text.begin(), text.end(), '\'', '"');
    return text;
}

}  // namespace extremal::tests
