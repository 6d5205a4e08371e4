// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact solutions are tested, not believed: what violates its boundary, its equation or its mesh says so,
/// and is not off by more than it says.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/model/wave/hamiltonian.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/premise.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::premise_test {
namespace {

/// JSON with apostrophes in place of quotes.
ReadScene readText(const std::string& model, const std::string& start, double end,
                   const std::string& reference, const std::string& scheme) {
    QString text = QString::fromStdString(
        "{'extremal':1,'model':" + model + ",'initial':" + start + ",'time':{'end':" + std::to_string(end) +
        "},'reference':{'type':'" + reference + "'},'observe':['error'],'schemes':[" + scheme + "]}");
    return readScene(text.replace('\'', '"').toStdString());
}
std::string sineGordon(const std::string& more = "'boundary':'dirichlet'", int cells = 100) {
    return "{'type':'field','potential':'sine-gordon','domain':[-20,20],'cells':" + std::to_string(cells) +
           "," + more + "}";
}
ReadScene readField(const std::string& model, const std::string& start, double end,
                    const std::string& reference = "auto") {
    return readText(model, start, end, reference, "{'step':0.05,'baseline':'method-of-lines-rk4'}");
}

std::string warningsOf(const ReadScene& read) {
    std::string text;
    for (const Problem& p : read.warnings) text += p.pointer + " " + p.message + "\n";
    for (const Problem& p : read.errors) text += "error " + p.pointer + " " + p.message + "\n";
    return text;
}

}  // namespace

