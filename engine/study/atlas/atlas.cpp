// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/atlas/atlas.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/reference/error_floor.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/candidates.hpp"
#include "engine/study/search/proposal.hpp"

namespace extremal {
namespace {

/// Those that the scene accepts with this step, without a warning of instability.
Value::Array fittingSchemes(Value document, double step, const AtlasOptions& options) {
    Value::Array fitting;
    for (Value scheme : everyScheme(options.isQuick ? std::set{1, 2} : std::set{1, 2, 3, 4, 6, 8})) {
        if (!scheme.find("tolerance")) scheme.set("step", step);
        document.set("schemes", Value::Array{scheme});
        const ReadScene read = readScene(document);
        if (read.resolved && read.errors.empty()) fitting.push_back(scheme);
    }
    return fitting;
}

double valueOf(const Sweep& sweep, std::size_t scheme, double step) {
    for (const SweepRow& row : sweep.rows())
        if (row.point.scheme == scheme && row.result.isDone() &&
            (row.point.step == 0 || std::abs(row.point.step - step) < 1e-9 * step))
            return row.result.error;
    return AtlasRow::unknown;
}

}  // namespace

const std::vector<std::string>& atlasSystems() {
    static const std::vector<std::string> all{
        "harmonic-oscillator", "pendulum",  "kepler",          "henon-heiles",
        "spring-pendulum",     "free-body", "heavy-top",       "coherent-state",
        "schrodinger-seed",    "wave",      "sine-gordon-kink"};
    return all;
}

AtlasSystem atlasSystem(const std::string& preset, const AtlasOptions& options) {
    const Preset* found = findPreset(preset);
    if (!found)
        throw InvalidScene("--systems", "no preset is called \"" + preset + "\"",
                           "extremal list presets shows them");
    const ReadScene read = readScene(found->json);
    const auto stepped = std::find_if(read.scene.schemes.begin(), read.scene.schemes.end(),
                                      [](const SchemeSpec& s) { return s.isEnabled && s.step.value > 0; });
    if (stepped == read.scene.schemes.end() || read.scene.reference.kind == ReferenceSpec::Kind::none)
        throw InvalidScene("--systems", "\"" + preset + "\" has no scheme with a step, or no reference",
                           "for example kepler");
    // A whole number of steps, so that the points of all sweeps meet.
    const double length = read.scene.end.value - read.scene.start.value;
    AtlasSystem system{preset, read.scene.title, length / std::ceil(length / stepped->step.value), {}};
    Value document = toValue(read.scene);
    document.set("views", Value::Array{});
    document.set("observe", Value::Array{});
    document.set("schemes", fittingSchemes(document, system.step, options));
    const ReadScene whole = readScene(document);
    if (!whole.resolved) throw InvalidScene(whole.errors);
    const double n = length / system.step;
    std::vector<double> steps;
    for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0})
        if (std::round(n * factor) >= 4 && (!options.isQuick || factor >= 0.5))
            steps.push_back(length / std::round(n * factor));
    for (const char* metric : {"error", "energy", "momentum", "norm", "phase"}) {
        const std::vector<std::string> known = metricNames(*whole.resolved->system, whole.resolved->initial);
        if (std::find(known.begin(), known.end(), metric) == known.end()) continue;
        const bool isError = std::string_view(metric) == "error";
        SweepOptions sweep;
        sweep.metric = isError ? "column:error" : metric;  // as runs write it, whatever the units
        sweep.ladder.steps = isError ? steps : std::vector<double>{system.step};
        sweep.repeat = !isError ? 0 : options.isQuick ? 1 : 3;
        sweep.threads = options.threads;
        system.parts.push_back({metric, Sweep(*whole.resolved, sweep)});
    }
    return system;
}

AtlasRow::Verdict AtlasRow::orderVerdict() const {
    constexpr double plateau = 0.5, resolved = 0.01;
    if (!order.isKnown() || claims.order == 0 || order.order < plateau) return Verdict::unknown;
    if (order.errorAt(order.to) > resolved * size) return Verdict::unknown;
    return order.order >= claims.order - 0.3 ? Verdict::kept : Verdict::below;
}

AtlasRow::Verdict AtlasRow::verdictOf(const Measured& measured) const {
    constexpr double conserved = 1e-9;
    const auto& names = claims.conserves;
    if (std::find(names.begin(), names.end(), measured.metric) == names.end() ||
        !std::isfinite(measured.value))
        return Verdict::unknown;
    return measured.value <= conserved ? Verdict::kept : Verdict::below;
}

std::vector<AtlasRow> rowsOf(const AtlasSystem& system) {
    const Sweep& errors = system.errors();
    const std::vector<OrderFit> orders = fitOrders(errors);
    const std::vector<Proposal> proposals = proposalsFor(errors, 1e-6);
    const double size = largestEntry(errors.scene().initial);
    std::vector<AtlasRow> all;
    auto order = orders.begin();
    for (const SchemeRows& scheme : bySchemes(errors)) {
        const ResolvedScheme& resolved = errors.scene().schemes[scheme.scheme];
        AtlasRow row;
        row.label = resolved.spec.label;
        row.claims = resolved.claims;
        row.order = *order++;
        row.size = size;
        for (const SweepRow& point : scheme.rows) {
            if (point.point.step > 0 && std::abs(point.point.step - system.step) > 1e-9 * system.step)
                continue;
            const PointResult& r = point.result;
            if (r.status == RunStatus::waiting) continue;
            if (r.isDone()) {
                row.error = r.error;
                row.seconds = r.cpuSeconds;
            } else {
                row.cause = name(r.cause);
            }
            if (point.point.step > 0 || r.isDone()) break;
        }
        for (std::size_t i = 1; i < system.parts.size(); ++i)
            row.metrics.push_back(
                {system.parts[i].metric, valueOf(system.parts[i].sweep, scheme.scheme, system.step)});
        for (const Proposal& p : proposals)
            if (p.scheme == scheme.scheme) row.secondsForError = p.predictedSeconds;
        all.push_back(std::move(row));
    }
    return all;
}

}  // namespace extremal
