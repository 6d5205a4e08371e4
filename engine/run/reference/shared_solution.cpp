// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/shared_solution.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace extremal {

SharedSolution::SharedSolution(std::function<ExactSolution()> make, std::vector<double> times,
                               std::size_t width)
    : make_(std::move(make)), times_(std::move(times)), width_(width) {
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

void SharedSolution::fill(std::size_t upTo) {
    if (!solution_) {
        solution_ = make_();
        states_.reserve(times_.size() * width_);
    }
    if (upTo <= known_) return;
    states_.resize(upTo * width_);
    solution_(std::span(times_).subspan(known_, upTo - known_), states_.data() + known_ * width_, width_);
    known_ = upTo;
}

ExactSolution SharedSolution::reader(std::shared_ptr<SharedSolution> shared) {
    struct Reader {
        std::shared_ptr<SharedSolution> shared;
        std::size_t place = 0;  ///< of the time asked for last
        ExactSolution own = {};

        void operator()(std::span<const double> t, double* x) {
            SharedSolution& s = *shared;
            std::vector<std::size_t> missing;
            {
                const std::lock_guard lock(s.mutex_);
                for (std::size_t i = 0; i < t.size(); ++i) {
                    // Times come in order, with few of other grids between them.
                    if (place >= s.times_.size() || s.times_[place] > t[i]) place = 0;
                    const auto from = s.times_.begin() + static_cast<std::ptrdiff_t>(place);
                    const auto near = std::min<std::ptrdiff_t>(8, s.times_.end() - from);
                    auto found = std::find_if(from, from + near, [&](double time) { return time >= t[i]; });
                    if (found == from + near) found = std::lower_bound(found, s.times_.end(), t[i]);
                    if (found == s.times_.end() || *found != t[i]) {
                        missing.push_back(i);
                        continue;
                    }
                    place = static_cast<std::size_t>(found - s.times_.begin());
                    s.fill(place + 1);
                    const double* state = s.states_.data() + place * s.width_;
                    std::copy(state, state + s.width_, x + i * s.width_);
                }
            }
            for (const std::size_t i : missing) {
                if (!own) own = s.make_();
                own(t[i], {x + i * s.width_, s.width_});
            }
        }
    };
    return ExactSolution(Reader{std::move(shared)});
}

}  // namespace extremal
