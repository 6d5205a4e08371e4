// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanisms of other kinds than those that the schemes were made with, against closed forms, other
/// coordinates and an error-controlled code: a moving constraint with drag, a disc that rolls on a turntable,
/// a billiard in a magnetic field, and a closed loop that passes its flat position.
#include <QTest>

#include <cmath>
#include <complex>

#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::other_kinds_test {
namespace {

using mechanism_test::byRungeKutta;
using mechanism_test::distance;
using mechanism_test::Ending;
using mechanism_test::MeasuredOrder;
using mechanism_test::Mechanical;
using mechanism_test::orderOf;
using mechanism_test::run;
using mechanism_test::startAt;
using mechanism_test::typedWith;

/// A bead on a hoop that turns about the vertical and breathes, with a drag that is not linear.
Mechanical beadOnTurningHoop() {
    return startAt(typedWith({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - 9.81*z",
                             {{"constraints", Value::Object{{"plane", "x*sin(1.5*t) - y*cos(1.5*t)"},
                                                            {"hoop", "x^2+y^2+z^2-(1+0.1*sin(2*t))^2"}}},
                              {"forces", Value::Object{{"x", "-0.2*sqrt(x_t^2+y_t^2+z_t^2)*x_t"},
                                                       {"y", "-0.2*sqrt(x_t^2+y_t^2+z_t^2)*y_t"},
                                                       {"z", "-0.2*sqrt(x_t^2+y_t^2+z_t^2)*z_t"}}}}),
                   {std::sin(0.7), 0, -std::cos(0.7)},
                   {std::cos(0.7) * 0.4 + 0.2 * std::sin(0.7), 1.5 * std::sin(0.7),
                    std::sin(0.7) * 0.4 - 0.2 * std::cos(0.7)});
}
/// An upright disc on a turntable: conditions that are affine in velocities, with places in them, a drive and
/// a drag.
Mechanical discOnTurntable() {
    return startAt(typedWith({"x", "y", "heading", "spin"},
                             "(x_t^2+y_t^2)/2 + 0.15*heading_t^2 + 0.25*spin_t^2 - (x^2+y^2)/2",
                             {{"rolling", Value::Object{{"along", "x_t - 0.5*cos(heading)*spin_t + 0.6*y"},
                                                        {"across", "y_t - 0.5*sin(heading)*spin_t - 0.6*x"}}},
                              {"forces", Value::Object{{"spin", "0.4 - 0.1*spin_t"},
                                                       {"heading", "0.3*cos(t) - 0.05*heading_t"}}}}),
                   {0.4, 0.1, 0.3, 0},
                   {0.5 * std::cos(0.3) * 1.2 - 0.06, 0.5 * std::sin(0.3) * 1.2 + 0.24, 0.5, 1.2});
}
/// A parallelogram of two cranks of length 1 and a coupler of length 2, with masses 1 at its joints.
Mechanical parallelogram() {
    const double a = 0.9;
    return startAt(typedWith({"x", "y", "u", "w"}, "(x_t^2+y_t^2+u_t^2+w_t^2)/2 - 2*(y+w)",
                             {{"constraints", Value::Object{{"left", "x^2+y^2-1"},
                                                            {"right", "(u-2)^2+w^2-1"},
                                                            {"coupler", "(u-x)^2+(w-y)^2-4"}}}}),
                   {std::sin(a), -std::cos(a), 2 + std::sin(a), -std::cos(a)},
                   {3.5 * std::cos(a), 3.5 * std::sin(a), 3.5 * std::cos(a), 3.5 * std::sin(a)});
}

Mechanical named(const QString& name) {
    return name == "bead on a turning hoop" ? beadOnTurningHoop() : discOnTurntable();
}

}  // namespace

class OtherKindsTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        for (const char* name : {"bead on a turning hoop", "disc on a turntable"}) {
            QTest::addRow("%s, midpoint", name) << name << "galerkin-gauss-1" << 2 << 120;
            QTest::addRow("%s, Gauss 2", name) << name << "galerkin-gauss-2" << 4 << 40;
            QTest::addRow("%s, Lobatto 2", name) << name << "galerkin-lobatto-2" << 4 << 40;
            QTest::addRow("%s, Gauss 3", name) << name << "galerkin-gauss-3" << 6 << 20;
        }
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const Mechanical of = named(name);
        const MeasuredOrder m = orderOf(of, scheme.toStdString(), 3, steps);
        QVERIFY(m.isDone());
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; |g| %.0e, rate %.0e", m.error.q, m.error.p,
              m.q, m.p, m.fine.largestValue, m.fine.largestRate);
        QVERIFY(std::abs(m.q - order) < 0.3);
        QVERIFY(std::abs(m.p - order) < 0.3);
        QVERIFY(m.fine.largestValue < 1e-13 && m.fine.largestRate < 1e-13);
        // The work of forces and of conditions that move is what the energy changes by.
        const EnergyFunction energy = energyOf(of.system);
        const auto balance = [&](const Ending& r) {
            return std::abs(energy(r.state.t, r.state.x.data()) - energy(0, of.start.x.data()) - r.work);
        };
        qInfo("balance %.1e, %.1e", balance(m.coarse), balance(m.fine));
        QVERIFY(balance(m.fine) < 1e-12 ||
                std::abs(std::log2(balance(m.coarse) / balance(m.fine)) - order) < 0.5);
        QVERIFY(std::abs(m.fine.work) > 0.01);
    }

    /// In a uniform field between impacts on a circle the path is an arc, the same one each time: bounces
    /// turn by one angle, after one time. Canonical angular momentum and energy are invariants.
    void aBilliardInAMagneticField_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::newRow("midpoint") << "galerkin-gauss-1" << 2;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 4;
        QTest::newRow("Gauss 3") << "galerkin-gauss-3" << 6;
    }
    void aBilliardInAMagneticField() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        const double B = 0.8;
        const Mechanical of = startAt(typedWith({"x", "y"}, "(x_t^2+y_t^2)/2 + 0.4*(x*y_t - y*x_t)",
                                                {{"walls", Value::Object{{"rim", "1 - x^2 - y^2"}}}}),
                                      {0.2, -0.1}, {0.9, 0.5});
        // z'' = -i B z': z = c + r exp(-i B t); reflected about the tangent where |z| = 1.
        using Complex = std::complex<double>;
        const Complex i(0, 1);
        const double end = 12;
        Complex z(0.2, -0.1), v(0.9, 0.5);
        double t = 0;
        int bounces = 0;
        for (;;) {
            const Complex r = v / (-i * B), c = z - r;
            const auto place = [&](double s) { return c + r * std::exp(-i * B * s); };
            double from = 1e-9, to = from;
            while (std::abs(place(to)) < 1) from = to, to += 1e-3;
            for (int k = 0; k < 80; ++k) {
                const double middle = (from + to) / 2;
                (std::abs(place(middle)) < 1 ? from : to) = middle;
            }
            const double length = std::min(from, end - t);
            z = place(length);
            v = v * std::exp(-i * B * length);
            t += length;
            if (t >= end) break;
            ++bounces;
            const Complex normal = z / std::abs(z);
            v -= 2 * std::real(v * std::conj(normal)) * normal;
        }
        State reference = of.start;
        reference.x = {z.real(), z.imag(), v.real() - B / 2 * z.imag(), v.imag() + B / 2 * z.real()};
        double coarse = 0, fine = 0;
        Ending last;
        for (const double many : {1.0, 1.07, 1.15, 1.21, 1.34}) {
            const int n = static_cast<int>(many * (order == 6 ? 60 : 120));
            coarse = std::hypot(coarse, distance(run(of, scheme.toStdString(), end, n).state, reference).p);
            last = run(of, scheme.toStdString(), end, 2 * n);
            fine = std::hypot(fine, distance(last.state, reference).p);
        }
        const auto spin = [](const State& s) { return s.x[0] * s.x[3] - s.x[1] * s.x[2]; };
        qInfo("%d bounces (%d); errors %.1e, %.1e, order %.2f; angular momentum %.0e", last.impacts, bounces,
              coarse, fine, std::log2(coarse / fine), spin(last.state) - spin(of.start));
        QCOMPARE(last.impacts, bounces);
        QVERIFY(std::abs(std::log2(coarse / fine) - order) < 0.4);
        QVERIFY(std::abs(spin(last.state) - spin(of.start)) < 1e-12);
    }

    /// Both cranks have one angle, a'' = -2 sin a; a second assembly crosses it where the loop is flat.
    void aLoopThroughItsFlatPosition_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::newRow("midpoint") << "galerkin-gauss-1" << 2 << 201;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 4 << 101;
        QTest::newRow("Gauss 3") << "galerkin-gauss-3" << 6 << 51;
    }
    void aLoopThroughItsFlatPosition() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const Mechanical of = parallelogram();
        const Mechanical crank = startAt(typedWith({"a"}, "a_t^2/2 + 2*cos(a)", {}), {0.9}, {3.5});
        const double end = 4;
        const State angle = byRungeKutta(crank, end);
        const double a = angle.x[0], rate = angle.x[1];
        QVERIFY(a > 5);  // past a = pi/2 and 3 pi/2, where the loop is flat
        State reference = of.start;
        const double x = std::sin(a), y = -std::cos(a), vx = rate * std::cos(a), vy = rate * std::sin(a);
        reference.x = {x, y, 2 + x, y, vx, vy, vx, vy};
        const Ending coarse = run(of, scheme.toStdString(), end, steps),
                     fine = run(of, scheme.toStdString(), end, 2 * steps);
        QVERIFY(coarse.outcome == Outcome::converged && fine.outcome == Outcome::converged);
        const auto e = distance(coarse.state, reference), f = distance(fine.state, reference);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f", f.q, f.p, std::log2(e.q / f.q),
              std::log2(e.p / f.p));
        QVERIFY(std::abs(std::log2(e.q / f.q) - order) < 0.3);
        QVERIFY(std::abs(std::log2(e.p / f.p) - order) < 0.3);
    }
};

EXTREMAL_TEST(OtherKindsTest)
}  // namespace extremal::other_kinds_test
#include "other_kinds_test.moc"
