// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/race.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace extremal {

Runner::Runner(std::shared_ptr<const SchemeResult> result) : result_(std::move(result)) {
    const auto times = result_->trajectory["t"], errors = result_->trajectory["error"];
    seconds_ = result_->summary.cpuSeconds;
    start_ = times.front();
    end_ = times.back();
    if (errors.size() != times.size()) return;
    times_.assign(times.begin(), times.end());
    double worst = 0;
    for (const double e : errors) {
        if (!(std::fabs(e) <= worst))
            worst = std::isfinite(e) ? std::fabs(e) : std::numeric_limits<double>::infinity();
        worst_.push_back(worst);
    }
}

double Runner::timeAt(double spent) const {
    return start_ + (end_ - start_) * std::clamp(spent / seconds_, 0.0, 1.0);
}

double Runner::errorUpTo(double t) const {
    if (times_.empty()) return Summary::unknown;
    const bool isBackwards = end_ < start_;
    const auto after = std::upper_bound(times_.begin(), times_.end(), t, [&](double value, double entry) {
        return isBackwards ? value > entry : value < entry;
    });
    return after == times_.begin() ? 0 : worst_[static_cast<std::size_t>(after - times_.begin()) - 1];
}

bool Runner::hasFinished(double spent, double wanted) const {
    return isComplete() && spent >= seconds_ && !isOut(spent, wanted);
}

bool Runner::isOut(double spent, double wanted) const {
    return errorUpTo(timeAt(spent)) > wanted || (!isComplete() && spent >= seconds_);
}

std::vector<Runner> runnersOf(const Comparison& comparison) {
    std::vector<Runner> runners;
    for (const auto& s : comparison.schemes)
        if (s && s->trajectory.rows() > 1 && s->summary.cpuSeconds > 0) runners.emplace_back(s);
    return runners;
}

std::vector<int> placesOf(const std::vector<Runner>& runners, double spent, double wanted) {
    std::vector<int> places(runners.size(), 0);
    for (std::size_t i = 0; i < runners.size(); ++i) {
        if (!runners[i].hasFinished(spent, wanted)) continue;
        places[i] = 1;
        for (const Runner& other : runners)
            places[i] += other.hasFinished(spent, wanted) && other.seconds() < runners[i].seconds();
    }
    return places;
}

}  // namespace extremal
