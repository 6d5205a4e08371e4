// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions on a rectangle, against products of solutions in one dimension, eigenstates, and each
/// other.
#include <QTest>

#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/model/wave/spectrum.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_plane_test {
namespace {

/// 4 pi by 5 in size, neither of which starts at 0, with unequal modes.
constexpr double left = -1, width = 12.566370614359172, bottom = 2, height = 5;
const Value alongX = Value::Array{left, left + width}, alongY = Value::Array{bottom, bottom + height};

System rectangle(int nx, int ny, const Value& potential, double hbar = 1) {
    return systemNamed("schrodinger-2d", {{"modes", static_cast<double>(nx)},
                                          {"modes_y", static_cast<double>(ny)},
                                          {"potential", potential},
                                          {"hbar", hbar},
                                          {"domain", alongX},
                                          {"domain_y", alongY}});
}
System line(int n, const Value& domain, const Value& potential) {
    return systemNamed("schrodinger",
                       {{"modes", static_cast<double>(n)}, {"potential", potential}, {"domain", domain}});
}

double waves(int number, double length) { return 2 * std::numbers::pi * number / length; }

State startOf(const System& system, Value::Object psi) {
    Settings given;
    given.keys.emplace_back("psi", std::move(psi));
    given.keys.emplace_back("normalise", true);
    return {0, 0, system.start(given, 0)};
}
State packetOn(const System& system) {
    return startOf(system, {{"packet", "periodic-gaussian"},
                            {"kappa", 8.0},
                            {"centre", 4.0},
                            {"wave_number", waves(2, width)},
                            {"kappa_y", 5.0},
                            {"centre_y", 4.2},
                            {"wave_number_y", waves(-2, height)}});
}
State packetAlong(const System& system, double kappa, double centre, double k) {
    return startOf(
        system, {{"packet", "periodic-gaussian"}, {"kappa", kappa}, {"centre", centre}, {"wave_number", k}});
}
/// Smooth enough for few modes.
State widePacket(const System& system) {
    return startOf(system, {{"packet", "periodic-gaussian"},
                            {"kappa", 2.0},
                            {"centre", 4.0},
                            {"kappa_y", 1.5},
                            {"centre_y", 4.2}});
}

/// psi(x, y) = f(x) g(y).
State product(const State& f, const State& g) {
    State both{f.t, f.node, {}};
    for (std::size_t j = 0; j < g.x.size() / 2; ++j)
        for (std::size_t i = 0; i < f.x.size() / 2; ++i) {
            const Complex c = coefficients(f.x.data())[i] * coefficients(g.x.data())[j];
            both.x.insert(both.x.end(), {c.real(), c.imag()});
        }
    return both;
}

std::unique_ptr<Integrator> baseline(const char* id, const System& system, double h) {
    const BaselineEntry* entry = findBaseline(id);
    return entry->make(system, {h, {}, 0, defaultsOf(entry->item)});
}
State run(Integrator& integrator, const State& start, int n) {
    const auto end = after(integrator, start, n);
    return end ? *end : State{};
}
State run(const char* id, const System& system, const State& start, double T, int n) {
    return run(*baseline(id, system, T / n), start, n);
}
State run(const Discretization& discretization, const System& system, const State& start, double T, int n) {
    return run(*makeIntegrator(system, discretization, {0, T / n}), start, n);
}
double norm(const System& system, const State& state) {
    return std::sqrt(squaredNorm(coefficients(state.x.data()), system.hamiltonian()->size()));
}

constexpr const char* potentialX = "6*(1 - cos((x + 1)/2 - 2.5))";
constexpr const char* potentialY = "3*(1 - sin(2*pi*(x - 2)/5))";
const std::string sum = std::string(potentialX) + " + 3*(1 - sin(2*pi*(y - 2)/5))";
/// Couples x and y.
const std::string coupled = sum + " + 2*cos((x + 1)/2 - 0.3)*cos(2*pi*(y - 2)/5)";

}  // namespace

