// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields and wave functions as others type them, against what is known of them by other routes: two coupled
/// chains that are two breathers, the centre of a cloud in a rotating trap, the shifts of two solitons, the
/// mass shell of a moving lump. And a norm that is not what was typed.
#include <QTest>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "engine/model/plane_field/problem.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::field_cases_test {
namespace {

ResolvedScene sceneOf(const std::string& text) {
    const ReadScene read = readScene(text);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    if (!read.resolved) qFatal("not a scene");
    return *read.resolved;
}

/// The end of a scheme's run in steps of that length.
State endOf(const ResolvedScene& scene, std::size_t scheme, double step) {
    State state = scene.initial;
    const auto integrator = scene.schemes[scheme].make(*scene.system, step, state);
    const int steps = static_cast<int>(std::lround((scene.scene.end.value - state.t) / step));
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("a step failed");
    return state;
}

}  // namespace

class FieldCasesTest : public QObject {
    Q_OBJECT
private slots:
    /// u + v and u - v solve sine-Gordon's equation with 2 sin, each for itself: two unlike breathers.
    void twoChainsAreTwoBreathers_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<double>("step");
        QTest::newRow("Fourier, Gauss 2") << R"("scheme":"field-gauss-1")" << 2 << 0.05;
        QTest::newRow("Fourier, Gauss 4") << R"("scheme":"field-gauss-2")" << 4 << 0.1;
        QTest::newRow("Fourier, Gauss 6") << R"("scheme":"field-gauss-3")" << 6 << 0.2;
    }
    void twoChainsAreTwoBreathers() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(double, step);
        const double w[2] = {0.6, 0.8}, root = std::sqrt(2.0);
        const ResolvedScene scene = sceneOf(
            R"J({"extremal":1,"model":{"type":"field","components":["u","v"],
                "potential":"2 - cos(u + v) - cos(u - v)","domain":[-30,30],"cells":384},
            "initial":{"u":"0","v":"0",
              "u_t":"2*sqrt(2)*(0.8/cosh(0.8*sqrt(2)*x) + 0.6/cosh(0.6*sqrt(2)*x))",
              "v_t":"2*sqrt(2)*(0.8/cosh(0.8*sqrt(2)*x) - 0.6/cosh(0.6*sqrt(2)*x))"},
            "time":{"end":4},"reference":"none","schemes":[{"step":0.1,)J" +
            scheme.toStdString() + "}]}");
        const PlaneFieldProblem& problem = *scene.system->part<PlaneField>().problem;
        std::vector<double> h, q, p;
        for (const double each : {step, step / 2, step / 4}) {
            const State end = endOf(scene, 0, each);
            const std::size_t n = problem.nodes();
            double u = 0, rate = 0;
            for (std::size_t i = 0; i < n; ++i) {
                double s[2], r[2];
                for (const std::size_t b : {0, 1}) {
                    const double k = std::sqrt(1 - w[b] * w[b]), angle = w[b] * root * 4,
                                 c = std::cosh(k * root * problem.x()[i]), z = k / w[b] * std::sin(angle) / c;
                    s[b] = 4 * std::atan(z);
                    r[b] = 4 * k * root * std::cos(angle) / c / (1 + z * z);
                }
                for (const int sign : {1, -1}) {
                    const std::size_t at = i + (sign < 0 ? n : 0);
                    u = std::max(u, std::abs(end.x[at] - (s[0] + sign * s[1]) / 2));
                    rate = std::max(rate, std::abs(end.x[2 * n + at] - (r[0] + sign * r[1]) / 2));
                }
            }
            qInfo("h = %.4f: %.2e, %.2e", each, u, rate);
            h.push_back(std::log(each));
            q.push_back(std::log(u));
            p.push_back(std::log(rate));
        }
        qInfo("orders %.2f, %.2f", slope(h, q), slope(h, p));
        QVERIFY(std::abs(slope(h, q) - order) < 0.2 && std::abs(slope(h, p) - order) < 0.2);
    }
    /// <x>, <p> of any cloud in a harmonic trap move as one particle does, whatever the interaction; here
    /// with unlike frequencies, in a frame that turns.
    void theCentreOfACloudIsAParticle() {
        constexpr double turn = 0.4, end = 2;
        const ResolvedScene scene = sceneOf(
            R"J({"extremal":1,"model":{"type":"schrodinger-2d","potential":"x^2/2 + y^2","interaction":3,
                "rotation":0.4,"domain":[-8,8],"domain_y":[-8,8],"modes":64,"modes_y":64},
            "initial":{"psi":{"re":"exp(-((x-1)^2 + y^2)/2)/sqrt(pi)","im":"0"}},"time":{"end":2},
            "reference":"none","observe":["position"],
            "schemes":[{"step":0.01,"scheme":"schrodinger-gauss-3"},{"step":0.01,"baseline":"srkn-11b"}]})J");
        std::array<double, 4> s{1, 0, 0, 0};  // x, y and their momenta, by many small steps
        const auto rate = [](const std::array<double, 4>& z) {
            return std::array<double, 4>{z[2] + turn * z[1], z[3] - turn * z[0], -z[0] + turn * z[3],
                                         -2 * z[1] - turn * z[2]};
        };
        constexpr int steps = 4000;
        for (int k = 0; k < steps; ++k) {
            const double h = end / steps;
            const auto moved = [&](const std::array<double, 4>& by, double f) {
                std::array<double, 4> z = s;
                for (std::size_t i = 0; i < 4; ++i) z[i] += f * by[i];
                return z;
            };
            const auto a = rate(s), b = rate(moved(a, h / 2)), c = rate(moved(b, h / 2)),
                       d = rate(moved(c, h));
            for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
        for (const std::size_t scheme : {0, 1}) {
            const State state = endOf(scene, scheme, 0.01);
            double centre[2] = {NAN, NAN};
            for (const Measure& measure : scene.system->measures)
                if (measure.observable == "position")
                    measure.bind(scene.initial)(state.t, state.x.data(), centre);
            qInfo("%.2e, %.2e", centre[0] - s[0], centre[1] - s[1]);
            QVERIFY(std::abs(centre[0] - s[0]) < 1e-8 && std::abs(centre[1] - s[1]) < 1e-8);
        }
    }
    /// What a Gaussian has at the last node, whichever axis that is on.
    void theEdgeIsWhereTheDomainEnds() {
        for (const bool isAlongX : {true, false}) {
            QString text = R"J({"extremal":1,"model":{"type":"schrodinger-2d","potential":"0",
                "domain":[-8,8],"domain_y":[-8,8],"modes":64,"modes_y":32},
                "initial":{"psi":{"re":"exp(-((x-%1)^2+(y-%2)^2)/2)"}},"time":{"end":1},"observe":["edge"],
                "schemes":[{"step":0.1,"baseline":"strang"}]})J";
            text = text.arg(isAlongX ? 2 : 0).arg(isAlongX ? 0 : 2);
            const ResolvedScene scene = sceneOf(text.toStdString());
            const double last = 8 - (isAlongX ? 16.0 / 64 : 16.0 / 32),
                         expected = std::exp(-(last - 2) * (last - 2) / 2);
            double edge = NAN;
            for (const Measure& measure : scene.system->measures)
                if (measure.observable == "edge")
                    measure.bind(scene.initial)(0, scene.initial.x.data(), &edge);
            qInfo("%.6e, %.6e", edge, expected);
            QVERIFY(std::abs(edge / expected - 1) < 1e-6);
        }
    }
    /// a sech(a x) exp(i v x), of eigenvalue z = v + i a: when two of them have met, each is shifted by
    /// ln(|z_1 - z_2*|^2/|z_1 - z_2|^2)/a in the direction that it runs in.
    void solitonsAreShiftedWhenTheyMeet() {
        const ResolvedScene scene = sceneOf(
            R"J({"extremal":1,"model":{"type":"schrodinger","interaction":-1,"domain":[-40,40],"modes":1024},
            "initial":{"normalise":false,"psi":{
              "re":"2*cos(0.5*(x+10))/cosh(2*(x+10)) + cos(1.5*(x-10))/cosh(x-10)",
              "im":"2*sin(0.5*(x+10))/cosh(2*(x+10)) - sin(1.5*(x-10))/cosh(x-10)"}},
            "time":{"end":20},"reference":"none","schemes":[{"step":0.02,"scheme":"schrodinger-gauss-4"}]})J");
        const State end = endOf(scene, 0, 0.02);
        const FieldSampling& field = scene.system->field;
        std::vector<double> sample(field.size());
        field.sample(end.x.data(), sample.data());
        const std::size_t n = field.x.size();
        const auto centreBetween = [&](double left, double right) {
            double sum = 0, all = 0;
            for (std::size_t i = 0; i < n; ++i) {
                if (field.x[i] < left || field.x[i] >= right) continue;
                const double density = sample[i] * sample[i] + sample[n + i] * sample[n + i];
                sum += field.x[i] * density;
                all += density;
            }
            return std::pair{sum / all, all * 80 / 1024};
        };
        const double ratio = std::log(std::norm(std::complex(2.0, 3.0)) / std::norm(std::complex(2.0, 1.0)));
        const auto [tall, tallNorm] = centreBetween(-10, 15);
        const auto [flat, flatNorm] = centreBetween(-35, -10);
        qInfo("%.7f (%.7f), %.7f (%.7f)", tall, ratio / 2, flat, -20 - ratio);
        QVERIFY(std::abs(tallNorm - 4) < 1e-6 && std::abs(flatNorm - 2) < 1e-6);
        QVERIFY(std::abs(tall - ratio / 2) < 2e-6 && std::abs(flat + 20 + ratio) < 2e-6);
    }
    /// E^2 - P^2 of a lump that moves is the square of the energy of the one at rest, and it runs with P/E.
    void aMovingLumpIsOnItsMassShell() {
        const auto lump = [](double velocity) {
            return sceneOf(
                R"J({"extremal":1,"model":{"type":"field-2d","components":["u","v"],"potential":"q-ball",
                    "domain":[-16,16],"domain_y":[-12,12],"cells":128,"cells_y":96},
                "initial":{"profile":{"name":"q-ball","omega":0.8,"centre":[-2,1],"velocity":[)J" +
                std::to_string(velocity) +
                R"J(,0]}},"time":{"end":8},"reference":"none","schemes":[{"step":0.1,"scheme":"field-gauss-3"}]})J");
        };
        const auto energyOf = [](const ResolvedScene& scene, const State& state) {
            return scene.system->part<PlaneField>().problem->energy(state.x.data());
        };
        const ResolvedScene rest = lump(0), moving = lump(0.5);
        const PlaneFieldProblem& problem = *moving.system->part<PlaneField>().problem;
        const double own = energyOf(rest, rest.initial), E = energyOf(moving, moving.initial),
                     P = problem.momentum(moving.initial.x.data())[0];
        const State end = endOf(moving, 0, 0.1);
        const auto placeOf = [&](const State& state) {
            double sum = 0, all = 0;
            const std::size_t n = problem.nodes(), nx = problem.x().size();
            for (std::size_t i = 0; i < n; ++i) {
                const double density = state.x[i] * state.x[i] + state.x[n + i] * state.x[n + i];
                sum += problem.x()[i % nx] * density;
                all += density;
            }
            return sum / all;
        };
        const double travelled = placeOf(end) - placeOf(moving.initial),
                     after = problem.momentum(end.x.data())[0];
        qInfo("E %.6f, P %.6f, shell %.2e, speed %.6f, travelled %.6f", E, P,
              std::sqrt(E * E - P * P) / own - 1, P / E, travelled / 8);
        QVERIFY(std::abs(std::sqrt(E * E - P * P) / own - 1) < 1e-6);
        QVERIFY(std::abs(P / E - 0.5) < 1e-6 && std::abs(travelled / 8 - 0.5) < 1e-5);
        QVERIFY(std::abs(after / P - 1) < 1e-6);
    }
    /// With an interaction the norm is a part of the problem: that psi is scaled must be said.
    void aScaledNormIsSaid() {
        const auto warnings = [](const std::string& model, const std::string& initial) {
            const ReadScene read =
                readScene(R"J({"extremal":1,"model":{"type":"schrodinger","domain":[-20,20],"modes":512,)J" +
                          model + R"J(},"initial":{)J" + initial +
                          R"J(},"time":{"end":1},"schemes":[{"step":0.01,"baseline":"strang"}]})J");
            QString all;
            for (const Problem& p : read.warnings)
                all += QString::fromStdString(p.pointer + ": " + p.message + "; ");
            return all;
        };
        const std::string attracts = R"("interaction":-1)", typed = R"J("psi":{"re":"2/cosh(2*x)"})J";
        const QString said = warnings(attracts, typed);
        qInfo("%s", qPrintable(said));
        QVERIFY(said.contains("/initial/normalise: scales psi from the norm ∫|ψ|² = 4 to 1"));
        QVERIFY(warnings(attracts, typed + R"(,"normalise":false)").isEmpty());
        QVERIFY(warnings(attracts, R"J("psi":{"re":"1/cosh(2*x)"})J").isEmpty());  // of norm 1
        QVERIFY(warnings(attracts, R"("psi":{"packet":"gaussian"})").isEmpty());
        QVERIFY(warnings(R"("potential":"0")", typed).isEmpty());  // a linear equation
    }
};

EXTREMAL_TEST(FieldCasesTest)
}  // namespace extremal::field_cases_test

#include "field_cases_test.moc"
