// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions with an interaction: Gauss and splittings against exact solitons, norm and energy over long
/// times, and what linear schemes refuse.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::interacting_wave_test {
namespace {

using Make = std::function<std::unique_ptr<Integrator>(const System&, double step)>;

System onLine(double left, double right, int modes, double g, const char* potential = "free") {
    return laws::systemNamed("schrodinger", {{"domain", Value::Array{left, right}},
                                             {"modes", static_cast<double>(modes)},
                                             {"potential", potential},
                                             {"interaction", g}});
}

State startOf(const System& system, const Value& psi, bool isNormalised = false) {
    return {0, 0, system.start({"", {{"psi", psi}, {"normalise", isNormalised}}, {}}, 0)};
}
const Value twoSolitons = Value::Object{{"packet", "two-soliton"}};

Make gaussOf(int degree, double shift = NAN) {
    return [=](const System& system, double step) {
        Discretization d = *namedScheme("schrodinger-gauss-" + std::to_string(degree));
        for (auto& [key, value] : d.space.keys)
            if (key == "energy_shift" && std::isfinite(shift)) value = shift;
        return makeIntegrator(system, d, {0, step});
    };
}
Make baseline(const char* id) {
    return [=](const System& system, double step) {
        return findBaseline(id)->make(system, {.step = step, .settings = {id, {}, {}}});
    };
}

/// The L2 error at the end, in the norm of coefficients.
double errorOf(const System& system, const State& start, const Value& psi, const Make& make, double end,
               int steps, double* normChange = nullptr) {
    State state = start;
    const auto integrator = make(system, end / steps);
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) return NAN;
    const ExactSolution exact = system.exactFrom({"", {{"psi", psi}}, {}}, start);
    if (!exact) return NAN;
    std::vector<double> known(state.x.size());
    exact(end, known);
    double sum = 0, norm = 0, before = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
        sum += (state.x[i] - known[i]) * (state.x[i] - known[i]);
        norm += state.x[i] * state.x[i];
        before += start.x[i] * start.x[i];
    }
    if (normChange) *normChange = std::abs(std::sqrt(norm / before) - 1);
    return std::sqrt(sum);
}

}  // namespace

