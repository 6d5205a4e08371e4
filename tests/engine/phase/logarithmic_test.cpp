// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that follow the potential, explicitly: orbits of Kepler with an error of the time alone, orders, the
/// form, the way back, formulas and compiled models alike, and refusals.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/phase/monitored.hpp"
#include "engine/run/run.hpp"
#include "engine/step/partitioned.hpp"
#include "engine/core/text/text.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/quoted.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::logarithmic_test {
namespace {

using tests::quoted;
using Vector = std::vector<double>;

std::string lagrangian(const std::string& L) {
    return quoted(
        "{'type': 'lagrangian', 'coordinates': ['x', 'y'], 'parameters': {'m': 1.5}, 'lagrangian': '" + L +
        "'}");
}
std::string hamiltonian(const std::string& H) {
    return quoted("{'type': 'hamiltonian', 'coordinates': ['x', 'y'], 'parameters': {}, 'hamiltonian': '" +
                  H + "'}");
}
const std::string kepler = quoted("{'type': 'kepler'}"),
                  typedKepler = lagrangian("(x_t^2+y_t^2)/2 + 1/sqrt(x^2+y^2)"),
                  keplersHamiltonian = hamiltonian("(p_x^2+p_y^2)/2 - 1/sqrt(x^2+y^2)"),
                  oblate = lagrangian(
                      "(x_t^2+m*y_t^2)/2 + 1/sqrt(x^2+y^2) + "
                      "0.01*(x^2-2*y^2)/sqrt(x^2+y^2)^5");

/// From the pericentre of an orbit of this eccentricity.
ReadScene sceneOf(const std::string& model, double e, const std::string& scheme, double step, double end) {
    return readScene("{\"extremal\": 1, \"model\": " + model + ", \"initial\": {\"q\": [" +
                     formatNumber(1 - e) + ", 0], \"p\": [0, " + formatNumber(std::sqrt((1 + e) / (1 - e))) +
                     "]}, \"reference\": \"none\", \"observe\": [\"energy\", \"reversibility\"], \"time\": "
                     "{\"end\": " +
                     formatNumber(end) + "}, \"schemes\": [{" + scheme + ", \"step\": " + formatNumber(step) +
                     "}]}");
}
std::string following(const std::string& scheme, const std::string& more = "") {
    return scheme + quoted(", 'monitor': {'type': 'logarithmic'" + more + "}");
}
std::string knots(const std::string& id, const std::string& first = "") {
    return quoted("'space': {'type': 'free-motion', 'knots': '" + id +
                  (first.empty() ? "'}" : "', 'first': '" + first + "'}"));
}

}  // namespace

