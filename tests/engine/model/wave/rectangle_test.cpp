// SPDX-License-Identifier: GPL-3.0-or-later
/// Named potentials and starts on a rectangle: values, sizes, and what is refused.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/model/wave/start/packet.hpp"
#include "tests/tools/test.hpp"

namespace extremal::rectangle_test {
namespace {

const wave::Grid grid{{-3, 12}, 48, {1, 8}, 32};
const wave::Constants units{{"hbar", 0.5}, {"m", 2}};

wave::Function potential(Value::Object keys) {
    return wave::makePotential(Value(std::move(keys)), "/potential", grid, units).function;
}
/// Pointer and message of what is wrong.
template <class Make>
QString refusal(Make&& make) {
    try {
        (void)make();
    } catch (const InvalidScene& e) {
        return QString::fromStdString(e.problems()[0].pointer + " " + e.problems()[0].message + " (" +
                                      e.problems()[0].hint + ")");
    }
    return {};
}
QString refusedPotential(const Value& given) {
    return refusal([&] { return wave::makePotential(given, "/potential", grid, units); });
}
QString refusedStart(const Value& psi) {
    const auto h = std::make_shared<const Hamiltonian>(
        grid, 0.5, 2, wave::makePotential(Value(0.0), "/potential", grid, units));
    return refusal([&] { return wave::makePacket(psi, "/psi", true, h, units); });
}

}  // namespace

class RectangleTest : public QObject {
    Q_OBJECT
private slots:
    void namedPotentials() {
        // m/2 (omega^2 d^2 + omega_y^2 e^2), from the middle (3, 5).
        const auto harmonic = potential({{"name", "harmonic"}, {"omega", 3.0}, {"omega_y", 2.0}});
        QCOMPARE(harmonic.value(4, 7, 0), 9.0 + 4 * 4);
        QCOMPARE(potential({{"name", "harmonic"}, {"omega", 3.0}}).value(3, 6, 0), 9.0);
        const auto lattice =
            potential({{"name", "lattice"}, {"depth", 2.0}, {"cells", 3.0}, {"cells_y", 2.0}});
        QVERIFY(std::abs(lattice.value(-3 + 2, 1, 0) - 4) < 1e-14);
        QVERIFY(std::abs(lattice.value(-3, 1 + 2, 0) - 4) < 1e-14);
        const auto barrier =
            potential({{"name", "barrier"}, {"height", 5.0}, {"centre", 1.0}, {"width", 0.5}});
        QVERIFY(std::abs(barrier.value(1.5, 2, 0) - 5 * std::exp(-0.5)) < 1e-14);
        QCOMPARE(barrier.value(1.5, 2, 0), barrier.value(1.5, 7, 0));
        const auto slits = potential(
            {{"name", "double-slit"}, {"height", 5.0}, {"width", 0.5}, {"slit", 1.0}, {"separation", 3.0}});
        QVERIFY(std::abs(slits.value(3, 5, 0) - 5) < 1e-12);  // the wall between the gaps
        QVERIFY(std::abs(slits.value(3, 6.5, 0)) < 1e-12);    // in the upper gap
        QVERIFY(std::abs(slits.value(3, 3.5, 0)) < 1e-12);
        QVERIFY(std::abs(slits.value(3, 7, 0) - 5 * (1 - std::exp(-1))) < 1e-12);  // at its edge
        QVERIFY(slits.value(6, 5, 0) < 1e-6);
    }
    void randomFieldsAreTheSameEverywhere() {
        const auto field =
            potential({{"name", "random"}, {"seed", 7.0}, {"correlation", 0.6}, {"amplitude", 3.0}});
        double mean = 0, square = 0, product = 0;
        constexpr int points = 96;
        for (int j = 0; j < points; ++j)
            for (int i = 0; i < points; ++i) {
                const double x = -3 + 12.0 * i / points, y = 1 + 8.0 * j / points, v = field.value(x, y, 0);
                mean += v / (points * points);
                square += v * v / (points * points);
                product += v * field.value(x + 0.6, y, 0) / (points * points);
            }
        qInfo("mean %.2g, variance %.3f, correlation at one length %.3f", mean, square, product / square);
        QVERIFY(std::abs(mean) < 1e-13);
        QVERIFY(square > 6 && square < 12);  // 9 in the mean of all seeds
        // The mean of products at a distance l is that of the weights' squares: exp(-1/2).
        QVERIFY(std::abs(product / square - std::exp(-0.5)) < 0.1);
        QVERIFY(std::abs(field.value(-3, 4, 0) - field.value(9, 4, 0)) < 1e-12);
        QVERIFY(std::abs(field.value(2, 1, 0) - field.value(2, 9, 0)) < 1e-12);
        const auto again = potential(
                       {{"name", "random"}, {"seed", 7.0}, {"correlation", 0.6}, {"amplitude", 3.0}}),
                   other = potential(
                       {{"name", "random"}, {"seed", 8.0}, {"correlation", 0.6}, {"amplitude", 3.0}});
        QCOMPARE(field.value(1.3, 2.4, 0), again.value(1.3, 2.4, 0));
        QVERIFY(std::abs(field.value(1.3, 2.4, 0) - other.value(1.3, 2.4, 0)) > 1e-3);
    }
    void whatIsRefused() {
        QVERIFY(refusedPotential("x + y + z").contains("unknown name \"z\""));
        QVERIFY(refusedPotential(Value::Object{{"name", "morse"}}).contains("unknown potential \"morse\""));
        QVERIFY(refusedPotential(Value::Object{{"name", "lattice"}, {"cells_y", 1.5}})
                    .startsWith("/potential/cells_y must be a whole number"));
        QVERIFY(refusedPotential(Value::Object{{"name", "double-slit"}, {"slit", -1.0}})
                    .startsWith("/potential/slit"));
        QVERIFY(refusedPotential(Value::Object{{"name", "harmonic"}, {"omegay", 1.0}})
                    .startsWith("/potential/omegay unknown key"));
        QVERIFY(refusedStart(Value::Object{{"re", "exp(-x^2)*z"}}).contains("unknown name"));
        QVERIFY(refusedStart(Value::Object{{"re", "exp(-x^2)*t"}}).contains("depends on t"));
        QVERIFY(refusedStart(Value::Object{{"packet", "gaussian"}, {"width_y", 0.0}})
                    .startsWith("/psi/width_y must be a positive"));
        QVERIFY(refusedStart(
                    Value::Object{{"packet", "plane-wave"}, {"wave_number", 0.0}, {"wave_number_y", 1.0}})
                    .startsWith("/psi/wave_number_y does not fit"));
        QVERIFY(refusedStart(Value::Object{{"packet", "plane-wave"},
                                           {"wave_number", 0.0},
                                           {"wave_number_y", 2 * std::numbers::pi / 8 * 16}})
                    .contains("needs more than 32 modes"));
        QVERIFY(refusedStart(Value::Object{{"values", Value::Object{{"re", Value::Array{1.0, 2.0}}}}})
                    .contains("1536 numbers"));
        QVERIFY(refusal([] {
                    return Hamiltonian(grid, 1, 1,
                                       wave::makePotential(Value("1/(y - 1)"), "/potential", grid, units));
                }).contains("is not finite at x = -3, y = 1"));
        // On an interval y is not a name.
        const wave::Grid interval{{0, 1}, 8};
        QVERIFY(refusal([&] {
                    return wave::makePotential(Value("x*y"), "/potential", interval, units);
                }).contains("unknown name \"y\""));
        QVERIFY(refusal([&] {
                    return wave::makePotential(Value(Value::Object{{"name", "double-slit"}}), "/potential",
                                               interval, units);
                }).contains("unknown potential"));
    }
};

EXTREMAL_TEST(RectangleTest)
}  // namespace extremal::rectangle_test

#include "rectangle_test.moc"
