// SPDX-License-Identifier: GPL-3.0-or-later
/// Where along a motion the energy equation of moving times has no root, as it is told beforehand.
#include <QTest>

#include "engine/family/energy_momentum/density.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::density_test {
namespace {

SolvabilityForecast forecast(const System& system, const State& start, FollowUntil until) {
    const Table<double> midpoint =
        makeTable(polynomialSpace<double>(1, PolynomialBasis::lobatto), gauss<double>(1));
    return forecastSolvability(system.mechanics(), midpoint, 2, start, 0.1, 20, until).value();
}

}  // namespace

class DensityTest : public QObject {
    Q_OBJECT
private slots:
    void aMotionIsFollowedToItsEndOrToTheFirstDoubt() {
        const System pendulum = laws::systemNamed("pendulum", {{"g", 1.0}});
        const State rotation{0, 0, {0, 2.2}}, libration{0, 0, {1, 0}};
        const SolvabilityForecast whole = forecast(pendulum, rotation, FollowUntil::end),
                                  start = forecast(pendulum, rotation, FollowUntil::doubt);
        QVERIFY(whole.signChanges.size() > 2 && whole.until > 19.8);
        QCOMPARE(start.signChanges.size(), std::size_t{1});
        QCOMPARE(start.signChanges.front(), whole.signChanges.front());
        QVERIFY(start.until >= start.signChanges.front() && start.until < start.signChanges.front() + 0.11);
        const SolvabilityForecast well = forecast(pendulum, libration, FollowUntil::doubt);
        QVERIFY(well.signChanges.empty() && well.unresolved == 0 && well.until > 19.8);
    }
};

EXTREMAL_TEST(DensityTest)
}  // namespace extremal::density_test

#include "density_test.moc"
