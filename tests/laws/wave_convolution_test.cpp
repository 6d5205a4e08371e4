// SPDX-License-Identifier: GPL-3.0-or-later
/// Leok's exact convolution as a choice: its own norm is kept, and it differs from products at the nodes
/// by aliasing alone.
#include <QTest>

#include <Eigen/Core>

#include <numbers>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/convolution.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_convolution_test {
namespace {

ConvolutionProblem galerkinOf(const Hamiltonian& h) {
    return convolutionGalerkin(h.fourierBasis(), h.potentialSeries());
}

System systemOf(int modes, const char* product, const Value& potential = "20*exp(cos(x))") {
    return systemNamed(
        "schrodinger",
        {{"modes", static_cast<double>(modes)}, {"potential", potential}, {"product", product}});
}
State run(const System& system, const Discretization& discretization, const State& start, double T, int n) {
    const auto integrator = makeIntegrator(system, discretization, {0, T / n});
    const auto end = after(*integrator, start, n);
    return end ? *end : State{};
}
State exactAt(const System& system, const State& start, double t) {
    State end = start;
    system.exact(start)(t, end.x);
    return end;
}
std::vector<Complex> valuesOf(const System& system, const State& state) {
    std::vector<Complex> psi(static_cast<std::size_t>(system.hamiltonian()->size()));
    system.hamiltonian()->toNodes(coefficients(state.x.data()), psi.data());
    return psi;
}
/// In the norm of the nodes.
double apart(const System& a, const State& x, const System& b, const State& y) {
    const auto u = valuesOf(a, x), v = valuesOf(b, y);
    double sum = 0;
    for (std::size_t j = 0; j < u.size(); ++j)
        sum += std::norm(u[j] - v[j]) * 2 * std::numbers::pi / static_cast<double>(u.size());
    return std::sqrt(sum);
}
std::string refusal(const System& system, const Discretization& discretization) {
    try {
        (void)makeIntegrator(system, discretization, {0, 0.01});
    } catch (const InvalidScene& e) {
        return e.problems()[0].pointer;
    }
    return {};
}

}  // namespace

