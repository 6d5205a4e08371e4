// SPDX-License-Identifier: GPL-3.0-or-later
/// Multiscale schemes on the stiff spring pendulum, with up to 250 fast periods in a step: errors against the
/// motion in quadruple precision, and the energy to t = 100.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::multiscale_table_test {
namespace {

struct Row {
    double k, h;
    int scheme;  ///< R1, R2, R3
    double theta, a, pa, pTheta, energy10, energy100;
};

/// Largest errors over all nodes to t = 10, and of the energy to t = 10 and t = 100, as an independent
/// program has measured them.
const std::vector<Row> table = {
    {1e4, .05, 1, 3.3e-8, 4.2e-8, 4.1e-6, 9.8e-8, 1.4e-6, 1.4e-6},
    {1e4, .05, 2, 6.3e-11, 3.4e-12, 3.4e-10, 1.9e-10, 1.5e-10, 1.6e-10},
    {1e4, .10, 1, 4.1e-5, 5.2e-5, 5.0e-3, 1.2e-4, 1.6e-4, 1.6e-4},
    {1e4, .10, 2, 2.4e-8, 4.4e-9, 4.3e-7, 7.0e-8, 9.9e-8, 1.0e-7},
    {1e4, .10, 3, 1.2e-11, 1.1e-11, 1.0e-9, 3.5e-11, 1.4e-10, 1.5e-10},
    {1e4, .20, 1, 9.8e-5, 1.2e-4, 1.1e-2, 2.9e-4, 4.8e-4, 1.8e-3},
    {1e4, .20, 2, 9.6e-8, 1.7e-7, 1.6e-5, 2.7e-7, 4.2e-7, 2.1e-6},
    {1e4, .20, 3, 1.7e-10, 2.1e-10, 2.0e-8, 4.8e-10, 2.7e-9, 3.5e-9},
    {1e4, .25, 1, 8.8e-5, 1.2e-4, 9.0e-3, 2.4e-4, 1.6e-3, 1.7e-3},
    {1e4, .25, 2, 1.2e-7, 2.1e-7, 1.6e-5, 3.2e-7, 6.8e-7, 7.2e-7},
    {1e4, .25, 3, 9.4e-11, 3.1e-10, 2.5e-8, 2.5e-10, 1.2e-8, 1.3e-8},
    {1e4, .50, 1, 6.0e-4, 2.1e-4, 2.2e-2, 1.4e-3, 4.3e-2, 9.6e-2},
    {1e4, .50, 2, 1.9e-6, 7.9e-7, 6.6e-5, 4.9e-6, 2.3e-5, 6.2e-5},
    {1e4, .50, 3, 2.2e-8, 2.3e-9, 2.9e-7, 5.6e-8, 6.7e-7, 1.2e-6},
    {1e6, .10, 1, 1.9e-8, 1.8e-8, 1.8e-5, 5.6e-8, 1.0e-6, 1.0e-6},
    {1e6, .10, 2, 1.3e-13, 3.0e-13, 3.0e-10, 3.9e-13, 1.1e-11, 1.2e-11},
    {1e6, .20, 1, 1.3e-7, 8.3e-8, 8.0e-5, 4.0e-7, 3.1e-6, 3.3e-6},
    {1e6, .20, 2, 5.0e-12, 3.1e-12, 3.0e-9, 1.5e-11, 8.1e-10, 8.7e-10},
    {1e6, .20, 3, 1.4e-14, 1.1e-14, 1.1e-11, 3.8e-14, 4.9e-12, 7.8e-12},
    {1e6, .25, 1, 3.9e-7, 1.8e-7, 1.8e-4, 1.2e-6, 6.7e-6, 7.3e-6},
    {1e6, .25, 2, 2.5e-11, 9.2e-12, 9.3e-9, 7.4e-11, 2.4e-9, 2.8e-9},
    {1e6, .50, 1, 2.0e-5, 2.0e-6, 2.4e-3, 5.6e-5, 4.1e-4, 4.2e-4},
    {1e6, .50, 2, 6.2e-8, 3.4e-10, 4.2e-7, 1.7e-7, 1.1e-6, 1.3e-6},
    {1e6, .50, 3, 2.7e-10, 1.8e-11, 2.4e-8, 7.2e-10, 3.4e-8, 4.2e-8},
    {1e8, .10, 1, 2.1e-10, 4.4e-11, 4.6e-7, 6.2e-10, 1.8e-9, 2.0e-9},
    {1e8, .10, 2, 2.0e-15, 9.5e-16, 9.8e-12, 5.6e-15, 2.3e-11, 6.8e-11},
    {1e8, .20, 1, 4.0e-8, 6.9e-10, 7.2e-6, 1.2e-7, 1.3e-7, 1.8e-7},
    {1e8, .20, 2, 1.7e-12, 6.8e-15, 6.6e-11, 5.1e-12, 2.5e-11, 5.2e-11},
    {1e8, .25, 2, 1.9e-11, 3.9e-14, 4.0e-10, 5.5e-11, 4.4e-11, 1.0e-10},
    {1e8, .50, 1, 2.0e-5, 2.5e-8, 2.6e-4, 5.5e-5, 1.0e-4, 1.1e-4},
    {1e8, .50, 2, 6.8e-8, 6.8e-12, 7.0e-8, 1.9e-7, 4.4e-8, 5.1e-8},
};

/// t, a, theta, p_a, p_theta at t = n / 10, n = 0..100.
std::vector<std::vector<double>> motion(double k) {
    const std::string name = k == 1e4 ? "1e4" : k == 1e6 ? "1e6" : "1e8";
    std::ifstream in(std::string(EXTREMAL_SOURCE_DIR) + "/tests/laws/data/spring_pendulum_k" + name + ".txt");
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream cells(line);
        std::vector<double> row;
        for (double x = 0; cells >> x;) row.push_back(x);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace

class MultiscaleTableTest : public QObject {
    Q_OBJECT
private slots:
    void errors_data() {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < table.size(); ++i)
            QTest::addRow("k = %g, h = %g, R%d", table[i].k, table[i].h, table[i].scheme)
                << static_cast<int>(i);
    }
    void errors() {
        QFETCH(int, index);
        const Row& row = table[static_cast<std::size_t>(index)];
        const System s = systemNamed("spring-pendulum", {{"k", row.k}});
        // With the grid the figures were measured with, but below some three periods per step, where the
        // automatic rule of the richer schemes is Gauss: R3 on its grid is then too ill-conditioned, and
        // Gauss is the more accurate one.
        Discretization discretization = *namedScheme("multiscale-r" + std::to_string(row.scheme));
        const bool isFilon = row.h * std::sqrt(row.k) > (row.scheme == 1 ? 19 : 21);
        if (isFilon)
            discretization.quadrature = completeQuadrature(discretization.space, {"filon-lobatto", {}, {}});
        const auto integrator = makeIntegrator(s, discretization, {0, row.h});
        State state{0, 0, {0.05 * std::sqrt(1e4 / row.k), 1, 0, 0}};
        const auto& m = s.mechanics();
        const auto H = [&] { return m.energy(m.model.get(), state.t, state.x.data(), state.x.data() + 2); };
        const double H0 = H();
        const auto known = motion(row.k);
        QVERIFY(known.size() == 101);
        std::array<double, 6> worst{};
        int iterations = 0, mostIterations = 0, solves = 0;
        while (state.t < 100 - 1e-9) {
            const StepReport report = advance(*integrator, state);
            QCOMPARE(report.outcome, Outcome::converged);
            iterations += report.cost.iterations;
            solves += report.cost.linearSolves - report.cost.iterations;
            mostIterations = std::max(mostIterations, static_cast<int>(report.cost.iterations));
            const double dH = std::abs(H() - H0);
            worst[5] = std::max(worst[5], dH);
            if (state.t > 10 + 1e-9) continue;
            worst[4] = std::max(worst[4], dH);
            const double place = 10 * state.t;
            if (std::abs(place - std::round(place)) > 1e-9) continue;
            const auto& x = known[static_cast<std::size_t>(std::llround(place))];
            // h is rounded: over ten seconds the phase at k = 1e8 would differ by 5e-12.
            const auto late =
                static_cast<double>(static_cast<long double>(state.node) * static_cast<long double>(row.h) -
                                    std::round(place) / 10.0L);
            std::array<double, 4> exact = {x[1], x[2], x[3], x[4]}, rate{};
            QVERIFY(
                m.flow(m.model.get(), state.t, exact.data(), exact.data() + 2, rate.data(), rate.data() + 2));
            for (std::size_t i = 0; i < 4; ++i) exact[i] += late * rate[i];
            for (std::size_t i = 0; i < 4; ++i)
                worst[i] = std::max(worst[i], std::abs(state.x[i] - exact[i]));
        }
        qInfo(
            "theta %.1e a %.1e p_a %.1e p_theta %.1e energy %.1e %.1e; %.1f iterations per step, %d at most, "
            "%.2f Jacobians",
            worst[1], worst[0], worst[2], worst[3], worst[4], worst[5],
            1.0 * iterations / static_cast<double>(state.node), mostIterations,
            1.0 * solves / static_cast<double>(state.node));
        const std::array<double, 6> expected = {row.a,      row.theta,    row.pa,
                                                row.pTheta, row.energy10, row.energy100};
        for (std::size_t i = 0; i < 6; ++i) {
            // Near round-off only an upper bound means something.
            const bool isRoundOff = expected[i] < 1e-12 || (i >= 4 && row.k == 1e8);
            QVERIFY2(worst[i] < (isRoundOff ? 5 : 2) * expected[i],
                     qPrintable(QString("%1 %2 %3").arg(i).arg(worst[i]).arg(expected[i])));
            if (!isRoundOff && isFilon)
                QVERIFY2(worst[i] > expected[i] / 2,
                         qPrintable(QString("%1 %2 %3").arg(i).arg(worst[i]).arg(expected[i])));
        }
    }
};

EXTREMAL_TEST(MultiscaleTableTest)
}  // namespace extremal::laws::multiscale_table_test

#include "multiscale_table_test.moc"
