// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a file may be written where another one stands: one decision for every writer.
///
/// A file that is missing, or has the same content, may always be written. One that was read for the work is
/// never replaced. Of others those that this program has made are replaced, as the results of an earlier run
/// are by those of a later one; everything else belongs to the user, and is replaced only if that is asked
/// for. Files are known for the program's own by what is in them:
///
/// - text with a comment by `markedAsOwn` (programs, pages, SVG): the comment has the fingerprint of the
/// rest,
///   so that a file that was edited since is the user's;
/// - PNG and PDF by the name of the program in their metadata;
/// - scene.json by its fingerprint in the summary.json, in the document of an answer (answer_files.hpp) or in
///   a log of a study beside it;
/// - other files of a run or an answer by the list in that document, and any CSV file by its first line,
///   which is that of the file to be written;
/// - these documents, logs and checkpoints by their keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace extremal {

struct Replacing {
    bool isForced = false;                         ///< files of the user are replaced (--force)
    std::vector<std::filesystem::path> read = {};  ///< what the work was read from: never replaced
};

/// Throws InvalidScene ("--out") where the file was read, ForeignFile where it is the user's. `text`: what
/// is to be written, as far as it is known; its beginning will do for a long CSV file.
void requireReplaceable(const std::filesystem::path& file, const Replacing& replacing,
                        std::optional<std::string_view> text = {});

/// The same for a file whose new content stands in another one. False: it is there already, and need not be
/// written.
bool mayReplace(const std::filesystem::path& file, const std::filesystem::path& content,
                const Replacing& replacing);

/// The text with a line that says who made it, as a comment that begins and ends as given, before the line
/// at a place (0: the first). The rest of the line is a fingerprint of the text.
std::string markedAsOwn(const std::string& text, const std::string& begin, const std::string& end = {},
                        int line = 0);

/// The name of the program in the metadata of pictures.
inline constexpr const char* maker = "Extremal";

}  // namespace extremal
