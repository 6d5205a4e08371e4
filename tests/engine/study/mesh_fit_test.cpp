// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements and steps together: against the best of all pairs, on made-up errors and on a field.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/knobs.hpp"
#include "engine/study/search/mesh_fit.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mesh_fit_test {
namespace {

struct MadeUp {
    int p, q;
    double A, B, sign;
    double leastRatio = 0;  ///< of steps to elements, below which it is not stable
    double error(double cells, double steps) const {
        if (steps < leastRatio * cells) return HUGE_VAL;
        return std::abs(A * std::pow(steps, -p) + sign * B * std::pow(cells, -q));
    }
    static double cost(double cells, double steps) { return std::pow(cells, 0.9) * steps; }
};

struct Found {
    int runs = 0;
    double cost = HUGE_VAL, least = HUGE_VAL;
};

Found searched(const MadeUp& of, MeshFit& fit, double wanted) {
    Found found;
    while (const auto pair = fit.next(wanted, HUGE_VAL)) {
        const double cost = MadeUp::cost(pair->cells, pair->steps);
        fit.take({pair->cells, pair->steps, of.error(pair->cells, pair->steps), cost, false, false});
        if (++found.runs > 50) break;
    }
    if (const MeshRun* const best = fit.best(wanted)) found.cost = best->cost;
    for (double N = 4; N < 1e5; N = std::max(N + 1, std::floor(1.03 * N)))
        for (double n = 1; n < 1e6; n = std::max(n + 1, std::floor(1.03 * n))) {
            if (MadeUp::cost(N, n) >= found.least) break;
            // What more steps do not keep is an accident.
            if (of.error(N, n) <= wanted && of.error(N, 1.1 * n) <= wanted) found.least = MadeUp::cost(N, n);
        }
    return found;
}

Sweep kink(double wanted, bool isAll, std::vector<std::string> only, SearchKnobs knobs, double seconds) {
    SweepOptions options;
    options.wantedError = wanted;
    options.hasAllCandidates = isAll;
    options.only = std::move(only);
    options.knobs = knobs;
    options.repeat = seconds > 0 ? 1 : 0;
    options.searchSeconds = seconds;
    Sweep sweep(*readScene(findPreset("sine-gordon-kink")->json).resolved, options);
    sweep.run({}, {}, {});
    return sweep;
}

}  // namespace

class MeshFitTest : public QObject {
    Q_OBJECT
private slots:
    void theCheapestPairIsFound_data() {
        QTest::addColumn<int>("p");
        QTest::addColumn<int>("q");
        QTest::addColumn<double>("A");
        QTest::addColumn<double>("B");
        QTest::addColumn<double>("sign");
        QTest::addColumn<double>("leastRatio");
        QTest::newRow("order 2, equal signs") << 2 << 2 << 40.0 << 600.0 << 1.0 << 0.0;
        QTest::newRow("order 2, a step makes up for the mesh") << 2 << 2 << 300.0 << 900.0 << -1.0 << 0.25;
        QTest::newRow("order 4") << 4 << 4 << 3e3 << 6e4 << 1.0 << 0.0;
        QTest::newRow("order 6") << 6 << 6 << 1e5 << 1e5 << 1.0 << 0.0;
        QTest::newRow("a higher order in time") << 4 << 2 << 1e3 << 500.0 << 1.0 << 0.0;
    }
    void theCheapestPairIsFound() {
        QFETCH(int, p);
        QFETCH(int, q);
        QFETCH(double, A);
        QFETCH(double, B);
        QFETCH(double, sign);
        QFETCH(double, leastRatio);
        const MadeUp of{p, q, A, B, sign, leastRatio};
        for (const double wanted : {1e-2, 1e-4, 1e-6}) {
            MeshFit fit(200, 100, std::min(p, q), q, 4);
            const Found found = searched(of, fit, wanted);
            qInfo("%.0e: %d runs, %.3f times the least", wanted, found.runs, found.cost / found.least);
            QVERIFY(found.runs <= 8 && found.cost / found.least < (sign > 0 ? 1.2 : 2));
            // Of its own mesh the error that no step improves.
            QVERIFY2(std::abs(fit.floorOf(200) / (B * std::pow(200.0, -q)) - 1) < 0.05,
                     qPrintable(QString::number(fit.floorOf(200))));
        }
    }
    void aRejectedPairDoesNotCount() {
        MeshFit fit(100, 10, 2, 2, 4);
        fit.take({100, 10, 1e-3, 1, false, false});
        QVERIFY(fit.best(1e-2));
        fit.reject(100, 10);
        QVERIFY(!fit.best(1e-2));
    }
    /// The kink to 1e-5: with 200 cells linear elements end at 3.7e-3, and degree 3 needs half as many.
    void aKinkTakesAMeshOfItsOwn() {
        const Sweep own = kink(1e-5, false, {"Gauss 2"}, {}, 0);
        const PointResult& gauss = own.rows().front().result;
        qInfo("Gauss 2: %s", gauss.reason.c_str());
        const auto at = gauss.reason.find("cannot give less than ");
        QVERIFY(at != std::string::npos);
        const double floor = std::stod(gauss.reason.substr(at + 22));
        QVERIFY2(std::abs(floor / 3.74e-3 - 1) < 0.05, qPrintable(QString::number(floor)));
        QVERIFY(gauss.reason.find("with 200 cells") != std::string::npos);
        // With one knob nothing reaches it.
        const Sweep fixed = kink(1e-5, false, {"Gauss 2"}, {true, false}, 0);
        QVERIFY(!fixed.rows().front().result.isDone());
        const Sweep all = kink(1e-5, true, {"Gauss 2"}, {}, 0);
        const SweepRow* best = nullptr;
        for (const SweepRow& row : all.rows()) {
            if (!row.result.isDone()) continue;
            qInfo("%s: %d cells, %lld steps, %.3g", all.scene().schemes[row.point.scheme].spec.label.c_str(),
                  row.result.reduction.cells, row.result.steps, row.result.error);
            if (row.result.reason.starts_with("the cheapest")) best = &row;
        }
        QVERIFY(best && best->result.error <= 1e-5);
        QCOMPARE(all.scene().schemes[best->point.scheme].spec.label, std::string("multisymplectic-3"));
        QVERIFY(best->result.reduction.cells <= 141);
        // What is found is a scheme of a scene.
        const ResolvedScheme scheme = schemeAt(all.scene(), best->point.scheme, best->result);
        QCOMPARE(scheme.discretization.space.integer("cells"), best->result.reduction.cells);
        QCOMPARE(scheme.discretization.space.integer("degree"), 3);
    }
    void knobsAreNamed() {
        QVERIFY(parseKnobs("") == SearchKnobs{} &&
                parseKnobs("step,degree,cells,modes,courant") == SearchKnobs{});
        QVERIFY((parseKnobs("step") == SearchKnobs{false, false, false, false}));
        QVERIFY(parseKnobs(textOf(SearchKnobs{false, true})) == (SearchKnobs{false, true}));
        QVERIFY(parseKnobs("step,tolerance").isTolerance && !SearchKnobs{}.isTolerance);
        QCOMPARE(textOf(parseKnobs("tolerance,courant,step")), "step,courant,tolerance");
        QCOMPARE(pointerOf([] { (void)parseKnobs("colour"); }), "--knobs");
    }
};

EXTREMAL_TEST(MeshFitTest)
}  // namespace extremal::mesh_fit_test
#include "mesh_fit_test.moc"
