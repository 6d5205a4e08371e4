// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/study_log.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "engine/core/problem.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "engine/core/text/regular_file.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/files/write_all.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

std::string headOf(const std::string& study, const Value& options, const Scene& scene) {
    return headOf(study, options, writeScene(scene));
}

std::string headOf(const std::string& study, const Value& options, const std::string& what) {
    Value head;
    head.set("extremal", 1);
    head.set("study", study);
    head.set("options", options);
    head.set("scene", fingerprint(what));
    return writeCompactJson(head);
}

std::vector<std::string> linesOf(const std::filesystem::path& log) {
    std::vector<std::string> lines;
    std::string content;
    try {
        content = readRegularFile(log.string(), std::size_t{2} << 30);
    } catch (const UnreadableFile&) {  // nothing is known
        return lines;
    }
    std::istringstream in(std::move(content));
    for (std::string line; std::getline(in, line);) {
        const std::size_t space = line.rfind(' ');
        if (space == std::string::npos) continue;
        const std::string text = line.substr(0, space);
        if (line.substr(space + 1) == checksum(text)) lines.push_back(text);
    }
    return lines;
}

StudyLog::StudyLog(std::filesystem::path file, bool isNew) : file_(std::move(file)) {
    // Not through a link that somebody has put there, and no pipe, which would wait for a reader.
    const int flags =
        O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (isNew ? O_TRUNC : 0);
    descriptor_ = ::open(file_.c_str(), flags, 0666);
    if (descriptor_ < 0) throw ExportError(file_, std::strerror(errno));
}

StudyLog::StudyLog(StudyLog&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

StudyLog::~StudyLog() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

StudyLog StudyLog::begin(const std::filesystem::path& file, const std::string& head,
                         const Replacing& replacing) {
    requireReplaceable(file, replacing);
    StudyLog log(file, true);
    log.append(head);
    return log;
}

StudyLog StudyLog::resume(const std::filesystem::path& file, const std::string& head,
                          std::vector<std::string>& known, const Replacing& replacing) {
    known = linesOf(file);
    if (known.empty()) return begin(file, head, replacing);
    if (known.front() != head)
        throw InvalidScene("--resume", file.string() + " belongs to another study, scene or option",
                           "another --out DIR, or leave --resume out to begin anew");
    known.erase(known.begin());
    StudyLog log(file, false);
    // A line that was cut off must not swallow the next one.
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (in.tellg() > 0) {
        in.seekg(-1, std::ios::end);
        if (in.get() != '\n') writeAll(log.descriptor_, "\n", file);
    }
    return log;
}

void StudyLog::append(const std::string& text) {
    writeAll(descriptor_, text + ' ' + checksum(text) + '\n', file_);
}

}  // namespace extremal
