// SPDX-License-Identifier: GPL-3.0-or-later
/// What every scheme and baseline for rigid bodies claims, measured on the free body and on the top.
#include <QTest>

#include <algorithm>

#include "tests/laws/bodies.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::body_claims_test {
namespace {

/// Everything that fits the body: lie-1..3, pairs of their own, and each baseline in each of its orders.
std::vector<Case> everyBodyScheme(const System& system) {
    std::vector<Case> cases;
    for (const Case& c : everyScheme(3, system))
        if (c.isPair) cases.push_back(c);
    for (const int degree : {2, 3})
        for (const char* rule : {"gauss", "lobatto"}) {
            const Discretization discretization = liePair(degree, {rule, {}, {}}, true);
            cases.push_back({"symmetric lie " + std::string(rule) + " " + std::to_string(degree),
                             describe(discretization.space, discretization.quadrature).claims,
                             [discretization](const System& s, const Clock& c) {
                                 return makeIntegrator(s, discretization, c);
                             },
                             true});
        }
    for (const BaselineEntry& e : baselineCatalog()) {
        if (e.isAdaptive() || !appliesTo(e, system)) continue;
        std::vector<Settings> variants;
        for (const FieldInfo& f : e.item.parameters)
            if (f.key == "order")
                for (const char* order : {"2", "4", "6"})
                    variants.push_back({e.item.id, {{"order", std::stod(order)}}, {}});
            else if (f.key == "projection")
                for (const bool on : {true, false}) variants.push_back({e.item.id, {{"projection", on}}, {}});
        for (const Settings& keys : variants) {
            std::string name = e.item.id;
            if (keys.find("order")) name += " " + std::to_string(keys.integer("order"));
            if (keys.find("projection")) name += keys.flag("projection") ? " projected" : " unprojected";
            cases.push_back({name, claimsOf(e, keys), [make = e.make, keys](const System& s, const Clock& c) {
                                 return make(s, {c.step, {}, 0, keys});
                             }});
        }
    }
    return cases;
}

bool claims(const Case& c, const char* what) {
    return std::find(c.claims.conserves.begin(), c.claims.conserves.end(), what) != c.claims.conserves.end();
}

double symplecticDefect(const Case& scheme, const System& system, const State& start, double h,
                        double sign = 1) {
    return bodySymplecticDefect(
        [&](const State& s) {
            return after(*scheme.make(system, {0, h}), s, 1);
        },
        start, sign);
}

}  // namespace

class BodyClaimsTest : public QObject {
    Q_OBJECT
    const System free_ = standard().system(), top_ = laws::top().system();

