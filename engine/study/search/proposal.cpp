// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/proposal.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

bool isMeasured(const PointResult& r) { return r.isDone() && std::isfinite(r.error) && r.cpuSeconds > 0; }

double between(double a, double b, double s) { return std::exp((1 - s) * std::log(a) + s * std::log(b)); }

/// Not above `step`, so that a whole number of steps makes up the run.
double wholeStep(const Scene& scene, double step) {
    const double length = scene.end.value - scene.start.value;
    return length / std::ceil(length / step * (1 - 1e-12));
}

}  // namespace

std::vector<Proposal> proposalsFor(const Sweep& sweep, double wantedError) {
    std::vector<Proposal> all;
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const auto reaches = [&](const SweepRow& row) {
            return isMeasured(row.result) && row.result.error <= wantedError;
        };
        const auto found = std::find_if(scheme.rows.begin(), scheme.rows.end(), reaches);
        if (found == scheme.rows.end()) continue;
        const PointResult& b = found->result;
        Proposal p{scheme.scheme, b.step, b.tolerance, b.cpuSeconds,
                   static_cast<std::size_t>(&*found - sweep.rows().data())};
        if (found != scheme.rows.begin() && b.error > 0 && isMeasured((found - 1)->result)) {
            const PointResult& a = (found - 1)->result;
            const double s = std::log(a.error / wantedError) / std::log(a.error / b.error);
            if (a.step > 0 && b.step > 0) p.step = wholeStep(sweep.scene().scene, between(a.step, b.step, s));
            if (a.tolerance > 0 && b.tolerance > 0) p.tolerance = between(a.tolerance, b.tolerance, s);
            p.predictedSeconds = between(a.cpuSeconds, b.cpuSeconds, s);
        }
        all.push_back(p);
    }
    std::stable_sort(all.begin(), all.end(), [](const Proposal& a, const Proposal& b) {
        return a.predictedSeconds < b.predictedSeconds;
    });
    return all;
}

}  // namespace extremal
