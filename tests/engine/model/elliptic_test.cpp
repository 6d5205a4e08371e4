// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/problem.hpp"
#include "engine/model/elliptic.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::elliptic_test {
namespace {

EllipticProblem wavy(double epsilon) {
    return {[](double s) { return 10 / (1 + 0.95 * std::sin(2 * std::numbers::pi * s)); }, epsilon,
            [](double x) { return x * x; }};
}

/// u(0.1 i), i = 1..9, with forty digits of residual, for epsilon = 0.025, 0.00625, 0.0173.
constexpr std::array<double, 3> epsilons = {0.025, 0.00625, 0.0173};
constexpr double known[9][3] = {{-0.00082002623133517270, -0.00082938155783379318, -0.00084570110887987491},
                                {-0.00162914178198336524, -0.00164728544549584131, -0.00168571360139180253},
                                {-0.00239810263792426412, -0.00242390065948106603, -0.00245140485775127318},
                                {-0.00307766478513755584, -0.00310941619628438896, -0.00311237743203547169},
                                {-0.00359858420960292691, -0.00363402105240073173, -0.00363684723808195001},
                                {-0.00387161689730006382, -0.00390790422432501595, -0.00391672486689941387},
                                {-0.00378751883420865308, -0.00382125470855216327, -0.00381533730263350584},
                                {-0.00321704600630838120, -0.00324426150157707730, -0.00324043172178330519},
                                {-0.00201095439957893467, -0.00202711359989473367, -0.00205597136977752064}};

double largestNodalError(const EllipticSolution& s, EllipticElements kind) {
    const std::vector<double> u = s.nodal(kind);
    double worst = 0, size = 0;
    for (int i = 0; i <= s.elements(); ++i) {
        const double exact = s.u(static_cast<double>(i) / s.elements());
        worst = std::max(worst, std::abs(u[static_cast<std::size_t>(i)] - exact));
        size = std::max(size, std::abs(exact));
    }
    return worst / size;
}

}  // namespace

