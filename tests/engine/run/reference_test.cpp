// SPDX-License-Identifier: GPL-3.0-or-later
/// A reference keeps what it promises: its own estimate of its error is never below its error, found from
/// exact solutions and, for chaotic and stiff motion, from runs in quadruple precision.
#include <QTest>

#include <boost/multiprecision/float128.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/family/wave/chebyshev_series.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::reference_test {
namespace {

using Quad = boost::multiprecision::float128;
using QuadState = std::array<Quad, 4>;

ResolvedScene resolved(const std::string& scene) {
    const ReadScene read = readScene(scene);
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return *read.resolved;
}

/// Of a system that does not know its exact motion.
ResolvedScene withoutExact(ResolvedScene scene) {
    System system = *scene.system;
    system.exact = {};
    scene.system = std::make_shared<const System>(std::move(system));
    return scene;
}

/// The largest error of a reference at times spread over the run.
double errorOf(const Reference& reference, const ResolvedScene& scene, const ExactSolution& truth,
               int samples) {
    const ErrorMeasure measure = errorMeasure(*scene.system, scene.initial);
    const ExactSolution solution = reference.make();
    std::vector<double> x(scene.initial.x.size()), y = x, values(measure.columns.size());
    double worst = 0;
    for (int i = 1; i <= samples; ++i) {
        const double t =
            scene.scene.start.value + (scene.scene.end.value - scene.scene.start.value) * i / samples;
        solution(t, x);
        truth(t, y);
        measure.evaluate(x.data(), y.data(), values.data());
        worst = std::max(worst, values[0]);
    }
    return worst;
}

/// The error of the reference over what it says of itself.
double broken(const ResolvedScene& scene, const ExactSolution& truth, int samples) {
    const Reference reference = makeReference(scene, {});
    if (!reference.make) return INFINITY;
    const double error = errorOf(reference, scene, truth, samples);
    qInfo("%s (%s): good to %.2e, off by %.2e", reference.info.description.c_str(),
          reference.info.type.c_str(), reference.info.estimatedError, error);
    return error / reference.info.estimatedError;
}

/// Motion in quadruple precision by a formula of order 8, `perSample` steps between the times that are asked.
template <class Rate>
ExactSolution inQuadruple(const State& start, Rate rate, double between, int perSample) {
    struct Motion {
        Rate rate;
        double start, between;
        int perSample;
        long long done = 0;
        QuadState x;
        boost::numeric::odeint::runge_kutta_fehlberg78<QuadState, Quad, QuadState, Quad> stepper = {};
    };
    Motion motion{rate, start.t, between, perSample, 0, {}};
    for (std::size_t i = 0; i < 4; ++i) motion.x[i] = start.x[i];
    return [motion = std::make_shared<Motion>(std::move(motion))](double t, std::span<double> x) {
        const Quad h = Quad(motion->between) / motion->perSample;
        const long long wanted = std::llround((t - motion->start) / motion->between);
        for (; motion->done < wanted; ++motion->done)
            for (int k = 0; k < motion->perSample; ++k)
                motion->stepper.do_step(motion->rate, motion->x, Quad(0), h);
        for (std::size_t i = 0; i < 4; ++i) x[i] = static_cast<double>(motion->x[i]);
    };
}

/// A wave function by the Chebyshev series of the exponential, whose error is round-off.
ExactSolution inSeries(const ResolvedScene& scene, int samples) {
    const double step = (scene.scene.end.value - scene.scene.start.value) / samples;
    const std::shared_ptr<Integrator> series = makeChebyshevSeries(scene.system->hamiltonian(), step);
    return [series, state = std::make_shared<State>(scene.initial)](double t, std::span<double> x) {
        while (state->t < t - series->stepSize() / 2)
            if (advance(*series, *state).outcome != Outcome::converged) qFatal("no series");
        std::copy(state->x.begin(), state->x.end(), x.begin());
    };
}

/// Without a potential every mode has its own phase.
ExactSolution freely(const ResolvedScene& scene) {
    return [h = scene.system->hamiltonian(), start = scene.initial](double t, std::span<double> x) {
        for (std::size_t k = 0; k < h->kinetic().size(); ++k) {
            const long double angle = -static_cast<long double>(h->kinetic()[k]) * t / h->hbar();
            const std::complex<long double> phase = std::polar(1.0L, angle),
                                            c(start.x[2 * k], start.x[2 * k + 1]), end = c * phase;
            x[2 * k] = static_cast<double>(end.real());
            x[2 * k + 1] = static_cast<double>(end.imag());
        }
    };
}

std::string scene(const std::string& model, const std::string& initial, const std::string& end,
                  const std::string& reference = "\"auto\"") {
    return R"({"extremal":1,"model":)" + model + R"(,"initial":)" + initial + R"(,"time":{"end":)" + end +
           R"(},"reference":)" + reference + R"(,"schemes":[{"baseline":"rk4","step":0.01}]})";
}

}  // namespace

