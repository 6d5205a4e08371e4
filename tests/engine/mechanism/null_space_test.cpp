// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of mechanisms by sweeps along what their constraints leave free: the same as by Newton's method for
/// all unknowns, without its matrix.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/integrator/variation/transposed_step.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace null_space_test {

/// Masses that are no diagonal and depend on the place, with two freedoms.
Mechanical beadOnSurface() {
    return startAt(typed({"x", "y", "z"}, "(1+x^2)*x_t^2/2 + y_t^2 + x_t*z_t/3 + (2+sin(y))*z_t^2/2 - 2*z",
                         {{"surface", "z - x^2/2 - sin(y)"}}, {{"y", "-0.2*y_t"}}),
                   {0.4, 0.3, 0}, {0.5, 1, 0});
}

struct Ended {
    State state;
    double sweeps = 0, solves = 0;  ///< of a step, on average
    double largestValue = 0, largestRate = 0;
};

Ended endOf(const Mechanical& of, const std::string& scheme, const std::string& method, double tolerance,
            double end = 2, int steps = 100) {
    Discretization d = *namedScheme(scheme);
    d.solver = {method, {}, {}};
    if (tolerance > 0) d.solver.keys.emplace_back("tolerance", tolerance);
    const auto integrator = makeIntegrator(of.system, d, {0, end / steps});
    Mechanism mechanism(of.system.parts);
    const auto& L = of.system.mechanics();
    std::vector<double> v(static_cast<std::size_t>(L.dimension));
    Ended ended{of.start};
    integrator->begin(ended.state);
    for (int i = 0; i < steps; ++i) {
        const StepReport report = advance(*integrator, ended.state);
        if (report.outcome != Outcome::converged) qFatal("a step failed");
        ended.sweeps += static_cast<double>(report.cost.iterations) / steps;
        ended.solves += static_cast<double>(report.cost.linearSolves) / steps;
        const double *q = ended.state.x.data(), *p = q + L.dimension;
        L.velocity(L.model.get(), ended.state.t, q, p, v.data());
        ended.largestValue = std::max(ended.largestValue, mechanism.largestValue(ended.state.t, q));
        ended.largestRate = std::max(ended.largestRate, mechanism.largestRate(ended.state.t, q, v.data()));
    }
    return ended;
}

