// SPDX-License-Identifier: GPL-3.0-or-later
/// The log of a study: its points as they finish, one per line, so that a study that is killed loses only
/// those in flight, and shards can be merged.
///
/// The first line is the head, JSON that says what study it is, of which scene and with which options; what
/// the other lines hold is the study's own matter (sweep_log.hpp, stability_study.hpp). Every line ends in
/// the CRC-32 of what stands before it; a line whose checksum is wrong, such as the last one of a process
/// that was killed, is ignored, and its point is run again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/run/files/replacing.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// The first line of a log, without its checksum. `what`: the text of the scene, or of what is studied
/// besides; equal ones are the same study.
std::string headOf(const std::string& study, const Value& options, const std::string& what);
std::string headOf(const std::string& study, const Value& options, const Scene& scene);

/// The lines of a log whose checksums are right, without these.
std::vector<std::string> linesOf(const std::filesystem::path& log);

class StudyLog {
public:
    /// Begins a log, in place of an older one. Throws what requireReplaceable does, and ExportError.
    static StudyLog begin(const std::filesystem::path& file, const std::string& head,
                          const Replacing& replacing = {});
    /// Goes on with a log, or begins one where there is none. `known`: its lines behind the head. Throws
    /// InvalidScene ("--resume") where it has another head, ExportError.
    static StudyLog resume(const std::filesystem::path& file, const std::string& head,
                           std::vector<std::string>& known, const Replacing& replacing = {});
    StudyLog(StudyLog&& other) noexcept;
    ~StudyLog();

    /// At once. Throws ExportError. Not for several threads at a time.
    void append(const std::string& line);

private:
    StudyLog(std::filesystem::path file, bool isNew);

    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace extremal