class WavePlaneTest : public QObject {
    Q_OBJECT
private slots:
    void transformsAreUnitaryAndThere() {
        const System system = rectangle(32, 20, 0.0);
        const State start = packetOn(system);
        const Hamiltonian& h = *system.hamiltonian();
        const auto n = static_cast<std::size_t>(h.size());
        std::vector<Complex> psi(n), back(n);
        h.toNodes(coefficients(start.x.data()), psi.data());
        h.toCoefficients(psi.data(), back.data());
        double worst = 0, onNodes = 0;
        for (std::size_t i = 0; i < n; ++i) {
            worst = std::max(worst, std::abs(back[i] - coefficients(start.x.data())[i]));
            onNodes += std::norm(psi[i]) * width * height / static_cast<double>(n);
        }
        QVERIFY(worst < 1e-15);
        QVERIFY(std::abs(onNodes - 1) < 1e-14);
        // A plane wave is one coefficient, and its energy hbar^2 k^2/2m: 3 and -2 whole waves.
        const double k = 2 * std::numbers::pi * 3 / width, l = -2 * std::numbers::pi * 2 / height;
        const State wave =
            startOf(system, {{"packet", "plane-wave"}, {"wave_number", k}, {"wave_number_y", l}});
        QVERIFY(std::abs(system.energy(0, wave.x.data()) - (k * k + l * l) / 2) < 1e-13);
        h.toNodes(coefficients(wave.x.data()), psi.data());
        for (const std::size_t j : {std::size_t{7}, n / 2 + 5}) {
            const double x = h.x()[j % 32], y = h.y()[j / 32];
            QVERIFY(std::abs(psi[j] - std::polar(1 / std::sqrt(width * height), k * x + l * y)) < 1e-14);
        }
        const MeanMomentum p = meanMomentum(h, coefficients(wave.x.data()));
        QVERIFY(std::abs(p.x - k) < 1e-14 && std::abs(p.y - l) < 1e-14);
        // Values row after row, x first, are what expressions in x and y are.
        const State typed = startOf(system, {{"re", "exp(-(x - 4)^2)*cos(y)"}, {"im", "x*exp(-(y - 4)^2)"}});
        Value::Array re, im;
        for (const double y : h.y())
            for (const double x : h.x()) {
                re.emplace_back(std::exp(-(x - 4) * (x - 4)) * std::cos(y));
                im.emplace_back(x * std::exp(-(y - 4) * (y - 4)));
            }
        const State given = startOf(system, {{"values", Value::Object{{"re", re}, {"im", im}}}});
        QVERIFY(waveDistance(typed, given) < 1e-14);
    }
    /// V(x) + W(y): the motion is a product of two in one dimension, known by their eigenstates.
    void separableProblemsAreProducts_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("steps");
        QTest::addColumn<double>("most");
        QTest::newRow("chebyshev-propagation") << "chebyshev-propagation" << 2 << 1e-12;
        QTest::newRow("srkn-14a") << "srkn-14a" << 300 << 1e-11;
        QTest::newRow("gauss 8") << "gauss 8" << 60 << 1e-11;
        QTest::newRow("strang") << "strang" << 200 << 1e-2;
    }
    void separableProblemsAreProducts() {
        QFETCH(QString, id);
        QFETCH(int, steps);
        QFETCH(double, most);
        const System both = rectangle(64, 48, sum), x = line(64, alongX, potentialX),
                     y = line(48, alongY, potentialY);
        const State start = packetOn(both), startX = packetAlong(x, 8, 4, waves(2, width)),
                    startY = packetAlong(y, 5, 4.2, waves(-2, height));
        QVERIFY(waveDistance(start, product(startX, startY)) < 1e-14);
        State endX = startX, endY = startY;
        constexpr double T = 1.5;
        x.exact(startX)(T, endX.x);
        y.exact(startY)(T, endY.x);
        const State expected = product(endX, endY);
        const State end = id == "gauss 8" ? run(wavePair(8), both, start, T, steps)
                                          : run(id.toUtf8().constData(), both, start, T, steps);
        const double error = waveDistance(end, expected);
        qInfo("%.2g", error);
        QVERIFY(error < most);
        // Seen failing: the same potential with x and y exchanged in its second part, or another mass along y
        // alone.
        if (steps > 2) return;
        const System wrong = rectangle(64, 48, std::string(potentialX) + " + 3*(1 - sin(2*pi*(x - 2)/5))");
        QVERIFY(waveDistance(run(id.toUtf8().constData(), wrong, start, T, steps), expected) > 0.1);
    }
    void potentialsInTimeAreProductsToo() {
        const std::string moving = "6*(1 - cos((x + 1)/2 - 2.5 - 0.4*sin(3*t)))";
        const System both = rectangle(48, 32, moving + " + t*sin(2*pi*(y - 2)/5)"),
                     x = line(48, alongX, moving), y = line(32, alongY, "t*sin(2*pi*(x - 2)/5)");
        const State startX = packetAlong(x, 6, 4, 0), startY = packetAlong(y, 3, 4.2, 0),
                    start = product(startX, startY);
        const State expected =
            product(run(wavePair(6), x, startX, 1, 60), run(wavePair(6), y, startY, 1, 60));
        const double gauss = waveDistance(run(wavePair(4), both, start, 1, 40), expected),
                     splitting = waveDistance(run("srkn-11b", both, start, 1, 120), expected);
        qInfo("Gauss 4: %.2g, srkn-11b: %.2g", gauss, splitting);
        QVERIFY(gauss < 1e-8);
        QVERIFY(splitting < 1e-8);
    }
    void ordersWhereXAndYAreCoupled_data() {
        QTest::addColumn<QString>("id");
        QTest::addColumn<int>("order");
        for (const int s : {1, 2, 3, 4}) QTest::addRow("gauss %d", s) << QString("gauss %1").arg(s) << 2 * s;
        QTest::newRow("strang") << "strang" << 2;
        QTest::newRow("suzuki-4") << "suzuki-4" << 4;
        QTest::newRow("blanes-moan-s10") << "blanes-moan-s10" << 6;
        QTest::newRow("srkn-11b") << "srkn-11b" << 6;
    }
    /// Of Gauss against the eigenstates of 24 x 20 nodes. Of splittings against Chebyshev's series on a finer
    /// grid: on the coarse one [V, [V, [V, T]]] = 0, on which the tables of Blanes and Moan rely, is true up
    /// to aliasing alone, and srkn-14a is seen with order 4 from 1e-8 on.
    void ordersWhereXAndYAreCoupled() {
        QFETCH(QString, id);
        QFETCH(int, order);
        const bool isGauss = id.startsWith("gauss");
        const System system = isGauss ? rectangle(24, 20, coupled) : rectangle(48, 40, coupled);
        State start = widePacket(system), exact = start;
        constexpr double T = 2;
        if (isGauss)
            system.exact(start)(T, exact.x);
        else
            exact = run("chebyshev-propagation", system, start, T, 1);
        const auto errorOf = [&](int n) {
            return waveDistance(isGauss ? run(wavePair(id.mid(6).toInt(), "krylov"), system, start, T, n)
                                        : run(id.toUtf8().constData(), system, start, T, n),
                                exact);
        };
        const double measured = timeOrder(errorOf, order == 2 ? 1e-6 : 1e-11);
        qInfo("order %.3f", measured);
        QVERIFY(measured > order - 0.2 && measured < order + 0.3);
    }
    void solversAgree() {
        const System system = rectangle(24, 20, coupled);
        const State start = packetOn(system);
        const State dense = run(wavePair(3, "dense"), system, start, 1, 20),
                    krylov = run(wavePair(3, "krylov"), system, start, 1, 20);
        const double apart = waveDistance(dense, krylov);
        qInfo("%.2g", apart);
        QVERIFY(apart < 1e-12);
        try {
            (void)makeIntegrator(system, wavePair(3, "banded"), {0, 0.05});
            QFAIL("banded was taken");
        } catch (const InvalidScene& e) {
            QCOMPARE(QString::fromStdString(e.problems()[0].pointer), QString("/solver/method"));
        }
    }
    void threeLevelsOnARectangle() {
        const System system = rectangle(24, 20, coupled);
        State start = widePacket(system), exact = start;
        system.exact(start)(1, exact.x);
        Discretization discretization = wavePair(1, "krylov");
        discretization.quadrature = {"exact", {}, {}};
        for (auto& [key, value] : discretization.space.keys)
            if (key == "form") value = "three-level";
        const auto errorOf = [&](int n) {
            return n < 150 ? 1 : waveDistance(run(discretization, system, start, 1, n), exact);
        };
        const double measured = timeOrder(errorOf, 1e-9);
        qInfo("order %.3f", measured);
        QVERIFY(std::abs(measured - 4) < 0.2);
    }
    void normAndEnergyAreKept() {
        const System system = rectangle(32, 32, coupled);
        State state = packetOn(system);
        const double E = system.energy(0, state.x.data());
        const auto integrator = makeIntegrator(system, wavePair(2, "krylov"), {0, 0.02});
        double worstNorm = 0, worstEnergy = 0;
        for (int k = 0; k < 400; ++k) {
            QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
            worstNorm = std::max(worstNorm, std::abs(norm(system, state) - 1));
            worstEnergy = std::max(worstEnergy, std::abs(system.energy(0, state.x.data()) / E - 1));
        }
        qInfo("norm %.2g, energy %.2g", worstNorm, worstEnergy);
        QVERIFY(worstNorm < 1e-12);
        QVERIFY(worstEnergy < 1e-11);
        // Seen failing: solved to 1e-6 only.
        State loose = packetOn(system);
        const auto careless =
            makeIntegrator(system, wavePair(2, "krylov", "mean", {{"tolerance", 1e-6}}), {0, 0.02});
        for (int k = 0; k < 400; ++k) (void)advance(*careless, loose);
        QVERIFY(std::abs(norm(system, loose) - 1) > 1e-9);
    }
    /// A coherent state of the round oscillator goes around: <x> and <y> are those of a classical particle.
    void coherentStateGoesAround() {
        const Value domain = Value::Array{-8.0, 8.0};
        const System system =
            systemNamed("schrodinger-2d", {{"modes", 64.0},
                                           {"modes_y", 64.0},
                                           {"domain", domain},
                                           {"domain_y", domain},
                                           {"potential", Value::Object{{"name", "harmonic"}}}});
        const double width_ = std::sqrt(0.5);
        State state = startOf(system, {{"packet", "gaussian"},
                                       {"centre", 2.0},
                                       {"width", width_},
                                       {"width_y", width_},
                                       {"wave_number_y", 1.5}});
        QVERIFY(std::abs(system.energy(0, state.x.data()) - (1 + 2 + 1.5 * 1.5 / 2)) < 1e-12);
        const auto integrator = makeIntegrator(system, wavePair(6), {0, 0.1});
        std::vector<Complex> work(static_cast<std::size_t>(system.hamiltonian()->size()));
        double worst = 0;
        for (int k = 0; k < 40; ++k) {
            QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
            const NodeMeans at = nodeMeans(*system.hamiltonian(), coefficients(state.x.data()), work.data());
            const MeanMomentum p = meanMomentum(*system.hamiltonian(), coefficients(state.x.data()));
            for (const double d : {at.x - 2 * std::cos(state.t), at.y - 1.5 * std::sin(state.t),
                                   p.x + 2 * std::sin(state.t), p.y - 1.5 * std::cos(state.t)})
                worst = std::max(worst, std::abs(d));
        }
        qInfo("%.2g", worst);
        QVERIFY(worst < 1e-10);
    }
    void whatPassesTheMiddle() {
        // d/dt of the share right of the middle line is the current through it; that on the far side of the
        // period is nothing here.
        const System system = rectangle(256, 64, sum);
        const State start = packetOn(system);
        const Hamiltonian& h = *system.hamiltonian();
        const auto n = static_cast<std::size_t>(h.size());
        std::vector<Complex> work(n), slope(n);
        const auto rightOf = [&](const State& state) {
            h.toNodes(coefficients(state.x.data()), work.data());
            double share = 0;
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t i = j % 256;
                // The line goes through the nodes of its column: half of their cells lie to the right.
                share += (i > 128    ? 1
                          : i == 128 ? 0.5
                                     : 0) *
                         std::norm(work[j]) * width * height / static_cast<double>(n);
            }
            return share;
        };
        constexpr double dt = 1e-3;
        const auto step = baseline("chebyshev-propagation", system, dt);
        State before = start, middle = start, end = start;
        before = run("chebyshev-propagation", system, start, 0.35, 1);
        middle = before;
        QVERIFY(advance(*step, middle).outcome == Outcome::converged);
        end = middle;
        QVERIFY(advance(*step, end).outcome == Outcome::converged);
        const double flow = (rightOf(end) - rightOf(before)) / (2 * dt);
        const double current =
            currentInTheMiddle(h, coefficients(middle.x.data()), work.data(), slope.data());
        qInfo("%.6g and %.6g", flow, current);
        QVERIFY(std::abs(current) > 0.1);
        QVERIFY(std::abs(flow - current) <
                1e-3 * std::abs(current));  // of the square of the cells: 4e-3 with 96
    }
    void tailLooksAlongBothDirections() {
        const System good = rectangle(64, 64, 0.0), poor = rectangle(64, 8, 0.0);
        QVERIFY(spectrumTail(*good.hamiltonian(), coefficients(packetOn(good).x.data())) < 1e-6);
        const std::string caution = poor.caution(packetOn(poor).x.data());
        QVERIFY2(caution.find("64 x 8") != std::string::npos, caution.c_str());
    }
    void eigenstatesOfAFineGridComeFromACoarseOne() {
        const Value domain = Value::Array{-5.6, 5.6};
        const auto oscillator = [&](double modes) {
            return systemNamed("schrodinger-2d",
                               {{"modes", modes},
                                {"modes_y", modes},
                                {"domain", domain},
                                {"domain_y", domain},
                                {"potential", Value::Object{{"name", "harmonic"}, {"omega_y", 1.1}}}});
        };
        const System fine = oscillator(64);
        const State ground = startOf(fine, {{"packet", "eigenstate"}, {"n", 0.0}});
        const double error = std::abs(fine.energy(0, ground.x.data()) - 1.05);
        qInfo("%.2g", error);
        QVERIFY(error < 1e-9);
        // Energies by the matrix of 22 x 22 nodes: n + 1/2 along either direction.
        const auto& energies = Eigenstates::of(oscillator(22).hamiltonian())->energies();
        const double known[] = {1.05, 2.05, 2.15, 3.05, 3.15, 3.25};
        for (std::size_t k = 0; k < 6; ++k) QVERIFY(std::abs(energies[k] - known[k]) < 1e-4);
    }
};

EXTREMAL_TEST(WavePlaneTest)
}  // namespace extremal::laws::wave_plane_test

#include "wave_plane_test.moc"