class NullSpaceTest : public QObject {
    Q_OBJECT
private slots:
    void sweepsEndWhereNewtonDoes_data() {
        QTest::addColumn<int>("which");
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {"gauss-1", "gauss-2", "gauss-3", "gauss-4", "gauss-8", "gauss-12", "lobatto-2", "lobatto-4"})
            for (int which = 0; which < 5; ++which)
                QTest::addRow("%s, mechanism %d", scheme, which) << which << QString(scheme);
    }
    void sweepsEndWhereNewtonDoes() {
        QFETCH(int, which);
        QFETCH(QString, scheme);
        const Mechanical of = which == 0   ? fourBar()
                              : which == 1 ? sphericalPendulum()
                              : which == 2 ? doublePendulum()
                              : which == 3 ? chargeOnTorus()
                                           : beadOnSurface();
        const std::string name = "galerkin-" + scheme.toStdString();
        const Ended byNewton = endOf(of, name, "newton", 0);
        for (const double tolerance : {0.0, 1e-10}) {
            const Ended bySweeps = endOf(of, name, "auto", tolerance);
            const Distance apart = distance(bySweeps.state, byNewton.state);
            qInfo("to %.0e: apart %.1e, %.1e; %.2f sweeps a step, %.2f by Newton's method", tolerance,
                  apart.q, apart.p, bySweeps.sweeps, byNewton.sweeps);
            const double most = tolerance > 0 ? 1e-9 : 1e-12;
            QVERIFY(apart.q < most && apart.p < 10 * most);
            // What is known at the start of some steps takes two; to round-off many functions are left to
            // Newton's method.
            const bool isLeft = tolerance == 0 && (scheme == "gauss-8" || scheme == "gauss-12");
            QVERIFY(isLeft == (bySweeps.solves > 0.3) && byNewton.solves > 1);
            QVERIFY(tolerance > 0 || (bySweeps.largestValue < 1e-13 && bySweeps.largestRate < 2e-12));
        }
    }
    /// A rod that turns through all directions, where one coordinate and then the other is at rest.
    void otherCoordinatesTakeOver() {
        const Mechanical of =
            startAt(typed({"x", "y"}, "(x_t^2+y_t^2)/2 - y", {{"rod", "x^2+y^2-1"}}), {0, -1}, {3, 0});
        const Ended ended = endOf(of, "galerkin-gauss-4", "auto", 0, 100, 5000);
        const auto& x = ended.state.x;
        const double energy = (x[2] * x[2] + x[3] * x[3]) / 2 + x[1];
        qInfo("%.2f sweeps a step; energy %.1e from that of the start", ended.sweeps, energy - 3.5);
        QVERIFY(ended.solves < 0.01 && std::abs(energy - 3.5) < 1e-11);
        QVERIFY(ended.largestValue < 1e-14 && ended.largestRate < 1e-13);
    }
    /// A symmetry is kept to round-off for as long as by Newton's method.
    void momentaAreKept() {
        const auto drift = [](const std::string& method) {
            const Mechanical of = sphericalPendulum();
            const auto momentum = [](const State& s) { return s.x[0] * s.x[4] - s.x[1] * s.x[3]; };
            return std::abs(momentum(endOf(of, "galerkin-gauss-3", method, 0, 500, 20000).state) -
                            momentum(of.start));
        };
        const double bySweeps = drift("auto"), byNewton = drift("newton");
        qInfo("angular momentum: %.1e by sweeps, %.1e by Newton's method", bySweeps, byNewton);
        QVERIFY(bySweeps < 2e-13 && byNewton < 2e-13);
    }
    /// What a step is varied by has its multipliers, which sweeps do without.
    void tangentMapsAreThoseOfNewton() {
        for (const Mechanical& of : {fourBar(), doublePendulum(), chargeOnTorus(), beadOnSurface()}) {
            std::vector<std::vector<double>> maps;
            for (const char* method : {"auto", "newton"}) {
                Discretization d = *namedScheme("galerkin-gauss-3");
                d.solver = {method, {}, {}};
                const auto integrator = makeIntegrator(of.system, d, {0, 0.02});
                State s = of.start;
                integrator->begin(s);
                for (int i = 0; i < 20; ++i) QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
                const std::size_t size = integrator->tangentSize();
                std::vector<double> W(size * size, 0.0);
                for (std::size_t i = 0; i < size; ++i) W[i * size + i] = 1;
                std::vector<double> back = W;
                QVERIFY(integrator->applyTangent(W));
                QVERIFY(dynamic_cast<TransposedStep&>(*integrator).applyTransposed(back));
                W.insert(W.end(), back.begin(), back.end());
                maps.push_back(W);
            }
            double largest = 0;
            for (std::size_t i = 0; i < maps[0].size(); ++i)
                largest = std::max(largest, std::abs(maps[0][i] - maps[1][i]));
            QVERIFY2(largest < 1e-10, qPrintable(QString::number(largest)));
        }
    }
    /// Eliminated in formulas, coordinates depend on each other as numbers have it.
    void dependenceIsThatOfNumbers() {
        const Mechanical of = fourBar();
        const Constraint& g = *of.system.parts.find<Constraint>();
        constexpr int n = 3, d = 4, nodes = 8;
        Eigen::MatrixXd q(nodes, d), found(nodes, n * 2);
        const Eigen::VectorXd t = Eigen::VectorXd::Zero(nodes);
        for (int i = 0; i < nodes; ++i)
            for (int k = 0; k < d; ++k) q(i, k) = std::sin(1 + i + 0.7 * k) + k;
        for (const std::vector<int>& order : {std::vector<int>{0, 1, 2, 0, 2, 3, 1}, {2, 0, 1, 3, 1, 0, 2}}) {
            const Constraint::AtNodes dependence = g.dependence(g.model.get(), order);
            dependence.call(dependence.model.get(), t.data(), nodes, q.data(), found.data());
            for (int i = 0; i < nodes; ++i) {
                Eigen::VectorXd value(n), byTime(n);
                Mechanism::Rows G(n, d);
                const Eigen::VectorXd place = q.row(i).transpose();
                g.first(g.model.get(), 0, place.data(), value.data(), G.data(), byTime.data());
                Eigen::MatrixXd dependent(n, n);
                for (int c = 0; c < n; ++c) dependent.col(c) = G.col(order[static_cast<std::size_t>(n + c)]);
                Eigen::MatrixXd right(n, 2);
                right << -G.col(order.back()), -value;
                const Eigen::MatrixXd expected = dense::solve<double>(dependent, right);
                for (int c = 0; c < n; ++c)
                    for (int j = 0; j < 2; ++j)
                        QVERIFY(std::abs(found(i, j * n + c) - expected(c, j)) <
                                1e-12 * (1 + expected.cwiseAbs().maxCoeff()));
            }
            // The same order is the same code.
            QCOMPARE(g.dependence(g.model.get(), order).model, dependence.model);
        }
    }
    /// In steps of which the crank makes a third of a turn and more, where there are other roots, the same
    /// one is found, or none.
    void longStepsHaveTheRootsOfNewton() {
        const Mechanical of = fourBar();
        int compared = 0;
        for (const int degree : {2, 3, 4, 6})
            for (double h = 0.03; h < 0.3; h *= 1.06) {
                std::unique_ptr<Integrator> integrators[2];
                State states[2] = {of.start, of.start};
                for (const bool isNewton : {false, true}) {
                    Discretization d = *namedScheme("galerkin-gauss-" + std::to_string(degree));
                    d.solver = {isNewton ? "newton" : "auto", {}, {}};
                    integrators[isNewton] = makeIntegrator(of.system, d, {0, h});
                    integrators[isNewton]->begin(states[isNewton]);
                }
                for (int i = 0; i < 40; ++i) {
                    Outcome outcomes[2];
                    for (const bool isNewton : {false, true})
                        outcomes[isNewton] = advance(*integrators[isNewton], states[isNewton]).outcome;
                    if (outcomes[0] != Outcome::converged || outcomes[1] != Outcome::converged) break;
                    const double apart = distance(states[0], states[1]).q;
                    QVERIFY2(
                        apart < 1e-3,
                        qPrintable(
                            QString("degree %1, h = %2, step %3: %4").arg(degree).arg(h).arg(i).arg(apart)));
                    ++compared;
                }
            }
        QVERIFY(compared > 2000);
    }
    /// Springs that are too stiff for sweeps are left to Newton's method.
    void stiffForcesAreLeftToNewton() {
        const Mechanical of =
            startAt(typed({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - 1e6*(sqrt(x^2+y^2)-1)^2/2 - y",
                          {{"plane", "z - x/2"}}),
                    {1, 0, 0.5}, {0, 0.5, 0});
        const Ended bySweeps = endOf(of, "galerkin-gauss-2", "auto", 0),
                    byNewton = endOf(of, "galerkin-gauss-2", "newton", 0);
        const Distance apart = distance(bySweeps.state, byNewton.state);
        qInfo("apart %.1e, %.1e; %.2f solves", apart.q, apart.p, bySweeps.solves);
        QVERIFY(bySweeps.solves > 1 && apart.q < 1e-9);
    }
};

EXTREMAL_TEST(NullSpaceTest)
}  // namespace null_space_test
}  // namespace extremal::mechanism_test
#include "null_space_test.moc"