class WaveConvolutionTest : public QObject {
    Q_OBJECT
private slots:
    void valuesAndCoefficientsBelongTogether() {
        const System system = systemOf(16, "convolution");
        const Hamiltonian& h = *system.hamiltonian();
        std::vector<Complex> c(16), psi(16), back(16);
        for (std::size_t i = 0; i < 16; ++i)
            c[i] = std::polar(1.0 / (1 + static_cast<double>(i)), static_cast<double>(i));
        h.toNodes(c.data(), psi.data());
        h.toCoefficients(psi.data(), back.data());
        for (std::size_t i = 0; i < 16; ++i) QVERIFY(std::abs(c[i] - back[i]) < 1e-15);
        // |c|^2 is the integral of |psi|^2 itself: of cos(8 x) pi, which the nodes alone take for 2 pi.
        for (int j = 0; j < 16; ++j) psi[static_cast<std::size_t>(j)] = j % 2 == 0 ? 1 : -1;
        h.toCoefficients(psi.data(), c.data());
        QVERIFY(std::abs(squaredNorm(c.data(), 16) - std::numbers::pi) < 1e-14);
        systemOf(16, "nodes").hamiltonian()->toCoefficients(psi.data(), c.data());
        QVERIFY(std::abs(squaredNorm(c.data(), 16) - 2 * std::numbers::pi) < 1e-14);
    }
    /// H in the run's coordinates is the convolution of the time-independent problem: the same energies, also
    /// of a random potential, whose coefficients are complex.
    void energiesAreThoseOfTheGeneralisedProblem() {
        const Value random = Value::Object{{"name", "random"}, {"amplitude", 30.0}, {"correlation", 0.4}};
        for (const Value& potential : {Value("20*exp(cos(x))"), random}) {
            const System system = systemOf(32, "convolution", potential);
            const ConvolutionProblem given = galerkinOf(*systemOf(32, "nodes", potential).hamiltonian());
            // A Hermitian matrix in real numbers: every eigenvalue is there twice.
            const Eigen::VectorXd scale = given.W.cwiseSqrt().cwiseInverse();
            const Eigen::MatrixXcd H = scale.asDiagonal() * given.H * scale.asDiagonal();
            Eigen::MatrixXd inReals(64, 64);
            inReals << H.real(), -H.imag(), H.imag(), H.real();
            const Eigen::VectorXd expected = dense::symmetricEigen<double>(inReals).values;
            const auto& energies = Eigenstates::of(system.hamiltonian())->energies();
            double worst = 0;
            for (std::size_t k = 0; k < 32; ++k)
                worst = std::max(worst, std::abs(energies[k] - expected(static_cast<Eigen::Index>(2 * k))));
            qInfo("%.2g", worst);
            QVERIFY(worst < 1e-11);
            QVERIFY(system.hamiltonian()->lowest() <= energies.front() &&
                    energies.back() <= system.hamiltonian()->highest());
            // apply() is the same operator.
            const State start = waveStart(system, 5);
            std::vector<Complex> Hc(32), work(32), real(32), image(32);
            system.hamiltonian()->apply(nullptr, coefficients(start.x.data()), Hc.data(), work.data());
            const ConvolutionProblem p = galerkinOf(*system.hamiltonian());
            Eigen::VectorXcd v = Eigen::Map<const Eigen::VectorXcd>(coefficients(start.x.data()), 32);
            const Eigen::VectorXd root = p.W.cwiseSqrt().cwiseInverse();
            const Eigen::VectorXcd direct = root.asDiagonal() * (p.H * (root.asDiagonal() * v));
            QVERIFY((direct - Eigen::Map<const Eigen::VectorXcd>(Hc.data(), 32)).norm() < 1e-11);
        }
    }
    /// To the last bit: round-off in the transforms must not make the norm grow.
    void theMatrixIsSymmetric() {
        const Value random = Value::Object{{"name", "random"}, {"amplitude", 30.0}, {"correlation", 0.4}};
        for (const Value& potential : {Value("20*exp(cos(x))"), random}) {
            const System system = systemOf(32, "nodes", potential);
            const Eigen::MatrixXd H =
                realMatrix(galerkinOf(*system.hamiltonian()), system.hamiltonian()->fourier());
            QVERIFY(H.norm() > 1 && H == H.transpose());
        }
    }
    void differsByAliasingAlone() {
        double before = 10;
        for (const auto& [modes, most] :
             {std::pair{16, 2.0}, {24, 0.2}, {32, 1e-2}, {48, 1e-7}, {64, 1e-12}}) {
            const System nodes = systemOf(modes, "nodes"), convolution = systemOf(modes, "convolution");
            const double d = apart(nodes, exactAt(nodes, waveStart(nodes, 10, 1.2, 2), 1), convolution,
                                   exactAt(convolution, waveStart(convolution, 10, 1.2, 2), 1));
            qInfo("%d modes: %.2g", modes, d);
            QVERIFY(d < most);
            QVERIFY(d < before);
            before = d;
        }
        QVERIFY(before < 1e-12);
    }
    void keepsItsOwnNormAndEnergyUnresolvedToo() {
        const System system = systemOf(16, "convolution", "50*(1 - cos(x))");
        State state = startA(system);
        const double E = system.energy(0, state.x.data());
        const auto integrator = makeIntegrator(system, wavePair(2), {0, 1.0 / 64});
        double norm = 0, energy = 0;
        for (int k = 0; k < 2000; ++k) {
            (void)advance(*integrator, state);
            norm = std::max(norm, std::abs(std::sqrt(squaredNorm(coefficients(state.x.data()), 16)) - 1));
            energy = std::max(energy, std::abs(system.energy(0, state.x.data()) / E - 1));
        }
        qInfo("norm %.2g, energy %.2g", norm, energy);
        QVERIFY(norm < 1e-12);
        QVERIFY(energy < 1e-11);
        // Seen failing: the printed equation keeps one of the two rows at k = +-N/2, and is not Hermitian.
        // Crank-Nicolson with it.
        const ConvolutionProblem right = galerkinOf(*system.hamiltonian());
        Eigen::MatrixXcd printed = right.H;
        printed.row(8) /= 2;
        const Eigen::VectorXd root = right.W.cwiseSqrt().cwiseInverse();
        printed = root.asDiagonal() * printed * root.asDiagonal();
        const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(16, 16),
                               half = Complex(0, 0.5 / 64) * printed;
        Eigen::VectorXcd v = Eigen::Map<const Eigen::VectorXcd>(coefficients(startA(system).x.data()), 16);
        for (int k = 0; k < 64; ++k) v = dense::solve<Complex>(one + half, (one - half) * v);
        qInfo("printed: %.2g", std::abs(v.norm() - 1));
        QVERIFY(std::abs(v.norm() - 1) > 1e-3);
    }
    void schemesHaveTheirOrders() {
        const System system = systemOf(48, "convolution", "20*(1 - cos(x))");
        const State start = waveStart(system, 10, 1.2, 2), exact = exactAt(system, start, 1);
        for (const int s : {1, 2, 4}) {
            const double order = timeOrder(
                [&](int n) { return waveDistance(run(system, wavePair(s), start, 1, n), exact); }, 1e-11);
            qInfo("Gauss %d: %.3f", s, order);
            QVERIFY(std::abs(order - 2 * s) < 0.2);
        }
        Discretization three = wavePair(1);
        three.quadrature = {"exact", {}, {}};
        for (auto& [key, value] : three.space.keys)
            if (key == "form") value = "three-level";
        const double order = timeOrder(
            [&](int n) { return n < 400 ? 1 : waveDistance(run(system, three, start, 1, n), exact); }, 1e-8);
        qInfo("three-level: %.3f", order);
        QVERIFY(std::abs(order - 4) < 0.2);
        const auto series = findBaseline("chebyshev-propagation")->make(system, {0.5, {}, 0, {}});
        QVERIFY(waveDistance(*after(*series, start, 2), exact) < 1e-12);
    }
    void whatNeedsTheNodesSaysSo() {
        const System system = systemOf(32, "convolution");
        QCOMPARE(refusal(system, wavePair(2, "krylov")), std::string("/solver/method"));
        QCOMPARE(refusal(system, wavePair(2, "banded")), std::string("/solver/method"));
        for (const char* id : {"strang", "srkn-14a", "spectral-collocation"}) {
            const BaselineEntry* entry = findBaseline(id);
            QVERIFY_EXCEPTION_THROWN((void)entry->make(system, {0.01, {}, 0, defaultsOf(entry->item)}),
                                     InvalidScene);
        }
        QVERIFY_EXCEPTION_THROWN((void)systemOf(1024, "convolution"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN((void)systemOf(32, "convolution", "cos(x - t)"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN(
            (void)systemNamed("schrodinger",
                              {{"product", "convolution"}, {"boundary", "dirichlet"}, {"modes", 32.0}}),
            InvalidScene);
    }
};

EXTREMAL_TEST(WaveConvolutionTest)
}  // namespace extremal::laws::wave_convolution_test

#include "wave_convolution_test.moc"
