// SPDX-License-Identifier: GPL-3.0-or-later
/// The study "linear-stability": every scheme of a scene on the linear test equation
/// (linear_stability.hpp). Each scheme is one point; its lines in the log:
///
///     {"extremal": 1, "study": "linear-stability", "options": {..}, "scene": "<fingerprint>"}
///     scheme,<index>,<low>,<high>,<points>,<z>,<amplification>,<phase error>,<z>,..., then of the region, if
///            it has one, <amplification>,<phase error>,<1 on a cut>,...
///     refused,<index>,<reason>
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/stability/linear_stability.hpp"

namespace extremal {

struct LinearOptions {
    std::vector<std::string> only = {};
    Shard shard = {};
    unsigned threads = 0;
};

class LinearStudy {
public:
    struct Row {
        std::size_t scheme = 0;
        bool isKnown = false;
        LinearStability result = {};
    };

    /// Throws InvalidScene, with options as pointers.
    LinearStudy(ResolvedScene scene, LinearOptions options);

    const ResolvedScene& scene() const { return scene_; }
    const LinearOptions& options() const { return options_; }
    const std::vector<Row>& rows() const { return rows_; }
    std::size_t size() const { return rows_.size(); }
    bool isComplete() const;
    double fraction() const { return progress_.fraction(); }
    AnnouncedTime announced() const { return progress_.announced(); }
    bool isPreparing() const { return false; }

    void take(std::size_t index, LinearStability result);
    void run(const std::function<void(std::size_t)>& onScheme, const std::stop_token& stop);

private:
    ResolvedScene scene_;
    LinearOptions options_;
    std::vector<Row> rows_;
    StudyProgress progress_;
};

Value optionsValue(const LinearOptions& options);
LinearOptions linearOptionsOf(const Value& value);
std::string headOf(const std::string& study, const LinearStudy& linear);
std::optional<std::size_t> takeLine(const std::string& line, LinearStudy& linear);
void runLines(LinearStudy& linear, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