class InteractingWaveTest : public QObject {
    Q_OBJECT
private slots:
    void twoSolitonsAreFollowedWithTheOrderOfTheScheme() {
        // 2 sech x, length 60, N = 2048, to pi/2; measured 2.00, 4.00, 7.01, 8.68, 1.99, 4.83: the pulse
        // changes so fast that higher degrees still gain more than their order.
        const System system = onLine(-30, 30, 2048, -1);
        const State start = startOf(system, twoSolitons);
        struct Row {
            const char* name;
            Make make;
            std::vector<int> steps;
            double order, more;
        };
        const std::vector<Row> rows{{"Gauss 2", gaussOf(1), {160, 320, 640}, 2, 0.1},
                                    {"Gauss 4", gaussOf(2), {80, 160, 320}, 4, 0.15},
                                    {"Gauss 6", gaussOf(3), {40, 80, 160}, 6, 1.3},
                                    {"Gauss 8", gaussOf(4), {80, 160}, 8, 1.3},
                                    {"Strang", baseline("strang"), {160, 320, 640}, 2, 0.1},
                                    {"Blanes-Moan", baseline("blanes-moan-s6"), {80, 160, 320}, 4, 0.9}};
        for (const Row& row : rows) {
            std::vector<double> h, e;
            for (const int n : row.steps) {
                double norm = 0;
                const double error =
                    errorOf(system, start, twoSolitons, row.make, std::numbers::pi / 2, n, &norm);
                qInfo("%s, %d steps: %.3e, norm %.1e", row.name, n, error, norm);
                QVERIFY(norm < 1e-12);
                h.push_back(-std::log(n));
                e.push_back(std::log(error));
            }
            const double order = slope(h, e);
            qInfo("%s: order %.2f", row.name, order);
            QVERIFY2(order > row.order - 0.15 && order < row.order + row.more, row.name);
        }
    }
    void darkSolitonsHaveTheErrorsOfTheTable() {
        // Two of them around a circle, as far apart that their product is exact; without a shift of energy.
        const System system = onLine(-30, 30, 256, 1);
        const Value psi = Value::Object{{"packet", "dark-soliton-pair"}, {"velocity", 0.4}};
        const State start = startOf(system, psi);
        const std::vector<double> known = system.start({"", {{"psi", psi}, {"normalise", false}}, {}}, 4);
        struct Row {
            int degree, steps;
            double first, second;
        };
        for (const Row& row : {Row{1, 40, 9.63e-2, 0}, {2, 40, 2.46e-5, 1.54e-6}, {3, 20, 1.64e-7, 2.6e-9}}) {
            double errors[2];
            for (const int run : {0, 1}) {
                State state = start;
                const int steps = row.steps << run;
                const auto integrator = gaussOf(row.degree, 0)(system, 4.0 / steps);
                for (int k = 0; k < steps; ++k)
                    QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
                double sum = 0;
                for (std::size_t i = 0; i < known.size(); ++i)
                    sum += (state.x[i] - known[i]) * (state.x[i] - known[i]);
                errors[run] = std::sqrt(sum);
                qInfo("degree %d, %d steps: %.3e", row.degree, steps, errors[run]);
            }
            QVERIFY(std::abs(std::log2(errors[0] / errors[1]) - 2 * row.degree) < 0.15);
            QVERIFY(std::abs(errors[0] / row.first - 1) < 0.03);
            if (row.second > 0) QVERIFY(std::abs(errors[1] / row.second - 1) < 0.03);
        }
        const auto refusal = [&](double g, const Value& other) {
            try {
                startOf(onLine(-30, 30, 64, g), other);
            } catch (const InvalidScene& e) {
                return e.problems().front().pointer;
            }
            return std::string();
        };
        QCOMPARE(refusal(-1, psi), std::string("/psi/packet"));
        QCOMPARE(refusal(1, Value::Object{{"packet", "dark-soliton-pair"}, {"velocity", 1.1}}),
                 std::string("/psi/velocity"));
        QVERIFY(!system.exactFrom({"", {{"psi", psi}}, {}}, start));
    }
    void errorsWithoutAShiftAreThoseOfTheTable() {
        const System system = onLine(-30, 30, 2048, -1);
        const State start = startOf(system, twoSolitons);
        const double end = std::numbers::pi / 2;
        const double two = errorOf(system, start, twoSolitons, gaussOf(2, 0), end, 160),
                     four = errorOf(system, start, twoSolitons, gaussOf(4, 0), end, 80),
                     strang = errorOf(system, start, twoSolitons, baseline("strang"), end, 640);
        qInfo("Gauss 4 %.3e, Gauss 8 %.3e, Strang %.3e", two, four, strang);
        QVERIFY(std::abs(two / 2.36e-6 - 1) < 0.03);
        QVERIFY(four < 6e-10);
        QVERIFY(std::abs(strang / 1.28e-3 - 1) < 0.03);
    }
    void aSolitonThatMovesAroundTheCircleKeepsItsShape() {
        const System system = onLine(-20, 20, 256, -1);
        const Value psi = Value::Object{{"packet", "soliton"}, {"velocity", 2.0}, {"amplitude", 1.5}};
        const State start = startOf(system, psi);
        // To t = 24 it goes once around and further.
        const double error = errorOf(system, start, psi, gaussOf(4), 24, 960);
        qInfo("error %.2e", error);
        QVERIFY(error < 1e-7);
    }
    void normAndEnergyStayOverLongTimes() {
        // A moving soliton, 10^4 steps of 0.02, energy relative to the start in quarters of the run.
        const System system = onLine(-20, 20, 256, -1);
        const State start = startOf(system, Value::Object{{"packet", "soliton"}, {"velocity", 1.0}});
        const double energy = system.energy(0, start.x.data());
        const auto squares = [](const State& state) {
            double sum = 0;
            for (const double each : state.x) sum += each * each;
            return sum;
        };
        for (const bool isGauss : {true, false}) {
            State state = start;
            const auto integrator = (isGauss ? gaussOf(2) : baseline("strang"))(system, 0.02);
            double norm = 0;
            std::vector<double> most(4);
            for (double& quarter : most)
                for (int k = 0; k < 2500; ++k) {
                    QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
                    norm = std::max(norm, std::abs(squares(state) / squares(start) - 1));
                    quarter =
                        std::max(quarter, std::abs(system.energy(state.t, state.x.data()) / energy - 1));
                }
            qInfo("%s: norm %.1e, energy %.1e %.1e %.1e %.1e", isGauss ? "Gauss 4" : "Strang", norm, most[0],
                  most[1], most[2], most[3]);
            QVERIFY(norm < 2e-12);
            // Of Gauss round-off, which adds up: 9.2e-14 to 3.6e-13.
            if (isGauss)
                QVERIFY(most[3] < 2e-12);
            else
                QVERIFY(most[3] < 2 * most[0] && most[0] > 1e-9);
        }
    }
    void withoutInteractionTheStepIsTheLinearOne() {
        const System linear =
            laws::systemNamed("schrodinger", {{"modes", 64.0}, {"potential", "6*(1 - cos(x)) + sin(2*x)"}});
        System weak = linear;
        weak.parts.set(Interaction{0});
        const Value packet = Value::Object{{"packet", "gaussian"}, {"wave_number", 3.0}};
        State a = startOf(linear, packet, true), b = a;
        const auto one = gaussOf(3)(linear, 0.05), other = gaussOf(3)(weak, 0.05);
        for (int k = 0; k < 20; ++k) {
            QCOMPARE(advance(*one, a).outcome, Outcome::converged);
            QCOMPARE(advance(*other, b).outcome, Outcome::converged);
        }
        double most = 0;
        for (std::size_t i = 0; i < a.x.size(); ++i) most = std::max(most, std::abs(a.x[i] - b.x[i]));
        qInfo("%.1e", most);
        QVERIFY(most < 1e-12);
    }
    void repulsionSpreadsAndAttractionHolds() {
        // d2<x^2>/dt2 = 2 <p^2> + (interaction energy): by the sign of g packets spread faster or slower.
        const auto widthOf = [](double g) {
            const System system = onLine(-20, 20, 256, g);
            State state = startOf(system, Value::Object{{"packet", "gaussian"}, {"width", 1.0}}, true);
            const auto integrator = gaussOf(2)(system, 0.05);
            for (int k = 0; k < 40; ++k)
                if (advance(*integrator, state).outcome != Outcome::converged) return NAN;
            std::vector<double> sample(system.field.size());
            system.field.sample(state.x.data(), sample.data());
            double sum = 0;
            const std::size_t n = system.field.x.size();
            for (std::size_t j = 0; j < n; ++j)
                sum += system.field.x[j] * system.field.x[j] *
                       (sample[j] * sample[j] + sample[n + j] * sample[n + j]) * 40 / static_cast<double>(n);
            return static_cast<float>(sum);
        };
        const double none = widthOf(1e-300), more = widthOf(2), less = widthOf(-2);
        qInfo("%.4f %.4f %.4f", less, none, more);
        QVERIFY(std::abs(none - 2) < 1e-5);  // width^2 + t^2/(4 width^2)
        QVERIFY(more > none + 0.1 && less < none - 0.1);
    }
    void whatIsLinearRefuses() {
        const auto refusal = [](const char* model, const char* scheme) {
            const ReadScene read = readScene(
                std::string(R"({"extremal": 1, "model": {"type": "schrodinger", "domain": [-20, 20], )") +
                model +
                R"(}, "initial": {"psi": {"packet": "gaussian"}}, "time": {"end": 1}, "schemes": [{"step": 0.01, )" +
                scheme + "}]}");
            return read.errors.empty() ? std::string()
                                       : read.errors.front().pointer + ": " + read.errors.front().message +
                                             "; " + read.errors.front().hint;
        };
        const char* attraction = R"("interaction": -1)";
        QCOMPARE(refusal(attraction, R"("scheme": "schrodinger-gauss-3")"), std::string());
        QCOMPARE(refusal(attraction, R"("baseline": "strang")"), std::string());
        QCOMPARE(refusal(attraction, R"("baseline": "srkn-11b")"), std::string());
        for (const char* scheme :
             {R"("scheme": "schrodinger-three-level")", R"("baseline": "crank-nicolson")",
              R"("baseline": "chebyshev-propagation")", R"("space": {"type": "space-time", "degree": 8})",
              R"("scheme": "schrodinger-gauss-3", "solver": {"method": "dense"})"}) {
            const std::string text = refusal(attraction, scheme);
            qInfo("%s", text.c_str());
            QVERIFY(!text.empty());
        }
        for (const char* model : {R"("interaction": -1, "boundary": "dirichlet")",
                                  R"("interaction": 1, "potential": "cos(x - t) ")"}) {
            const std::string text = refusal(model, R"("scheme": "schrodinger-gauss-3")");
            qInfo("%s", text.c_str());
            QVERIFY(text.find("/model/interaction") == 0);
        }
    }
};

EXTREMAL_TEST(InteractingWaveTest)

}  // namespace extremal::interacting_wave_test

#include "interacting_wave_test.moc"
