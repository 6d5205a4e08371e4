// SPDX-License-Identifier: GPL-3.0-or-later
/// What a typed density is taken for, what it measures, and what is refused, with the place and the remedy.
#include <QTest>

#include <cmath>
#include <functional>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/conservative.hpp"
#include "engine/model/density/density_system.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/parts/premise_check.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/model/density/densities.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_density_test {
using namespace densities;
namespace {

DensityCase typed(Value lagrangian, Value::Object parameters = {}) {
    DensityCase c;
    c.lagrangian = std::move(lagrangian);
    c.parameters = std::move(parameters);
    return c;
}

/// The first problem, "pointer: message (hint)".
QString refusal(const std::function<void()>& make) {
    try {
        make();
    } catch (const InvalidScene& e) {
        const Problem& p = e.problems().front();
        return QString::fromStdString(p.pointer + ": " + p.message + " (" + p.hint + ")");
    }
    return {};
}
QString refusalOf(const DensityCase& c) {
    return refusal([&] { (void)systemOf(c); });
}

}  // namespace

class TypedDensityTest : public QObject {
    Q_OBJECT
private slots:
    void usualDensitiesAreRecognised_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("potential");
        QTest::addColumn<double>("speed");
        QTest::newRow("wave") << "(u_t^2 - u_x^2)/2"
                              << "none" << 1.0;
        QTest::newRow("product") << "(u_t - c*u_x)*(u_t + c*u_x)/2"
                                 << "none" << 2.0;
        QTest::newRow("Klein-Gordon") << "u_t^2/2 - u_x^2/2 - m^2*u^2/2"
                                      << "klein-gordon" << 1.0;
        QTest::newRow("sine-Gordon") << "u_t^2/2 - c^2*u_x^2/2 - (1 - cos(u))"
                                     << "sine-gordon" << 2.0;
        QTest::newRow("sine-Gordon, written otherwise") << "cos(u) - 1 + 0.5*u_t^2 - u_x^2/2"
                                                        << "sine-gordon" << 1.0;
        QTest::newRow("phi-4") << "u_t^2/2 - u_x^2/2 - (1 - u^2)^2/4"
                               << "phi4" << 1.0;
        QTest::newRow("another") << "u_t^2/2 - u_x^2/2 - m*u^6"
                                 << "" << 1.0;
    }
    void usualDensitiesAreRecognised() {
        QFETCH(QString, text);
        QFETCH(QString, potential);
        QFETCH(double, speed);
        const DensityCase c = typed(text.toStdString(), {{"c", 2.0}, {"m", 3.0}});
        const auto problem = problemOf(c);
        QVERIFY2(problem->density.usual().has_value(), problem->density.unusual().c_str());
        if (!potential.isEmpty())
            QCOMPARE(QString::fromStdString(problem->density.usual()->potential), potential);
        const System system = systemOf(c);
        QVERIFY(system.parts.find<ScalarField>());
        QCOMPARE(system.fieldProblem().speed(), speed);
        if (potential == "klein-gordon") QCOMPARE(system.fieldProblem().potential.mass(), 3.0);
        // W by the density itself.
        for (const double u : {-1.3, 0.2, 2.1}) {
            const double at[] = {u, 0, 0, 0.3, 0.7};
            const double expected = -problem->density.value(at), found = system.fieldProblem().potential(u);
            QVERIFY(std::abs(found - expected) < 1e-14 * (1 + std::abs(expected)));
        }
        // Every scheme of fields takes it, and implicit cells as well.
        for (const char* id : {"leapfrog", "method-of-lines-rk4", "implicit-cells"})
            QVERIFY2(canIntegrate(*findBaseline(id), system), id);
    }
    void usualDensitiesOfSeveralComponentsAndOfThePlaneAreRecognised() {
        DensityCase c =
            typed(Value(Value::Object{
                      {"u", "u_t^2/2 - u_x^2/2"}, {"v", "v_t^2/2 - 4*v_x^2/2"}, {"meeting", "-k*u^2*v^2"}}),
                  {{"k", 0.5}});
        c.names = {"u", "v"};
        const System row = systemOf(c);
        QVERIFY(row.parts.find<PlaneField>());
        QCOMPARE(row.part<PlaneField>().problem->speed(1), 2.0);
        c.lagrangian = "(u_t^2 + v_t^2 - u_x^2 - u_y^2 - v_x^2 - v_y^2)/2 - (u^2 + v^2)^2";
        c.cells = 8;
        c.cellsY = 6;
        const System plane = systemOf(c);
        QVERIFY(plane.parts.find<PlaneField>() && plane.part<PlaneField>().problem->isComplex());
        const double u[] = {0.3, 0.4};
        double W = 0;
        plane.part<PlaneField>().problem->potential().evaluate(u, 1, 1, &W, nullptr, nullptr);
        QVERIFY(std::abs(W - 0.0625) < 1e-15);
        // Between ends that are not periodic there are components for typed densities alone.
        DensityCase ends = typed("(u_t^2 + v_t^2 - u_x^2 - v_x^2)/2 - u^2*v^2");
        ends.names = {"u", "v"};
        ends.boundary = "dirichlet";
        QVERIFY(systemOf(ends).parts.find<DensityField>());
    }
    void othersAreNot_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("reason");
        QTest::newRow("Born-Infeld") << "-sqrt(1 - u_t^2 + u_x^2)"
                                     << "u_t and u_t is not a number";
        QTest::newRow("slanted") << "u_t^2/2 - u_x^2/2 + 0.5*u_t*u_x"
                                 << "u_x and u_t is 0.5, not 0";
        QTest::newRow("mass") << "m*u_t^2/2 - u_x^2/2"
                              << "u_t and u_t is 3, not 1";
        QTest::newRow("sign") << "u_t^2/2 + u_x^2/2"
                              << "u_x and u_x is not negative";
        QTest::newRow("no gradient") << "u_t^2/2 - u^2"
                                     << "u_x and u_x is not negative";
        QTest::newRow("time") << "u_t^2/2 - u_x^2/2 - t*u^2"
                              << "depends on t";
        QTest::newRow("place") << "u_t^2/2 - u_x^2/2 - x*u^2"
                               << "depends on x";
        QTest::newRow("coupled") << "u_t^2/2 - u_x^2/2 + u^2*u_t"
                                 << "u_t and u is not a number";
        QTest::newRow("linear") << "u_t^2/2 - u_x^2/2 + 3*u_t"
                                << "linear in u_t";
    }
    void othersAreNot() {
        QFETCH(QString, text);
        QFETCH(QString, reason);
        const DensityCase c = typed(text.toStdString(), {{"m", 3.0}});
        const auto problem = problemOf(c);
        QVERIFY(!problem->density.usual());
        QVERIFY2(QString::fromStdString(problem->density.unusual()).contains(reason),
                 problem->density.unusual().c_str());
        const System system = systemOf(c);
        QVERIFY(system.parts.find<DensityField>() && !system.parts.find<ScalarField>());
        QVERIFY(!canIntegrate(*findBaseline("method-of-lines-rk4"), system));
        // Explicit steps need p = m u_t, which Born-Infeld, slanted and coupled have not.
        QCOMPARE(canIntegrate(*findBaseline("leapfrog"), system), problem->density.implicitBecause().empty());
        QVERIFY(canIntegrate(*findBaseline("implicit-cells"), system));
        QCOMPARE(conservesEnergy(system), !problem->density.isTimeDependent());
    }
    void whatIsWrongIsSaidWithItsPlace() {
        QVERIFY(refusalOf(typed("u_t^2/2 - v_x^2"))
                    .startsWith("/lagrangian: the density has an unknown name \"v_x\""));
        QVERIFY(refusalOf(typed(Value(Value::Object{{"a", "u_t^2/2"}, {"b", "-u_x^2 +"}})))
                    .startsWith("/lagrangian/b"));
        QVERIFY(refusalOf(typed("u_t^2/2 - u_y^2")).contains("u_y"));
        QVERIFY(refusalOf(typed("u_t^2 - u_x^2", {{"x", 1.0}})).startsWith("/parameters/x"));
        DensityCase twice = typed("u_t^2 - u_x^2");
        twice.names = {"u", "u_x"};
        QVERIFY(refusalOf(twice).startsWith("/components/1"));
        Settings model = settingsOf(typed("u_t^2/2 - u_x^2"));
        for (auto& [key, value] : model.keys)
            if (key == "potential") value = Value("phi4");
        QVERIFY(
            refusal([&] { (void)findModel("field")->make(model); }).startsWith("/potential: stands beside"));
    }
    void schemesThatCannotTakeItSayWhyAndWhatCan() {
        const auto text = [](const std::string& scheme, const std::string& more = {}) {
            return R"({"extremal":1,"model":{"type":"field","lagrangian":"u_t^2/2 - u_x^2/2 + u_t*u_x","cells":40)" +
                   more + R"j(},"initial":{"u":"exp(-x^2)"},"time":{"end":1},"schemes":[{"step":0.1,)j" +
                   scheme + "}]}";
        };
        for (const auto& [scheme, reason] :
             {std::pair{R"("baseline":"method-of-lines-rk4")", "is 1, not 0"},
              {R"("space":"tent")", "is 1, not 0"},
              {R"("space":{"type":"fourier-field","degree":2})", "is 1, not 0"},
              {R"("baseline":"leapfrog")", "its derivative by u_t depends on u_x"}}) {
            const ReadScene read = readScene(text(scheme));
            QVERIFY(!read.errors.empty());
            const QString said = QString::fromStdString(read.errors[0].message + read.errors[0].hint);
            QVERIFY2(said.contains(reason) && said.contains("implicit-cells"), qPrintable(said));
        }
        QVERIFY(readScene(text(R"("baseline":"implicit-cells")")).errors.empty());
    }
    /// 64 x 64 nodes and no more, and without a kinetic term none.
    void whatCannotBeSolvedIsRefused() {
        DensityCase c = typed("-sqrt(1 - u_t^2 + u_x^2 + u_y^2)");
        c.cells = 66;
        c.cellsY = 8;
        const System wide = systemOf(c);
        const QString said = refusal([&] {
            const Settings keys{"implicit-cells", {{"rule", "gauss-2"}}, {}};
            (void)findBaseline("implicit-cells")->make(wide, {0.1, {}, 0, keys});
        });
        QVERIFY2(said.contains("64 x 64") && said.contains("66 x 8"), qPrintable(said));
        const System singular = systemOf(typed("u*u_t - u_x^2/2"));
        const State start = stateOf(singular, {{"u", "sin(x)"}});
        const QString without = refusal(
            [&] { findModel("field")->checkInitial(settingsOf(typed("u*u_t - u_x^2/2")), singular, start); });
        QVERIFY2(without.startsWith("/lagrangian") && without.contains("kinetic"), qPrintable(without));
        const System light = systemOf(typed("-sqrt(1 - u_t^2 + u_x^2)"));
        const State fast = stateOf(light, {{"u_t", "2"}});
        QVERIFY(refusal([&] { findModel("field")->checkInitial({}, light, fast); }).contains("not finite"));
    }
    void energyAndMomentaAreThoseOfTheDensity() {
        // Energy (1 + u_x^2)/sqrt(1 - u_t^2 + u_x^2), momenta u_t/sqrt and -u_t u_x/sqrt.
        DensityCase c = typed("-sqrt(1 - u_t^2 + u_x^2)");
        c.cells = 200;
        const System system = systemOf(c);
        const State s = stateOf(system, {{"u", "0.5*sin(x)"}, {"u_t", "0.3 + 0.2*cos(x)"}});
        double energy = 0, momentum = 0, translation = 0;
        constexpr int fine = 4000;
        for (int i = 0; i < fine; ++i) {
            const double x = 2 * pi * i / fine, v = 0.3 + 0.2 * std::cos(x), slope = 0.5 * std::cos(x),
                         root = std::sqrt(1 - v * v + slope * slope);
            energy += (1 + slope * slope) / root * 2 * pi / fine;
            momentum += v / root * 2 * pi / fine;
            translation -= v * slope / root * 2 * pi / fine;
        }
        QVERIFY(std::abs(system.energy(0, s.x.data()) - energy) < 1e-3);
        QCOMPARE(system.momenta.size(), std::size_t(1));
        QVERIFY(std::abs(system.momenta[0].value(s.x.data(), s.x.data()) - momentum) < 1e-3);
        double values[2];
        measureOf(system, "translation-momentum")->bind(s)(0, s.x.data(), values);
        QVERIFY(std::abs(values[0] - translation) < 1e-3);
        QVERIFY(values[1] == 0);
        // A density that depends on u, or whose ends are held, has no such momentum.
        QVERIFY(systemOf(typed("u_t^2 - u_x^2 - u^4")).momenta.empty());
        c.boundary = "dirichlet";
        QVERIFY(systemOf(c).momenta.empty());
    }
    void anExactSolutionIsTested() {
        const System system = systemOf(typed("-sqrt(1 - u_t^2 + u_x^2)"));
        const PremiseCheck& check = *system.parts.find<PremiseCheck>();
        const auto fault = [&](const char* exact) {
            const Settings given{"", {{"exact", exact}}, {}};
            const State start = stateOf(system, given.keys);
            return check.fault({given, start, 0, 2});
        };
        QVERIFY2(fault("0.4*sin(x - t)").empty(), fault("0.4*sin(x - t)").c_str());
        QVERIFY(!fault("0.4*sin(x - 1.1*t)").empty());
        const Settings ends{"", {{"exact", "0.1*(x - t)"}}, {}};
        const State start = stateOf(system, ends.keys);
        QVERIFY(check.premise({ends, start, 0, 2}, [] { return ExactSolution(); }).isViolated);
    }
};

EXTREMAL_TEST(TypedDensityTest)

}  // namespace extremal::typed_density_test

#include "typed_density_test.moc"
