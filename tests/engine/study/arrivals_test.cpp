// SPDX-License-Identifier: GPL-3.0-or-later
/// Momenta with which motions arrive at a second position.
#include <QTest>

#include <cmath>

#include "engine/scene/write/codec.hpp"
#include "engine/study/orbits/arrivals.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::arrivals_test {
namespace {

ResolvedScene sceneOf(const std::string& model, const std::string& initial, const std::string& schemes) {
    const ReadScene read = readScene(R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial +
                                     R"(,"time":{"end":4},"schemes":[)" + schemes + "]}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

const char* const pendulum = R"({"type":"pendulum","m":1,"l":1,"g":1})";

}  // namespace

class ArrivalsTest : public QObject {
    Q_OBJECT
private slots:
    void everySchemeArrivesToRoundOff() {
        const ResolvedScene scene =
            sceneOf(R"({"type":"kepler"})", R"({"q":[1,0],"q1":[0,1],"at":1.5})",
                    R"({"step":0.1,"scheme":"galerkin-gauss-4"},{"step":0.03,"baseline":"stormer-verlet"},
                       {"step":0.05,"baseline":"rk4"},{"step":0.05,"scheme":"midpoint"})");
        const std::vector<Arrival> all = seekArrivals(scene, "", {});
        QCOMPARE(all.size(), std::size_t{4});
        std::vector<double> exact(4);
        for (const Arrival& each : all) {
            QVERIFY2(each.outcome == Outcome::converged, each.scheme.c_str());
            QVERIFY2(each.misses.back() < 4e-15, each.scheme.c_str());  // measured: 1.2e-15
            QVERIFY(each.misses.size() <= 6);
        }
        // By the exact solution, Gauss 8 has the momentum to 1e-11.
        scene.system->exact({0, 0, all[0].start, {}})(1.5, exact);
        QVERIFY(std::hypot(exact[0], exact[1] - 1) < 1e-9);
    }
    /// dq/dp_0 of an oscillator is sin t: 0 after half a turn, where all motions meet again.
    void theDeterminantIsThatOfTheLinearMotion() {
        for (const double at : {1., 3.}) {
            const ResolvedScene scene = sceneOf(R"({"type":"harmonic-oscillator","m":1,"k":1})",
                                                R"({"q":[0.5],"q1":[0.2],"at":)" + std::to_string(at) + "}",
                                                R"({"step":0.1,"scheme":"galerkin-gauss-4"})");
            const std::vector<Arrival> all = seekArrivals(scene, "", {});
            QVERIFY(std::abs(all[0].determinant - std::sin(at)) < 1e-12);
            QVERIFY(std::abs(all[0].start[1] - (0.2 - 0.5 * std::cos(at)) / std::sin(at)) < 1e-12);
        }
    }
    /// In 12 a pendulum may swing twice with a small amplitude, or once nearly to the top.
    void anotherGuessFindsAnotherMotion() {
        const ResolvedScene scene = sceneOf(pendulum, R"({"q":[0.2],"q1":[0.3],"at":12})",
                                            R"({"step":0.1,"scheme":"galerkin-gauss-4"})");
        const Arrival one = seekArrivals(scene, "", {1.95}).front(),
                      other = seekArrivals(scene, "", {0.3}).front();
        QVERIFY(one.outcome == Outcome::converged && other.outcome == Outcome::converged);
        QVERIFY(one.misses.back() < 1e-13 && other.misses.back() < 1e-13);
        QVERIFY(std::abs(one.start[1] - other.start[1]) > 0.1);
    }
    void whatCannotBeIsSaid() {
        const ResolvedScene swing =
            sceneOf(pendulum, R"({"q":[1],"p":[0]})", R"({"step":0.1,"scheme":"galerkin-gauss-4"})");
        QCOMPARE(pointerOf([&] { (void)seekArrivals(swing, "", {}); }), std::string("/initial"));
        const ResolvedScene scene = sceneOf(pendulum, R"({"q":[0.2],"q1":[0.3],"at":1})",
                                            R"({"step":0.1,"scheme":"galerkin-gauss-4"},
                                               {"label":"adaptive","tolerance":1e-8,"baseline":"dopri5"})");
        QCOMPARE(pointerOf([&] { (void)seekArrivals(scene, "", {1, 2}); }), std::string("--guess"));
        QCOMPARE(pointerOf([&] { (void)seekArrivals(scene, "adaptive", {}); }), std::string("--scheme"));
        QCOMPARE(seekArrivals(scene, "", {}).size(), std::size_t{1});
    }
};

EXTREMAL_TEST(ArrivalsTest)

}  // namespace extremal::arrivals_test

#include "arrivals_test.moc"
