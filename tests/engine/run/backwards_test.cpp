// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs backwards in time, and the way back of a run forwards.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::backwards_test {
namespace {

std::string scene(const std::string& time, const std::string& schemes, const std::string& rest,
                  const std::string& initial = R"({"q":[0.4,0],"p":[0,2]})",
                  const std::string& model = R"({"type":"kepler"})") {
    return R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial + R"(,"time":)" + time +
           R"(,"schemes":)" + schemes + "," + rest + "}";
}
const std::string gauss = R"([{"label":"g","scheme":"galerkin-gauss-4","step":0.05}])",
                  energy = R"("observe":["energy"],"reference":"none")";

Comparison ran(const std::string& text) {
    const ReadScene read = readScene(text);
    if (!read.errors.empty()) qFatal("%s", read.errors.front().message.c_str());
    return run(read.scene);
}
std::string list(const Trajectory& rows, std::size_t row) {
    const auto at = [&](const char* name) { return formatNumber(rows[name][row]); };
    return R"({"q":[)" + at("q.x") + "," + at("q.y") + R"(],"p":[)" + at("p.x") + "," + at("p.y") + "]}";
}
/// One coordinate with a force that depends on time, and the state of its last row.
const std::string forced = R"({"type":"lagrangian","coordinates":["x"],
    "lagrangian":"x_t^2/2 - x^4/4 + x*sin(t) "})";
std::string endOf(const Trajectory& rows) {
    return R"({"q":[)" + formatNumber(rows["q.x"].back()) + R"(],"p":[)" + formatNumber(rows["p.x"].back()) +
           "]}";
}
std::string stepping(const std::string& scheme, double h) {
    return "{" + scheme + ",\"step\":" + formatNumber(h) + "}";
}
double column(const SchemeResult& s, const char* name) {
    double largest = 0;
    for (const double v : s.trajectory[name])
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    return largest;
}

}  // namespace

