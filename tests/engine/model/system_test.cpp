// SPDX-License-Identifier: GPL-3.0-or-later
/// What systems say in the usual way of coordinates, and what they say themselves.
#include <QTest>

#include <cmath>

#include "engine/observe/catalog.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::system_test {

class SystemTest : public QObject {
    Q_OBJECT
private slots:
    void coordinatesGiveTheUsualColumnsEnergyAndError() {
        const System kepler = laws::systemNamed("kepler");
        std::vector<std::string> names;
        for (const Quantity& c : stateColumns(kepler)) names.push_back(c.name);
        QCOMPARE(names, (std::vector<std::string>{"q.x", "q.y", "p.x", "p.y"}));
        const std::vector<double> x{0.4, 0, 0, 2};
        QCOMPARE(energyOf(kepler)(0, x.data()), 2 - 1 / 0.4);
        std::vector<double> dx(4);
        QVERIFY(rateOf(kepler, 0, x.data(), dx.data()));
        QCOMPARE(dx[1], 2.0);
        QCOMPARE(dx[2], -1 / 0.16);
        const ErrorMeasure measure = errorMeasure(kepler, {0, 0, x});
        const std::vector<double> reference{0.1, 0.4, 3, -2};
        std::vector<double> values(measure.columns.size());
        measure.evaluate(x.data(), reference.data(), values.data());
        QCOMPARE(values, (std::vector<double>{0.5, 5, 0.4 - 0.1, -0.4}));
        QCOMPARE(measure.scale, 0.4);
    }

    void aSystemMaySayItselfWhatItsStateIs() {
        System spin;
        spin.columns = {{"turns", "turns", "n", ""}};
        spin.energy = [](double, const double* x) { return 7 * x[0]; };
        spin.error.columns = {{"error", "", "|n - n_ref|", ""}};
        spin.error.evaluate = [](const double* x, const double* r, double* values) {
            values[0] = std::abs(x[0] - r[0]);
        };
        spin.momenta = {{"kept", "k", "", [](const double* x, const double*) { return x[1]; }}};
        const State start{0, 0, {1, 5}};
        QVERIFY(!spin.hasCoordinates());
        QCOMPARE(stateColumns(spin).size(), std::size_t(1));
        for (const auto& [id, values] : {std::pair<const char*, std::vector<double>>{"energy", {14, 7}},
                                         {"error", {0.5}},
                                         {"momentum", {8, 3}}}) {
            const Observer o =
                findObservable(id)->bind({spin, start, [](double, std::span<double> x) { x[0] = 1.5; }});
            QCOMPARE(o.columns.size(), values.size());
            std::vector<double> seen(values.size());
            o.evaluate({1, 1, {2, 8}}, {}, seen.data());
            QCOMPARE(seen, values);
        }
    }

    void aMomentumThatIsAStateColumnIsNotWrittenTwice() {
        System spin;
        spin.columns = {{"momentum.z", "", "", ""}};
        spin.momenta = {{"z", "L", "", [](const double* x, const double*) { return x[0]; }}};
        const Observer o = findObservable("momentum")->bind({spin, {0, 0, {1}}, {}});
        QCOMPARE(o.columns.size(), std::size_t(1));
        QCOMPARE(o.columns[0].name, std::string("momentum_error"));
        QCOMPARE(o.extreme, 0);
        double error = 0;
        o.evaluate({1, 1, {4}}, {}, &error);
        QCOMPARE(error, 3.0);
    }
};

EXTREMAL_TEST(SystemTest)
}  // namespace extremal::system_test

#include "system_test.moc"