class LogarithmicTest : public QObject {
    Q_OBJECT private slots : void keplersOrbitsAreExact_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("knots");
        QTest::addColumn<double>("e");
        for (const double e : {0.3, 0.9, 0.99})
            for (const char* id : {"strang", "suzuki-4", "kahan-li-6", "kahan-li-8"}) {
                QTest::addRow("%s, e=%g", id, e) << QString::fromStdString(kepler) << id << e;
                QTest::addRow("typed, %s, e=%g", id, e) << QString::fromStdString(typedKepler) << id << e;
            }
    }
    /// Energy, angular momentum and the Laplace vector, with steps that are far from small (Mikkola and
    /// Tanikawa 1999; Preto and Tremaine 1999): of a drift, a kick and a drift, and of what is composed of
    /// such steps. With a kick first, and of other tables, it is not so.
    void keplersOrbitsAreExact() {
        QFETCH(QString, model);
        QFETCH(QString, knots);
        QFETCH(double, e);
        const std::string scheme = logarithmic_test::knots(knots.toStdString(), "drift");
        const double first = 0.2 * std::pow(1 - e, 1.5), end = 30;
        const ReadScene read = sceneOf(model.toStdString(), e, following(scheme), first, end);
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        double off = 0;
        int steps = 0;
        for (; s.t < end && steps < 100000; ++steps) {
            QCOMPARE(integrator->advance(s, end).outcome, Outcome::converged);
            const double x = s.x[0], y = s.x[1], u = s.x[2], v = s.x[3], r = std::hypot(x, y),
                         L = x * v - y * u;
            off = std::max({off, std::abs((u * u + v * v) / 2 - 1 / r + 0.5), std::abs(v * L - x / r - e),
                            std::abs(u * L + y / r), std::abs(L - std::sqrt(1 - e * e))});
        }
        qInfo("%d steps: %.1e", steps, off);
        QVERIFY(steps < 5000);
        QVERIFY(off < 1e-14 * steps / (1 - e));
    }
    void otherOrbitsAreNotExact() {
        for (const std::string& scheme : {knots("strang", "kick"), knots("blanes-moan-s10", "drift")}) {
            const State s =
                tests::stateAfter(sceneOf(kepler, 0.6, following(scheme), 0.05, 1e5), 100).value();
            const double energy = (s.x[2] * s.x[2] + s.x[3] * s.x[3]) / 2 - 1 / std::hypot(s.x[0], s.x[1]);
            qInfo("%.1e", energy + 0.5);
            QVERIFY(std::abs(energy + 0.5) > 1e-11);
        }
    }
    void orders_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("step");
        const auto row = [](const std::string& scheme, int order, double step) {
            QTest::newRow(scheme.c_str()) << QString::fromStdString(scheme) << order << step;
        };
        row(knots("strang"), 2, 0.004);
        row(knots("suzuki-4"), 4, 0.01);
        row(knots("blanes-moan-s6"), 4, 0.02);
        row(knots("blanes-moan-s10"), 6, 0.04);
        row(knots("kahan-li-6"), 6, 0.03);
        row(knots("kahan-li-8"), 8, 0.05);
        row(quoted("'baseline': 'stormer-verlet'"), 2, 0.004);
        row(quoted("'scheme': 'free-motion-1', 'composition': {'type': 'kahan-li', 'order': 6}"), 6, 0.04);
        // K is a Hamiltonian as any other for implicit ones.
        row(quoted("'scheme': 'galerkin-gauss-2'"), 4, 0.02);
        row(quoted("'scheme': 'galerkin-gauss-3'"), 6, 0.04);
    }
    /// In the oblate field, where orbits are not those of Kepler, q and p against steps of order 12 to the
    /// same time.
    void orders() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(double, step);
        Vector errors;
        for (const int n : {100, 200}) {
            const double h = step * 100 / n;
            const ReadScene read = sceneOf(oblate, 0.5, following(scheme.toStdString()), h, 1e5);
            const State s = tests::stateAfter(read, n).value();
            const Vector exact = tests::after(
                sceneOf(oblate, 0.5, quoted("'scheme': 'galerkin-gauss-6'"), s.t / 2000, 1e5), 2000);
            errors.push_back(tests::apart({s.x[0], s.x[1]}, {exact[0], exact[1]}));
            errors.push_back(tests::apart({s.x[2], s.x[3]}, {exact[2], exact[3]}));
        }
        for (std::size_t k = 0; k < 2; ++k) {
            const double found = std::log2(errors[k] / errors[2 + k]);
            qInfo("%s: %.1e, %.1e, order %.2f", k == 0 ? "q" : "p", errors[k], errors[2 + k], found);
            QVERIFY(std::abs(found - order) < 0.4);
        }
    }
    /// Of a formula, of a compiled model and of a Hamiltonian; with a longest step as well.
    void modelsMakeTheSameSteps() {
        for (const char* more : {"", ", 'max': 0.3"}) {
            const std::string scheme = following(knots("blanes-moan-s10"), more);
            const State one = tests::stateAfter(sceneOf(kepler, 0.7, scheme, 0.02, 1e5), 200).value();
            for (const std::string& model : {typedKepler, keplersHamiltonian}) {
                const State other = tests::stateAfter(sceneOf(model, 0.7, scheme, 0.02, 1e5), 200).value();
                QVERIFY(std::abs(one.t - other.t) < 1e-12);
                QVERIFY(tests::apart(one.x, other.x) < 1e-11);
            }
        }
    }
    /// K and its derivatives by differences, and its halves.
    void derivatives() {
        for (const char* more : {"", ", 'max': 0.3"})
            for (const std::string& model : {kepler, oblate}) {
                const ReadScene read = sceneOf(model, 0.5, following(knots("strang"), more), 0.02, 10);
                const ResolvedScene& r = *read.resolved;
                const MonitoredProblem problem =
                    monitoredProblem(*r.system, read.scene.schemes[0].monitor, r.initial, 0.02);
                const PhaseMechanics& K = problem.system.part<PhaseMechanics>();
                const void* const m = K.model.get();
                Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(problem.start.x.data(), 6), g(6), up(6),
                                down(6), f(3), v(3);
                QVERIFY(std::abs(K.energy(m, 0, x.data(), x.data() + 3)) < 1e-15);
                x << 0.2, 0.6, 0.3, x(3), 0.2, 1.4;
                Eigen::MatrixXd h(6, 6);
                K.gradient(m, 0, x.data(), x.data() + 3, g.data());
                K.hessian(m, 0, x.data(), x.data() + 3, h.data());
                for (Eigen::Index k = 0; k < 6; ++k) {
                    const double at = x(k), step = 1e-5;
                    x(k) = at + step;
                    const double above = K.energy(m, 0, x.data(), x.data() + 3);
                    K.gradient(m, 0, x.data(), x.data() + 3, up.data());
                    x(k) = at - step;
                    const double below = K.energy(m, 0, x.data(), x.data() + 3);
                    K.gradient(m, 0, x.data(), x.data() + 3, down.data());
                    x(k) = at;
                    QVERIFY(std::abs((above - below) / (2 * step) - g(k)) < 1e-8);
                    QVERIFY(((up - down) / (2 * step) - h.col(k)).cwiseAbs().maxCoeff() < 1e-7);
                }
                K.force(m, 0, x.data(), f.data());
                K.velocity(m, 0, x.data() + 3, v.data());
                QVERIFY(f == -g.head(3) && v == g.tail(3));
                // g is its rate of the time where K = 0.
                x(3) = -problem.energy.energy(problem.energy.model.get(), 0, x.data() + 1, x.data() + 4);
                K.velocity(m, 0, x.data() + 3, v.data());
                QVERIFY(std::abs(v(0) / (*problem.monitor)(x.data() + 1, x.data() + 4) - 1) < 1e-14);
            }
    }
    /// Kicks and drifts in turn by one call of K, and by a call for each.
    void oneCallHasTheBitsOfMany() {
        for (const std::string& model : {kepler, oblate})
            for (const Splitting& splitting : {strang(), blanesMoanS10(), srkn14a()}) {
                const ReadScene read = sceneOf(model, 0.5, following(knots("strang")), 0.02, 10);
                const ResolvedScene& r = *read.resolved;
                const MonitoredProblem problem =
                    monitoredProblem(*r.system, read.scene.schemes[0].monitor, r.initial, 0.02);
                PhaseMechanics K = problem.system.part<PhaseMechanics>();
                const auto stages = partitionedStages(splitting, true);
                const auto byOne = makePartitioned(flowOf(K), 0.05, stages);
                QVERIFY(K.kicksAndDrifts);
                K.kicksAndDrifts = nullptr;
                const auto byMany = makePartitioned(flowOf(K), 0.05, stages);
                QVERIFY(tests::areAlike(*byOne, *byMany, problem.start, 0.05, 20));
            }
    }
    /// In (t, q; -E, p), by the scheme.
    void theFormIsKept() {
        const ReadScene read = sceneOf(oblate, 0.6, following(knots("blanes-moan-s6")), 0.05, 10);
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        for (int k = 0; k < 20; ++k) {
            QCOMPARE(integrator->advance(s, 10).outcome, Outcome::converged);
            const auto M = tangentMap(*integrator);
            QVERIFY(M && M->rows() == 6);
            const double off = canonicalDefect(*M);
            QVERIFY2(off < 1e-13 * std::pow(M->cwiseAbs().maxCoeff(), 2), qPrintable(QString::number(off)));
        }
    }
    void thereAndBack() {
        const ReadScene read = sceneOf(oblate, 0.6, following(knots("blanes-moan-s10")), 0.05, 20);
        const auto result = run(read.scene).schemes.front();
        QCOMPARE(result->summary.status, RunStatus::done);
        double most = 0;
        for (const double each : result->trajectory["reversibility"])
            most = std::max(most, std::isnan(each) ? 1 : each);
        qInfo("%.1e", most);
        QVERIFY(most < 1e-11);
    }
    /// One force a kick.
    void stepsAreExplicit() {
        const ReadScene read = sceneOf(oblate, 0.6, following(knots("blanes-moan-s10")), 0.05, 20);
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        for (int k = 0; k < 5; ++k) {
            const StepReport report = integrator->advance(s, 20);
            QVERIFY(report.cost.evaluations <= 11 && report.cost.iterations == 0);
        }
    }
    void theFirstAndTheLongestStepAreThoseAskedFor() {
        const ReadScene read =
            sceneOf(kepler, 0.9, following(knots("blanes-moan-s10"), ", 'max': 0.02"), 0.003, 20);
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        double longest = 0, first = 0;
        while (s.t < 20) {
            const StepReport report = integrator->advance(s, 20);
            QCOMPARE(report.outcome, Outcome::converged);
            if (first == 0) first = report.step;
            longest = std::max(longest, report.step);
        }
        QVERIFY2(std::abs(first / .003 - 1) < .1, qPrintable(QString::number(first)));
        QVERIFY2(longest < .02 && longest > .014, qPrintable(QString::number(longest)));
    }
    void refusals() {
        const auto refused = [](const std::string& model, const std::string& scheme) {
            const ReadScene read = sceneOf(model, 0.5, scheme, 0.05, 10);
            return read.errors.empty() ? Problem{} : read.errors[0];
        };
        const std::string place = "/schemes/0/monitor";
        const std::string mixed = hamiltonian("(p_x^2+p_y^2)*(1+x^2)/2 - 1/sqrt(x^2+y^2)"),
                          trough = lagrangian("(x_t^2+y_t^2)/2 - x^2 - y^2");
        QCOMPARE(tests::unlike(refused(mixed, following(quoted("'scheme': 'midpoint'"))), place.c_str(),
                               "constant masses", "auto"),
                 QString());
        // V = 1/4 at the start, x = 1/2.
        QCOMPARE(tests::unlike(refused(trough, following(knots("strang"))), place.c_str(),
                               "is -4 at the start", ""),
                 QString());
        // Another monitor is not explicit, and these knots are for another kinetic energy.
        QCOMPARE(
            tests::unlike(refused(kepler, knots("strang") + quoted(", 'monitor': 'auto'")), place.c_str(),
                          "a function of the momenta and one of the places", "logarithmic"),
            QString());
        QCOMPARE(tests::unlike(
                     refused(kepler, following(knots("srkn-14a"))), "/schemes/0/space/knots",
                     "with the energy of the monitor: srkn-14a has its order for kinetic energies p^2/(2m)",
                     "blanes-moan-s10"),
                 QString());
    }
};

EXTREMAL_TEST(LogarithmicTest)
}  // namespace extremal::logarithmic_test
#include "logarithmic_test.moc"
