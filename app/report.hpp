// SPDX-License-Identifier: GPL-3.0-or-later
/// What the command line says: errors as `extremal: WHERE: WHAT (HINT)` on standard error, tables and
/// documents on standard output.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"
#include "engine/run/files/export.hpp"

namespace extremal {
class SnapshotError;
}

namespace extremal::app {

/// Most errors, and most warnings, that are listed at once.
inline constexpr std::size_t mostProblems = 100;

/// One line on standard error. `where` may be empty.
void printProblem(std::string_view where, std::string_view what, std::string_view hint = {});

/// Problems of a scene: FILE:POINTER, or --set POINTER for what an override did. The same words are said
/// once. `lead` comes before the message ("warning: "). After mostProblems of them one line says how many
/// more there are.
void printProblems(const std::string& file, const std::vector<Problem>& problems, std::string_view lead = {});

/// Problems with arguments ("--out") have their own place; others are of the scene. Returns the exit code.
int tellUnusable(const InvalidScene& error, const std::string& file);
/// What could not be written. Returns the exit code.
int tellUnwritable(const ExportError& error);

/// A picture that could not be made or written. Returns the exit code.
int tellUndrawn(const SnapshotError& error);

/// Writes to standard output. Returns `code`, or 3 after an error message if not all could be written.
[[nodiscard]] int print(std::string_view text, int code);

/// Columns two spaces apart; numbers to the right. The first row is the header.
struct Table {
    std::vector<std::vector<std::string>> rows;
    std::vector<bool> isRightAligned;
    std::string text() const;
};

/// Sets `key` to the first mostProblems of them, and `key`_left_out to the number of the others, where there
/// are more.
void setProblems(Value& document, const std::string& key, const std::vector<Problem>& problems);

}  // namespace extremal::app
