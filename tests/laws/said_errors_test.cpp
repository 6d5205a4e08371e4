// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said of a scheme's error is true within [0.3, 3], or marked as not to be judged: on scenes of all
/// families, against truths that no reference of the program takes part in. Motions that have a Lagrangian
/// are extrapolated in quadruple precision from its formula, others are closed forms, bodies are integrated
/// from Euler's equations, and fields have elements of degree 3 on twice as many cells.
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

#include "engine/model/wave/basis/eigen.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/run/reference/stepped_solution.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/study/search/metric.hpp"
#include "engine/study/search/point.hpp"
#include "tests/tools/hard_motions.hpp"
#include "tests/tools/quadruple_lagrangian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::said_errors_test {
namespace {

using hard_motions::Case;
using Known = std::function<ExactSolution(const ResolvedScene&)>;

struct Subject {
    std::string name;
    std::string scene;
    std::vector<Override> changes;
    Known truth;
};

/// Solutions that are stepped along, whose times ascend.
ExactSolution quadruple(const ResolvedScene& scene) {
    return [motion = std::make_shared<QuadrupleLagrangian>(scene)](double t, std::span<double> x) {
        motion->at(t, x.data());
    };
}

/// Of places alone; momenta by differences, which errors of places do not see.
Known places(const Case& known) {
    return [truth = known.truth](const ResolvedScene&) -> ExactSolution {
        return [truth](double t, std::span<double> x) {
            const std::vector<double> q = truth(t);
            std::fill(x.begin(), x.end(), 0.0);
            std::copy(q.begin(), q.end(), x.begin());
        };
    };
}

/// A body that is free, or heavy with its centre of mass at `arm`: the quaternion of its attitude and its
/// momentum in the body, by extrapolation in quadruple precision.
class QuadrupleBody {
public:
    using Number = boost::multiprecision::float128;
    QuadrupleBody(const ResolvedScene& scene, std::array<double, 3> inertia, std::array<double, 3> arm)
        : t_(scene.initial.t) {
        for (int i = 0; i < 3; ++i) inertia_[i] = inertia[i], arm_[i] = arm[i];
        x_.assign(scene.initial.x.begin(), scene.initial.x.end());
    }
    /// As states of bodies have them.
    void at(double until, double* x) {
        constexpr double longest = 0.05;
        while (t_ < until) {
            const Number left = Number(until) - t_, h = std::min(Number(longest), left);
            x_ = extrapolatedStep(
                [this](const Number&, const std::vector<Number>& s, std::vector<Number>& d) { rate(s, d); },
                t_, x_, h);
            t_ += h;
        }
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] = static_cast<double>(x_[i]);
    }

private:
    /// q' = q (0, omega)/2, pi' = pi x omega + gamma x arm, of U = arm . gamma with gamma = R^T e3.
    void rate(const std::vector<Number>& s, std::vector<Number>& d) const {
        d.resize(s.size());
        const Number* const q = s.data();
        const Number* const pi = s.data() + 4;
        const std::array<Number, 3> w{pi[0] / inertia_[0], pi[1] / inertia_[1], pi[2] / inertia_[2]};
        d[0] = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
        d[1] = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
        d[2] = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
        d[3] = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
        const std::array<Number, 3> gamma{2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]),
                                          q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3]};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            d[4 + i] = pi[j] * w[k] - pi[k] * w[j] + gamma[j] * arm_[k] - gamma[k] * arm_[j];
        }
    }
    Number t_;
    std::array<Number, 3> inertia_, arm_;
    std::vector<Number> x_;
};
Known body(std::array<double, 3> inertia, std::array<double, 3> arm) {
    return [=](const ResolvedScene& scene) -> ExactSolution {
        return [motion = std::make_shared<QuadrupleBody>(scene, inertia, arm)](
                   double t, std::span<double> x) { motion->at(t, x.data()); };
    };
}

