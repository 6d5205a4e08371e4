// SPDX-License-Identifier: GPL-3.0-or-later
/// Short numbers that stand for long texts, as hexadecimal digits.
#pragma once

#include <string>
#include <string_view>

namespace extremal {

/// CRC-64 of a text: equal ones are taken for the same text.
std::string fingerprint(std::string_view text);

/// CRC-32 of bytes, which tells whether they are whole.
std::string checksum(std::string_view bytes);

}  // namespace extremal