class EllipticTest : public QObject {
    Q_OBJECT
private slots:
    void theSolutionAgreesWithFortyDigits() {
        for (std::size_t k = 0; k < 3; ++k) {
            const EllipticSolution s(wavy(epsilons[k]), 10);
            double worst = 0;
            for (int i = 1; i <= 9; ++i)
                worst = std::max(worst, std::abs(s.u(0.1 * i) / known[i - 1][k] - 1));
            qInfo("epsilon %g: %.1e", epsilons[k], worst);
            QVERIFY(worst < 1e-13);
        }
    }
    void hatsAreThoseOfTheElementsAndOfTheClosedForm() {
        const double epsilon = 0.025, K = 2 * std::numbers::pi / epsilon;
        const auto R = [&](double x) { return (x + 0.95 * (1 - std::cos(K * x)) / K) / 10; };
        double worst = 0, apart = 0, inElement = 0;
        for (const int elements : {10, 7, 200}) {
            const EllipticSolution solution(wavy(epsilon), elements);
            for (const int node : {1, elements / 2, elements - 1}) {
                const EllipticHat hat =
                    ellipticHat(wavy(epsilon), EllipticElements::multiscale, elements, node);
                const EllipticHat straight =
                    ellipticHat(wavy(epsilon), EllipticElements::linear, elements, node);
                const double x0 = (node - 1.0) / elements, x1 = node / static_cast<double>(elements),
                             x2 = (node + 1.0) / elements;
                QVERIFY(std::abs(hat.x.front() - x0) < 1e-15 && std::abs(hat.x.back() - x2) < 1e-15);
                QVERIFY(hat.phi.front() == 0 && hat.phi[hat.phi.size() / 2] == 1 && hat.phi.back() == 0);
                std::vector<double> unit(static_cast<std::size_t>(elements) + 1);
                unit[static_cast<std::size_t>(node)] = 1;
                for (std::size_t i = 0; i < hat.x.size(); ++i) {
                    const double x = hat.x[i];
                    const double exact =
                        x <= x1 ? (R(x) - R(x0)) / (R(x1) - R(x0)) : (R(x2) - R(x)) / (R(x2) - R(x1));
                    worst = std::max(worst, std::abs(hat.phi[i] - exact));
                    if (i % 50 == 25)
                        inElement = std::max(
                            inElement,
                            std::abs(hat.phi[i] - solution.between(EllipticElements::multiscale, unit, x)));
                    QVERIFY(std::abs(straight.phi[i] - (1 - std::abs(x - x1) * elements)) < 1e-12);
                    apart = std::max(apart, std::abs(hat.phi[i] - straight.phi[i]));
                }
            }
        }
        qInfo("from the closed form %.1e, from the elements %.1e, from straight lines %.2f", worst, inElement,
              apart);
        QVERIFY(worst < 1e-12 && inElement < 1e-12);  // measured: 2.5e-13 (the closed form cancels), 1e-14
        QVERIFY(apart > 0.05);                        // a hat that does not know the coefficient is seen
    }
    void multiscaleElementsAreExactAtTheNodes() {
        for (const double epsilon : epsilons)
            for (const int n : {10, 20, 40, 80, 160}) {
                const double error =
                    largestNodalError(EllipticSolution(wavy(epsilon), n), EllipticElements::multiscale);
                qInfo("epsilon %g, %d elements: %.1e", epsilon, n, error);
                QVERIFY(error < 1e-13);
            }
    }
    void linearElementsMissTheCoefficient() {
        for (const double epsilon : epsilons) {
            const double error =
                largestNodalError(EllipticSolution(wavy(epsilon), 10), EllipticElements::linear);
            qInfo("epsilon %g: %.3f", epsilon, error);
            QVERIFY(error > 0.5);  // 0.68 to 0.69
        }
        // Resolved, they converge: the law above has teeth on both sides.
        const double fine = largestNodalError(EllipticSolution(wavy(0.025), 640), EllipticElements::linear);
        qInfo("640 elements: %.2e", fine);
        QVERIFY(fine < 0.02);
    }
    void betweenTheNodesTheErrorIsQuadraticInTheMesh() {
        double last = 0;
        for (const int n : {5, 10, 20}) {
            const EllipticSolution s(wavy(0.00625), n);
            const std::vector<double> u = s.nodal(EllipticElements::multiscale);
            double worst = 0;
            for (int i = 0; i < n; ++i) {
                const double x = (i + 0.5) / n;
                worst = std::max(worst, std::abs(s.between(EllipticElements::multiscale, u, x) - s.u(x)));
            }
            qInfo("%d elements: %.2e", n, worst);
            if (last > 0) QVERIFY(std::abs(std::log2(last / worst) - 2) < 0.3);
            last = worst;
        }
        QVERIFY(std::abs(last / 2.9e-5 - 1) < 0.1);  // 2.9e-5 at 20 elements, whatever epsilon
    }
    void anyCoefficientAndForceWork() {
        // a = exp(sin), f = cos 3x: against the equation itself, by differences of the flux a u' - F.
        const EllipticProblem p{[](double s) { return std::exp(std::sin(6 * s)); }, 0.05,
                                [](double x) { return std::cos(3 * x); }};
        const EllipticSolution s(p, 16);
        QVERIFY(largestNodalError(s, EllipticElements::multiscale) < 1e-13);
        const auto flux = [&](double x) {
            const double d = 1e-5;
            return p.a(x / p.epsilon) * (s.u(x + d) - s.u(x - d)) / (2 * d) - std::sin(3 * x) / 3;
        };
        for (const double x : {0.2, 0.5, 0.8}) QVERIFY(std::abs(flux(x) - flux(0.4)) < 1e-6);
    }
    void aCoefficientThatIsNotPositiveIsRefused() {
        const EllipticProblem p{[](double s) { return std::sin(s); }, 0.05, [](double) { return 1.0; }};
        QVERIFY_EXCEPTION_THROWN(EllipticSolution(p, 10), InvalidScene);
    }
    /// The whole curve is one linear system.
    void itIsSolvedOnce() {
        const Comparison result = run(readScene(findPreset("elliptic")->json).scene);
        QVERIFY(!result.schemes.empty());
        for (const auto& scheme : result.schemes) QCOMPARE(scheme->summary.cost.linearSolves, 1);
    }
};

EXTREMAL_TEST(EllipticTest)
}  // namespace extremal::elliptic_test

#include "elliptic_test.moc"
