// SPDX-License-Identifier: GPL-3.0-or-later
/// Checkpoints: what a scheme of a run needs to go on after the process was killed, in a file
/// "<slug>.checkpoint" beside the results to come.
///
/// A scheme is one march, or several in turn (with halved steps, where the order is measured), each a stage
/// with a name; one that has ended stays in the file. A stage is the state at the end of a block of steps,
/// what the integrator and the observers remember of those before, and all that was recorded
/// (Recording::checkpoint). What is computed around the marches (the reference, the way back) is computed
/// anew.
///
/// A file is written under a temporary name and renamed when whole. Its first line is JSON that says whose it
/// is; the second has the CRC-32 of the bytes behind it. One whose checksum is wrong counts as missing.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include "engine/core/text/archive.hpp"
#include "engine/core/value.hpp"

namespace extremal {

struct CheckpointPlan {
    std::filesystem::path folder;
    std::string program = {};  ///< its version: another one may round differently
    double seconds = 20;       ///< between two checkpoints of a scheme; writing takes 2 % of the time at most
    bool isResumed = false;    ///< goes on from those that there are
};

/// Of one scheme. For one thread at a time.
class SchemeCheckpoint {
public:
    struct Stage {
        bool hasEnded = false;
        std::string bytes = {};
        void checkpoint(Archive& archive) { archive(hasEnded, bytes); }
    };

    /// Reads the file where the plan says so, else removes it. `owner`: the scene, as text, and the scheme.
    /// Throws InvalidScene ("--resume") where it belongs to others.
    SchemeCheckpoint(std::filesystem::path file, const Value& owner, const CheckpointPlan& plan);

    /// Null where it is not known.
    const Stage* find(const std::string& name) const;
    /// Whether it is time for the next one.
    bool isDue() const { return Clock::now() >= due_; }
    /// Keeps a stage, and writes the file; not for a stage that has ended after so short a time that it is as
    /// well made again.
    void write(const std::string& name, Stage stage);
    /// Why the file could not be written; empty: it could.
    const std::string& failure() const { return failure_; }
    bool isWritten() const { return isWritten_; }
    /// Removes the file: the results are there.
    void remove();

private:
    using Clock = std::chrono::steady_clock;
    void read(const Value& head);

    std::filesystem::path file_;
    std::string head_, failure_;
    std::chrono::duration<double> pause_;
    Clock::time_point begin_ = Clock::now(), due_;
    std::map<std::string, Stage> stages_;
    bool isWritten_ = false;  ///< there is a file
};

}  // namespace extremal
