// SPDX-License-Identifier: GPL-3.0-or-later
/// Methods for wave functions with an interaction beside splittings: their errors are those of other codes,
/// and what they keep.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/baseline/catalog.hpp"
#include "engine/model/wave/interaction.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::coupled_waves_test {
namespace {

System line(double half, int modes, double g) {
    return laws::systemNamed("schrodinger", {{"domain", Value::Array{-half, half}},
                                             {"modes", static_cast<double>(modes)},
                                             {"potential", "free"},
                                             {"interaction", g}});
}

struct Found {
    double error = 0, norm = 0, energy = 0, whole = 0;  ///< energy: per norm; whole: norm² times it
};

Found foundBy(const char* id, const System& system, const Value& psi, double end, int steps) {
    const State start{0, 0, system.start({"", {{"psi", psi}, {"normalise", false}}, {}}, 0)};
    State state = start;
    const auto integrator = findBaseline(id)->make(system, {.step = end / steps, .settings = {id, {}, {}}});
    const auto squares = [](const State& s) {
        double sum = 0;
        for (const double each : s.x) sum += each * each;
        return sum;
    };
    const double before = squares(start), energy = system.energy(0, start.x.data());
    Found found;
    for (int k = 0; k < steps; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("a step failed");
        found.norm = std::max(found.norm, std::abs(squares(state) / before - 1));
        const double whole = squares(state) / before * system.energy(state.t, state.x.data()) / energy;
        found.whole = std::max(found.whole, std::abs(whole - 1));
        found.energy = std::max(found.energy, std::abs(system.energy(state.t, state.x.data()) / energy - 1));
    }
    std::vector<double> known(state.x.size());
    system.exactFrom({"", {{"psi", psi}}, {}}, start)(end, known);
    double sum = 0;
    for (std::size_t i = 0; i < known.size(); ++i) sum += std::pow(state.x[i] - known[i], 2);
    found.error = std::sqrt(sum);
    return found;
}

}  // namespace