    void addCases() {
        QTest::addColumn<bool>("isTop");
        QTest::addColumn<int>("index");
        for (const bool isTop : {false, true}) {
            const auto cases = everyBodyScheme(isTop ? top_ : free_);
            for (std::size_t i = 0; i < cases.size(); ++i)
                QTest::addRow("%s, %s", isTop ? "top" : "free", cases[i].name.c_str())
                    << isTop << static_cast<int>(i);
        }
    }
    const System& system() const {
        QFETCH(bool, isTop);
        return isTop ? top_ : free_;
    }
    Case current() const {
        QFETCH(int, index);
        return everyBodyScheme(system())[static_cast<std::size_t>(index)];
    }
    State start() const {
        QFETCH(bool, isTop);
        return bodyState(isTop ? laws::top().start : standard().start, {0.5, 0.5, -0.5, 0.5});
    }

private slots:
    void theOrderIsTheOneClaimed_data() { addCases(); }
    void theOrderIsTheOneClaimed() {
        const Case c = current();
        QFETCH(bool, isTop);
        const auto reference =
            after(*makeIntegrator(system(), liePair(8), {0, isTop ? 0.02 : 0.1}), start(), isTop ? 200 : 40);
        std::vector<double> h, attitude, momentum;
        for (double n = 3; n < 5000; n *= 1.3) {
            const auto steps = std::llround(n);
            const auto end = after(*c.make(system(), {0, 4.0 / static_cast<double>(steps)}), start(), steps);
            if (!end) continue;
            const auto& r = reference->x;
            const double a = attitudeError(end->x, {r[0], r[1], r[2], r[3]}),
                         p = momentumError(end->x, {r[4], r[5], r[6]});
            if (std::max(a, p) > 3e-3) continue;
            if (std::min(a, p) < 3e-12) break;
            h.push_back(-std::log(static_cast<double>(steps)));
            attitude.push_back(std::log(a));
            momentum.push_back(std::log(p));
        }
        const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
        for (auto* v : {&h, &attitude, &momentum}) v->erase(v->begin(), v->end() - points);
        QVERIFY2(points >= 3, "no window");
        const double a = slope(h, attitude), p = slope(h, momentum);
        qInfo("claimed %d, measured attitude %.2f, momentum %.2f", c.claims.order, a, p);
        QVERIFY(std::abs(a - c.claims.order) < 0.25);
        QVERIFY(std::abs(p - c.claims.order) < 0.25);
    }
    void momentumAndEnergyAreKeptWhereClaimed_data() { addCases(); }
    void momentumAndEnergyAreKeptWhereClaimed() {
        const Case c = current();
        const EnergyFunction energy = energyOf(system());
        State s = start();
        const State first = s;
        const auto integrator = c.make(system(), {0, 0.1});
        double momentum = 0, drift = 0, early = 0, late = 0;
        for (int k = 0; k < 20000; ++k) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            for (const MomentumMap& map : system().momenta)
                momentum = std::max(momentum, std::abs(map.value(s.x.data(), s.x.data()) -
                                                       map.value(first.x.data(), first.x.data())));
            drift = std::abs(energy(0, s.x.data()) - energy(0, first.x.data()));
            (k < 5000 ? early : k >= 15000 ? late : drift) = std::max(k < 5000 ? early : late, drift);
        }
        qInfo("momentum %.1e, energy %.1e early, %.1e late", momentum, early, late);
        if (claims(c, "momentum"))
            QVERIFY(momentum < 1e-12);
        else
            QVERIFY(momentum > 1e-9);
        if (claims(c, "energy"))
            QVERIFY(std::max(early, late) < 1e-13);
        else if (c.claims.isSymplectic)
            QVERIFY(late <= 1.05 * early + 1e-12);
        else
            QVERIFY(late > 2 * early);
    }
    void symmetricSchemesReturn_data() { addCases(); }
    void symmetricSchemesReturn() {
        const Case c = current();
        const auto there = after(*c.make(system(), {0, 0.25}), start(), 40);
        const auto back = after(*c.make(system(), {10, -0.25}), *there, 40);
        double defect = 0;
        for (std::size_t i = 0; i < 10; ++i) defect = std::max(defect, std::abs(back->x[i] - start().x[i]));
        qInfo("back to %.1e", defect);
        if (c.claims.isSymmetric)
            QVERIFY(defect < 2e-13);  // measured: at most 2.4e-14
        else
            QVERIFY(defect > 1e-12);  // lie-3 on the free body: 1.8e-12
    }
    void theStepIsSymplecticWhereClaimed_data() { addCases(); }
    void theStepIsSymplecticWhereClaimed() {
        const Case c = current();
        const double defect = symplecticDefect(c, system(), start(), 0.5),
                     broken = symplecticDefect(c, system(), start(), 0.5, -1);
        qInfo("|M^T w M - w| = %.1e; with the wrong sign of the bracket %.1e", defect, broken);
        QVERIFY(broken > 1e-3);  // the law can fail
        if (c.claims.isSymplectic)
            QVERIFY(defect < 2e-11);  // measured: at most 5e-12
        else
            QVERIFY(defect > 1e-8);  // moser-veselov 6: 3e-7
    }
};

EXTREMAL_TEST(BodyClaimsTest)
}  // namespace extremal::laws::body_claims_test

#include "body_claims_test.moc"
