// SPDX-License-Identifier: GPL-3.0-or-later
/// Phase spaces of kinds that the design page does not list: a relativistic charge in a travelling wave, a
/// Hamiltonian with a singular H_pp, a charge on a paraboloid with a form in an awkward gauge, and a bracket
/// of Nambu with a Casimir of degree four. References are of long double, of equations written by hand.
#include <QTest>

#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/other_routes.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::further_phase_spaces_test {
namespace {

using Real = long double;
using Reals = std::vector<Real>;
using Rates = std::function<void(Real t, const Reals& x, Reals& dx)>;

/// The method of Gragg, Bulirsch and Stoer with 2, 4, .. 16 midpoint steps in each of some steps: order 16.
Reals extrapolated(const Rates& rates, Reals x, Real end, int steps = 160) {
    const Real H = end / steps;
    Reals dx(x.size());
    for (int step = 0; step < steps; ++step) {
        std::vector<Reals> row;
        for (int k = 1; k <= 8; ++k) {
            const int n = 2 * k;
            const Real h = H / n, t = H * step;
            Reals before = x, now = x;
            rates(t, x, dx);
            for (std::size_t i = 0; i < x.size(); ++i) now[i] += h * dx[i];
            for (int j = 1; j < n; ++j) {
                rates(t + j * h, now, dx);
                for (std::size_t i = 0; i < x.size(); ++i)
                    before[i] = std::exchange(now[i], before[i] + 2 * h * dx[i]);
            }
            rates(t + H, now, dx);
            for (std::size_t i = 0; i < x.size(); ++i) now[i] = (now[i] + before[i] + h * dx[i]) / 2;
            // Neville's scheme in h^2: row[m] has been extrapolated m times.
            std::vector<Reals> next{now};
            for (int m = 1; m < k; ++m) {
                const auto last = static_cast<std::size_t>(m - 1);
                const Real ratio = static_cast<Real>(k) / (k - m), factor = 1 / (ratio * ratio - 1);
                Reals value = next[last];
                for (std::size_t i = 0; i < x.size(); ++i) value[i] += factor * (value[i] - row[last][i]);
                next.push_back(value);
            }
            row = std::move(next);
        }
        x = row.back();
    }
    return x;
}

/// A problem, and its equations of motion by hand.
struct Case {
    System system;
    State start;
    Rates rates;
    int half = 0;  ///< entries of q; of p are the others. 0: the state has no such halves
};

System typedModel(const char* type, Settings settings) {
    return laws::systemNamed(type, std::move(settings.keys));
}

/// H = sqrt(1 + (p_x - A)^2 + (p_y + B)^2), A = .4 sin(2 x - 1.5 t), B = .3 cos(x + y).
Case travellingWave() {
    return {
        typedModel("hamiltonian",
                   {"",
                    {{"coordinates", Value::Array{"x", "y"}},
                     {"parameters", Value(Value::Object{})},
                     {"hamiltonian", "sqrt(1 + (p_x - .4*sin(2*x - 1.5*t))^2 + (p_y + .3*cos(x + y))^2)"}},
                    {}}),
        {0, 0, {0.3, -0.2, 0.8, 0.5}},
        [](Real t, const Reals& x, Reals& dx) {
            const Real A = 0.4L * std::sin(2 * x[0] - 1.5L * t), slope = 0.8L * std::cos(2 * x[0] - 1.5L * t),
                       u = x[2] - A, w = x[3] + 0.3L * std::cos(x[0] + x[1]),
                       fall = -0.3L * std::sin(x[0] + x[1]), gamma = std::sqrt(1 + u * u + w * w);
            dx = {u / gamma, w / gamma, (u * slope - w * fall) / gamma, -w * fall / gamma};
        },
        2};
}
/// H_pp = diag(e^y, 0) everywhere: no Legendre transform, and not linear in p either.
Case singularMasses() {
    return {typedModel("hamiltonian", {"",
                                       {{"coordinates", Value::Array{"x", "y"}},
                                        {"parameters", Value(Value::Object{})},
                                        {"hamiltonian", "exp(y)*p_x^2/2 + p_y*sin(x) + y^2/2 + cos(x)/2"}},
                                       {}}),
            {0, 0, {0.4, 0.1, 0.7, -0.3}},
            [](Real, const Reals& x, Reals& dx) {
                dx = {std::exp(x[1]) * x[2], std::sin(x[0]), -x[3] * std::cos(x[0]) + std::sin(x[0]) / 2,
                      -std::exp(x[1]) * x[2] * x[2] / 2 - x[1]};
            },
            2};
}
/// On z = (x^2 + y^2)/2 with velocities' momenta (u, w), in the field B = (1 + x^2)/2 + (1 + y^2)/3. To the
/// form is added d chi, chi = x u^2/2 + y u w + .3 x y w, so that every variable has a velocity in L.
Case onAParaboloid() {
    return {typedModel("phase-space",
                       {"",
                        {{"variables", Value::Array{"u", "x", "w", "y"}},
                         {"parameters", Value(Value::Object{})},
                         {"one_form", Value::Object{{"x", "u - y*(1 + x^2)/2 + u^2/2 + .3*y*w"},
                                                    {"y", "w + x*(1 + y^2)/3 + u*w + .3*x*w"},
                                                    {"u", "x*u + y*w"},
                                                    {"w", "y*u + .3*x*y"}}},
                         {"hamiltonian", "(u^2 + w^2 - (x*u + y*w)^2/(1 + x^2 + y^2))/2 + (x^2 + y^2)/4"}},
                        {}}),
            {0, 0, {0.3, 0.5, -0.4, 0.2}},
            [](Real, const Reals& at, Reals& dx) {
                const Real u = at[0], x = at[1], w = at[2], y = at[3], D = 1 + x * x + y * y,
                           s = (x * u + y * w) / D, B = (1 + x * x) / 2 + (1 + y * y) / 3, dx_ = u - s * x,
                           dy = w - s * y;
                dx = {B * dy + s * u - s * s * x - x / 2, dx_, -B * dx_ + s * w - s * s * y - y / 2, dy};
            }};
}
constexpr const char* nambuModel = R"json({"type": "poisson", "variables": ["x", "y", "z"],
    "bracket": {"x,y": "z^3 + x/3", "y,z": "x^3 + z/3", "z,x": "y^3"},
    "hamiltonian": "x^2/2 + y^2 + .75*z^2 + .2*x*y",
    "casimirs": {"C": "(x^4 + y^4 + z^4)/4 + x*z/3"}})json";
