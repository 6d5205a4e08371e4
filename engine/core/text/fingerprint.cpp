// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/fingerprint.hpp"

#include <boost/crc.hpp>

namespace extremal {
namespace {

std::string hex(unsigned long long value, int digits) {
    std::string text;
    for (int i = digits - 1; i >= 0; --i) text += "0123456789abcdef"[(value >> (4 * i)) & 15];
    return text;
}

}  // namespace

std::string fingerprint(std::string_view text) {
    boost::crc_optimal<64, 0x42f0e1eba9ea3693ULL, ~0ULL, ~0ULL, true, true> crc;
    crc.process_bytes(text.data(), text.size());
    return hex(crc.checksum(), 16);
}

std::string checksum(std::string_view bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return hex(crc.checksum(), 8);
}

}  // namespace extremal
