// SPDX-License-Identifier: GPL-3.0-or-later
/// The edges of linear stability, over the catalogue: half the trace of the scheme's own step matrix, in
/// quadruple precision, is beyond 1 inside each interval and not outside, up
/// to 1e-8 beside the edges. The matrix comes from the table in quadruple precision by another route than the
/// edges: all stages of the tableau at once, of few stages by expanded determinants.
#include <QTest>

#include <cmath>
#include <functional>

#include "engine/baseline/parts.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/tableau/tableau.hpp"
#include "tests/laws/catalogue.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::stability_edges_test {
namespace {

using Trace = std::function<Quad(double)>;
using Intervals = std::vector<UnstableInterval>;

/// Half the trace of q' = p, p' = -z^2 q from all stages at once: P = p_0 - z^2 Ahat Q, Q = q_0 + A P.
Quad traceByStages(const Tableau& t, const Quad& square) {
    const Eigen::Index n = t.velocities(), m = t.forces();
    Tableau::Matrix system = Tableau::Matrix::Identity(n + m, n + m), start(n + m, 2);
    system.topRightCorner(n, m) = square * t.Ahat;
    system.bottomLeftCorner(m, n) = -t.A;
    start.setZero();
    start.col(0).tail(m).setOnes();
    start.col(1).head(n).setOnes();
    const Tableau::Matrix stages = dense::solve<Quad>(system, start);
    const Quad ofQ = t.b.dot(stages.col(0).head(n)), ofP = square * t.bHat.dot(stages.col(1).tail(m));
    return (1 + ofQ + 1 - ofP) / 2;
}

struct StepTrace {
    Trace trace;          ///< empty where the step is not a Runge-Kutta method
    bool isFast = false;  ///< a quotient of polynomials of low degree
};

StepTrace traceOf(const ResolvedScheme& scheme) {
    constexpr int fewStages = 6, mostStages = 20;
    const auto* const ofFamily = scheme.family ? scheme.family->parts.find<StepTableau>() : nullptr;
    const auto* const own = scheme.baseline ? scheme.baseline->parts.find<BaselineTableau>() : nullptr;
    if (!ofFamily && !own) return {};
    try {
        const auto part = ofFamily ? ofFamily->of(scheme.discretization, 1) : own->of(scheme.spec.baseline);
        const Tableau whole =
            scheme.isComposed() ? composed(*part, {scheme.parts.begin(), scheme.parts.end()}) : *part;
        if (whole.forces() > mostStages) return {};
        // Expanded determinants of more stages lose their digits at large z.
        if (whole.forces() <= fewStages)
            return {[R = oscillatorTrace(whole)](double z) { return R(Quad(z) * Quad(z)); }, true};
        return {[whole](double z) { return traceByStages(whole, Quad(z) * Quad(z)); }, false};
    } catch (const InvalidScene&) {
        return {};
    }
}

/// What contradicts the intervals; empty: nothing. Between them, half the trace may be 1 to round-off.
std::string contradiction(const Intervals& intervals, const StepTrace& step) {
    const Trace& trace = step.trace;
    const int places = step.isFast ? 61 : 17;
    constexpr double margin = 1e-8, farthest = 40;
    const double known = step.isFast ? 1e-18 : 1e-27;
    const auto isUnstable = [&](double z) { return !(abs(trace(z)) <= 1 + Quad(known)); };
    // Half the trace is beyond 1 by about 2 g^2 s (1 - s) at the part s of an interval with the growth g.
    const auto isSeen = [&](const UnstableInterval& i, double part) {
        return !i.isBounded() || 2 * i.growth * i.growth * part * (1 - part) > 10 * known;
    };
    const auto at = [](double z) { return QString::number(z, 'g', 12).toStdString(); };
    double below = 0;
    for (std::size_t n = 0; n < intervals.size(); ++n) {
        const UnstableInterval& i = intervals[n];
        const double width = (i.isBounded() ? i.high : i.low + 1) - i.low;
        for (const double part : {1e-3, 0.1, 0.5, 0.9, 0.999})
            if (isSeen(i, part) && !isUnstable(i.low + part * width))
                return "stable at " + at(i.low + part * width);
        for (int k = 1; k < places; ++k)
            if (const double z = below + k * (i.low - below) / places; isUnstable(z))
                return "unstable at " + at(z);
        const double inside = std::min(margin, 0.01 * width / i.low);
        const bool isSeenBeside = isSeen(i, inside * i.low / width);
        if (i.low > 0 && (isUnstable(i.low * (1 - std::min(margin, 0.1 * (i.low - below) / i.low))) ||
                          (isSeenBeside && !isUnstable(i.low * (1 + inside)))))
            return "no edge at " + at(i.low);
        if (!i.isBounded()) return {};
        const double next = n + 1 < intervals.size() ? intervals[n + 1].low : HUGE_VAL;
        if ((isSeenBeside && !isUnstable(i.high * (1 - inside))) ||
            isUnstable(i.high + std::min(margin * i.high, 0.1 * (next - i.high))))
            return "no edge at " + at(i.high);
        below = i.high;
    }
    for (double z = below + 0.013; z < farthest; z += step.isFast ? 0.0131 : 0.531)
        if (isUnstable(z)) return "unstable at " + at(z);
    return {};
}

const State start{0, 0, {1, 0.3}};

}  // namespace

