/// The log of a study: its points as they finish, one per line, so that a study that is killed loses only
/// those in flight, and shards can be merged.
///
///     {"extremal": 1, "study": "convergence", "options": {..}, "scene": "<fingerprint>"} checksum
///     point,<index>,<status>,<cause>,<failed_at>,<error>,<steps>,<iterations>,<evaluations>,<linear solves>,
///           <rejected>,<cpu_seconds>,<cpu_spread>,<step>,<tolerance> checksum
///     reference,<type>,<estimated_error> checksum
///
/// Every line ends in the CRC-32 of what stands before it; a line whose checksum is wrong, such as the last
/// one of a process that was killed, is ignored, and its point is run again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// What the points of a study depend on, but for the scene: as JSON, and back. Shard and threads are not in
/// it.
Value optionsValue(const SweepOptions& options);
SweepOptions optionsOf(const Value& value);

/// Of the text of a scene: equal ones are the same study.
std::string fingerprint(const std::string& text);

class PointLog {
public:
    /// Begins a log, in place of an older one. Throws ExportError.
    static PointLog begin(const std::filesystem::path& file, const std::string& study, const Sweep& sweep);
    /// Goes on with a log: its points are taken over into the sweep. Begins one where there is none. Throws
    /// InvalidScene ("--resume") where it belongs to another study, scene or option.
    static PointLog resume(const std::filesystem::path& file, const std::string& study, Sweep& sweep);
    PointLog(PointLog&& other) noexcept;
    ~PointLog();

    /// Appends a line at once. Throws ExportError. Not for several threads at a time.
    void add(std::size_t index, const PointResult& result);
    void add(const ReferenceInfo& reference);

private:
    PointLog(std::filesystem::path file, bool isNew);
    void append(const std::string& line);

    std::filesystem::path file_;
    int descriptor_ = -1;
};

/// The head of a log: what study it is of. Throws InvalidScene where the file is no log.
struct LogHead {
    std::string study, scene;  ///< scene: its fingerprint
    SweepOptions options;
};
LogHead readLogHead(const std::filesystem::path& file);
/// Takes the points of a log over into the sweep, and says which there were. Throws InvalidScene where one is
/// known already, and differs in anything but its times.
std::vector<std::size_t> takePoints(const std::filesystem::path& file, Sweep& sweep);

}  // namespace extremal
