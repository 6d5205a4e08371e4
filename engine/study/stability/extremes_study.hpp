// SPDX-License-Identifier: GPL-3.0-or-later
/// The study "extremes": every case of extremes.hpp. It has no scene. Its lines in the log:
///
///     {"extremal": 1, "study": "extremes", "options": {"long": false}, "scene": "<fingerprint of all
///     cases>"} case,<index>,<class>,<measure>,<failed_at>
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/stability/extremes.hpp"

namespace extremal {

class ExtremesStudy {
public:
    struct Row {
        ExtremeCase at;
        ExtremeResult result = {};
        bool isKnown() const { return !result.kind.empty(); }
    };

    /// `threads`: 0 for as many as the machine has cores. `withLong`: also the runs that take
    /// minutes. Throws InvalidScene ("--shard").
    explicit ExtremesStudy(Shard shard = {}, unsigned threads = 0, bool withLong = false);

    bool hasLong() const { return withLong_; }

    const std::vector<Row>& rows() const { return rows_; }
    std::size_t size() const { return rows_.size(); }
    bool isComplete() const;
    double fraction() const { return progress_.fraction(); }
    bool isPreparing() const { return false; }

    void take(std::size_t index, ExtremeResult result) { rows_[index].result = std::move(result); }
    void run(const std::function<void(std::size_t)>& onCase, const std::stop_token& stop);

private:
    Shard shard_;
    unsigned threads_;
    bool withLong_;
    std::vector<Row> rows_;
    StudyProgress progress_;
};

std::string headOf(const std::string& study, const ExtremesStudy& extremes);
std::optional<std::size_t> takeLine(const std::string& line, ExtremesStudy& extremes);
void runLines(ExtremesStudy& extremes, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
