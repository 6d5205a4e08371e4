// SPDX-License-Identifier: GPL-3.0-or-later
/// The charged particle against its equation of motion, and in uniform fields against the exact one.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::charged_particle_test {
namespace {

System particle(Value::Array A, Value phi, double m = 1, double charge = 1) {
    return laws::systemNamed("charged-particle", {{"vector_potential", Value(std::move(A))},
                                                  {"scalar_potential", std::move(phi)},
                                                  {"m", m},
                                                  {"charge", charge}});
}
std::vector<std::string> namesOfMomenta(const System& s) {
    std::vector<std::string> names;
    for (const MomentumMap& map : s.momenta) names.push_back(map.name);
    return names;
}
using Names = std::vector<std::string>;

/// Largest distance of a run of Gauss 12 from the exact motion.
double distanceFromExact(const System& s, State state) {
    const ExactSolution exact = s.exact(state);
    const auto step = makeIntegrator(s, *namedScheme("galerkin-gauss-6"), {0, 0.05});
    std::vector<double> x(6);
    double worst = 0;
    for (int k = 0; k < 400; ++k) {
        if (advance(*step, state).outcome != Outcome::converged) return 1e300;
        exact(state.t, x);
        worst = std::max(worst, laws::distance(state.x, x, 0, 6));
    }
    return worst;
}

}  // namespace

class ChargedParticleTest : public QObject {
    Q_OBJECT
private slots:
    void theExampleGoesRoundTheAxis() {
        const System s = particle({"-y/2", "x/2", "0"}, "0");
        const ExactSolution exact = s.exact({0, 0, {1, 0, 0, 0, -0.5, 0.1}});
        std::vector<double> x(6);
        for (const double t : {0.0, 0.7, 3.0, 50.0}) {
            exact(t, x);
            QVERIFY(std::abs(x[0] - std::cos(t)) < 1e-14 && std::abs(x[1] + std::sin(t)) < 1e-14);
            QVERIFY(std::abs(x[2] - 0.1 * t) < 1e-14);
        }
    }
    void uniformFieldsInAnyGauge() {
        // B = (0.3, -0.4, 1.2) and E = (0.1, 0.2, -0.05); the second A has the gradient of x y z + x^2 added.
        const char* phi = "-0.1*x - 0.2*y + 0.05*z";
        const State start{0, 0, {0.5, -0.2, 0.1, 0.4, 0.3, -0.6}};
        for (const Value::Array& A :
             {Value::Array{"(-0.4*z - 1.2*y)/2", "(1.2*x - 0.3*z)/2", "(0.3*y + 0.4*x)/2"},
              Value::Array{"(-0.4*z - 1.2*y)/2 + y*z + 2*x", "(1.2*x - 0.3*z)/2 + x*z",
                           "(0.3*y + 0.4*x)/2 + x*y"}}) {
            const System s = particle(A, phi, 0.8, -1.5);
            QVERIFY(s.exact);
            const double worst = distanceFromExact(s, start);
            qInfo("%.1e", worst);
            QVERIFY(worst < 1e-10);
        }
        const double worst = distanceFromExact(particle({"0", "0", "0"}, phi), start);
        QVERIFY2(worst < 1e-12, qPrintable(QString::number(worst)));
    }
    void exactOnlyWhereTheFieldsAreUniform() {
        QVERIFY(!particle({"-y*sqrt(x^2+y^2)/3", "x*sqrt(x^2+y^2)/3", "0"}, "0").exact);
        QVERIFY(!particle({"-y/2", "x/2", "0"}, "x^2/2").exact);
        QVERIFY(!particle({"-y/2*cos(t)", "x/2*cos(t)", "0"}, "0").exact);
        // Uniform where one usually looks.
        QVERIFY(!particle({"-y/2", "x/2", "0"}, "exp(-(x-50)^2)").exact);
        QVERIFY(!particle({"-y/2", "x/2 + exp(-(x-70)^2)*y", "0"}, "0").exact);
        QVERIFY(!particle({"-y/2", "x/2", "exp(-(t-50)^2)"}, "0").exact);
    }
    void momentaFollowTheSymmetry() {
        QCOMPARE(namesOfMomenta(particle({"-y/2", "x/2", "0"}, "0")), (Names{"z", "linear.z"}));
        QCOMPARE(namesOfMomenta(particle({"0", "x", "0"}, "0")), (Names{"linear.y", "linear.z"}));
        QCOMPARE(namesOfMomenta(
                     particle({"-y*sqrt(x^2+y^2)/3", "x*sqrt(x^2+y^2)/3", "0"}, "z/(100*sqrt(x^2+y^2))")),
                 Names{"z"});
        QCOMPARE(namesOfMomenta(particle({"-y/2", "x/2", "0"}, "(x^2 + 1.0000001*y^2)*z")), Names{});
        QCOMPARE(namesOfMomenta(particle({"-y/2", "x/2", "0"}, "exp(-(x-50)^2)")), Names{"linear.z"});
        QCOMPARE(namesOfMomenta(particle({"-y/2", "x/2", "0"}, "exp(-(x^2+y^2-2500)^2)")),
                 (Names{"z", "linear.z"}));
    }
    void momentaAreKept() {
        const System s =
            particle({"-y*sqrt(x^2+y^2)/3", "x*sqrt(x^2+y^2)/3", "0"}, "0.01/sqrt(x^2+y^2) + z^2/2");
        State state{0, 0, {0.2, -1, 0.1, 0.3, 0.1, 0.1}};
        const double before = s.momenta.at(0).value(state.x.data(), state.x.data() + 3);
        const auto step = makeIntegrator(s, *namedScheme("galerkin-gauss-2"), {0, 0.2});
        for (int k = 0; k < 500; ++k) QVERIFY(advance(*step, state).outcome == Outcome::converged);
        QVERIFY(std::abs(s.momenta[0].value(state.x.data(), state.x.data() + 3) - before) < 1e-12);
    }
    void mistakesAreNamed_data() {
        QTest::addColumn<QString>("first");
        QTest::addColumn<QString>("phi");
        QTest::addColumn<QString>("pointer");
        QTest::newRow("unknown name") << "-y/2 + w"
                                      << "0"
                                      << "/vector_potential/0";
        QTest::newRow("velocity") << "x_t"
                                  << "0"
                                  << "/vector_potential/0";
        QTest::newRow("dot") << "0"
                             << "dot(x)"
                             << "/scalar_potential";
        QTest::newRow("not closed") << "0"
                                    << "(x"
                                    << "/scalar_potential";
        QTest::newRow("escape") << "0"
                                << "0) + (x_t"
                                << "/scalar_potential";
    }
    void mistakesAreNamed() {
        QFETCH(QString, first);
        QFETCH(QString, phi);
        QFETCH(QString, pointer);
        try {
            (void)particle({first.toStdString(), "0", "0"}, phi.toStdString());
            QFAIL("not refused");
        } catch (const InvalidScene& e) {
            QCOMPARE(QString::fromStdString(e.problems().front().pointer), pointer);
        }
    }
};

EXTREMAL_TEST(ChargedParticleTest)
}  // namespace extremal::charged_particle_test

#include "charged_particle_test.moc"
