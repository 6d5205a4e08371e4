// SPDX-License-Identifier: GPL-3.0-or-later
/// How errors shrink with the step, and the order that follows: convergence.csv.
#include "engine/study/convergence.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "engine/core/known_value.hpp"
#include "engine/study/catalog.hpp"

namespace extremal::studies {
namespace {

/// Of the time alone; where the mesh is refined with the step, of the space as well.
int claimedOrder(const ResolvedScheme& scheme, std::span<const SweepRow> rows) {
    return areMeshesRefined(rows) ? std::min(scheme.claims.order, scheme.orderInSpace())
                                  : scheme.claims.order;
}

std::vector<Value::Array> rowsOf(const Sweep& sweep) {
    std::vector<Value::Array> all;
    const std::vector<OrderFit> fits = fitOrders(sweep);
    auto next = fits.begin();
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const ResolvedScheme& resolved = sweep.scene().schemes[scheme.scheme];
        const OrderFit& fit = *next++;
        for (const auto& [point, result] : scheme.rows) {
            if (result.status == RunStatus::waiting) continue;
            all.push_back({resolved.spec.label, positiveNumber(point.step), positiveNumber(point.tolerance),
                           knownNumber(result.error), name(result.status), knownText(name(result.cause)),
                           knownNumber(fit.order), knownNumber(fit.r2),
                           positiveNumber(claimedOrder(resolved, scheme.rows)), knownNumber(fit.from),
                           knownNumber(fit.to), positiveNumber(cellsAt(sweep, point))});
        }
    }
    return all;
}

/// One per scheme.
std::vector<Value::Array> summaryOf(const Sweep& sweep) {
    std::vector<Value::Array> all;
    const std::vector<OrderFit> fits = fitOrders(sweep);
    auto next = fits.begin();
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const ResolvedScheme& resolved = sweep.scene().schemes[scheme.scheme];
        const OrderFit& fit = *next++;
        int run = 0, failed = 0;
        double least = std::numeric_limits<double>::infinity();
        for (const SweepRow& row : scheme.rows) {
            run += row.result.status != RunStatus::waiting;
            failed += row.result.status == RunStatus::failed;
            if (row.result.isDone() && row.result.error < least) least = row.result.error;
        }
        if (run == 0) continue;
        all.push_back({resolved.spec.label, run, positiveNumber(failed), knownNumber(fit.order),
                       positiveNumber(claimedOrder(resolved, scheme.rows)), knownNumber(fit.from),
                       knownNumber(fit.to), knownNumber(least)});
    }
    return all;
}

}  // namespace

StudyEntry convergence() {
    StudyEntry e;
    e.item = {
        "convergence",
        "Convergence",
        "Errors against the step, and the order measured where they lie on a line. On meshes that may be "
        "refined the elements become smaller with the step.",
        {},
        {},
        ""};
    e.columns = {"label", "step", "tolerance",     "error",    "status", "cause",
                 "order", "r2",   "order_claimed", "fit_from", "fit_to"};
    e.further = "cells";
    e.rows = rowsOf;
    e.summaryColumns = {"scheme",  "points",    "failed",  "order",
                        "claimed", "from step", "to step", "least error"};
    e.summary = summaryOf;
    return e;
}

}  // namespace extremal::studies
