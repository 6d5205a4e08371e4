// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading files that somebody else may have put there: regular ones alone, up to a size. A pipe or a device
/// would be read for ever, and opening one may have effects of its own.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace extremal {

/// Why a file cannot be read, without its name: "is not a regular file".
class UnreadableFile : public std::runtime_error {
public:
    explicit UnreadableFile(const std::string& reason) : std::runtime_error(reason) {}
};

/// The bytes of a file of at most so many. Throws UnreadableFile.
std::string readRegularFile(const std::string& path, std::size_t most = std::size_t{256} << 20);

}  // namespace extremal