class CoupledWavesTest : public QObject {
    Q_OBJECT
private slots:
    void errorsAreThoseOfTheTable_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("coarse");
        QTest::addColumn<int>("fine");
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("last");
        QTest::addColumn<double>("order");
        QTest::newRow("Besse") << "besse" << 160 << 1280 << 1.28e-3 << 2.00e-5 << 2.0;
        QTest::newRow("DFP") << "delfour-fortin-payre" << 160 << 1280 << 4.18e-3 << 6.54e-5 << 2.0;
        QTest::newRow("IF-RK4") << "if-rk4" << 160 << 640 << 4.78e-4 << 2.31e-6 << 3.9;
        QTest::newRow("ETD-RK4") << "etd-rk4" << 160 << 640 << 1.76e-4 << 5.3e-7 << 4.13;
    }
    void errorsAreThoseOfTheTable() {
        // 2 sech x, N = 2048, length 60, to pi/2, as a prototype in another language measured it.
        QFETCH(QString, id);
        QFETCH(int, coarse);
        QFETCH(int, fine);
        QFETCH(double, first);
        QFETCH(double, last);
        QFETCH(double, order);
        const System system = line(30, 2048, -1);
        const Value psi = Value::Object{{"packet", "two-soliton"}};
        const std::string name = id.toStdString();
        const Found a = foundBy(name.c_str(), system, psi, std::numbers::pi / 2, coarse),
                    b = foundBy(name.c_str(), system, psi, std::numbers::pi / 2, fine);
        const double found = std::log(a.error / b.error) / std::log(static_cast<double>(fine) / coarse);
        qInfo("%s: %.3e, %.3e, order %.2f; norm %.1e, energy %.1e", name.c_str(), a.error, b.error, found,
              a.norm, a.energy);
        QVERIFY(std::abs(a.error / first - 1) < 0.03);
        QVERIFY(std::abs(b.error / last - 1) < 0.03);
        QVERIFY(std::abs(found - order) < 0.15);
        const bool keepsNorm = name == "besse" || name == "delfour-fortin-payre";
        QVERIFY(keepsNorm ? a.norm < 1e-12 : a.norm > 1e-10);
        QVERIFY(name == "delfour-fortin-payre" ? a.energy < 1e-12 : a.energy > 1e-9);
    }
    void anExactIntegralOverTimeKeepsTheEnergyAndNotTheNorm() {
        // The same table.
        const System system = line(30, 2048, -1);
        const Value psi = Value::Object{{"packet", "two-soliton"}};
        struct Row {
            int degree, coarse, fine;
            double first, last, order;
        };
        for (const Row& row : {Row{1, 160, 1280, 1.40e-2, 2.19e-4, 2},
                               {2, 80, 320, 3.73e-5, 1.46e-7, 4},
                               {3, 40, 160, 1.63e-6, 2.9e-10, 6.2}}) {
            const std::string id = "energy-" + std::to_string(row.degree);
            const double end = std::numbers::pi / 2;
            const Found a = foundBy(id.c_str(), system, psi, end, row.coarse),
                        b = foundBy(id.c_str(), system, psi, end, row.fine);
            const double order =
                std::log(a.error / b.error) / std::log(static_cast<double>(row.fine) / row.coarse);
            qInfo("%s: %.3e, %.3e, order %.2f; norm %.1e, %.1e, norm^2 times energy %.1e", id.c_str(),
                  a.error, b.error, order, a.norm, b.norm, a.whole);
            QVERIFY(std::abs(a.error / row.first - 1) < 0.03);
            QVERIFY(std::abs(b.error / row.last - 1) < 0.05);
            QVERIFY(std::abs(order - row.order) < 0.15);
            QVERIFY(a.whole < 1e-12);
            QVERIFY(a.norm > 1e-10 && b.norm > 1e-13);
        }
    }
    void thePlaneAndPotentialsThatDependOnTimeAreTaken() {
        // Against a splitting, whose error is smaller.
        const System plane = laws::systemNamed("schrodinger-2d", {{"domain", Value::Array{-7.0, 7.0}},
                                                                  {"domain_y", Value::Array{-7.0, 7.0}},
                                                                  {"modes", 32.0},
                                                                  {"modes_y", 32.0},
                                                                  {"potential", "harmonic"},
                                                                  {"interaction", 5.0}});
        const System driven = laws::systemNamed(
            "schrodinger", {{"modes", 64.0}, {"potential", "2*(1 - cos(x)) + sin(x)*sin(3*t)"}});
        for (const System* system : {&plane, &driven}) {
            const bool isPlane = system == &plane;
            const Value psi = isPlane ? Value(Value::Object{{"re", "exp(-((x - 1)^2 + y^2)/2)"}})
                                      : Value(Value::Object{{"packet", "periodic-gaussian"}, {"kappa", 8.0}});
            const State start{0, 0, system->start({"", {{"psi", psi}, {"normalise", true}}, {}}, 0)};
            const auto end = [&](const char* id, int steps) {
                State state = start;
                const auto integrator =
                    findBaseline(id)->make(*system, {.step = 1.0 / steps, .settings = {id, {}, {}}});
                for (int k = 0; k < steps; ++k)
                    if (advance(*integrator, state).outcome != Outcome::converged) qFatal("%s failed", id);
                return state;
            };
            const State known = end("srkn-11b", 400);
            for (const char* id : {"besse", "delfour-fortin-payre", "if-rk4", "etd-rk4"}) {
                const auto error = [&](int steps) {
                    const State is = end(id, steps);
                    double sum = 0;
                    for (std::size_t i = 0; i < is.x.size(); ++i) sum += std::pow(is.x[i] - known.x[i], 2);
                    return std::sqrt(sum);
                };
                const double a = error(80), b = error(160), order = std::log2(a / b);
                qInfo("%s %s: %.2e, %.2e, order %.2f", isPlane ? "plane" : "driven", id, a, b, order);
                const double wanted = findBaseline(id)->item.claims->order;
                QVERIFY(std::abs(order - wanted) < 0.3 && b < 1e-2);
            }
        }
    }
    void rotationsAreRefused() {
        for (const char* id : {"besse", "delfour-fortin-payre", "if-rk4", "etd-rk4", "energy-2"}) {
            QVERIFY(findBaseline(id)->takes.contains(Interaction::part));
            QVERIFY(!findBaseline(id)->takes.contains(Rotation::part));
        }
    }
};

EXTREMAL_TEST(CoupledWavesTest)

}  // namespace extremal::coupled_waves_test

#include "coupled_waves_test.moc"