/// Elements of degree 3 in space and time on twice as many cells, with steps of a quarter.
ExactSolution finerMesh(const ResolvedScene& scene) {
    constexpr int times = 2, shorter = 4;
    SchemeSpec spec;
    spec.kind = SchemeSpec::Kind::discretization;
    spec.space = {"tent",
                  {{"degree", 3.0},
                   {"cells", static_cast<double>(times * scene.scene.model.integer("cells"))},
                   {"functions", "lagrange"}},
                  {}};
    spec.quadrature.type = "auto";
    spec.solver.type = "auto";
    ResolvedScheme scheme = resolve(spec, scene.system.get());
    resolveSystem(scheme, scene.scene);
    const double h = scene.schemes.front().spec.step.value / shorter;
    const auto make = [scheme, h] { return scheme.make(*scheme.ownSystem, h, scheme.ownInitial); };
    const MeshSolution solution{scheme.ownSystem, scheme.ownInitial.x.size(),
                                stepped(make, scheme.ownInitial, scene.scene.end.value)};
    return solution.on(systemOf(scene, scene.schemes.front()));
}

/// psi(x, t) at the nodes.
using Wave = std::function<std::complex<double>(double x, double t)>;
Known wave(const Wave& psi) {
    return [psi](const ResolvedScene& scene) -> ExactSolution {
        return [psi, system = scene.system](double t, std::span<double> x) {
            const Hamiltonian& h = *system->hamiltonian();
            const auto n = static_cast<std::size_t>(h.size());
            std::vector<std::complex<double>> values(n), c(n);
            for (std::size_t i = 0; i < n; ++i) values[i] = psi(h.x()[i], t);
            h.toCoefficients(values.data(), c.data());
            for (std::size_t i = 0; i < n; ++i) coefficients(x.data())[i] = c[i];
        };
    };
}
/// Of the oscillator with omega = m = hbar = 1, from the ground state moved to -3.
std::complex<double> coherent(double x, double t) {
    const double q = -3 * std::cos(t), p = 3 * std::sin(t);
    return std::pow(std::numbers::pi, -0.25) *
           std::exp(std::complex<double>(-(x - q) * (x - q) / 2, p * x - p * q / 2 - t / 2));
}
/// A free packet of width s with wave number k.
std::complex<double> freePacket(double x, double t, double s, double k) {
    const std::complex<double> i(0, 1), spread = 1.0 + i * t / (2 * s * s);
    const double d = x - k * t;
    return std::pow(2 * std::numbers::pi * s * s, -0.25) / std::sqrt(spread) *
           std::exp(-d * d / (4 * s * s * spread) + i * (k * x - k * k * t / 2));
}

const std::string packet = R"~({"extremal":1,"model":{"type":"schrodinger","potential":"free",
    "domain":[-20,20],"modes":256},"initial":{"psi":{"packet":"gaussian","centre":0,"width":1,
    "wave_number":2}},"time":{"end":3},"observe":["error"],"schemes":[{"step":0.1,
    "scheme":"schrodinger-gauss-1"}]})~";

std::string lagrangian(const std::string& coordinates, const std::string& formula, const std::string& initial,
                       double end, const std::string& scheme) {
    return hard_motions::sceneOf(coordinates, formula, initial, end, scheme);
}

std::string textOf(const char* preset) { return std::string(findPreset(preset)->json); }