class PremiseTest : public QObject {
    Q_OBJECT
private slots:
    void endsThatAreViolatedAreSaid_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("start");
        QTest::addColumn<double>("end");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, const std::string& model, const char* start, double end,
                            const char* expected) {
            QTest::newRow(name) << QString::fromStdString(model) << start << end << expected;
        };
        row("kink that meets the wall", sineGordon(), "{'profile':'kink','v':0.5,'x0':15}", 15,
            "does not hold at x = 20 (6 from t = 9.9 on)");
        row("kink far from the wall", sineGordon(), "{'profile':'kink','v':0.5,'x0':-2.5}", 10, "");
        row("antikink to the left", sineGordon(), "{'profile':'antikink','v':-0.5,'x0':-15}", 15,
            "does not hold at x = -20 (6 from t = 9.9 on)");
        row("breather 0.5", sineGordon(), "{'profile':'breather','omega':0.5}", 20, "");
        row("breather 0.95", sineGordon(), "{'profile':'breather','omega':0.95}", 20,
            "does not hold at x = -20 (0.0051 from t = 0.56 on)");
        row("breather 0.95, nothing acts on the ends", sineGordon("'boundary':'neumann'"),
            "{'profile':'breather','omega':0.95}", 20, "does not hold at x = -20 (0.0034 from t");
        row("breather beside the middle, periodic", sineGordon("'boundary':'periodic'"),
            "{'profile':'breather','omega':0.95,'x0':6}", 20, "does not hold at x = -20 (0.023");
        row("breather in the middle, periodic", sineGordon("'boundary':'periodic'"),
            "{'profile':'breather','omega':0.5}", 20, "");
        const std::string wave = "{'type':'field','potential':'none','domain':[0,4],'cells':50,";
        row("pulse that leaves", wave + "'boundary':'dirichlet'}", "{'exact':'exp(-20*(x-t-2)^2)'}", 3,
            "does not hold at x = 4 (1 from t = 1.8 on)");
        row("plane wave", wave + "'boundary':'periodic'}", "{'profile':'plane-wave'}", 30, "");
        row("elastic bar, d'Alembert's solution in its own words",
            "{'type':'elastic-bar','cells':20,'grading':'uniform'}", "{'displacement':'0.01*sin(pi*X)'}", 5,
            "");
        row("d'Alembert's solution", wave + "'boundary':'dirichlet'}", "{'u':'exp(-20*(x-2)^2)'}", 30, "");
    }
    void endsThatAreViolatedAreSaid() {
        QFETCH(QString, model);
        QFETCH(QString, start);
        QFETCH(double, end);
        QFETCH(QString, expected);
        const ReadScene read = readField(model.toStdString(), start.toStdString(), end);
        QVERIFY2(read.errors.empty(), warningsOf(read).c_str());
        const ExactPremise premise = premiseOf(read.scene, *read.resolved->system, read.resolved->initial);
        QVERIFY2(QString::fromStdString(premise.text).startsWith(expected), premise.text.c_str());
        QCOMPARE(premise.isViolated, !expected.isEmpty());
        const std::string all = warningsOf(read);
        QCOMPARE(all.find("a computed reference is used") != std::string::npos, premise.isViolated);
    }
    void whoAsksForItIsToldItsBound() {
        const ReadScene read = readField(sineGordon(), "{'profile':'kink','v':0.5,'x0':15}", 15, "exact");
        const std::string all = warningsOf(read);
        QVERIFY2(all.find("its estimated error contains that") != std::string::npos, all.c_str());
        QCOMPARE(makeReference(*read.resolved, {}).info.type, "exact");
    }
    /// Far out exp(g) overflows, and 1 - v^2 has few digits near the speed of the wave.
    void profilesHaveNoLimits() {
        for (const char* name : {"kink-kink", "kink-antikink"}) {
            const ReadScene read = readText(
                "{'type':'field','potential':'sine-gordon','domain':[-1000,1000],"
                "'cells':20,'boundary':'dirichlet'}",
                std::string("{'profile':'") + name + "','v':0.5}", 10, "exact",
                "{'step':0.05,'baseline':'method-of-lines-rk4'}");
            QVERIFY2(read.errors.empty(), warningsOf(read).c_str());
        }
        const double v = 1 - 1e-13, x = 3e-7;
        const ReadScene read = readField(
            "{'type':'field','potential':'sine-gordon','domain':[-1,1],'cells':20,'boundary':'dirichlet'}",
            "{'profile':'kink','v':" + QString::number(v, 'g', 17).toStdString() + "}", 10);
        QVERIFY2(read.errors.empty(), warningsOf(read).c_str());
        std::array<double, 2> u{};
        exactSolution(read.scene, *read.resolved->system, read.resolved->initial)
            .atPlaces()(0, {&x, 1}, u.data());
        const long double wide = v, gamma = 1 / std::sqrt((1 - wide) * (1 + wide));
        const long double truth = 4 * std::atan(std::exp(gamma * x));
        QVERIFY(std::abs(u[0] - static_cast<double>(truth)) < 1e-14);
    }
    void theBoundIsThatOfTheError_data() {
        QTest::addColumn<QString>("start");
        QTest::addColumn<double>("end");
        QTest::newRow("kink") << "{'profile':'kink','v':0.5,'x0':15}" << 15.0;
        QTest::newRow("breather 0.8") << "{'profile':'breather','omega':0.8}" << 20.0;
        QTest::newRow("breather 0.95") << "{'profile':'breather','omega':0.95}" << 20.0;
    }
    void theBoundIsThatOfTheError() {
        QFETCH(QString, start);
        QFETCH(double, end);
        const ResolvedScene automatic = *readField(sineGordon(), start.toStdString(), end).resolved,
                            asked = *readField(sineGordon(), start.toStdString(), end, "exact").resolved;
        const Reference computed = makeReference(automatic, {}), exact = makeReference(asked, {});
        QCOMPARE(computed.info.type, "computed");
        QCOMPARE(exact.info.type, "exact");
        const ErrorMeasure measure = errorMeasure(*asked.system, asked.initial);
        const ExactSolution a = computed.make(), b = exact.make();
        std::vector<double> x(asked.initial.x.size()), y(x), values(measure.columns.size());
        double error = 0;
        for (int k = 1; k <= 50; ++k) {
            a(end * k / 50, x);
            b(end * k / 50, y);
            measure.evaluate(x.data(), y.data(), values.data());
            error = std::max(error, values[0]);
        }
        qInfo("%s: off by %.2e, promised %.2e (the computed one is good to %.1e)", QTest::currentDataTag(),
              error, exact.info.estimatedError, computed.info.estimatedError);
        QVERIFY(exact.info.estimatedError > error);
        QVERIFY(exact.info.estimatedError < 3 * error);
    }
    void aTypedSolutionMustSolveItsEquation_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("exact");
        QTest::addColumn<bool>("isSolution");
        const std::string half =
            "{'type':'field','potential':'none','wave_speed':0.5,'domain':[0,'2*pi'],'boundary':'periodic','"
            "cells':"
            "64}";
        const auto row = [](const char* name, const std::string& model, const char* exact, bool isSolution) {
            QTest::newRow(name) << QString::fromStdString(model) << exact << isSolution;
        };
        row("wave of another speed", half, "cos(3*(x-0.7*t))", false);
        row("nearly the speed", half, "cos(3*(x-0.500000001*t))", false);
        row("wave", half, "cos(3*(x-0.5*t))", true);
        row("wave, by the name of the speed", half, "cos(3*(x-wave_speed*t)) + sin(x+wave_speed*t)", true);
        row("no wave at all", half, "sin(x)*exp(-t)", false);
        row("kink", sineGordon(), "4*atan(exp((x-0.5*t)/sqrt(0.75)))", true);
        row("kink, wrongly boosted", sineGordon(), "4*atan(exp((x-0.5*t)/0.75))", false);
        row("kink of another equation",
            "{'type':'field','potential':'phi4','domain':[-20,20],'boundary':'dirichlet','cells':64}",
            "4*atan(exp((x-0.5*t)/sqrt(0.75)))", false);
        const auto medium = [](const std::string& a) {
            return "{'type':'field','potential':'none','a':'" + a +
                   "','epsilon':1,'domain':[0,1],'boundary':'dirichlet','cells':16}";
        };
        row("static solution in a medium", medium("1/(1+s^2)"), "x + x^3/3", true);
        row("static solution of another medium", medium("1/(1+2*s^2)"), "x + x^3/3", false);
    }
    void aTypedSolutionMustSolveItsEquation() {
        QFETCH(QString, model);
        QFETCH(QString, exact);
        QFETCH(bool, isSolution);
        const ReadScene read = readField(model.toStdString(), "{'exact':'" + exact.toStdString() + "'}", 5);
        const std::string all = warningsOf(read);
        const bool isRefused =
            all.find("error /initial/exact does not solve the equation") != std::string::npos;
        QVERIFY2(read.errors.size() == (isSolution ? 0 : 1), all.c_str());
        QVERIFY2(isRefused != isSolution, all.c_str());
    }
    void aTypedProfileMustBeStationary() {
        const auto read = [](const char* exact) {
            return readText(
                "{'type':'static-profile','energy':'u^2/2','stiffness':1,'domain':[0,1],'ends':[0,'sinh("
                "1)'],'exact':'" +
                    std::string(exact) + "'}",
                "{}", 1, "exact", "{'step':0.1,'scheme':'free-knot-1'}");
        };
        QVERIFY2(warningsOf(read("sinh(x)")).find("/exact") == std::string::npos,
                 warningsOf(read("sinh(x)")).c_str());
        QVERIFY(warningsOf(read("sin(x)")).find("does not make the energy stationary") != std::string::npos);
        QVERIFY(warningsOf(read("sinh(x) + exp(x)")).find("is held") != std::string::npos);
    }
    void wavesKnowTheErrorOfTheirMesh_data() {
        QTest::addColumn<int>("modes");
        for (const int modes : {24, 32, 40, 48, 64, 128, 320}) QTest::addRow("%d modes", modes) << modes;
    }
    /// The coherent state is known: a Gaussian about q = -3 cos t with the momentum p = 3 sin t.
    void wavesKnowTheErrorOfTheirMesh() {
        QFETCH(int, modes);
        const ReadScene read = readText(
            "{'type':'schrodinger','potential':{'name':'harmonic','omega':1},'domain':[-10,10],'modes':" +
                std::to_string(modes) + "}",
            "{'psi':{'packet':'gaussian','centre':-3,'width':'sqrt(1/2)'}}", 4 * std::numbers::pi, "auto",
            "{'step':0.05,'scheme':'schrodinger-gauss-4'}");
        const ResolvedScene scene = *read.resolved;
        const Reference reference = makeReference(scene, {});
        QCOMPARE(reference.info.type, "exact");
        const ExactSolution solution = reference.make();
        const Hamiltonian& h = *scene.system->hamiltonian();
        const auto n = static_cast<std::size_t>(modes);
        std::vector<double> x(2 * n);
        std::vector<Complex> psi(n);
        double error = 0;
        for (int k = 1; k <= 97; ++k) {
            const double t = scene.scene.end.value * k / 97, q = -3 * std::cos(t), p = 3 * std::sin(t);
            solution(t, x);
            h.toNodes(coefficients(x.data()), psi.data());
            double sum = 0;
            for (std::size_t j = 0; j < n; ++j) {
                const double d = h.x()[j] - q;
                const Complex truth = std::pow(std::numbers::pi, -0.25) *
                                      std::exp(Complex(-d * d / 2, p * h.x()[j] - q * p / 2 - t / 2));
                sum += std::norm(psi[j] - truth) * 20 / modes;
            }
            error = std::max(error, std::sqrt(sum));
        }
        qInfo("%d modes: off by %.2e, promised %.2e", modes, error, reference.info.estimatedError);
        // The domain ends at 10, where the state and its periodic copy are 2e-11.
        QVERIFY(reference.info.estimatedError + 2e-11 > error);
        if (error > 1e-8) QVERIFY(reference.info.estimatedError < 3 * error);
    }
    void packetsCutByAWallAreSaid() {
        const auto read = [](const char* centre) {
            return readText(
                "{'type':'schrodinger','potential':'free','domain':[0,'pi'],'boundary':'dirichlet','modes':"
                "96}",
                "{'psi':{'packet':'gaussian','centre':" + std::string(centre) + ",'width':0.13}}", 1, "auto",
                "{'step':0.01,'scheme':'schrodinger-gauss-4'}");
        };
        QVERIFY(warningsOf(read("1.1")).empty());
        const ReadScene cut = read("0.2");
        const std::string all = warningsOf(cut);
        QVERIFY2(all.find("/initial/psi exact solution: does not hold at x = 0 (0.5") != std::string::npos,
                 all.c_str());
        const Reference reference = makeReference(*cut.resolved, {});
        qInfo("promised %.2e", reference.info.estimatedError);
        QVERIFY(reference.info.estimatedError > 0.1);
    }
};

EXTREMAL_TEST(PremiseTest)
}  // namespace extremal::premise_test

#include "premise_test.moc"
