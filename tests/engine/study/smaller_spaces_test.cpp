// SPDX-License-Identifier: GPL-3.0-or-later
/// Spaces with fewer functions than those of the scene: what they leave out is in their errors, searches find
/// what is enough, and the plots beside a search show what it went by.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "engine/model/wave/resampling.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/knobs.hpp"
#include "engine/study/search/reductions.hpp"
#include "engine/study/sweep.hpp"
#include "engine/study/sweep_log.hpp"
#include "tests/tools/test.hpp"

namespace extremal::smaller_spaces_test {
namespace {

ResolvedScene sceneOf(const char* preset) { return *readScene(findPreset(preset)->json).resolved; }

Sweep searched(ResolvedScene scene, double wish) {
    SweepOptions options;
    options.repeat = 0;
    options.wantedError = wish;
    Sweep sweep(std::move(scene), options);
    sweep.run({}, {}, {});
    return sweep;
}

/// A coherent state over two periods, by Gauss 16 with some modes of the 128 of the scene.
std::string coherentState(const std::string& modes,
                          const std::string& packet = R"J("gaussian","centre":-3,"width":"sqrt(1/2)")J") {
    return R"({"extremal":1,"model":{"type":"schrodinger","potential":{"name":"harmonic","omega":1},
        "domain":[-10,10],"modes":128},"initial":{"psi":{"packet":)" +
           packet + R"(}},"time":{"end":"4*pi"},"reference":{"type":"exact"},"observe":["error"],
        "schemes":[{"label":"few","step":"pi/20","space":{"type":"fourier","degree":8,"modes":)" +
           modes + "}}]}";
}

}  // namespace

class SmallerSpacesTest : public QObject {
    Q_OBJECT

private slots:
    /// After two periods the state is back, with its sign: another route to the error than the reference of
    /// the scene. That of the modes alone would say 1e-12 for all of them.
    void whatModesLeaveOutIsInTheError_data() {
        QTest::addColumn<int>("modes");
        for (const int modes : {24, 32, 40, 48, 64, 128, 160})
            QTest::newRow(std::to_string(modes).c_str()) << modes;
    }
    void whatModesLeaveOutIsInTheError() {
        QFETCH(int, modes);
        const auto read = readScene(coherentState(std::to_string(modes)));
        QVERIFY(read.resolved);
        SweepOptions options;
        options.repeat = 0;
        options.isAtEnd = true;
        options.ladder.steps = {std::acos(-1.0) / 20};
        Sweep sweep(*read.resolved, options);
        sweep.run({}, {}, {});
        const PointResult& result = sweep.rows().front().result;
        QVERIFY(result.isDone());
        const ResolvedScheme& scheme = sweep.scene().schemes.front();
        State state = scheme.ownSystem ? scheme.ownInitial : sweep.scene().initial;
        QCOMPARE(static_cast<int>(state.x.size()), 2 * modes);
        const std::vector<double> start = state.x;
        const auto integrator = scheme.make(*systemOf(sweep.scene(), scheme), result.step, state);
        for (int k = 0; k < 80; ++k) QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
        double sum = 0;
        for (std::size_t i = 0; i < start.size(); ++i) sum += std::pow(state.x[i] - start[i], 2);
        const double expected = std::sqrt(sum);
        qInfo("%d modes: error %.4e, after two periods %.4e", modes, result.error, expected);
        QVERIFY(std::abs(result.error - expected) <= 1e-2 * expected + 1e-10);
        if (modes == 32) QVERIFY(result.error > 0.1);   // measured: 0.209
        if (modes >= 64) QVERIFY(result.error < 1e-8);  // measured: 2.5e-9
    }
    /// Sampling is exact at the nodes, whatever the numbers of modes, in one dimension and in two.
    void statesOnOtherMeshesHaveTheSameValues_data() {
        QTest::addColumn<int>("dimension");
        QTest::addColumn<QString>("boundary");
        QTest::newRow("line") << 1 << "periodic";
        QTest::newRow("Dirichlet") << 1 << "dirichlet";
        QTest::newRow("plane") << 2 << "periodic";
    }
    void statesOnOtherMeshesHaveTheSameValues() {
        QFETCH(int, dimension);
        QFETCH(QString, boundary);
        const auto hamiltonianOf = [&](int nx, int ny) {
            const wave::Grid grid =
                dimension == 1 ? wave::Grid{{-3, 7}, nx} : wave::Grid{{-3, 7}, nx, {1, 2}, ny};
            return Hamiltonian(grid, 1, 1,
                               wave::makePotential("free", "/potential", grid, {{"hbar", 1}, {"m", 1}}),
                               boundary == "periodic" ? WaveBasis::fourier : WaveBasis::dirichlet);
        };
        const int ny = dimension == 1 ? 1 : 12;
        const Hamiltonian whole = hamiltonianOf(24, ny);
        std::vector<Complex> c(static_cast<std::size_t>(whole.size()));
        for (std::size_t i = 0; i < c.size(); ++i) c[i] = std::polar(1.0 / (1 + i % 5), 1.7 * double(i * i));
        for (const int nx : {10, 18, 24, 36}) {
            const Hamiltonian other = hamiltonianOf(nx, dimension == 1 ? 1 : 8);
            const std::vector<Complex> own = WaveResampling(whole, other)(c.data());
            std::vector<Complex> values(own.size());
            other.toNodes(own.data(), values.data());
            // By the sum over the basis of the first, on a mesh that has the nodes of both.
            const Hamiltonian both = hamiltonianOf(24 * nx, dimension == 1 ? 1 : 24);
            const std::vector<Complex> fine = WaveResampling(whole, both)(c.data());
            if (boundary == "periodic") {
                std::vector<Complex> all(fine.size());
                both.toNodes(fine.data(), all.data());
                double most = 0;
                for (int j = 0; j < other.grid().ny; ++j)
                    for (int i = 0; i < nx; ++i) {
                        const int at = 24 * i + (dimension == 1 ? 0 : 3 * j) * 24 * nx;
                        most = std::max(most, std::abs(values[static_cast<std::size_t>(i + j * nx)] -
                                                       all[static_cast<std::size_t>(at)]));
                    }
                qInfo("%d modes: %.1e", nx, most);
                QVERIFY(most < 1e-13);  // measured: 4e-15
            } else if (nx >= 24) {
                // There and back nothing is lost.
                const std::vector<Complex> back = WaveResampling(other, whole)(own.data());
                double most = 0;
                for (std::size_t i = 0; i < c.size(); ++i) most = std::max(most, std::abs(back[i] - c[i]));
                qInfo("%d modes: %.1e", nx, most);
                QVERIFY(most < 1e-11);
            }
        }
    }
    void modesThatCannotBeNameTheirKey() {
        const auto problemsOf = [](const std::string& text) {
            std::vector<std::string> all;
            for (const Problem& p : readScene(text).errors) all.push_back(p.pointer);
            return all;
        };
        const std::vector<std::string> modes{"/schemes/0/space/modes"};
        QCOMPARE(problemsOf(coherentState("33")), modes);
        QCOMPARE(problemsOf(coherentState("4")), modes);
        // Which modes an eigenstate is one of matters; and its phase is no property of the function.
        QCOMPARE(problemsOf(coherentState("32", R"("eigenstate","n":2)")), modes);
    }
    void searchesFindTheModesThatAreEnough() {
        const Sweep sweep = searched(sceneOf("coherent-state"), 1e-6);
        for (const SweepRow& row : sweep.rows()) {
            if (!row.result.isDone()) continue;  // Crank-Nicolson costs a hundred times the cheapest
            const ResolvedScheme found = schemeAt(sweep.scene(), row.point.scheme, row.result);
            QVERIFY(row.result.reduction.smaller > 0);
            const int modes = found.discretization.space.integer("modes");
            qInfo("%s: %d modes, %lld steps, error %.2e", found.spec.label.c_str(), modes, row.result.steps,
                  row.result.error);
            // 48 modes err by 1.1e-5.
            QVERIFY(modes > 48 && modes <= 64 && row.result.error <= 1e-6);
        }
    }
    void harmonicsAreLeftOut() {
        const char* const text = R"({"extremal":1,"model":{"type":"spring-pendulum","k":1e6},
            "initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":10},
            "schemes":[{"label":"R3","step":0.1,"scheme":"multiscale-r3"}]})";
        const Sweep sweep = searched(*readScene(std::string_view(text)).resolved, 1e-4);
        const SweepRow& row = sweep.rows().front();
        QVERIFY(row.result.isDone() && row.result.reduction.smaller > 0);
        const std::string kept =
            textOfSmaller(sweep.scene().schemes.front(), row.result.reduction, sweep.scene());
        qInfo("%s; %lld evaluations in place of %g", kept.c_str(), row.result.cost.evaluations,
              row.result.unreducedWork);
        QVERIFY(static_cast<double>(row.result.cost.evaluations) < 0.8 * row.result.unreducedWork);
        QVERIFY(kept.find("harmonics of degrees") != std::string::npos);
        // It can be run as it was found.
        const ResolvedScheme again = schemeAt(sweep.scene(), 0, row.result);
        const auto& harmonics = again.discretization.space.find("harmonics")->asArray();
        QVERIFY(harmonics.size() < 3 || harmonics[0].asNumber() < 4 ||
                again.discretization.space.integer("degree") < 8);
    }
    void movingNodesAreLeftOut() {
        const ResolvedScene scene = sceneOf("kink-moving-mesh");
        for (const ResolvedScheme& scheme : scene.schemes) {
            if (scheme.discretization.space.type != "moving-mesh") continue;
            const auto all = smallerReductionsOf(scheme, {}, scene);
            QVERIFY(all.size() >= 4);
            for (std::size_t i = 1; i < all.size(); ++i) QVERIFY(all[i].share < all[i - 1].share);
            const ResolvedScheme fewest = reduced(scheme, all.back().reduction, scene);
            QCOMPARE(textOfSmaller(scheme, all.back().reduction, scene),
                     std::to_string(fewest.discretization.space.integer("nodes")) + " moving nodes");
            QVERIFY(fewest.ownInitial.x.size() < scheme.ownInitial.x.size());
        }
    }
    void knobsAreNamed() {
        for (const char* name : {"modes", "harmonics", "mesh-nodes"}) QVERIFY(parseKnobs(name).isSmaller);
        QVERIFY(!parseKnobs("step,degree").isSmaller && parseKnobs("").isSmaller);
        QCOMPARE(parseKnobs(textOf(SearchKnobs{})), SearchKnobs{});
        QVERIFY_EXCEPTION_THROWN(parseKnobs("mode"), InvalidScene);
    }
    void theLogHasTheSmallerSpace() {
        SweepOptions options;
        options.repeat = 0;
        options.wantedError = 1e-4;
        options.only = {"Gauss 16"};
        Sweep sweep(sceneOf("coherent-state"), options), again(sceneOf("coherent-state"), options);
        std::vector<std::string> lines;
        runLines(sweep, [&](const std::string& line) { lines.push_back(line); }, {});
        for (const std::string& line : lines) (void)takeLine(line, again);
        QVERIFY(sweep.rows().front().result.reduction.smaller > 0);
        QCOMPARE(again.rows().front().result.reduction.smaller,
                 sweep.rows().front().result.reduction.smaller);
        QVERIFY(again.rows().front().result.tried == sweep.rows().front().result.tried);
    }
    void thePlaneOfStepsAndElementsIsDrawn() {
        ResolvedScene kink = sceneOf("sine-gordon-kink");
        SweepOptions options;
        options.repeat = 0;
        options.wantedError = 1e-3;
        options.only = {"degree 2"};
        Sweep sweep(std::move(kink), options);
        sweep.run({}, {}, {});
        const std::vector<Figure> figures = studyFigures("cheapest", sweep);
        QCOMPARE(figures.size(), std::size_t(2));
        const Figure& plane = figures[1];
        QCOMPARE(plane.view, "two-knobs");
        QVERIFY(plane.x.isLog && plane.y.isLog);
        const SweepRow& row = sweep.rows().front();
        QVERIFY(row.result.tried.size() >= 3);
        QCOMPARE(plane.series().front().x.size(), row.result.tried.size());
        // What was found is near the line of the wish, and on that of its cost.
        const auto distance = [&](const Guide& line) {
            double least = HUGE_VAL;
            for (std::size_t i = 0; i < line.x.size(); ++i)
                if (std::isfinite(line.x[i]))
                    least = std::min(least, std::abs(std::log(line.x[i] / double(row.result.steps))) +
                                                std::abs(std::log(line.y[i] / row.result.reduction.cells)));
            return least;
        };
        int seen = 0;
        for (const Guide& line : plane.all<Guide>()) {
            if (line.isStrong || line.isBroad) ++seen;
            if (line.isStrong) qInfo("to the wish: %.3f", distance(line));
            if (line.isStrong) QVERIFY(distance(line) < 0.2);
            if (line.isBroad) QVERIFY(distance(line) < 0.05);
        }
        QCOMPARE(seen, 2);
        const auto labels = plane.all<Label>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const Label& l) { return l.text.starts_with("wish"); }));
    }
    void theTermsOfAFormulaAreDrawn() {
        const char* const text = R"({"extremal":1,"model":{"type":"lagrangian","coordinates":["x"],
            "lagrangian":{"kinetic":"x_t^2/2","spring":"-x^2/2","cubic":"1e-4*x^3","quartic":"1e-7*x^4"}},
            "initial":{"q":[1],"v":[0]},"time":{"end":10},"schemes":[{"scheme":"midpoint","step":0.1}]})";
        SweepOptions options;
        options.repeat = 0;
        options.rungs = {1e-2, 1e-4};
        Sweep sweep(*readScene(std::string_view(text)).resolved, options);
        sweep.run({}, {}, {});
        QCOMPARE(sweep.terms().size(), std::size_t(4));
        const std::vector<Figure> figures = studyFigures("needs", sweep);
        QCOMPARE(figures.size(), std::size_t(2));
        const Figure& terms = figures[1];
        QCOMPARE(terms.view, "needs-terms");
        QCOMPARE(terms.y.ticks.front().second, std::string("quartic"));
        int bars = 0;
        for (const Guide& guide : terms.all<Guide>()) bars += guide.isBroad;
        QCOMPARE(bars, 4);
        QVERIFY(terms.series().front().x.size() >= 2);
        QVERIFY(terms.message.empty());
    }
};

EXTREMAL_TEST(SmallerSpacesTest)

}  // namespace extremal::smaller_spaces_test

#include "smaller_spaces_test.moc"