class ReferenceTest : public QObject {
    Q_OBJECT
private slots:
    void computedOnesKeepTheirPromise_data() {
        QTest::addColumn<QString>("scene");
        const auto row = [](const char* name, const std::string& s) {
            QTest::newRow(name) << QString::fromStdString(s);
        };
        row("Kepler", scene(R"({"type":"kepler"})", R"({"q":[0.4,0],"p":[0,2]})", "20"));
        row("Kepler, e = 0.95",
            scene(R"({"type":"kepler"})", R"({"q":[0.05,0],"p":[0,6.244997998398398]})", "13"));
        row("oscillator", scene(R"({"type":"harmonic-oscillator"})", R"({"q":[1],"p":[0.3]})", "300"));
        const std::string lie = R"("schemes":[{"scheme":"lie-1","step":0.05}]})";
        row("free body", R"({"extremal":1,"model":{"type":"rigid-body"},"time":{"end":60},)"
                         R"("initial":{"attitude":[1,0,0,0],"momentum":[0.5,0.2,0.8]},)" +
                             lie);
        const std::string psi =
            R"("initial":{"psi":{"packet":"periodic-gaussian","kappa":20,"centre":1.2,"wave_number":5}},)"
            R"("schemes":[{"scheme":"schrodinger-gauss-1","step":0.01}]})";
        row("wave function", R"({"extremal":1,"time":{"end":2},"model":{"type":"schrodinger","modes":96,)"
                             R"("potential":"50*(1 - cos(x)) "},)" +
                                 psi);
        row("semiclassical wave",
            R"({"extremal":1,"time":{"end":2},"model":{"type":"schrodinger","modes":256,)"
            R"("hbar":0.02,"potential":"1 - cos(x) "},)" +
                psi);
    }
    void computedOnesKeepTheirPromise() {
        QFETCH(QString, scene);
        const ResolvedScene known = resolved(scene.toStdString()), unknown = withoutExact(known);
        constexpr int samples = 500;
        // Eigenvalues of a large matrix are themselves off by its round-off.
        const ExactSolution truth =
            known.system->parts.find<Wave>() ? inSeries(known, samples) : known.system->exact(known.initial);
        QVERIFY(truth);
        QVERIFY(broken(unknown, truth, samples) < 1);  // measured: at most 0.6, Kepler, e = 0.95
    }
    void exactOnesKeepTheirPromise_data() {
        QTest::addColumn<QString>("scene");
        const auto row = [](const char* name, const std::string& s) {
            QTest::newRow(name) << QString::fromStdString(s);
        };
        const auto wave = [](const char* end, const char* model) {
            return R"({"extremal":1,"time":{"end":)" + std::string(end) +
                   R"(},"model":{"type":"schrodinger",)" + model +
                   R"(},"schemes":[{"scheme":"schrodinger-gauss-1","step":0.01}],"initial":{"psi":)"
                   R"({"packet":"periodic-gaussian","kappa":20,"centre":1.2,"wave_number":5}}})";
        };
        row("wave function", wave("2", R"("modes":96,"potential":"50*(1 - cos(x)) ")"));
        row("wave function, long", wave("20", R"("modes":96,"potential":"50*(1 - cos(x)) ")"));
        row("wave function, unresolved", wave("2", R"("modes":96,"potential":"5000*(1 - cos(x)) ")"));
        row("semiclassical wave", wave("2", R"("modes":256,"hbar":0.02,"potential":"1 - cos(x) ")"));
        row("free wave", wave("2", R"("modes":256,"potential":"0*x")"));
        row("free wave, long", wave("200", R"("modes":64,"potential":"0*x")"));
        row("Kepler", scene(R"({"type":"kepler"})", R"({"q":[0.4,0],"p":[0,2]})", "20"));
        row("Kepler, long", scene(R"({"type":"kepler"})", R"({"q":[0.4,0],"p":[0,2]})", "200"));
    }
    void exactOnesKeepTheirPromise() {
        QFETCH(QString, scene);
        const ResolvedScene s = resolved(scene.toStdString());
        constexpr int samples = 100;
        const double between = s.scene.end.value / samples;
        const auto kepler = [](const QuadState& x, QuadState& dx, const Quad&) {
            const Quad r2 = x[0] * x[0] + x[1] * x[1], r3 = r2 * sqrt(r2);
            dx = {x[2], x[3], -x[0] / r3, -x[1] / r3};
        };
        const ExactSolution truth = !s.system->parts.find<Wave>()
                                        ? inQuadruple(s.initial, kepler, between, 400)
                                    : scene.contains("0*x") ? freely(s)
                                                            : inSeries(s, samples);
        QVERIFY(broken(s, truth, samples) < 1);
    }
    void chaoticAndStiffOnesKeepTheirPromise_data() {
        QTest::addColumn<bool>("isStiff");
        QTest::addColumn<double>("end");
        QTest::newRow("chaotic, T = 40") << false << 40.0;
        QTest::newRow("chaotic, T = 200") << false << 200.0;
        QTest::newRow("stiff") << true << 10.0;
    }
    void chaoticAndStiffOnesKeepTheirPromise() {
        QFETCH(bool, isStiff);
        QFETCH(double, end);
        const std::string model = isStiff
                                      ? R"({"type":"lagrangian","coordinates":["a","u"],"lagrangian":)"
                                        R"("a_t^2/2 + (1 + a)^2*u_t^2/2 + 9.81*(1 + a)*cos(u) - 5000*a^2"})"
                                      : R"({"type":"lagrangian","coordinates":["x","y"],"lagrangian":)"
                                        R"("x_t^2/2 + y_t^2/2 - x^2/2 - y^2/2 - x^2*y + y^3/3"})";
        const std::string start = isStiff ? R"({"q":[0.01,1],"p":[0,0]})" : R"({"q":[0,0.1],"p":[0.49,0.2]})";
        const ResolvedScene s = resolved(scene(model, start, std::to_string(end)));
        const auto rate = [isStiff](const QuadState& x, QuadState& dx, const Quad&) {
            const Quad &q = x[0], &y = x[1], &p = x[2], &w = x[3];
            if (isStiff) {
                const Quad r = 1 + q, u = w / (r * r);
                dx = {p, u, r * u * u + Quad(9.81) * cos(y) - 10000 * q, -Quad(9.81) * r * sin(y)};
            } else {
                dx = {p, w, -q - 2 * q * y, -y - q * q + y * y};
            }
        };
        const int samples = isStiff ? 200 : static_cast<int>(end);
        // The steps of the formula resolve the motion to 1e-20: half of them change nothing.
        QVERIFY(broken(s, inQuadruple(s.initial, rate, end / samples, isStiff ? 60 : 40), samples) < 1);
    }
    void stiffSpringsAreNotResolved_data() {
        QTest::addColumn<QString>("k");
        QTest::addColumn<bool>("isResolvable");
        QTest::newRow("1e6") << "1e6" << true;
        QTest::newRow("1e12") << "1e12" << false;
    }
    void stiffSpringsAreNotResolved() {
        QFETCH(QString, k);
        QFETCH(bool, isResolvable);
        const auto spring = [&](const std::string& reference) {
            const std::string text =
                R"({"extremal":1,"model":{"type":"spring-pendulum","k":)" + k.toStdString() +
                R"(},"initial":{"q":["0.05*sqrt(1e4/k) ",1]},"time":{"end":6},)" + R"("reference":)" +
                reference + R"(,"schemes":[{"step":0.1,"scheme":"multiscale-r3"}]})";
            return *readScene(text).resolved;
        };
        const ResolvedScene s = spring(R"("auto")");
        const Reference found = makeReference(s, {});
        qInfo("%s: good to %.2e", found.info.description.c_str(), found.info.estimatedError);
        QVERIFY(found.info.description.starts_with("multiscale"));
        QVERIFY(found.info.estimatedError < 1e-10);  // 2e-14 at 1e6, 3e-11 at 1e12
        if (!isResolvable) return;
        const Reference resolvedOne = makeReference(
            spring(R"({"type":"scheme","scheme":{"step":0.0005,"scheme":"galerkin-gauss-8"}})"), {});
        const ExactSolution a = found.make(), b = resolvedOne.make();
        std::vector<double> x(4), y(4);
        double worst = 0;
        for (int i = 1; i <= 60; ++i) {
            a(0.1 * i, x);
            b(0.1 * i, y);
            worst = std::max({worst, std::abs(x[0] - y[0]), std::abs(x[1] - y[1])});
        }
        qInfo("apart: %.2e", worst);
        QVERIFY(worst < 1e-11);
    }
    void schemesAsReferencesKeepTheirPromise_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {R"("scheme":"midpoint","step":0.001)", R"("scheme":"galerkin-gauss-2","step":0.01)",
              R"("baseline":"rk4","step":0.002)"})
            QTest::newRow(scheme) << QString(scheme);
    }
    void schemesAsReferencesKeepTheirPromise() {
        QFETCH(QString, scheme);
        const ResolvedScene s =
            resolved(scene(R"({"type":"kepler"})", R"({"q":[0.4,0],"p":[0,2]})", "10",
                           R"({"type":"scheme","scheme":{)" + scheme.toStdString() + "}}"));
        QVERIFY(broken(s, s.system->exact(s.initial), 501) < 1);
    }
};

EXTREMAL_TEST(ReferenceTest)
}  // namespace extremal::reference_test

#include "reference_test.moc"