/// x' = grad C x grad H up to sign, as of Nambu.
Case nambu() {
    Case made{{}, {0, 0, {0.7, 0.5, -0.6, 0}}, [](Real, const Reals& at, Reals& dx) {
                  const Real x = at[0], y = at[1], z = at[2], Cx = x * x * x + z / 3, Cy = y * y * y,
                             Cz = z * z * z + x / 3, Hx = x + 0.2L * y, Hy = 2 * y + 0.2L * x, Hz = 1.5L * z;
                  dx = {Cz * Hy - Cy * Hz, Cx * Hz - Cz * Hx, Cy * Hx - Cx * Hy};
              }};
    return made;
}

Case caseOf(const QString& name) {
    if (name == "wave") return travellingWave();
    return name == "singular" ? singularMasses() : onAParaboloid();
}

std::vector<double> referenceOf(const Case& of, double end) {
    const std::size_t n = of.half > 0 ? of.start.x.size() : std::min<std::size_t>(4, of.start.x.size());
    Reals x(of.start.x.begin(), of.start.x.begin() + static_cast<std::ptrdiff_t>(n));
    const Reals there = extrapolated(of.rates, std::move(x), end);
    return {there.begin(), there.end()};
}
/// The largest error of the first entries, and of the others.
struct Errors {
    double q = 0, p = 0;
};
Errors errorsOf(const State& state, const std::vector<double>& reference, int half) {
    Errors found;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        double& part = static_cast<int>(i) < half || half == 0 ? found.q : found.p;
        part = std::max(part, std::abs(state.x[i] - reference[i]));
    }
    if (half == 0) found.p = found.q;
    return found;
}

