// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/timing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace extremal {

Timing timeRuns(const Integrator& integrator, const State& start, const MarchGrid& grid, double first,
                const TimingPlan& plan, const std::stop_token& stop, const MotionCheck* motion) {
    const auto together = static_cast<int>(std::clamp(std::ceil(plan.shortest / std::max(first, 1e-7)), 1.0,
                                                      static_cast<double>(plan.together)));
    std::vector<double> times;
    double all = 0, fastest = HUGE_VAL;
    for (int i = 0; i < plan.repeat && all < plan.longest && !stop.stop_requested(); ++i) {
        double sum = 0;
        for (int k = 0; k < together && !stop.stop_requested(); ++k) {
            const auto copy = integrator.clone();
            State state = start;
            std::optional<MotionCheck> own = motion ? std::optional(*motion) : std::nullopt;
            const double used = march(*copy, state, grid, {}, stop, own ? &*own : nullptr).cpuSeconds;
            fastest = std::min(fastest, used);
            sum += used;
        }
        times.push_back(sum / together);
        all += sum;
    }
    if (times.empty() || stop.stop_requested()) return {};
    std::sort(times.begin(), times.end());
    const std::size_t half = times.size() / 2;
    return {times.size() % 2 == 1 ? times[half] : (times[half - 1] + times[half]) / 2, fastest,
            (times.back() - times.front()) / 2};
}

}  // namespace extremal
