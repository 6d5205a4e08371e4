// SPDX-License-Identifier: GPL-3.0-or-later
/// The study "stability": every scheme over a grid of one or two numbers of the scene, and the limits along
/// the first of them. Its lines in the log:
///
///     {"extremal": 1, "study": "stability", "options": {..}, "scene": "<fingerprint>"}
///     point,<index>,<class>,<cause>,<growth>,<max_energy_error>,<failed_at>,<judgement>
///     limit,<index>,<limit>,<low>,<high>
///
/// Points are numbered scheme by scheme, y by y, along x; behind them the limits, scheme by scheme and y by
/// y.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/stability/stability.hpp"

namespace extremal {

struct StabilityOptions {
    VariedNumber x;
    std::optional<VariedNumber> y = {};
    bool findsLimits = false;
    std::vector<std::string> only = {};
    Shard shard = {};
    unsigned threads = 0;
};

class StabilityStudy {
public:
    struct Row {
        std::size_t scheme = 0;
        double x = 0, y = StabilityResult::unknown;
        StabilityResult result = {};
    };
    struct Limit {
        std::size_t scheme = 0;
        double y = StabilityResult::unknown;
        bool isKnown = false;
        StabilityLimit limit = {};
    };

    /// Throws InvalidScene, with options as pointers.
    StabilityStudy(ResolvedScene scene, StabilityOptions options);

    const ResolvedScene& scene() const { return scene_; }
    const StabilityOptions& options() const { return options_; }
    const std::vector<Row>& rows() const { return rows_; }
    const std::vector<Limit>& limits() const { return limits_; }
    /// Of points and limits.
    std::size_t size() const { return rows_.size() + limits_.size(); }
    bool isComplete() const;
    double fraction() const { return progress_.fraction(); }
    AnnouncedTime announced() const { return progress_.announced(); }
    bool isPreparing() const { return false; }  ///< it has no reference

    /// What is known of the point or limit with this index.
    using Result = std::variant<StabilityResult, StabilityLimit>;
    void take(std::size_t index, const Result& result);
    void run(const std::function<void(std::size_t)>& onPoint, const std::stop_token& stop);

private:
    std::vector<std::pair<std::string, double>> changesAt(double y) const;
    bool isKnown(std::size_t index) const;
    double secondsAhead(const std::vector<std::size_t>& wanted, const std::stop_token& stop) const;
    Result resultAt(std::size_t index, const std::stop_token& stop) const;

    ResolvedScene scene_;
    StabilityOptions options_;
    std::vector<Row> rows_;
    std::vector<Limit> limits_;
    StudyProgress progress_;
};

/// Where the energy error stands out along x, ten times as high as on both sides, or a run between bounded
/// ones is not bounded.
struct ResonancePeak {
    std::size_t scheme = 0;
    double x = 0, energyError = StabilityResult::unknown;  ///< unknown where a run was not bounded
    double prominence = 0;
    double phase = StabilityResult::unknown;  ///< h w of the fastest motion, where x is the step
};
/// Scheme by scheme, along x; none of a study over two numbers.
std::vector<ResonancePeak> resonancesOf(const StabilityStudy& stability);

Value optionsValue(const StabilityOptions& options);
StabilityOptions stabilityOptionsOf(const Value& value);
std::string headOf(const std::string& study, const StabilityStudy& stability);
std::optional<std::size_t> takeLine(const std::string& line, StabilityStudy& stability);
void runLines(StabilityStudy& stability, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
