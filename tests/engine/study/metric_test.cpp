// SPDX-License-Identifier: GPL-3.0-or-later
/// What a study measures: columns by their names, over scales, in sums; and joint wishes.
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::metric_test {
namespace {

ResolvedScene springPendulum() {
    return *readScene(std::string(R"({"extremal":1,"model":{"type":"spring-pendulum","k":100},
        "initial":{"q":[0.1,1],"p":[0,0]},"time":{"end":2},"observe":["error","energy","momentum"],
        "schemes":[{"label":"G","step":0.05,"scheme":"galerkin-gauss-2"}]})"))
                .resolved;
}
ResolvedScene kepler(const std::string& schemes = R"({"label":"G","step":0.1,"scheme":"galerkin-gauss-2"})") {
    return *readScene(std::string(R"({"extremal":1,"model":{"type":"kepler"},
        "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":3},"observe":["error","energy"],"schemes":[)") +
                      schemes + "]}")
                .resolved;
}

double measured(const ResolvedScene& scene, const std::string& metric, bool isAtEnd = false) {
    SweepOptions options;
    options.metric = metric;
    options.isAtEnd = isAtEnd;
    options.repeat = 0;
    options.ladder.steps = {0.05};
    Sweep sweep(scene, options);
    sweep.run({}, {}, {});
    return sweep.rows().front().result.error;
}

/// The columns of a run of the same scheme with the same step.
class Columns {
public:
    explicit Columns(ResolvedScene scene) {
        Scene changed = scene.scene;
        changed.schemes.front().step = {0.05, {}};
        Run run(resolve(changed));
        run.start();
        run.wait();
        result_ = run.latest().schemes.front();
    }
    double largest(const std::string& column) const {
        double most = 0;
        for (const double v : result_->trajectory[column]) most = std::max(most, std::abs(v));
        return most;
    }
    double last(const std::string& column) const { return std::abs(result_->trajectory[column].back()); }
    std::size_t rows() const { return result_->trajectory.rows(); }
    double at(const std::string& column, std::size_t row) const { return result_->trajectory[column][row]; }

private:
    std::shared_ptr<const SchemeResult> result_;
};

bool isClose(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

class MetricTest : public QObject {
    Q_OBJECT
private slots:
    /// The number is that of the column which a run of the scene writes.
    void aColumnIsThatOfARun() {
        const Columns run(springPendulum());
        for (const char* column : {"error.theta", "error.a", "energy_error"})
            QVERIFY2(isClose(measured(springPendulum(), column), run.largest(column)), column);
        QVERIFY(isClose(measured(springPendulum(), "error.theta", true), run.last("error.theta")));
        for (const char* column : {"q.theta", "p.a", "energy", "error"})
            QVERIFY2(
                isClose(measured(springPendulum(), std::string("column:") + column), run.largest(column)),
                column);
        QVERIFY(isClose(measured(springPendulum(), "energy"), run.largest("energy_error")));
        QVERIFY(isClose(measured(springPendulum(), "2*error.a"), 2 * run.largest("error.a")));
        QVERIFY(isClose(measured(springPendulum(), "error.a / 4"), run.largest("error.a") / 4));
    }
    /// Lengths and angles are not added: each over its own size, of which an angle has 1 rad.
    void anErrorInSeveralUnitsIsRelative() {
        const Columns run(springPendulum());
        double own = 0;
        for (std::size_t i = 0; i < run.rows(); ++i) own = std::max(own, std::abs(run.at("q.a", i)));
        double most = 0;
        for (std::size_t i = 0; i < run.rows(); ++i)
            most = std::max(
                most, std::hypot(run.at("error.a", i) / own, run.at("error.theta", i)) / std::sqrt(2.0));
        const double found = measured(springPendulum(), "error");
        qInfo("%g, from the rows of a run %g", found, most);
        QVERIFY(std::abs(found / most - 1) < 0.02);  // the size is taken at 1001 places, not at the rows
        QVERIFY(isClose(found, measured(springPendulum(), "rms(error.a/own, error.theta/own)")));
        QVERIFY(std::abs(measured(springPendulum(), "error.a/own") * own / run.largest("error.a") - 1) <
                0.02);
        // In one unit it is the distance that runs write.
        const Columns inOneUnit(kepler());
        QVERIFY(isClose(measured(kepler(), "error"), inOneUnit.largest("error")));
        QVERIFY(isClose(measured(kepler(), "rms(error.x, error.y)") * std::sqrt(2.0),
                        inOneUnit.largest("error")));
    }
    void whatCannotBeMeasuredSaysSo() {
        const ResolvedScene scene = springPendulum();
        const auto problem = [&](const std::string& metric) {
            try {
                (void)metricOf(metric, false, *scene.system, scene.initial);
            } catch (const InvalidScene& e) {
                const Problem& first = e.problems().front();
                return QString::fromStdString(first.pointer + ": " + first.message + " (" + first.hint + ")");
            }
            return QString();
        };
        QVERIFY2(problem("error.thet").contains("error.theta"), qPrintable(problem("error.thet")));
        QVERIFY(problem("column:q.x").contains("no column \"q.x\""));
        QVERIFY(problem("rms(error.a, error.theta)").contains("cannot be added"));
        QVERIFY(problem("rms(error.a/own, error.theta)").contains("cannot be added"));
        QCOMPARE(problem("rms(error.a/0.1, error.theta/own)"), QString());
        QVERIFY(problem("error.a/x").contains("own"));
        QVERIFY(problem("-1*error.a").contains("weight"));
        QCOMPARE(pointerOf([&] {
                     const ResolvedScene planet = kepler();
                     (void)metricOf("momentum/own", false, *planet.system, planet.initial);
                 }),
                 "--metric");  // of what is conserved no size is known
        QVERIFY(problem("rms()").startsWith("--metric"));
    }
    /// Each wish holds at what is found, and costs more than either alone.
    void jointWishesAllHold() {
        const auto found = [&](double error, std::vector<Wish> wishes) {
            SweepOptions options;
            options.wantedError = error;
            options.wishes = std::move(wishes);
            options.repeat = 0;
            options.metric = error > 0 ? "error" : "energy";
            Sweep sweep(kepler(), options);
            sweep.run({}, {}, {});
            return sweep.rows().front().result;
        };
        const PointResult one = found(1e-2, {}), both = found(1e-2, {{"energy", 1e-9}});
        QVERIFY(one.isDone() && both.isDone());
        QCOMPARE(both.errors.size(), 2UL);
        QVERIFY(both.errors[0] <= 1e-2 && both.errors[1] <= 1e-9 && both.errors[1] > 1e-11);
        QVERIFY(both.steps > 2 * one.steps);
        QVERIFY(std::abs(both.excess - std::log(both.errors[1] / 1e-9)) < 1e-9);
    }
};

EXTREMAL_TEST(MetricTest)
}  // namespace extremal::metric_test
#include "metric_test.moc"
