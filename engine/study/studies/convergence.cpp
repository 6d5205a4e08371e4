/// How errors shrink with the step, and the order that follows: convergence.csv.
#include "engine/study/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/study/catalog.hpp"

namespace extremal::studies {
namespace {

double sizeOf(const State& state) {
    double size = 0;
    for (const double v : state.x) size = std::max(size, std::abs(v));
    return size;
}

std::vector<Value::Array> rowsOf(const Sweep& sweep) {
    std::vector<Value::Array> all;
    const double floor = floorOf(sweep.reference()), scale = sizeOf(sweep.scene().initial);
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const ResolvedScheme& resolved = sweep.scene().schemes[scheme.scheme];
        const OrderFit fit = fitOrder(scheme.rows, floor, scale);
        for (const auto& [point, result] : scheme.rows) {
            if (result.status == RunStatus::waiting) continue;
            all.push_back({resolved.spec.label, point.step > 0 ? Value(point.step) : Value(nullptr),
                           point.tolerance > 0 ? Value(point.tolerance) : Value(nullptr),
                           knownNumber(result.error), name(result.status), knownText(name(result.cause)),
                           knownNumber(fit.order), knownNumber(fit.r2),
                           resolved.claims.order > 0 ? Value(resolved.claims.order) : Value(nullptr),
                           knownNumber(fit.from), knownNumber(fit.to)});
        }
    }
    return all;
}

/// One per scheme.
std::vector<Value::Array> summaryOf(const Sweep& sweep) {
    std::vector<Value::Array> all;
    const double floor = floorOf(sweep.reference()), scale = sizeOf(sweep.scene().initial);
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const ResolvedScheme& resolved = sweep.scene().schemes[scheme.scheme];
        const OrderFit fit = fitOrder(scheme.rows, floor, scale);
        int run = 0, failed = 0;
        double least = std::numeric_limits<double>::infinity();
        for (const SweepRow& row : scheme.rows) {
            run += row.result.status != RunStatus::waiting;
            failed += row.result.status == RunStatus::failed;
            if (row.result.isDone() && row.result.error < least) least = row.result.error;
        }
        if (run == 0) continue;
        all.push_back({resolved.spec.label, run, failed > 0 ? Value(failed) : Value(nullptr),
                       knownNumber(fit.order),
                       resolved.claims.order > 0 ? Value(resolved.claims.order) : Value(nullptr),
                       knownNumber(fit.from), knownNumber(fit.to), knownNumber(least)});
    }
    return all;
}

}  // namespace

StudyEntry convergence() {
    StudyEntry e;
    e.item = {"convergence",
              "Convergence",
              "Errors against the step, and the order measured where they lie on a line.",
              {},
              {},
              ""};
    e.columns = {"label", "step", "tolerance",     "error",    "status", "cause",
                 "order", "r2",   "order_claimed", "fit_from", "fit_to"};
    e.rows = rowsOf;
    e.summaryColumns = {"scheme",  "points",    "failed",  "order",
                        "claimed", "from step", "to step", "least error"};
    e.summary = summaryOf;
    return e;
}

}  // namespace extremal::studies