State ending(const Case& of, Integrator& integrator, int steps) {
    const auto found = laws::after(integrator, of.start, steps);
    if (!found) qFatal("a step failed");
    return *found;
}
/// max |M^T Om_1 M - Om_0| / |M|^2 of the first steps.
double defect(const Case& of, Integrator& integrator) {
    double worst = 0;
    State s = of.start;
    for (int k = 0; k < 10; ++k) {
        const State before = s;
        if (advance(integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        const auto M = tangentMap(integrator);
        if (!M) qFatal("no tangent map");
        worst = std::max(worst, formDefect(SymplecticForm(of.system), before.x.data(), s.x.data(), *M) /
                                    std::max(1.0, std::pow(M->cwiseAbs().maxCoeff(), 2)));
    }
    return worst;
}

std::string nambuScene(const std::string& scheme) {
    return std::string(R"({"extremal": 1, "model": )") + nambuModel +
           R"(, "initial": {"x": [0.7, 0.5, -0.6]}, "time": {"end": 4}, "reference": "none", "schemes": [)" +
           scheme + "]}";
}

}  // namespace

class FurtherPhaseSpacesTest : public QObject {
    Q_OBJECT
private slots:
    /// By the engine's own equations, from formulas that were differentiated by the program.
    void theReferencesAgree_data() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"wave", "singular", "paraboloid"}) QTest::addRow("%s", name) << name;
    }
    void theReferencesAgree() {
        QFETCH(QString, name);
        const Case of = caseOf(name);
        const State there = endByRungeKutta(of.system, of.start, 2);
        const Errors apart = errorsOf(there, referenceOf(of, 2), of.half);
        qInfo("%.1e, %.1e", apart.q, apart.p);
        QVERIFY(apart.q < 1e-11 && apart.p < 1e-11);
    }
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("rule");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("nodes");
        for (const char* name : {"wave", "singular", "paraboloid"})
            for (int s = 1; s <= 3; ++s) {
                QTest::addRow("%s, G(%d) of %d", name, s, s) << name << "gauss" << s << s;
                QTest::addRow("%s, G(%d) of %d", name, s + 1, s) << name << "gauss" << s << s + 1;
                QTest::addRow("%s, L(%d) of %d", name, s + 1, s) << name << "lobatto" << s << s + 1;
            }
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(QString, rule);
        QFETCH(int, degree);
        QFETCH(int, nodes);
        const Case of = caseOf(name);
        const Discretization d =
            laws::polynomialPair(degree, {rule.toStdString(), {{"nodes", static_cast<double>(nodes)}}, {}});
        const auto claims = describe(d, of.system).claims;
        QCOMPARE(claims.order, 2 * degree);
        QVERIFY(claims.isSymplectic);
        const std::vector<double> reference = referenceOf(of, 2);
        const int steps = degree == 1 ? 160 : degree == 2 ? 48 : 16;
        const auto errorsWith = [&](int n) {
            const auto integrator = makeIntegrator(of.system, d, {0, 2.0 / n});
            return errorsOf(ending(of, *integrator, n), reference, of.half);
        };
        const Errors coarse = errorsWith(steps), fine = errorsWith(2 * steps);
        const double q = std::log2(coarse.q / fine.q), p = std::log2(coarse.p / fine.p);
        const auto integrator = makeIntegrator(of.system, d, {0, 0.1});
        const double form = defect(of, *integrator);
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; defect %.0e", fine.q, fine.p, q, p, form);
        QVERIFY(std::abs(q - 2 * degree) < 0.25);
        QVERIFY(std::abs(p - 2 * degree) < 0.25);
        QVERIFY(form <= 1e-13);
    }
    /// Of the same order, but without the form.
    void othersLoseTheForm_data() { theReferencesAgree_data(); }
    void othersLoseTheForm() {
        QFETCH(QString, name);
        const Case of = caseOf(name);
        const bool isCanonical = of.half > 0;
        const Settings other =
            isCanonical ? Settings{"rk4", {}, {}} : Settings{"gauss-collocation", {{"stages", 2.0}}, {}};
        const auto integrator = findBaseline(other.type)->make(of.system, {0.1, of.start, 0, other});
        const double lost = defect(of, *integrator);
        qInfo("%.1e", lost);
        QVERIFY(lost > 1e-9);
    }
    /// A half of the variables that the form is free of is found among variables in any order.
    void theGaugeOfTheParaboloidIsFound() {
        const Case of = onAParaboloid();
        const OneForm& form = of.system.part<OneForm>();
        QVERIFY(form.hasPlane() && form.gauged);
        QCOMPARE(form.free.size(), std::size_t(2));
    }
    /// H changes with t: there is nothing to keep.
    void theEnergyOfTheWaveIsNotKept() {
        const ReadScene read = readScene(std::string_view(R"json({"extremal": 1, "model": {
            "type": "hamiltonian", "coordinates": ["x"], "hamiltonian": "sqrt(1 + (p_x - .4*sin(2*x - 1.5*t))^2)"},
            "initial": {"q": [0.3], "p": [0.8]}, "time": {"end": 1}, "reference": "none",
            "schemes": [{"scheme": "galerkin-gauss-2", "keep": "energy", "step": 0.1}]})json"));
        QVERIFY(!read.errors.empty());
        QCOMPARE(read.errors[0].pointer, std::string("/schemes/0/keep/0"));
        QVERIFY(read.errors[0].message.find("the Hamiltonian depends on time") != std::string::npos);
    }
    /// A Casimir of degree four: Gauss loses it and keeps the quadratic energy, a list keeps both; both have
    /// order 2s.
    void nambu_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<bool>("isKept");
        for (int s = 1; s <= 3; ++s) {
            QTest::addRow("Gauss, %d", s) << s << false;
            QTest::addRow("kept, %d", s) << s << true;
        }
    }
    void nambu() {
        QFETCH(int, degree);
        QFETCH(bool, isKept);
        const Case of = further_phase_spaces_test::nambu();
        Reals x(of.start.x.begin(), of.start.x.begin() + 3);
        const Reals there = extrapolated(of.rates, std::move(x), 4);
        const auto schemeWith = [&](int steps) {
            return "{\"scheme\": \"galerkin-gauss-" + std::to_string(degree) +
                   "\", \"step\": " + std::to_string(4.0 / steps) +
                   (isKept ? ", \"keep\": [\"energy\", \"casimir.C\"]}" : "}");
        };
        const auto errorWith = [&](int steps) {
            const std::vector<double> end = tests::after(readScene(nambuScene(schemeWith(steps))), steps);
            if (end.empty()) qFatal("a step failed");
            double error = 0;
            for (std::size_t i = 0; i < 3; ++i)
                error = std::max(error, std::abs(end[i] - static_cast<double>(there[i])));
            return error;
        };
        const int steps = degree == 1 ? 320 : degree == 2 ? 80 : 40;
        const double fine = errorWith(2 * steps), order = std::log2(errorWith(steps) / fine);
        const ReadScene read = readScene(nambuScene(schemeWith(80)));
        const auto integrator = tests::integratorOf(read);
        State s = read.resolved->initial;
        integrator->begin(s);
        const auto C = [](const State& at) {
            const double a = at.x[0], b = at.x[1], c = at.x[2];
            return (a * a * a * a + b * b * b * b + c * c * c * c) / 4 + a * c / 3;
        };
        const auto H = [](const State& at) {
            const double a = at.x[0], b = at.x[1], c = at.x[2];
            return a * a / 2 + b * b + .75 * c * c + .2 * a * b;
        };
        double lostC = 0, lostH = 0;
        const double startC = C(s), startH = H(s);
        for (int k = 0; k < 2000; ++k) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            lostC = std::max(lostC, std::abs(C(s) - startC));
            lostH = std::max(lostH, std::abs(H(s) - startH));
        }
        qInfo("error %.1e, order %.2f; H %.0e, Casimir %.1e", fine, order, lostH, lostC);
        QVERIFY(std::abs(order - 2 * degree) < 0.25);
        QVERIFY(lostH < 5e-15);  // 4e-16
        if (isKept)
            QVERIFY(lostC < 1e-15);  // 8e-17
        else
            QVERIFY(lostC > (degree == 1 ? 1e-6 : degree == 2 ? 1e-9 : 1e-13));  // 3e-6, 2e-9, 4e-13
    }
};

EXTREMAL_TEST(FurtherPhaseSpacesTest)
}  // namespace extremal::further_phase_spaces_test

#include "further_phase_spaces_test.moc"
