// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motion between kicks in coordinates and of wave functions: steps are stationary for the action as it
/// is written, which is evaluated here by differences of the energy alone; orders in q and p; refusals.
#include <QTest>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::free_coordinates_test {
namespace {

Discretization knots(const std::string& id) {
    return {{"free-motion", {{"knots", id}}, {}}, {"auto", {}, {}}, {}};
}
struct Table {
    const char* id;
    Splitting (*make)();
};
/// Strang steps with kicks and drifts exchanged.
Splitting kahanLi(int order) {
    const Settings composition{"kahan-li", {{"order", static_cast<double>(order)}}, {}};
    Splitting s = strangSteps(order, compositionParts(composition, 2));
    for (SplittingStage& stage : s.stages) stage.isKick = !stage.isKick;
    return s;
}
const Table tables[] = {{"strang", strang},
                        {"suzuki-4", suzuki4},
                        {"blanes-moan-s6", blanesMoanS6},
                        {"srkn-6b", srkn6b},
                        {"blanes-moan-s10", blanesMoanS10},
                        {"srkn-11b", srkn11b},
                        {"srkn-14a", srkn14a},
                        {"kahan-li-6", [] { return kahanLi(6); }},
                        {"kahan-li-8", [] { return kahanLi(8); }},
                        {"srkn-19a", srkn19a},
                        {"srkn-19b", srkn19b}};

struct Motion {
    const char* name;
    System system;
    State start;
    double end;
};
std::vector<Motion> motions() {
    std::vector<Motion> all;
    all.push_back({"Henon-Heiles", laws::systemNamed("henon-heiles"), {0, 0, {0, 0.1, 0.39, 0.1}}, 6});
    all.push_back({"Kepler", laws::systemNamed("kepler"), {0, 0, {0.7, 0, 0, 1.3}}, 4});
    // Unlike masses, and a potential that depends on time.
    Value::Object typed{{"coordinates", Value(Value::Array{"x", "y"})},
                        {"lagrangian", "x_t^2/2 + 3/2*y_t^2 - (1 + sin(2*t)/2)*cos(x - y) - x^4/4 - y^2/2"}};
    all.push_back({"typed", laws::systemNamed("lagrangian", typed), {0.3, 0, {0.4, -0.2, 0.5, 0.6}}, 4});
    return all;
}

/// dU/dx_i at a place, by central differences of order 8 of the energy at rest.
std::vector<double> slopeOf(const Mechanical& m, double t, std::vector<double> x) {
    const std::vector<double> rest(x.size());
    constexpr double step = 0.01;
    const double weights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
    std::vector<double> slopes(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double at = x[i];
        for (int k = 1; k <= 4; ++k)
            for (const int side : {-1, 1}) {
                x[i] = at + side * k * step;
                slopes[i] += side * weights[k - 1] * m.energy(m.model.get(), t, x.data(), rest.data()) / step;
            }
        x[i] = at;
    }
    return slopes;
}

}  // namespace

class FreeCoordinatesTest : public QObject {
    Q_OBJECT

    static void rows() {
        QTest::addColumn<int>("motion");
        QTest::addColumn<int>("table");
        const auto all = motions();
        for (int m = 0; m < static_cast<int>(all.size()); ++m)
            for (int k = 0; k < static_cast<int>(std::size(tables)); ++k)
                QTest::addRow("%s, %s", all[static_cast<std::size_t>(m)].name, tables[k].id) << m << k;
    }

private slots:
    void stepsAreStationary_data() { rows(); }
    /// Places x_k at the ends of the drifts a_k h; the kicks in between weigh b_k at x_k. The derivatives of
    /// S = sum m (x_k - x_(k-1))^2 / (2 a_k h) - h sum b_k U(x_k) are -p_0, 0 inside, and p_1.
    void stepsAreStationary() {
        QFETCH(int, motion);
        QFETCH(int, table);
        const Motion m = motions()[static_cast<std::size_t>(motion)];
        const Mechanical& mechanics = m.system.mechanics();
        const auto d = static_cast<std::size_t>(mechanics.dimension);
        const double h = 0.1;
        State state = m.start;
        const auto integrator = makeIntegrator(m.system, knots(tables[table].id), {m.start.t, h});
        QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);