const std::vector<Subject>& subjects() {
    using hard_motions::rk4;
    const auto end = [](double value) { return Override{"/time/end", value}; };
    const auto only = [](const char* scheme, double step) {
        return Override{"/schemes",
                        Value(Value::Array{Value(Value::Object{{"scheme", scheme}, {"step", step}})})};
    };
    const auto baseline = [](const char* id, double step) {
        return Override{"/schemes",
                        Value(Value::Array{Value(Value::Object{{"baseline", id}, {"step", step}})})};
    };
    const Override computed{"/reference", Value(Value::Object{{"type", "auto"}})};
    static const std::vector<Subject> all = [&] {
        using namespace hard_motions;
        const Case grazes = grazing(), well = wells(), kick = pulse(1e-3), chaos = chaotic(),
                   ball = contact();
        std::vector<Subject> list{
            {"an orbit that grazes its star", grazes.scene, {}, places(grazes)},
            {"wells of abs(x)", well.scene, {}, places(well)},
            {"a pulse of width 1e-3", kick.scene, {}, places(kick)},
            {"a pulse stepped over", kick.scene, {{"/schemes/0/step", 0.1}}, places(kick)},
            {"double pendulum to t = 20", chaos.scene, {}, places(chaos)},
            {"a contact by (abs(z) - z)/2", ball.scene, {}, places(ball)},
            {"oscillator", textOf("harmonic-oscillator"), {end(10), only("midpoint", 0.2)}, quadruple},
            {"pendulum", textOf("pendulum"), {end(10), only("galerkin-gauss-2", 0.1)}, quadruple},
            {"pendulum, RK4", textOf("pendulum"), {end(10), baseline("rk4", 0.1)}, quadruple},
            {"pendulum at the separatrix",
             textOf("pendulum-separatrix"),
             {end(5), only("midpoint", 0.05)},
             quadruple},
            {"Kepler", textOf("kepler"), {end(10), only("galerkin-gauss-3", 0.1)}, quadruple},
            {"Kepler, fine", textOf("kepler"), {end(10), only("galerkin-gauss-6", 0.1)}, quadruple},
            {"Hénon-Heiles", textOf("henon-heiles"), {end(50), only("galerkin-gauss-2", 0.5)}, quadruple},
            {"Hénon-Heiles, to t = 200",
             textOf("henon-heiles"),
             {end(200), only("galerkin-gauss-4", 0.5)},
             quadruple},
            {"Duffing", textOf("duffing"), {end(10), only("galerkin-lobatto-3", 0.2)}, quadruple},
            {"forced pendulum",
             textOf("forced-pendulum"),
             {end(10), only("galerkin-gauss-2", 0.2)},
             quadruple},
            {"double well", textOf("double-well"), {end(20), only("midpoint", 0.2)}, quadruple},
            {"spring pendulum",
             textOf("spring-pendulum"),
             {end(0.5), only("galerkin-gauss-4", 0.01)},
             quadruple},
            {"spring pendulum, one harmonic",
             textOf("spring-pendulum"),
             {end(0.5), only("multiscale-r1", 0.1)},
             quadruple},
            {"Fermi-Pasta-Ulam chain",
             lagrangian(R"("a","b","c")",
                        "(a_t^2+b_t^2+c_t^2)/2-(a^2+(b-a)^2+(c-b)^2+c^2)/2-(a^4+(b-a)^4+(c-b)^4+c^4)",
                        R"({"q":[1,0,0.5],"v":[0,0.3,0]})", 10,
                        R"({"baseline":"stormer-verlet","step":0.05})"),
             {},
             quadruple},
            {"three bodies", textOf("three-bodies"), {end(1), computed, baseline("rk4", 0.02)}, quadruple},
            {"two planets",
             lagrangian(R"("x","y","u","w")",
                        "(x_t^2+y_t^2)/2+(u_t^2+w_t^2)/200+1/sqrt(x^2+y^2)+1/(100*sqrt(u^2+w^2))+"
                        "1/(1000*sqrt((x-u)^2+(y-w)^2))",
                        R"({"q":[1,0,0,2],"v":[0,1,-0.7,0]})", 10,
                        R"({"scheme":"galerkin-gauss-2","step":0.2})"),
             {},
             quadruple},
            {"charged particle",
             textOf("charged-particle"),
             {end(30), only("galerkin-gauss-2", 0.6)},
             quadruple},
            {"own, magnetic, driven",
             lagrangian(R"("x","y")", "(x_t^2+y_t^2)/2+0.5*(x*y_t-y*x_t)-(x^2+2*y^2)/2+0.3*x*cos(1.3*t)",
                        R"({"q":[1,0],"v":[0,0.5]})", 10, R"({"baseline":"rk4","step":0.1})"),
             {},
             quadruple},
            {"free body", textOf("free-body"), {end(20), only("lie-2", 0.25)}, body({1, 2, 3}, {0, 0, 0})},
            {"heavy top", textOf("heavy-top"), {end(10), only("lie-1", 0.1)}, body({1, 1, 0.5}, {0, 0, 1})},
            {"sine-Gordon kink, degree 2",
             textOf("sine-gordon-kink"),
             {only("multisymplectic-2", 0.2)},
             finerMesh},
            {"sine-Gordon kink that meets a wall",
             textOf("sine-gordon-kink"),
             {end(20), {"/initial/x0", 12.0}, only("multisymplectic-1", 0.1)},
             finerMesh},
            {"breather", textOf("breather"), {end(12), only("multisymplectic-1", 0.1)}, finerMesh},
            {"phi4 kink", textOf("phi4-kink"), {only("multisymplectic-1", 0.1)}, finerMesh},
            {"Klein-Gordon wave", textOf("klein-gordon"), {only("multisymplectic-1", 0.05)}, finerMesh},
            {"coherent state",
             textOf("coherent-state"),
             {end(6), only("schrodinger-gauss-2", 0.1)},
             wave(coherent)},
            {"coherent state on 32 modes",
             textOf("coherent-state"),
             {end(6), {"/model/modes", 32.0}, only("schrodinger-gauss-2", 0.05)},
             wave(coherent)},
            {"free packet", packet, {}, wave([](double x, double t) { return freePacket(x, t, 1, 2); })}};
        return list;
    }();
    return all;
}

}  // namespace

