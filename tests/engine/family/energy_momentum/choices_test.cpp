// SPDX-License-Identifier: GPL-3.0-or-later
/// What the window offers: spaces with moving times are further rows of the grid of Galerkin schemes.
#include <QTest>

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/family/energy_momentum/moving_time.hpp"
#include "engine/family/scheme.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::energy_momentum_choices_test {
namespace {

int movingRows(const System& system) {
    const ChoiceGrid grid = choicesFor(system);
    return static_cast<int>(std::count_if(grid.rows.begin(), grid.rows.end(),
                                          [](const auto& row) { return row.text.starts_with("SEM "); }));
}

}  // namespace

class ChoicesTest : public QObject {
    Q_OBJECT
private slots:
    void theGridHasARowForEachDegree() {
        const ChoiceGrid grid = choicesFor(laws::systemNamed("kepler"));
        QCOMPARE(grid.cells.size(), grid.rows.size() * grid.columns.size());
        QCOMPARE(movingRows(laws::systemNamed("kepler")), 4);
        // A cell is a scheme that runs.
        for (const ChoiceGrid::Cell& cell : grid.cells)
            if (cell.id == "sem2.gauss") {
                QCOMPARE(describe(cell.discretization).claims.order, 4);
                QVERIFY(cell.discretization == namedScheme("sem-2"));
                return;
            }
        QFAIL("no cell of degree 2 with Gauss");
    }
    void whatHasNoEnergyHasNoSuchRows() {
        const System forced = laws::systemNamed(
            "lagrangian", {{"coordinates", Value::Array{"q"}}, {"lagrangian", "q_t^2/2 + q*cos(t)"}});
        QCOMPARE(movingRows(forced), 0);
        QCOMPARE(movingRows(laws::systemNamed("rigid-body")), 0);
        QVERIFY(!choicesFor(forced).rows.empty());
    }
    void limitsMustContainTheFirstStep() {
        const auto refused = [](const char* key, Value value) {
            Settings space = namedScheme("sem-1")->space;
            std::erase_if(space.keys, [&](const auto& member) { return member.first == key; });
            space.keys.emplace_back(key, value);
            try {
                movingTimeOptions(space, 2, 0.1);
            } catch (const InvalidScene& e) {
                return e.problems().front().pointer == std::string("/space/") + key;
            }
            return false;
        };
        QVERIFY(refused("hmin", 0.2));
        QVERIFY(refused("hmax", 0.05));
        QVERIFY(refused("window", Value::Array{1.5, 2.0}));
        const MovingTimeOptions usual = movingTimeOptions(namedScheme("sem-1")->space, 2, 0.1);
        QCOMPARE(usual.least, 0.025);
        QCOMPARE(usual.most, 3.0);
    }
};

EXTREMAL_TEST(ChoicesTest)
}  // namespace extremal::energy_momentum_choices_test

#include "choices_test.moc"
