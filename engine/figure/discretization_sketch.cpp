// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/discretization_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/family/table_of.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/figure/kkt_axes.hpp"
#include "engine/figure/step_functions.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/run/kkt_pattern.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/space/typed.hpp"

namespace extremal {
namespace {

constexpr int curvePoints = 240;

Figure titled(const char* title, const char* x, const char* y) {
    Figure figure;
    figure.title = title;
    figure.x.title = x;
    figure.y.title = y;
    figure.x.range = figure.y.range = {0, 1};
    return figure;
}

/// The range of all curves, with some room.
void fitHeight(Figure& figure, double least = 0) {
    double low = -least, high = least;
    for (const Series& s : figure.series())
        for (const double y : s.y)
            if (std::isfinite(y)) {
                low = std::min(low, y);
                high = std::max(high, y);
            }
    const double room = 0.06 * std::max(high - low, 1e-9);
    figure.y.range = {low - room, high + room};
}

/// Curves of the functions or of their slopes, and at the nodes their values.
void drawFunctions(Figure& figure, const Table<double>& table, bool areSlopes) {
    const auto& atNodes = areSlopes ? table.derivative : table.value;
    std::vector<Series> curves = stepFunctions(table, areSlopes);
    for (std::size_t a = 0; a < curves.size(); ++a) {
        Series dots;
        curves[a].label = dots.label = std::exchange(curves[a].part, {});
        curves[a].style = dots.style = static_cast<int>(a % 8);
        dots.kind = SeriesKind::marks;
        for (int i = 0; i < table.nodes(); ++i) {
            dots.x.push_back(table.node(i));
            dots.y.push_back(atNodes(i, static_cast<Eigen::Index>(a)));
        }
        figure.add(std::move(curves[a]));
        figure.add(std::move(dots));
    }
    fitHeight(figure);
    // Weights stand on the lower edge, the largest as high as a fifth of the figure.
    const auto [low, high] = *figure.y.range;
    const double largest = table.weight.cwiseAbs().maxCoeff();
    for (int i = 0; i < table.nodes(); ++i)
        figure.add(Guide{{table.node(i), table.node(i)},
                         {low, low + 0.2 * (high - low) * std::abs(table.weight(i)) / largest},
                         true});
}

/// Intervals of instability may be narrower than a pixel: the subtitle lists them.
void drawAmplification(Figure& figure, const Table<double>& table,
                       const std::vector<UnstableInterval>& intervals) {
    const double limit = firstEdge(intervals);
    const double end = std::isfinite(limit) && limit > 0 ? std::clamp(1.6 * limit, 2.0, 40.0) : 12.0;
    Series trace;
    trace.label = "half the trace of a step";
    for (int i = 0; i <= 2 * curvePoints; ++i) {
        const double z = end * i / (2 * curvePoints), half = halfTrace(table, z);
        trace.x.push_back(z);
        trace.y.push_back(std::abs(half) <= 3 ? half : std::numeric_limits<double>::quiet_NaN());
    }
    figure.x.range = {0, end};
    for (const double bound : {-1.0, 1.0}) figure.add(Guide{{0, end}, {bound, bound}, true});
    figure.add(std::move(trace));
    fitHeight(figure, 1);
    figure.subtitle =
        intervals.empty() ? "stable for every step" : "unstable: h ω " + intervalsText(intervals);
}

void drawPattern(Figure& figure, const KktPattern& p) {
    figure.aspect = Aspect::equal;
    if (!p.failure.empty()) {
        figure.message = p.failure;
        return;
    }
    const auto add = [&](const KktPattern::Entries& entries, Tone tone) {
        Series cells;
        cells.kind = SeriesKind::cells;
        cells.label = tone == Tone::full ? "action" : "continuity";
        cells.tone = tone;
        for (const auto& [row, column] : entries) {
            cells.x.push_back(column);
            cells.y.push_back(p.size - 1 - row);
        }
        figure.add(std::move(cells));
    };
    add(p.action, Tone::full);
    add(p.continuity, Tone::pale);
    nameBlocks(figure, p);
    figure.subtitle = std::to_string(p.size) + " unknowns, bandwidth " + std::to_string(p.bandwidth);
}

void tellFacts(DiscretizationSketch& sketch, const ResolvedScheme& scheme, const Table<double>* table,
               const Settings& space) {
    const auto small = [](double x) { return formatNumber(x, 3); };
    const Properties& p = scheme.properties;
    std::vector<std::string>& facts = sketch.facts;
    if (!p.knownAs.empty()) facts.push_back(p.knownAs);
    facts.emplace_back(scheme.claims.isSymmetric ? "symmetric" : "not symmetric");
    if (const auto stability = stabilityOf(scheme)) {
        const double limit = firstEdge(stability->intervals);
        if (std::isinf(limit))
            facts.emplace_back("no limit of h ω");
        else if (limit > 0)
            facts.push_back("stable for h ω below " + small(limit));
    }
    if (table) {
        for (std::string& fact : stepFacts(*table, space)) facts.push_back(std::move(fact));
        std::string defects = "D(k)";
        for (const double d : consistencyDefects(*table, std::min(3, table->space.degree + 1)))
            defects += (defects == "D(k)" ? " " : ", ") + formatNumber(d, 1);
        facts.push_back(defects);
    }
    for (const std::string& remark : {p.shortfall, p.caution})
        if (!remark.empty()) sketch.remarks.push_back(remark);
}

}  // namespace

DiscretizationSketch sketchOf(const ReadScene& read) {
    DiscretizationSketch sketch;
    sketch.errors = read.errors;
    sketch.functions = titled("Functions of a step", "τ", "φ");
    sketch.slopes = titled("Their slopes", "τ", "φ′");
    sketch.amplification = titled("Amplification", "h ω", "½ tr M");
    sketch.pattern = titled("KKT matrix", "", "");
    if (!read.errors.empty() || !read.resolved || read.resolved->schemes.empty()) return sketch;
    const ResolvedScene& scene = *read.resolved;
    const ResolvedScheme& scheme = scene.schemes.front();
    const double h = scheme.spec.step.value;
    sketch.order = scheme.claims.order;
    const Discretization* const plain = scheme.plain();
    const bool isFitted = plain && !isTermRule(plain->quadrature) && plain->space.find("functions") &&
                          dependsOnStep(plain->space);
    if (!plain || !(isFitted || hasTable(*plain))) {
        tellFacts(sketch, scheme, nullptr, {});
        for (Figure* f : {&sketch.functions, &sketch.slopes, &sketch.amplification, &sketch.pattern})
            f->message = "Several rules or spaces: no one table";
        return sketch;
    }
    const Settings space = withStep(plain->space, h);
    const Table<double> table = tableOf(space, plain->quadrature);
    sketch.functions.subtitle = "dots at nodes, strokes: weights";
    drawFunctions(sketch.functions, table, false);
    drawFunctions(sketch.slopes, table, true);
    drawAmplification(sketch.amplification, table, OscillatorStep(oscillatorAction(table)).intervals());
    drawPattern(sketch.pattern,
                kktPattern(*systemOf(scene, scheme), {space, plain->quadrature, plain->solver},
                           initialOf(scene, scheme), h));
    tellFacts(sketch, scheme, &table, space);
    return sketch;
}

std::optional<double> measuredOrder(const ReadScene& read, const std::stop_token& stop) {
    if (!read.errors.empty() || !read.resolved || read.resolved->schemes.empty()) return {};
    const ResolvedScene& scene = *read.resolved;
    const ResolvedScheme& scheme = scene.schemes.front();
    const State& start = initialOf(scene, scheme);
    if (!scheme.isFixed() || !(scheme.spec.step.value > 0)) return {};
    constexpr int steps = 8, levels = 5;
    std::vector<std::vector<double>> ends;
    double h = scheme.spec.step.value;
    for (int level = 0; level < levels; ++level, h /= 2) {
        try {
            const auto integrator = scheme.make(*systemOf(scene, scheme), h, start);
            State state = start;
            integrator->begin(state);
            for (int k = 1; k <= steps << level; ++k)
                if (stop.stop_requested() ||
                    integrator->advance(state, start.t + k * h).outcome != Outcome::converged)
                    return {};
            ends.push_back(state.x);
        } catch (const InvalidScene&) {
            return {};
        }
    }
    double size = 1;
    for (const double x : ends.back()) size = std::max(size, std::abs(x));
    std::vector<double> change;
    for (std::size_t l = 0; l + 1 < ends.size(); ++l) {
        double worst = 0;
        for (std::size_t i = 0; i < ends[l].size(); ++i)
            worst = std::max(worst, std::abs(ends[l][i] - ends[l + 1][i]));
        change.push_back(worst / size);
    }
    // The last pair that rounding leaves alone.
    for (std::size_t l = change.size(); l-- > 1;)
        if (change[l] > 1e-13 && change[l - 1] > 1e-12) return std::log2(change[l - 1] / change[l]);
    return {};
}

}  // namespace extremal
