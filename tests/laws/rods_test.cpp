// SPDX-License-Identifier: GPL-3.0-or-later
/// A rod in space that stands still, as a motion on SE(3) with the length along it as time: arcs of circles
/// are exact, a cantilever under a force at its tip converges with the order of the scheme, as an initial
/// value problem and between its two ends; other forms of the same rod exist, and are found by other starts.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/laws/matrix_groups.hpp"
#include "tests/tools/test.hpp"

namespace extremal::rods_test {
namespace {

using namespace laws;

/// A thin rod along z at rest, (xi - e0) . K (xi - e0) / 2 with bending and torsion 1 and `stiffness` for
/// shear and length.
System rod(double stiffness) {
    return systemNamed("group",
                       {{"group", "se3"},
                        {"parameters", Value::Object{{"K", stiffness}}},
                        {"lagrangian", "(xi1^2 + xi2^2 + xi3^2)/2 + K*(xi4^2 + xi5^2 + (xi6 - 1)^2)/2"},
                        {"let", Value()}});
}
/// From its clamped end, with the moment there and a force along y.
State clamped(const System& system, double moment, double force) {
    return {0, 0, system.start(Settings{"", {{"mu", Value::Array{moment, 0, 0, 0, force, 0}}}, {}}, 0)};
}
struct Tip {
    double y = 1e300, z = 1e300, moment = 1e300;
};
Tip tipOf(const System& system, int degree, int elements, double moment, double force) {
    const auto integrator = makeIntegrator(system, liePair(degree), {0, 1.0 / elements});
    const auto end = after(*integrator, clamped(system, moment, force), elements);
    if (!end) return {};
    // g row by row, then mu.
    return {end->x[7], end->x[11], end->x[16]};
}
/// The moment at the base for which that at the tip vanishes, by secants from a guess.
double momentFor(const System& system, int degree, int elements, double force, double guess) {
    double a = guess, b = guess * 1.001, atA = tipOf(system, degree, elements, a, force).moment;
    for (int iteration = 0; iteration < 50; ++iteration) {
        const double atB = tipOf(system, degree, elements, b, force).moment;
        if (std::abs(atB) < 1e-11 || atB == atA) break;
        const double next = b - atB * (b - a) / (atB - atA);
        a = b;
        atA = atB;
        b = next;
    }
    return b;
}

// Of the inextensible rod, EI = 1, length 1, force 2 across it, by elliptic integrals.
constexpr double force = 2, tipY = 0.493457480397, tipZ = 0.839358279175;

}  // namespace

class RodsTest : public QObject {
    Q_OBJECT

private slots:
    /// Constant strain: two elements of degree 1 over an arc of two radians.
    void circlesAreExact() {
        for (const double stiffness : {1e2, 1e8})
            for (const int degree : {1, 2}) {
                const Tip tip = tipOf(rod(stiffness), degree, 2, 2, 0);
                const double error = std::hypot(tip.y + (1 - std::cos(2)) / 2, tip.z - std::sin(2) / 2);
                qInfo("K = %.0e, degree %d: %.1e", stiffness, degree, error);
                QVERIFY(error < 1e-14);
            }
    }

    /// From the known moment at the base, and with the moment that leaves the tip free.
    void aCantileverConverges() {
        const System system = rod(1e8);
        for (const bool isFreed : {false, true}) {
            double before = 0, slope = 0;
            for (const int n : {4, 8, 16, 32}) {
                const double moment = isFreed ? momentFor(system, 1, n, -force, force * tipZ) : force * tipZ;
                const Tip tip = tipOf(system, 1, n, moment, -force);
                const double error = std::hypot(tip.y + tipY, tip.z - tipZ);
                slope = before > 0 ? std::log2(before / error) : 0;
                before = error;
                qInfo("%s, %d elements: %.3e, slope %.2f", isFreed ? "free tip" : "known moment", n, error,
                      slope);
                if (n > 4) QVERIFY(slope > 1.9 && slope < 2.1);
            }
            for (const int degree : {2, 3}) {
                const double moment =
                    isFreed ? momentFor(system, degree, 16, -force, force * tipZ) : force * tipZ;
                const Tip tip = tipOf(system, degree, 16, moment, -force);
                const double error = std::hypot(tip.y + tipY, tip.z - tipZ);
                qInfo("degree %d, 16 elements: %.1e", degree, error);
                QVERIFY(error < 1e-6);
            }
        }
    }

    /// A rod under this force has other forms of equilibrium, with other moments at its base.
    void otherEquilibriaExist() {
        const System system = rod(1e4);
        constexpr double large = 20;
        std::vector<double> moments;
        for (double guess = -14; guess <= 14; guess += 0.5) {
            const double found = momentFor(system, 3, 32, -large, guess);
            if (!(std::abs(tipOf(system, 3, 32, found, -large).moment) < 1e-8)) continue;
            if (std::none_of(moments.begin(), moments.end(),
                             [&](double m) { return std::abs(m - found) < 1e-3; })) {
                moments.push_back(found);
                qInfo("moment %.6f", found);
            }
        }
        QVERIFY(moments.size() >= 2);
    }
};

EXTREMAL_TEST(RodsTest)
}  // namespace extremal::rods_test

#include "rods_test.moc"