class SaidErrorsTest : public QObject {
    Q_OBJECT
private slots:
    void whatIsSaidIsTrueOrMarked_data() {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < subjects().size(); ++i)
            QTest::newRow(subjects()[i].name.c_str()) << static_cast<int>(i);
    }
    void whatIsSaidIsTrueOrMarked() {
        QFETCH(int, index);
        const Subject& subject = subjects()[static_cast<std::size_t>(index)];
        std::vector<Override> changes = subject.changes;
        changes.push_back({"/observe", Value(Value::Array{"error"})});
        changes.push_back({"/views", Value(Value::Array{})});
        const ReadScene read = readScene(subject.scene, changes);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Comparison done = run(read.scene);
        const Summary& summary = done.schemes.front()->summary;
        QVERIFY(summary.status == RunStatus::done);
        const ResolvedScene& scene = *read.resolved;
        // Up to the horizon, where there is one.
        double said = summary.maxError;
        ResolvedScene judged = scene;
        if (std::isfinite(done.reference.horizon)) {
            said = 0;
            const auto t = done.schemes.front()->trajectory["t"],
                       error = done.schemes.front()->trajectory["error"];
            for (std::size_t i = 0; i < t.size() && t[i] <= done.reference.horizon; ++i)
                said = std::max(said, error[i]), judged.scene.end = {t[i], {}};
        }
        const Metric metric = metricOf("column:error", false, *scene.system, scene.initial);
        StudyPoint point;
        point.step = scene.schemes.front().spec.step.value;
        point.tolerance = scene.schemes.front().spec.tolerance.value_or(0);
        ExactSolution truth;
        try {
            truth = subject.truth(scene);
        } catch (const std::exception& e) {
            QFAIL(e.what());
        }
        const double real = runPoint(judged, point, metric, std::move(truth), 0, {}).error;
        const double ratio = real / said;
        const bool isMarked = summary.floor >= said || !done.reference.caution.empty() ||
                              summary.caution.find("judged") != std::string::npos;
        qInfo("%-36s said %.3e, true %.3e, ratio %.3f; floor %.1e of %s, bound %.1e, horizon %.4g%s%s%s",
              subject.name.c_str(), said, real, ratio, summary.floor, summary.floorOf.c_str(),
              std::isfinite(done.reference.bound) ? done.reference.bound : done.reference.estimatedError,
              done.reference.horizon, isMarked ? "; marked: " : "", done.reference.caution.c_str(),
              summary.caution.c_str());
        QVERIFY((ratio >= 0.3 && ratio <= 3) || isMarked);
    }
};

EXTREMAL_TEST(SaidErrorsTest)
}  // namespace extremal::laws::said_errors_test
#include "said_errors_test.moc"
