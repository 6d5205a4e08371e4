// SPDX-License-Identifier: GPL-3.0-or-later
/// Pixels as a PNG picture, not compressed: for the images inside an SVG, which have some ten thousand
/// pixels.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace extremal {

/// `pixels`: red, green and blue, row after row from the top; width * rows of them.
std::string pngOf(int width, const std::vector<std::array<unsigned char, 3>>& pixels);

/// Bytes as text (RFC 4648).
std::string base64(const std::string& bytes);

}  // namespace extremal
