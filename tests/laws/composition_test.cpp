// SPDX-License-Identifier: GPL-3.0-or-later
/// Compositions of any symmetric scheme, pairs and baselines alike: order, symmetry, symplecticity, momentum,
/// and what is lost where the parts are wrong or the scheme is not symmetric.
#include <QTest>

#include <algorithm>
#include <numeric>

#include "engine/integrator/composition.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/measured_order.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::composition_test {
namespace {

Settings to(const std::string& type, int order) {
    return {type, {{"order", static_cast<double>(order)}}, {}};
}

Case composedCase(const Case& scheme, const Settings& composition) {
    Case c = scheme;
    c.name = composition.type + "-" + std::to_string(composition.integer("order")) + " of " + scheme.name;
    c.claims = composedClaims(composition, scheme.claims);
    c.make = [make = scheme.make, parts = compositionParts(composition, scheme.claims.order)](
                 const System& s, const Clock& clock) { return composed(parts, *make(s, clock)); };
    return c;
}

/// Every symmetric scheme up to order 4, two and four orders up; those of order 2 also to orders 6 and 8 at
/// once.
std::vector<Case> everyComposition() {
    std::vector<Case> cases;
    for (const Case& c : everyScheme(2)) {
        if (!c.claims.isSymmetric || c.claims.order > 4) continue;
        for (const char* type : {"yoshida", "suzuki"})
            for (int order = c.claims.order + 2; order <= 6; order += 2)
                cases.push_back(composedCase(c, to(type, order)));
        for (const int order : {6, 8})
            if (c.claims.order == 2) cases.push_back(composedCase(c, to("kahan-li", order)));
    }
    return cases;
}

Case named(const std::string& name) {
    for (const Case& c : everyScheme(2))
        if (c.name == name) return c;
    return {};
}

/// Orders 6 of the splitting 1/6, 2/3, 1/6 have a leading error so small that on Kepler the next one
/// outweighs it, with the other sign, down to 1e-9: their order shows below. So do orders 8, of which 1e-11
/// is a large error.
Orders orderOf(const Case& scheme, const System& system, const State& start) {
    const double least = scheme.claims.order == 8                ? 2e-13
                         : scheme.name.ends_with("of splitting") ? 1e-12
                                                                 : 2e-11;
    return measure(
        system, start, 3, 1e-3,
        [&](double h) {
            return [integrator = std::shared_ptr<Integrator>(scheme.make(system, {0, h}))](State& state) {
                return advance(*integrator, state).outcome == Outcome::converged;
            };
        },
        least);
}

/// The order of a scheme of a scene for wave functions or bodies, from errors down to `least`.
double orderInScene(const std::string& ground, const std::string& scheme, double least, double& finest) {
    const auto errorOf = [&](int n) {
        const ReadScene read = readScene(ground + ",\"time\":{\"end\":1},\"schemes\":[{\"step\":\"1/" +
                                         std::to_string(n) + "\"," + scheme + "}]}");
        if (!read.errors.empty()) throw std::runtime_error(read.errors.front().message);
        const System system = makeSystem(read.scene);
        const State start = initialState(read.scene, system);
        const SchemeSpec& spec = read.scene.schemes.front();
        const auto end = after(*resolve(spec).make(system, spec.step.value, start), start, n);
        std::vector<double> exact(start.x.size());
        system.exact(start)(1, exact);
        finest = end ? distance(end->x, exact, 0, exact.size()) : 1e300;
        return finest;
    };
    return timeOrder(errorOf, least);
}

double returnDefect(const Case& scheme, const System& system) {
    const auto there = after(*scheme.make(system, {0, 0.1}), keplerStart, 300);
    if (!there) return 1e300;
    State back = *there;
    back.node = 0;
    const auto home = after(*scheme.make(system, {there->t, -0.1}), back, 300);
    return home ? distance(home->x, keplerStart.x, 0, 4) : 1e300;
}

}  // namespace

class CompositionTest : public QObject {
    Q_OBJECT
    const std::vector<Case> cases_ = everyComposition();
    const System kepler_ = systemNamed("kepler"), pendulum_ = systemNamed("pendulum");

    void addCases() {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < cases_.size(); ++i)
            QTest::addRow("%s", cases_[i].name.c_str()) << static_cast<int>(i);
    }
    const Case& current() const {
        QFETCH(int, index);
        return cases_[static_cast<std::size_t>(index)];
    }