class BackwardsTest : public QObject {
    Q_OBJECT
private slots:
    void aRunFromTheEndReturnsToTheStart() {
        const Comparison there = ran(scene(R"({"end":20})", gauss, energy));
        const Trajectory& rows = there.schemes[0]->trajectory;
        const Comparison back =
            ran(scene(R"({"start":20,"end":0})", gauss, energy, list(rows, rows.rows() - 1)));
        const SchemeResult& s = *back.schemes[0];
        QCOMPARE(s.summary.status, RunStatus::done);
        QCOMPARE(s.summary.steps, 400);
        QCOMPARE(s.summary.tEnd, 0.0);
        QCOMPARE(s.fraction, 1.0);
        QCOMPARE(s.trajectory.rows(), rows.rows());
        // Rows are in the order of time, as are those of a run forwards.
        double worst = 0;
        for (std::size_t r = 0; r < rows.rows(); ++r) {
            QVERIFY(std::abs(s.trajectory["t"][r] - rows["t"][r]) < 1e-12);
            for (const char* name : {"q.x", "q.y", "p.x", "p.y"})
                worst = std::max(worst, std::abs(s.trajectory[name][r] - rows[name][r]));
        }
        qInfo("rows differ by %.1e", worst);
        QVERIFY(worst < 1e-11);
        // The file begins where the run begins.
        const std::string csv = csvText(s.trajectory);
        QVERIFY(csv.find("\n20,") < csv.find("\n19.95,") && csv.ends_with("\n"));
        QVERIFY(csv.find("\n20,") == csv.find('\n'));
    }
    void theErrorIsThatAgainstTheExactSolution() {
        const Comparison back = ran(scene(R"({"start":3,"end":-7})", gauss, R"("observe":["error"])"));
        QCOMPARE(back.reference.type, std::string("exact"));
        const double error = back.schemes[0]->summary.maxError;
        qInfo("error %.1e", error);
        QVERIFY(error > 1e-12 && error < 1e-6);
        const Comparison there = ran(scene(R"({"start":3,"end":13})", gauss, R"("observe":["error"])"));
        // The orbit is symmetric about its perihelion, where both begin.
        QVERIFY(std::abs(there.schemes[0]->summary.maxError / error - 1) < 1e-3);
    }
    void rowsAtTimesOfTheirOwn() {
        const Comparison back =
            ran(scene(R"({"start":5,"end":0})", gauss, energy + R"(,"output":{"every":0.7,"dense":true})"));
        const auto t = back.schemes[0]->trajectory["t"];
        QCOMPARE(t.size(), std::size_t(9));  // 5, 4.3, .., 0.1, and the end
        QVERIFY(std::abs(t[8] - 5) < 1e-12 && std::abs(t[7] - 4.3) < 1e-12 && std::abs(t[1] - 0.1) < 1e-12 &&
                t[0] == 0);
        QVERIFY(column(*back.schemes[0], "energy_error") < 1e-6);
        const Comparison nodes =
            ran(scene(R"({"start":5,"end":0})", gauss, energy + R"(,"output":{"every":1})"));
        QCOMPARE(nodes.schemes[0]->trajectory.rows(), std::size_t(6));
    }
    void fieldsHaveTheirFrames() {
        const Comparison back =
            ran(scene(R"({"start":5,"end":-5})", R"([{"scheme":"multisymplectic-1","step":0.1}])",
                      R"("observe":["error"],"views":["carpet"])", R"({"profile":"breather","omega":0.9})",
                      R"({"type":"field","potential":"sine-gordon","domain":[-20,20],
                                              "boundary":"periodic","cells":80})"));
        const FieldFrames* const frames = back.schemes[0]->products.find<FieldFrames>();
        QVERIFY(frames && frames->all.size() == 101);
        QVERIFY(std::is_sorted(frames->all.begin(), frames->all.end(),
                               [](const Frame& a, const Frame& b) { return a.t < b.t; }));
        QVERIFY(back.schemes[0]->summary.maxError < 0.05);
    }
    void timeAxesGoForwards() {
        const Comparison back =
            ran(scene(R"({"start":5,"end":0})", gauss, energy + R"(,"views":["energy"])"));
        const Figure figure = makeFigure(back, {"energy", "", ""});
        QVERIFY(figure.x.range && figure.x.range->first == 0 && figure.x.range->second == 5);
        QVERIFY(figure.message.empty());
        const auto& x = figure.series().front().x;
        QVERIFY(std::is_sorted(x.begin(), x.end()));
    }
    void forcesThatDependOnTimeAreThoseOfTheirTime() {
        const Comparison there =
            ran(scene(R"({"end":10})", gauss, R"("reference":"none")", R"({"q":[1],"p":[0]})", forced));
        const Comparison back = ran(scene(R"({"start":10,"end":0})", gauss, R"("reference":"none")",
                                          endOf(there.schemes[0]->trajectory), forced));
        QVERIFY(std::abs(back.schemes[0]->trajectory["q.x"][0] - 1) < 1e-12);
        QVERIFY(std::abs(back.schemes[0]->trajectory["p.x"][0]) < 1e-12);
    }
    /// To the exact solution, and from there, with forces that depend on time.
    void errorControlGoesBackwardsAsWell_data() {
        QTest::addColumn<QString>("baseline");
        const System kepler = makeSystem(readScene(scene(R"({"end":1})", gauss, energy)).scene);
        for (const BaselineEntry& each : baselineCatalog())
            if (each.isAdaptive() && appliesTo(each, kepler))
                QTest::newRow(each.item.id.c_str()) << QString::fromStdString(each.item.id);
    }
    void errorControlGoesBackwardsAsWell() {
        QFETCH(QString, baseline);
        const std::string schemes = "[{\"baseline\":\"" + baseline.toStdString() + "\",\"tolerance\":1e-10}]";
        const Comparison exact =
            ran(scene(R"({"start":3,"end":-7})", schemes,
                      R"("observe":["error","energy"],"output":{"every":0.5,"dense":true})"));
        const SchemeResult& s = *exact.schemes[0];
        QCOMPARE(s.summary.status, RunStatus::done);
        QCOMPARE(s.summary.tEnd, -7.0);
        const auto t = s.trajectory["t"];
        QVERIFY(t.size() == 21 && t[0] == -7 && t[20] == 3 && std::is_sorted(t.begin(), t.end()));
        qInfo("error %.1e", s.summary.maxError);
        QVERIFY(s.summary.maxError > 0 && s.summary.maxError < 2e-6);

        const Comparison there =
            ran(scene(R"({"end":10})", schemes, R"("reference":"none")", R"({"q":[1],"p":[0]})", forced));
        const Trajectory& rows = there.schemes[0]->trajectory;
        QCOMPARE(rows["t"].back(), 10.0);
        const Comparison back =
            ran(scene(R"({"start":10,"end":0})", schemes, R"("reference":"none")", endOf(rows), forced));
        QCOMPARE(back.schemes[0]->trajectory["t"][0], 0.0);
        const double missed =
            std::hypot(back.schemes[0]->trajectory["q.x"][0] - 1, back.schemes[0]->trajectory["p.x"][0]);
        qInfo("%.1e from the start", missed);
        QVERIFY(missed < 1e-6);
    }
    void whatOnlyGoesForwardsSaysSo_data() {
        QTest::addColumn<QString>("schemes");
        QTest::addColumn<QString>("rest");
        QTest::addColumn<QString>("pointer");
        const QString g = QString::fromStdString(gauss);
        QTest::newRow("a transformed time") << R"([{"baseline":"time-transformed","step":0.1}])"
                                            << R"("reference":"none")"
                                            << "/schemes/0";
        QTest::newRow("steps as unknowns") << R"([{"scheme":"sem-1","step":0.1}])"
                                           << R"("reference":"none")"
                                           << "/schemes/0";
        QTest::newRow("a reference scheme")
            << g
            << R"("observe":["error"],"reference":{"type":"scheme","scheme":{"scheme":"midpoint","step":0.1}})"
            << "/reference";
    }
    void whatOnlyGoesForwardsSaysSo() {
        QFETCH(QString, schemes);
        QFETCH(QString, rest);
        QFETCH(QString, pointer);
        const ReadScene read =
            readScene(scene(R"({"start":2,"end":0})", schemes.toStdString(), rest.toStdString()));
        QVERIFY(!read.errors.empty());
        QCOMPARE(read.errors.front().pointer, pointer.toStdString());
    }

