// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/image/png.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <boost/crc.hpp>

namespace extremal {
namespace {

std::string bigEndian(std::uint32_t value) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
    return text;
}

std::string chunk(std::string_view type, const std::string& data) {
    const std::string body = std::string(type) + data;
    boost::crc_32_type crc;
    crc.process_bytes(body.data(), body.size());
    return bigEndian(static_cast<std::uint32_t>(data.size())) + body + bigEndian(crc.checksum());
}

/// A zlib stream of stored blocks (RFC 1950, 1951).
std::string stored(const std::string& bytes) {
    std::string text = "\x78\x01";
    constexpr std::size_t most = 65535;
    for (std::size_t at = 0; at < bytes.size(); at += most) {
        const auto size = static_cast<unsigned>(std::min(most, bytes.size() - at));
        text += static_cast<char>(at + most >= bytes.size());
        for (const unsigned word : {size, ~size})
            for (const int shift : {0, 8}) text += static_cast<char>(word >> shift & 0xFF);
        text += bytes.substr(at, size);
    }
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    return text + bigEndian(b << 16 | a);
}

}  // namespace

std::string pngOf(int width, const std::vector<std::array<unsigned char, 3>>& pixels) {
    const auto columns = static_cast<std::size_t>(width);
    std::string rows;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (i % columns == 0) rows += '\0';  // no filter
        for (const unsigned char c : pixels[i]) rows += static_cast<char>(c);
    }
    const std::string head = bigEndian(static_cast<std::uint32_t>(width)) +
                             bigEndian(static_cast<std::uint32_t>(pixels.size() / columns)) +
                             std::string("\x08\x02\0\0\0", 5);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", head) + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

std::string base64(const std::string& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
    }
    return text;
}

}  // namespace extremal