class StabilityEdgesTest : public QObject {
    Q_OBJECT
private slots:
    void theStepMatrixConfirmsEveryEdge() {
        const System system = systemNamed("harmonic-oscillator");
        int checked = 0, edges = 0, narrow = 0;
        for (const CatalogueScheme& c : everythingOn(system, start, 0.1)) {
            if (c.scheme.isAdaptive() || !c.claims().isSymplectic || !c.claims().isOneStep) continue;
            const StepTrace trace = traceOf(c.scheme);
            const auto stability = stabilityOf(c.scheme);
            if (!trace.trace || !stability || !stability->growthWithin) continue;
            const std::string wrong = contradiction(stability->intervals, trace);
            QVERIFY2(wrong.empty(), (c.name + ": " + wrong).c_str());
            ++checked;
            edges += static_cast<int>(stability->intervals.size());
            for (const UnstableInterval& i : stability->intervals) narrow += i.high - i.low < 0.004;
        }
        qInfo("%d schemes, %d intervals, %d of them narrower than 0.004", checked, edges, narrow);
        QVERIFY(checked > 100 && edges > 100 && narrow > 10);
    }
    void aBrokenEdgeIsSeen() {
        SchemeSpec spec;
        spec.kind = SchemeSpec::Kind::named;
        spec.named = "galerkin-lobatto-4";
        spec.step = {0.1, {}};
        const ResolvedScheme scheme = resolve(spec);
        const StepTrace trace = traceOf(scheme);
        const Intervals right = stabilityOf(scheme)->intervals;
        QVERIFY(right.size() >= 2 && contradiction(right, trace).empty());
        for (std::size_t i = 0; i < right.size(); ++i)
            for (const double moved : {1 + 1e-7, 1 - 1e-7}) {
                Intervals broken = right;
                broken[i].low *= moved;
                QVERIFY(!contradiction(broken, trace).empty());
                if (!right[i].isBounded()) continue;
                broken = right;
                broken[i].high *= moved;
                QVERIFY(!contradiction(broken, trace).empty());
            }
        for (std::size_t i = 0; i < right.size(); ++i) {
            Intervals lacking = right;
            lacking.erase(lacking.begin() + static_cast<std::ptrdiff_t>(i));
            if (right[i].high - right[i].low > 0.02) QVERIFY(!contradiction(lacking, trace).empty());
        }
        Intervals further = right;
        further.insert(further.begin(), {1.0, 1.001, 1e-3});
        QVERIFY(!contradiction(further, trace).empty());
    }
};

EXTREMAL_TEST(StabilityEdgesTest)
}  // namespace extremal::laws::stability_edges_test

#include "stability_edges_test.moc"
