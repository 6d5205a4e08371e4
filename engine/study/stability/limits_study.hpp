// SPDX-License-Identifier: GPL-3.0-or-later
/// The study "limits": of every scheme of a scene the set of steps that are usable for the wishes, with the
/// reason at each end (usable_steps.hpp). Each scheme is one point; its lines in the log:
///
///     {"extremal": 1, "study": "limits", "options": {..}, "scene": "<fingerprint>"}
///     frequencies,<lowest>,<highest>,<wish>,<floor>
///     scheme,<index>,<runs>,<reason that there are none>,<from>,<to>,<class>,<reason>,<below>,<above>,
///            <error at from>,<error at to>, ... range after range
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/stability/usable_steps.hpp"
#include "engine/study/wish.hpp"

namespace extremal {

struct LimitsOptions {
    std::string metric = "error";  ///< where there are no wishes: to a thousandth of its size
    bool isAtEnd = false;
    std::vector<Wish> wishes = {};  ///< all must hold; a value of 0: a thousandth of the size
    double seconds = 2;             ///< of CPU, for each scheme
    std::vector<std::string> only = {};
    Shard shard = {};
    unsigned threads = 0;
};

class LimitsStudy {
public:
    struct Row {
        std::size_t scheme = 0;
        bool isKnown = false;
        UsableSteps result = {};
    };
    /// What all schemes share.
    struct Ground {
        double omegaLow = 0, omegaHigh = 0;  ///< of the linearisation along the reference; 0: not known
        double wish = std::numeric_limits<double>::quiet_NaN();  ///< of the first metric
        double floor = wish;
    };

    /// Throws InvalidScene, with options as pointers.
    LimitsStudy(ResolvedScene scene, LimitsOptions options);

    const ResolvedScene& scene() const { return scene_; }
    const LimitsOptions& options() const { return options_; }
    const std::vector<Metric>& metrics() const { return metrics_; }
    const std::vector<Row>& rows() const { return rows_; }
    const Ground& ground() const { return ground_; }
    std::size_t size() const { return rows_.size(); }
    bool isComplete() const;
    double fraction() const { return progress_.fraction(); }
    AnnouncedTime announced() const { return progress_.announced(); }
    bool isPreparing() const { return progress_.isPreparing(); }

    void take(std::size_t index, UsableSteps result);
    void take(const Ground& ground) { ground_ = ground; }
    void run(const std::function<void(std::size_t)>& onScheme, const std::stop_token& stop);

private:
    ResolvedScene scene_;
    LimitsOptions options_;
    std::vector<Metric> metrics_;
    std::vector<Row> rows_;
    Ground ground_;
    StudyProgress progress_;
};

Value optionsValue(const LimitsOptions& options);
LimitsOptions limitsOptionsOf(const Value& value);
std::string headOf(const std::string& study, const LimitsStudy& limits);
std::optional<std::size_t> takeLine(const std::string& line, LimitsStudy& limits);
void runLines(LimitsStudy& limits, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