        std::vector<double> drift, weight{0}, time{m.start.t};
        for (const SplittingStage& s : tables[table].make().stages) {
            if (s.isKick) {
                weight.back() += s.fraction;
                continue;
            }
            drift.push_back(s.fraction);
            weight.push_back(0);
            time.push_back(time.back() + s.fraction * h);
        }
        double most = 0;
        std::vector<double> x(m.start.x.begin(), m.start.x.begin() + static_cast<std::ptrdiff_t>(d)), p(d);
        // The first derivative gives x_1 from p_0, each further one the next place.
        for (std::size_t i = 0; i < d; ++i) p[i] = m.start.x[d + i];
        for (std::size_t k = 0;; ++k) {
            const std::vector<double> slopes = slopeOf(mechanics, time[k], x);
            for (std::size_t i = 0; i < d; ++i) p[i] -= h * weight[k] * slopes[i];
            if (k == drift.size()) break;
            for (std::size_t i = 0; i < d; ++i) x[i] += drift[k] * h * p[i] / mechanics.masses[i];
        }
        for (std::size_t i = 0; i < d; ++i) {
            most = std::max(most, std::abs(x[i] - state.x[i]));
            most = std::max(most, std::abs(p[i] - state.x[d + i]));
        }
        qInfo("%.1e", most);
        QVERIFY(most < 1e-12);
    }
    void ordersInPlaceAndMomentum_data() { rows(); }
    void ordersInPlaceAndMomentum() {
        QFETCH(int, motion);
        QFETCH(int, table);
        const Motion m = motions()[static_cast<std::size_t>(motion)];
        const Discretization scheme = knots(tables[table].id);
        const int order = describe(scheme, m.system).claims.order;
        QCOMPARE(order, tables[table].make().order);
        const auto endOf = [&](const Discretization& d, int n) {
            const auto integrator = makeIntegrator(m.system, d, {m.start.t, m.end / n});
            const auto end = laws::after(*integrator, m.start, n);
            return end.value().x;
        };
        const std::vector<double> exact = endOf(*namedScheme("galerkin-gauss-8"), 200);
        const std::size_t d = exact.size() / 2;
        std::vector<double> steps, places, momenta;
        for (int n = 4; n < 4000; n = static_cast<int>(std::ceil(1.3 * n))) {
            const std::vector<double> x = endOf(scheme, n);
            const double q = laws::distance(x, exact, 0, d), p = laws::distance(x, exact, d, 2 * d);
            if (!(q < 1e-3 && p < 1e-3)) continue;
            if (q < 2e-12 || p < 2e-12) break;
            steps.push_back(-std::log(n));
            places.push_back(std::log(q));
            momenta.push_back(std::log(p));
        }
        const auto last = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, steps.size()));
        QVERIFY(last >= 3);
        for (auto* v : {&steps, &places, &momenta}) v->erase(v->begin(), v->end() - last);
        qInfo("q %.2f, p %.2f", slope(steps, places), slope(steps, momenta));
        for (const double found : {slope(steps, places), slope(steps, momenta)})
            QVERIFY(std::abs(found - order) < 0.3);
    }
    void wavesOnTheirGrid() {
        const System system = laws::waveSystem(64, "20*(1 - cos(x))");
        const State start = laws::waveStart(system, 10, 1.2, 2);
        State exact = start;
        system.exact(start)(1, exact.x);
        for (const auto& [s, order] : {std::pair{1, 2}, {2, 4}, {3, 6}}) {
            const Discretization d = *namedScheme("free-motion-" + std::to_string(s));
            const double found = laws::timeOrder(
                [&](int n) {
                    const auto integrator = makeIntegrator(system, d, {0, 1.0 / n});
                    const State end = laws::after(*integrator, start, n).value();
                    return laws::waveDistance(end, exact);
                },
                3e-12);
            qInfo("order %.2f", found);
            QVERIFY(std::abs(found - order) < 0.3);
            const Properties p = describe(d, system);
            QVERIFY(std::isinf(p.stabilityLimit));
            QCOMPARE(p.claims.conserves, std::vector<std::string>{"norm"});
        }
    }
    void whatHasNoFreeMotionIsRefused() {
        const Discretization d = *namedScheme("free-motion-2");
        const auto refused = [&](const System& system, const char* because) {
            const std::string said = mismatch(d, system);
            qInfo("%s", said.c_str());
            QVERIFY2(said.find(because) != std::string::npos, said.c_str());
            QVERIFY_THROWS_EXCEPTION(InvalidScene, (void)makeIntegrator(system, d, {0, 0.1}));
        };
        refused(laws::systemNamed("spring-pendulum"), "a function of the momenta and one of the places");
        refused(laws::systemNamed("lagrangian", {{"coordinates", Value(Value::Array{"x", "y"})},
                                                 {"lagrangian", "(x_t^2 + y_t^2)/2 + x*y_t - y*x_t"}}),
                "a function of the momenta and one of the places");
        refused(laws::systemNamed("schrodinger", {{"boundary", "dirichlet"}}), "periodic domain");
        QVERIFY(isFor(d, laws::systemNamed("kepler")));
    }
};

EXTREMAL_TEST(FreeCoordinatesTest)

}  // namespace extremal::free_coordinates_test

#include "free_coordinates_test.moc"