    /// 400 steps of each: what a symmetric scheme misses is round-off, RK4 misses by its error.
    void theWayBack_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<double>("h");
        QTest::addColumn<double>("symmetric");  // at most
        QTest::addColumn<double>("rk4");
        QTest::newRow("pendulum") << R"({"type":"pendulum","g":1})"
                                  << R"({"q":[2],"p":[0]})" << 0.1 << 2e-13 << 6e-5;
        QTest::newRow("Kepler") << R"({"type":"kepler"})"
                                << R"({"q":[0.4,0],"p":[0,2]})" << 0.05 << 2e-12 << 5e-2;
        QTest::newRow("double pendulum") << R"({"type":"double-pendulum"})"
                                         << R"({"q":[2,2.5],"p":[0,0]})" << 0.01 << 5e-12 << 1e-2;
    }
    void theWayBack() {
        QFETCH(QString, model);
        QFETCH(QString, initial);
        QFETCH(double, h);
        QFETCH(double, symmetric);
        QFETCH(double, rk4);
        std::string schemes = stepping(R"("baseline":"rk4")", h);
        for (const char* id : {"4", "2", "1"})
            schemes = stepping("\"scheme\":\"galerkin-gauss-" + std::string(id) + "\"", h) + "," + schemes;
        const Comparison c = ran(scene("{\"end\":" + formatNumber(400 * h) + "}", "[" + schemes + "]",
                                       R"("observe":["reversibility"],"reference":"none")",
                                       initial.toStdString(), model.toStdString()));
        for (const auto& s : c.schemes) {
            const auto off = s->trajectory["reversibility"];
            QCOMPARE(off.back(), 0.0);
            qInfo("%s: %.1e at the start, %.1e at most", s->spec.label.c_str(), off.front(),
                  s->summary.extremes.front().value);
            QVERIFY(std::all_of(off.begin(), off.end(), [](double v) { return std::isfinite(v); }));
            QCOMPARE(s->summary.extremes.front().value, column(*s, "reversibility"));
            if (s->spec.label != c.schemes.back()->spec.label)
                QVERIFY(off.front() < symmetric);
            else
                QVERIFY(off.front() > rk4 / 2 && off.front() < rk4 * 2);
        }
    }
};

EXTREMAL_TEST(BackwardsTest)
}  // namespace extremal::backwards_test

#include "backwards_test.moc"
