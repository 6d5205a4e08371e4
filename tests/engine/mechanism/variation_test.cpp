// SPDX-License-Identifier: GPL-3.0-or-later
/// Variations of states carried along by steps with constraints, rolling conditions, forces and impacts: they
/// are the derivatives of the steps, keep the symplectic form along constraints, and shrink volumes by what
/// forces say.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/integrator/variation/with_exponents.hpp"
#include "engine/integrator/variation/with_variations.hpp"
#include "engine/mechanism/tangent_space.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/symmetry/conserved.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_variation_test {
namespace {

using Matrix = Eigen::MatrixXd;
using mechanism_test::Mechanical;
using mechanism_test::startAt;
using mechanism_test::typed;
using mechanism_test::typedWith;

const Value::Object drag{{"x", "-0.3*x_t*sqrt(x_t^2+y_t^2+z_t^2)"},
                         {"y", "-0.3*y_t*sqrt(x_t^2+y_t^2+z_t^2)+sin(t)"}};

Mechanical named(const std::string& name) {
    if (name == "ball on a rod") return mechanism_test::sphericalPendulum();
    if (name == "two rods") return mechanism_test::doublePendulum();
    if (name == "winch") return mechanism_test::winch();
    if (name == "torus") return mechanism_test::chargeOnTorus();
    if (name == "rod and drag") return mechanism_test::sphericalPendulum(drag);
    if (name == "van der Pol")
        return startAt(typed({"x"}, "(x_t^2 - x^2)/2", {}, {{"x", "2*(1-x^2)*x_t + sin(t)"}}), {1}, {0.5});
    if (name == "blade")
        return startAt(typedWith({"x", "y", "phi"}, "(x_t^2+y_t^2)/2 + phi_t^2/5 + x/2 - y^2/3",
                                 {{"rolling", Value::Object{{"blade", "x_t*sin(phi)-y_t*cos(phi)"}}}}),
                       {0.1, 0.2, 0.3}, {std::cos(0.3), std::sin(0.3), 0.8});
    if (name == "post")
        return startAt(typedWith({"theta"}, "theta_t^2/2 + 9.81*cos(theta)",
                                 {{"walls", Value::Object{{"post", Value::Object{{"gap", "theta + 0.5"},
                                                                                 {"restitution", 0.8}}}}}}),
                       {-0.4}, {-3});
    if (name == "rim")
        return startAt(typedWith({"x", "y"}, "(x_t^2+y_t^2)/2 - x^4/4",
                                 {{"walls", Value::Object{{"rim", "1 - x^2/4 - y^2"}}}}),
                       {1.2, 0.65}, {1, 0.7});
    if (name == "moving wall")
        return startAt(
            typedWith({"x", "y"}, "(x_t^2+y_t^2)/2 - y",
                      {{"forces", Value::Object{{"y", "-0.4*y_t^3+t"}}},
                       {"walls", Value::Object{{"floor", Value::Object{{"gap", "y-0.1*sin(3*t)-x^2/9"},
                                                                       {"restitution", 0.7}}}}}}),
            {0.5, 0.2}, {0.3, -1});
    return startAt(
        typedWith(
            {"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - 9.81*z",
            {{"constraints", Value::Object{{"rod", "x^2+y^2+z^2-1"}}},
             {"walls", Value::Object{{"wall", Value::Object{{"gap", "x-0.55"}, {"restitution", 0.8}}}}}}),
        {0.6, 0, -0.8}, {-1, 1.5, -0.75});
}

/// Along `direction`, by central differences of order 4; states are put back on the constraints.
Eigen::VectorXd byDifferences(const Mechanical& of, const std::string& scheme, double h,
                              const Eigen::VectorXd& direction) {
    constexpr double apart = 1e-3;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(direction.size());
    for (const auto& [place, weight] :
         {std::pair(1, 8.0), std::pair(-1, -8.0), std::pair(2, -1.0), std::pair(-2, 1.0)}) {
        State s = of.start;
        for (Eigen::Index i = 0; i < direction.size(); ++i)
            s.x[static_cast<std::size_t>(i)] += place * apart * direction(i);
        putOnConstraints(of.system, s, true);
        const auto integrator = makeIntegrator(of.system, *namedScheme(scheme), {0, h});
        if (advance(*integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        sum += weight / (12 * apart) * Eigen::Map<const Eigen::VectorXd>(s.x.data(), direction.size());
    }
    return sum;
}

/// The largest size of what a run of `steps` steps says of its variations.
struct Said {
    double symplecticity = 0, volume = 0, contraction = 0;
};
Said variationsOf(const Mechanical& of, const std::string& scheme, double h, int steps) {
    const auto integrator =
        withVariations(makeIntegrator(of.system, *namedScheme(scheme), {0, h}), of.system,
                       VariationPlan{.map = true}, tangentBasis(of.system), freeVariations(of.system));
    State s = of.start;
    integrator->begin(s);
    std::vector<double> values(integrator->quantities().size());
    const auto at = [&](const char* name) { return values[*indexOf(integrator->quantities(), name)]; };
    Said said;
    const auto grow = [](double& to, double value) { to = std::abs(value) <= to ? to : std::abs(value); };
    for (int i = 0; i < steps; ++i) {
        if (advance(*integrator, s).outcome != Outcome::converged) qFatal("a step failed");
        integrator->measure(s, values.data());
        grow(said.symplecticity, at("symplecticity"));
        grow(said.volume, at("volume"));
        grow(said.contraction, (1 + at("volume")) * std::exp(-at("expansion")) - 1);
    }
    return said;
}

Comparison runScene(const std::string& text) {
    const ReadScene read = readScene(text);
    if (!read.errors.empty()) qFatal("%s", read.errors.front().message.c_str());
    return run(read.scene);
}

}  // namespace

class VariationTest : public QObject {
    Q_OBJECT
private slots:
    void mapsAreDerivativesOfSteps_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-lobatto-2", "galerkin-gauss-3"})
            for (const char* name : {"ball on a rod", "two rods", "winch", "torus", "rod and drag",
                                     "van der Pol", "blade", "post", "rim", "moving wall", "rod and wall"})
                QTest::addRow("%s, %s", name, scheme) << name << scheme;
    }
    void mapsAreDerivativesOfSteps() {
        QFETCH(QString, name);
        QFETCH(QString, scheme);
        const Mechanical of = named(name.toStdString());
        const double h = 0.2;
        const auto integrator = makeIntegrator(of.system, *namedScheme(scheme.toStdString()), {0, h});
        State s = of.start;
        integrator->begin(s);
        QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        QCOMPARE(integrator->impacts().size(), std::size_t(of.system.parts.find<Wall>() ? 1 : 0));
        const auto n = static_cast<Eigen::Index>(of.start.x.size());
        const TangentBasis basis = tangentBasis(of.system);
        Matrix B = Matrix::Identity(n, n);
        if (basis) {
            const std::vector<double> columns = basis(of.start.t, of.start.x.data());
            B = Eigen::Map<const Matrix>(columns.data(), n, freeVariations(of.system));
        }
        QCOMPARE(B.cols(), Eigen::Index(freeVariations(of.system)));
        Matrix M = B;
        QVERIFY(integrator->applyTangent({M.data(), static_cast<std::size_t>(M.size())}));
        double worst = 0;
        for (Eigen::Index c = 0; c < B.cols(); ++c)
            worst = std::max(
                worst,
                (M.col(c) - byDifferences(of, scheme.toStdString(), h, B.col(c))).cwiseAbs().maxCoeff());
        qInfo("difference %.1e of %.1e", worst, M.cwiseAbs().maxCoeff());
        QVERIFY(worst < 2e-8 * M.cwiseAbs().maxCoeff());
        // With the transposed matrix of the step, and with that of its columns.
        Matrix all = Matrix::Identity(n, n), transposed = all;
        QVERIFY(integrator->applyTangent({all.data(), static_cast<std::size_t>(all.size())}));
        QVERIFY(applyTransposed(*integrator, {transposed.data(), static_cast<std::size_t>(all.size())}));
        const double apart = (transposed - all.transpose()).cwiseAbs().maxCoeff();
        qInfo("transposed off by %.1e of %.1e", apart, all.cwiseAbs().maxCoeff());
        QVERIFY(apart < 1e-12 * all.cwiseAbs().maxCoeff());
    }
    void constrainedStepsKeepTheFormOfTheirManifold_data() {
        QTest::addColumn<QString>("name");
        for (const char* name : {"ball on a rod", "two rods", "winch", "torus"}) QTest::newRow(name) << name;
    }
    void constrainedStepsKeepTheFormOfTheirManifold() {
        QFETCH(QString, name);
        for (const char* scheme :
             {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-lobatto-2", "galerkin-gauss-3"}) {
            const Said said = variationsOf(named(name.toStdString()), scheme, 0.05, 20);
            qInfo("%s: form %.1e, volume %.1e", scheme, said.symplecticity, said.volume);
            QVERIFY(said.symplecticity < 1e-13 && said.volume < 1e-13);
        }
        // Tangents have images that are tangent: the same steps with drag do not keep the form.
        QVERIFY(variationsOf(named("rod and drag"), "galerkin-gauss-2", 0.05, 20).symplecticity > 1e-3);
    }
    /// exp(-c h) by the diagonal Pade approximations: what is left of z^3/12, z^5/720, z^7/100800.
    void forcesContractToTheOrderOfTheScheme() {
        const Mechanical of = startAt(typed({"x"}, "x_t^2/2 - x^2/2", {}, {{"x", "-x_t"}}), {1}, {0.5});
        const double z = 0.25;
        const double left[] = {std::pow(z, 3) / 12, std::pow(z, 5) / 720, std::pow(z, 7) / 100800};
        for (int s = 1; s <= 3; ++s) {
            const double found = variationsOf(of, "galerkin-gauss-" + std::to_string(s), z, 5).contraction;
            qInfo("Gauss %d: %.2e of %.2e", s, found, left[s - 1]);
            QVERIFY(found > 0.3 * left[s - 1] && found < 3 * left[s - 1]);
        }
        const Mechanical rod = named("rod and drag");
        const double coarse = variationsOf(rod, "galerkin-gauss-2", 0.1, 10).contraction,
                     fine = variationsOf(rod, "galerkin-gauss-2", 0.05, 20).contraction;
        qInfo("rod with drag: %.1e, %.1e, order %.2f of one step", coarse, fine, std::log2(coarse / fine));
        QVERIFY(std::abs(std::log2(coarse / fine) - 5) < 0.6);
    }
    void impactsContractByTheirRestitution() {
        for (const char* name : {"post", "rim", "rod and wall"}) {
            const Said said = variationsOf(named(name), "galerkin-gauss-3", 0.05, 10);
            qInfo("%s: volume %.3f, contraction %.1e", name, said.volume, said.contraction);
            QVERIFY(said.contraction < 1e-7);
        }
        // Energies of H at the contact: not the form, to the order of the scheme.
        const double form = variationsOf(named("rim"), "galerkin-gauss-2", 0.1, 5).symplecticity;
        QVERIFY(form > 1e-9 && form < 1e-3);
    }
    /// Kepler with drag: L from 1.1 to about half, and its balance to round-off.
    void momentaBalanceToRoundOff() {
        const Comparison c =
            runScene(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y"],
            "parameters":{"c":0.02},"lagrangian":"(x_t^2+y_t^2)/2+1/sqrt(x^2+y^2)",
            "forces":{
    "x" : "-c*x_t", "y" : "-c*y_t"}},"initial":{"q":[1,0],"v":[0,1.1]},"time":{"end":40},
            "schemes":[{"scheme":"galerkin-gauss-2","step":0.05},{"scheme":"galerkin-lobatto-3","step":0.05}],
            "observe":["momentum-balance"]
    })json");
        QCOMPARE(c.schemes.size(), std::size_t(2));
        for (const auto& result : c.schemes) {
            const SchemeResult& scheme = *result;
            double worst = 0;
            for (const double value : scheme.trajectory["momentum_balance"]) worst = std::max(worst, value);
            const auto q = [&](const char* name) { return scheme.trajectory[name].back(); };
            const double L = q("q.x") * q("p.y") - q("q.y") * q("p.x");
            qInfo("L %.4f, balance %.1e", L, worst);
            QVERIFY(std::abs(L - 0.494) < 0.002);
            QVERIFY(worst < 4e-15);
        }
    }
    /// A symmetry that the constraint has not does not belong to the mechanism; a wall gives momentum.
    void onlySymmetriesOfConstraintsCount() {
        const System sphere = mechanism_test::sphericalPendulum().system,
                     ellipsoid =
                         typed({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - z", {{"g", "x^2+2*y^2+z^2-1"}}),
                     aside = typed({"x", "y"}, "(x_t^2+y_t^2)/2", {{"g", "(x-1)^2+y^2-1"}});
        QVERIFY(hasMomenta(sphere));
        QCOMPARE(momentaOf(sphere).size(), std::size_t(1));
        QVERIFY(!hasMomenta(ellipsoid));
        QCOMPARE(momentaOf(aside).size(), std::size_t(1));
        const Comparison c =
            runScene(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y"],
            "parameters":{},"lagrangian":"(x_t^2+y_t^2)/2 - y","walls":{"floor":{"gap":"y+x/4","restitution":0.9}}},
            "initial":{"q":[0,1],"v":[0.3,0]},"time":{"end":8},
            "schemes":[{"scheme":"galerkin-gauss-2","step":0.1}],"observe":["momentum-balance"]})json");
        double worst = 0;
        for (const double value : c.schemes.front()->trajectory["momentum_balance"])
            worst = std::max(worst, value);
        QVERIFY(c.schemes.front()->summary.impacts >= 2);
        qInfo("balance %.1e", worst);
        QVERIFY(worst < 2e-14);
    }
    /// A driven pendulum with damping c: the exponents have the sum -c.
    void exponentsOfADampedPendulumAddUpToItsDamping() {
        const Comparison c = runScene(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["phi"],
            "parameters":{"c":0.5,"A":1.2},"lagrangian":"phi_t^2/2+cos(phi)",
            "forces":{
    "phi" : "-c*phi_t+A*cos(2*t/3)"}},"initial":{"q":[0.2],"v":[0]},"time":{"end":1000},
            "schemes":[{"scheme":"galerkin-gauss-3","step":0.2}],"observe":["lyapunov-spectrum","contraction"]
    })json");
        const auto last = [&](const char* name) { return c.schemes.front()->trajectory[name].back(); };
        qInfo("exponents %.4f %.4f, sum %.9f", last("lyapunov.1"), last("lyapunov.2"), last("lyapunov_sum"));
        QVERIFY(std::abs(last("lyapunov_sum") + 0.5) < 1e-7);
        QVERIFY(last("lyapunov.1") > 0.09 && last("lyapunov.1") < 0.18);
    }
    void aConstrainedMotionHasExponentsOfItsManifold() {
        const Comparison c =
            runScene(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y","u","w"],
            "parameters":{},"lagrangian":"(x_t^2+y_t^2+u_t^2+w_t^2)/2 - 9.81*(y+w)",
            "constraints":{
    "a" : "x^2+y^2-1", "b" : "(u-x)^2+(w-y)^2-1"}},
            "initial":{"q":[1,0,1,1],"v":[0,0,0,0]},"time":{"end":100},
            "schemes":[{"scheme":"galerkin-gauss-3","step":0.02}],
            "observe":["lyapunov-spectrum","lyapunov","symplecticity","volume"]
    })json");
        const auto& t = c.schemes.front()->trajectory;
        QVERIFY(t.find("lyapunov.4") && !t.find("lyapunov.5"));
        qInfo("exponents %.3f %.3f %.3f %.3f, %.3f; form %.1e", t["lyapunov.1"].back(),
              t["lyapunov.2"].back(), t["lyapunov.3"].back(), t["lyapunov.4"].back(), t["lyapunov"].back(),
              t["symplecticity"].back());
        QVERIFY(t["lyapunov.1"].back() > 1);
        QVERIFY(std::abs(t["lyapunov.1"].back() + t["lyapunov.4"].back()) < 0.2);
        // The frame is orthonormal in (q, p), and its volume is not that of the form: its logarithm is
        // bounded.
        QVERIFY(std::abs(t["lyapunov_sum"].back()) < 0.05);
    }
    void forcesAreRefusedWhereTheyMeanNothing() {
        const ReadScene read =
            readScene(std::string(R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x"],
            "parameters":{},"lagrangian":"x_t^2/2-x^2/2","forces":{"x":"-x_t"}},"initial":{"q":[1]},
            "time":{"end":1},"schemes":[{"scheme":"galerkin-gauss-2","step":0.1}],"observe":["symplecticity","volume"]})json"));
        std::string said;
        for (const Problem& p : read.errors) said += p.message + "; " + p.hint + "\n";
        QVERIFY2(said.find("a problem without a force") != std::string::npos, said.c_str());
    }
};

EXTREMAL_TEST(VariationTest)
}  // namespace extremal::mechanism_variation_test
#include "variation_test.moc"
