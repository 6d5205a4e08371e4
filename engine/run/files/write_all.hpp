// SPDX-License-Identifier: GPL-3.0-or-later
/// Writing to a file descriptor.
#pragma once

#include <filesystem>
#include <string_view>

namespace extremal {

/// All of the text, however many calls that takes. `file`: whose descriptor it is. Throws ExportError.
void writeAll(int descriptor, std::string_view text, const std::filesystem::path& file);

}  // namespace extremal
