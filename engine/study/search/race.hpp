// SPDX-License-Identifier: GPL-3.0-or-later
/// Schemes side by side with the same processor time in place of the same time of the motion: where each is
/// when so much has been spent. The wanted error is the finish line: who arrives with a larger one has not
/// finished.
///
/// A scheme is taken to spend the same time on each part of its run: t = start + (end - start) b / c, b spent
/// of the c seconds that its steps took.
#pragma once

#include <string>
#include <vector>

#include "engine/run/comparison.hpp"

namespace extremal {

class Runner {
public:
    explicit Runner(std::shared_ptr<const SchemeResult> result);

    const SchemeResult& result() const { return *result_; }
    double seconds() const { return seconds_; }  ///< that it needs to where its run ended
    bool isComplete() const { return result_->summary.status == RunStatus::done; }
    /// Where it is when so many seconds have been spent.
    double timeAt(double spent) const;
    /// The largest error up to a time; not a number where errors are not known.
    double errorUpTo(double t) const;
    /// Has arrived at the end within the wanted error.
    bool hasFinished(double spent, double wanted) const;
    /// The error has been larger than wanted: it cannot finish any more.
    bool isOut(double spent, double wanted) const;

private:
    std::shared_ptr<const SchemeResult> result_;
    double seconds_ = 0, start_ = 0, end_ = 0;
    std::vector<double> times_, worst_;  ///< worst_[i]: the largest error up to times_[i]
};

/// The schemes of a comparison that have rows and costs.
std::vector<Runner> runnersOf(const Comparison& comparison);

/// Places, from 1, of those that have finished, by the time they needed; 0 of the others.
std::vector<int> placesOf(const std::vector<Runner>& runners, double spent, double wanted);

}  // namespace extremal