private slots:
    void thePartsFulfilTheirConditions() {
        for (const char* type : {"yoshida", "suzuki"})
            for (const int from : {2, 4, 6}) {
                const std::vector<double> g = compositionParts(to(type, from + 2), from);
                double sum = 0, powers = 0;
                for (const double part : g) {
                    sum += part;
                    powers += std::pow(part, from + 1);
                }
                QCOMPARE(g.size(), std::size_t(std::string(type) == "yoshida" ? 3 : 5));
                QVERIFY(std::abs(sum - 1) < 1e-15 && std::abs(powers) < 1e-14);
                for (std::size_t i = 0; i < g.size(); ++i) QVERIFY(g[i] == g[g.size() - 1 - i]);
            }
        for (const int order : {6, 8}) {
            const std::vector<double> g = compositionParts(to("kahan-li", order), 2);
            QCOMPARE(g.size(), std::size_t(order == 6 ? 9 : 17));
            // The conditions of one order after the other that are of single powers, and their palindrome.
            for (int power = 1; power < order; power += 2) {
                double sum = 0;
                for (const double part : g) sum += std::pow(part, power);
                QVERIFY2(std::abs(sum - (power == 1)) < 1e-15, qPrintable(QString::number(sum)));
            }
            for (std::size_t i = 0; i < g.size(); ++i) QVERIFY(g[i] == g[g.size() - 1 - i]);
        }
        QCOMPARE(compositionParts(to("yoshida", 8), 2).size(), std::size_t(27));
        const std::vector<double> g = compositionParts(to("yoshida", 4), 2);
        QVERIFY(std::abs(g[0] - 1.3512071919596578) < 1e-15 && std::abs(g[1] + 1.7024143839193153) < 1e-15);
    }
    void everyCompositionHasItsOrder_data() { addCases(); }
    void everyCompositionHasItsOrder() {
        for (const bool isKepler : {true, false}) {
            const Orders o = orderOf(current(), isKepler ? kepler_ : pendulum_,
                                     isKepler ? keplerStart : State{0, 0, {2.0, 0.5}});
            qInfo("claimed %d, measured q %.3f, p %.3f (%d points)", current().claims.order, o.q, o.p,
                  o.points);
            QVERIFY2(o.points >= 3, "no window");
            // On Kepler 5.97 to 6.07 for order 6, 7.98 to 8.08 for order 8; on the pendulum, where four
            // points from 1e-9 on are all there is, 5.78 to 6.1. Of two of order 8 the next term of the error
            // outweighs the leading one on Kepler down to round-off: 8.24 and 8.51.
            const bool isLate = isKepler && current().claims.order == 8 &&
                                (current().name.ends_with("of splitting") ||
                                 current().name.ends_with("average-vector-field"));
            const double below = isKepler ? 0.15 : 0.3, above = isLate ? 0.7 : below;
            for (const double order : {o.q, o.p})
                QVERIFY(order > current().claims.order - below && order < current().claims.order + above);
        }
    }
    void wavesAndBodiesAreComposedAsWell_data() {
        QTest::addColumn<QString>("ground");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("least");
        const char* wave =
            R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x) "},)"
            R"("initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}})";
        const char* body =
            R"({"extremal":1,"model":{"type":"rigid-body"},"initial":{"attitude":[1,0,0,0],"momentum":[0.5,0.2,0.8]})";
        const auto row = [](const char* name, const char* ground, const char* scheme, int order,
                            double least = 1e-11) {
            QTest::newRow(name) << QString(ground) << QString(scheme) << order << least;
        };
        row("Gauss 2, suzuki", wave, R"("scheme":"schrodinger-gauss-1","composition":"suzuki")", 4);
        row("Gauss 2, yoshida", wave, R"("scheme":"schrodinger-gauss-1","composition":"yoshida")", 4);
        row("Gauss 4, yoshida", wave, R"("scheme":"schrodinger-gauss-2","composition":"yoshida")", 6);
        row("slabs, yoshida", wave,
            R"("space":{"type":"space-time","degree":1,"slabs":2},"composition":"yoshida")", 4);
        row("Crank-Nicolson, suzuki", wave, R"("baseline":"crank-nicolson","composition":"suzuki")", 4);
        row("Strang, suzuki", wave, R"("baseline":"strang","composition":"suzuki")", 4);
        row("Lie 2, suzuki", body, R"("scheme":"lie-symmetric-1","composition":"suzuki")", 4);
        row("splitting, yoshida", body, R"("baseline":"rigid-splitting","composition":"yoshida")", 4);
        // Of degree 8, as by default, the order is 10, which leaves no window. GMRES solves to 1e-13: below
        // 1e-10 the error grows with the number of steps.
        row("collocation, suzuki", wave,
            R"("baseline":{"type":"spectral-collocation","degree":2,"nodes":"roots"},"composition":"suzuki")",
            4, 1e-9);
        // 9e-11 after two steps already.
        row("Lie 4, yoshida", body, R"("scheme":"lie-symmetric-2","composition":"yoshida")", 6, 1e-14);
    }
    void wavesAndBodiesAreComposedAsWell() {
        QFETCH(QString, ground);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(double, least);
        double finest = 0;
        const double measured = orderInScene(ground.toStdString(), scheme.toStdString(), least, finest);
        qInfo("order %.2f of %d, down to %.1e", measured, order, finest);
        QVERIFY(std::abs(measured - order) < 0.3);
    }
    void schemesOfMoreLevelsAreRefused() {
        for (const char* scheme : {R"("scheme":"schrodinger-three-level")", R"("baseline":"leapfrog")"}) {
            const ReadScene read = readScene(
                R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x) "},)"
                R"("initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}},)"
                R"("time":{"end":1},"schemes":[{"step":0.001,)" +
                std::string(scheme) + R"(,"composition":"suzuki"}]})");
            QCOMPARE(read.errors.size(), std::size_t{1});
            QCOMPARE(read.errors[0].pointer, std::string("/schemes/0/composition"));
            QVERIFY(read.errors[0].message.find("one-step") != std::string::npos);
        }
    }
    void wrongPartsGainNothing() {
        // The parts for a scheme of order 4, on one of order 2: their cubes do not sum to zero.
        const Case midpoint = named("midpoint");
        Case broken = midpoint;
        broken.make = [make = midpoint.make](const System& s, const Clock& clock) {
            return composed(compositionParts(to("yoshida", 6), 4), *make(s, clock));
        };
        const Orders o = orderOf(broken, kepler_, keplerStart);
        qInfo("measured %.3f", o.q);
        QVERIFY(o.points >= 3 && std::abs(o.q - 2) < 0.2);
    }
    void schemesThatAreNotSymmetricGainNoTwoOrders() {
        const Case euler = named("symplectic-euler");
        QVERIFY(!euler.claims.isSymmetric);
        std::string hint;
        QVERIFY(!compositionRefusal(to("yoshida", 4), euler.claims, hint).empty() && !hint.empty());
        Case forced = euler;
        forced.make = [make = euler.make](const System& s, const Clock& clock) {
            return composed(compositionParts(to("yoshida", 4), 2), *make(s, clock));
        };
        const Orders o = measure(kepler_, keplerStart, 3, 3e-2, [&](double h) {
            return [step = std::shared_ptr<Integrator>(forced.make(kepler_, {0, h}))](State& state) {
                return advance(*step, state).outcome == Outcome::converged;
            };
        });
        qInfo("measured %.3f", o.q);
        QVERIFY(o.points >= 3 && o.q < 1.5);
    }
    void compositionsReturn_data() { addCases(); }
    void compositionsReturn() {
        const double defect = returnDefect(current(), kepler_);
        qInfo("back at the start to %.2e", defect);
        QVERIFY(defect < 1e-9);
    }
    void partsThatAreNoPalindromeDoNotReturn() {
        Case broken = named("midpoint");
        broken.make = [make = broken.make](const System& s, const Clock& clock) {
            return composed({0.1, 0.2, 0.7}, *make(s, clock));
        };
        QVERIFY(returnDefect(broken, kepler_) > 1e-6);
    }
    void momentumIsKept_data() { addCases(); }
    void momentumIsKept() {
        const auto end = after(*current().make(kepler_, {0, 0.05}), keplerStart, 1000);
        QVERIFY(end);
        const double L = end->x[0] * end->x[3] - end->x[1] * end->x[2];
        qInfo("|L - L(0)| = %.2e", std::abs(L - 0.8));
        const auto& kept = current().claims.conserves;
        if (std::find(kept.begin(), kept.end(), "momentum") != kept.end()) QVERIFY(std::abs(L - 0.8) < 1e-12);
    }
    void theCurveIsThatOfShorterSteps() {
        // Order 4 inside the step as well: a chord would be off by h^2.
        const Case c = composedCase(named("midpoint"), to("suzuki", 4));
        const ExactSolution exact = kepler_.exact(keplerStart);
        std::vector<double> errors;
        for (const double h : {0.1, 0.05}) {
            const auto step = c.make(kepler_, {0, h});
            State state = keplerStart;
            double worst = 0;
            std::vector<double> x(4), e(4);
            for (int k = 0; k < static_cast<int>(std::lround(1 / h)); ++k) {
                QVERIFY(advance(*step, state).outcome == Outcome::converged);
                for (const double tau : {0.0, 0.25, 0.5, 0.8, 1.0}) {
                    step->denseOutput(tau, x);
                    exact(state.t - (1 - tau) * h, e);
                    worst = std::max(worst, distance(x, e, 0, 4));
                }
            }
            errors.push_back(worst);
        }
        const double order = std::log2(errors[0] / errors[1]);
        qInfo("order of the curve %.2f, error %.2e", order, errors[1]);
        QVERIFY(order > 3.5);
    }
    void aStepThatFailsLeavesTheState() {
        const Case c = composedCase(named("midpoint"), to("yoshida", 4));
        const auto step = c.make(kepler_, {0, 1e3});
        State state{0, 0, {1e-9, 0, 0, 0}};
        const State before = state;
        if (advance(*step, state).outcome != Outcome::converged) QCOMPARE(state.x, before.x);
        QVERIFY(state.node == 0 ? state.t == 0 : state.t == 1e3);
    }
    void scenesSayWhatIsComposed() {
        const auto read = [](const std::string& scheme) {
            return readScene(std::string_view(
                R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},)"
                R"("time":{"end":1},"schemes":[{"step":0.05,)" +
                scheme + "}]}"));
        };
        const ReadScene plain = read(R"("baseline":"stormer-verlet","composition":"yoshida")");
        QVERIFY(plain.errors.empty());
        QCOMPARE(resolve(plain.scene.schemes[0]).claims.order, 4);
        QCOMPARE(plain.scene.schemes[0].label, std::string("stormer-verlet, yoshida 4"));
        QCOMPARE(readScene(std::string_view(writeScene(plain.scene))).scene, plain.scene);
        QVERIFY(!resolve(read(R"("scheme":"midpoint","composition":"suzuki")").scene.schemes[0]).plain());
        const auto pointerOf = [&](const std::string& scheme) {
            const ReadScene r = read(scheme);
            return r.errors.size() == 1 ? r.errors[0].pointer : std::string("?");
        };
        QCOMPARE(pointerOf(R"("baseline":"rk4","composition":"yoshida")"),
                 std::string("/schemes/0/composition"));
        QCOMPARE(pointerOf(R"("scheme":"midpoint","composition":{"type":"yoshida","order":5})"),
                 std::string("/schemes/0/composition/order"));
        QCOMPARE(pointerOf(R"("scheme":"galerkin-gauss-3","composition":{"type":"suzuki","order":4})"),
                 std::string("/schemes/0/composition/order"));
        QCOMPARE(pointerOf(R"("scheme":"midpoint","composition":{"type":"suzuki","order":12})"),
                 std::string("/schemes/0/composition/order"));
        QCOMPARE(pointerOf(R"("scheme":"midpoint","composition":"yosida")"),
                 std::string("/schemes/0/composition"));
    }
    void stabilityLimitsAreThoseOfTheParts() {
        const auto limit = [](const std::string& scheme) {
            const ReadScene r = readScene(std::string_view(
                R"({"extremal":1,"model":{"type":"harmonic-oscillator"},"initial":{"q":[1]},"time":{"end":1},"schemes":[{"step":0.05,)" +
                scheme + "}]}"));
            return resolve(r.scene.schemes[0]).stabilityLimit();
        };
        const double yoshida = limit(R"("baseline":"stormer-verlet","composition":"yoshida")");
        const double suzuki = limit(R"("baseline":"stormer-verlet","composition":"suzuki")");
        qInfo("Yoshida 4 of Verlet: %.4f, Suzuki 4: %.4f", yoshida, suzuki);
        QVERIFY(std::abs(limit(R"("baseline":"stormer-verlet")") - 2) < 1e-12);
        QVERIFY(std::isinf(limit(R"("scheme":"midpoint","composition":"yoshida")")));
        // The trace of three maps of Verlet, multiplied out, leaves [-2, 2] at 1.5734.
        QVERIFY(std::abs(yoshida - 1.5734) < 1e-4);
        QVERIFY(std::abs(suzuki - 2.7210) < 1e-4);
    }
};

EXTREMAL_TEST(CompositionTest)
}  // namespace extremal::laws::composition_test

#include "composition_test.moc"
