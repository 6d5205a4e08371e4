#include "engine/run/open_bar.hpp"

#include <cmath>

#include "engine/core/text.hpp"
#include "engine/scene/companion.hpp"

namespace extremal {

void judgeBar(SchemeResult& result, const System& system, const State& initial) {
    constexpr double open = 0.05;
    const Trajectory& rows = result.trajectory;
    const Column* error = rows.find("error");
    if (!error || rows.rows() == 0) return;
    double scale = errorMeasure(system, initial).scale;
    if (const auto d = static_cast<std::size_t>(system.dimension()); d > 0) {
        double sum = 0;
        for (std::size_t i = 0; i < d; ++i)
            for (const double q : rows.columns[1 + i].values) sum += q * q;
        scale = std::sqrt(sum / static_cast<double>(rows.rows()));
    }
    const std::vector<double>& t = rows.columns.front().values;
    if (const double turned = result.scheme ? unresolvedTurn(*result.scheme, system, initial) : 0;
        turned > 0) {
        result.summary.opensAt = t.front();
        result.summary.caution = "the error bar is open from the start: a step is " +
                                 formatNumber(turned, 2) +
                                 " rad of the fastest motion, which neither the scheme nor its companion "
                                 "needs to follow";
        return;
    }
    for (std::size_t r = 0; r < t.size(); ++r) {
        if (error->values[r] <= open * scale) continue;
        result.summary.opensAt = t[r];
        result.summary.caution =
            "the error bar is open from t = " + formatNumber(t[r], 3) +
            " on: the difference from the companion is above 0.05 of the size of the state";
        return;
    }
}

void judgeCompanion(SchemeResult& result, const Reference& reference, const std::string& reason) {
    constexpr double most = 0.02;
    Summary& summary = result.summary;
    if (!reason.empty()) summary.caution = "there is no error bar: it " + reason;
    if (!reference.counts || reference.counts->steps == 0 || summary.steps == 0) return;
    if (static_cast<double>(reference.counts->events) <= most * static_cast<double>(reference.counts->steps))
        return;
    if (result.trajectory.rows() > 0) summary.opensAt = result.trajectory.columns.front().values.front();
    summary.caution =
        "the error bar is open from the start: " + std::to_string(reference.counts->events) + " of " +
        std::to_string(reference.counts->steps) +
        " steps of its companion had no root of the energy equation or did more than go on, and the "
        "difference may be the error of the companion";
}

}  // namespace extremal
