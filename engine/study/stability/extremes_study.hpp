// SPDX-License-Identifier: GPL-3.0-or-later
/// The study "extremes": every case of extremes.hpp, without a scene; or, with numbers that vary (--x, --y),
/// every scheme of a scene over them. Its lines in the log:
///
///     {"extremal": 1, "study": "extremes", "options": {"long": false}, "scene": "<fingerprint of all
///     cases>"} case,<index>,<class>,<measure>,<failed_at>,<judgement>,<floor>
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/progress.hpp"
#include "engine/study/stability/extremes.hpp"
#include "engine/study/stability/stability.hpp"

namespace extremal {

/// Of a scene.
struct ExtremesOptions {
    VariedNumber x;
    std::optional<VariedNumber> y = {};
    std::string metric = "error";  ///< where there are no wishes: to a thousandth of its size
    bool isAtEnd = false;
    std::vector<Wish> wishes = {};
    std::vector<std::string> only = {};
    Shard shard = {};
    unsigned threads = 0;
};

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

    /// Of a scene: an axis along x for each value of y. Throws InvalidScene, with options as pointers.
    ExtremesStudy(const ResolvedScene& scene, const ExtremesOptions& options);

    bool hasLong() const { return withLong_; }
    /// Null of the study without a scene.
    const ExtremesOptions* options() const { return options_.get(); }
    const std::string& sceneText() const { return sceneText_; }
    const std::vector<ExtremeAxis>& axes() const { return own_ ? *own_ : extremeAxes(); }

    const std::vector<Row>& rows() const { return rows_; }
    std::size_t size() const { return rows_.size(); }
    bool isComplete() const;
    double fraction() const { return progress_.fraction(); }
    AnnouncedTime announced() const { return progress_.announced(); }
    bool isPreparing() const { return false; }

    void take(std::size_t index, ExtremeResult result) { rows_[index].result = std::move(result); }
    void run(const std::function<void(std::size_t)>& onCase, const std::stop_token& stop);

private:
    double secondsAhead(const std::vector<std::size_t>& wanted, const std::stop_token& stop) const;

    Shard shard_;
    unsigned threads_;
    bool withLong_ = false;
    std::shared_ptr<const std::vector<ExtremeAxis>> own_ = {};  ///< of a scene; null: extremeAxes()
    std::shared_ptr<const ExtremesOptions> options_ = {};
    std::string sceneText_ = {};
    std::vector<Row> rows_;
    StudyProgress progress_;
};

/// Of a study of a scene.
Value optionsValue(const ExtremesOptions& options);
ExtremesOptions extremesOptionsOf(const Value& value);
std::string headOf(const std::string& study, const ExtremesStudy& extremes);
std::optional<std::size_t> takeLine(const std::string& line, ExtremesStudy& extremes);
void runLines(ExtremesStudy& extremes, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
