// SPDX-License-Identifier: GPL-3.0-or-later
/// The step on oscillatory spaces, against values computed independently (raw basis, multipliers kept as
/// unknowns) and against the motion itself.
#include <QTest>

#include <cmath>
#include <vector>

#include "engine/family/multiscale/oscillatory_table.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::oscillatory_step_test {
namespace {

struct Known {
    const char* name;
    double k, h;
    OscillatoryBasis a, theta;
    int steps;
    std::array<double, 4> x;  ///< a, theta, p_a, p_theta
};

}  // namespace

class OscillatoryStepTest : public QObject {
    Q_OBJECT
private slots:
    void stepsAgreeWithIndependentValues() {
        const OscillatoryBasis a1{2, {1}}, th1{4, {1}}, a3{4, {3, 1}}, th3{5, {3, 1}}, a2{3, {2}},
            th2{4, {2}};
        const std::vector<Known> all = {
            {"T1",
             1e4,
             0.2,
             a1,
             th1,
             1,
             {2.09763273530531e-2, .838852162582603, -4.51910295089156, -1.59295997025938}},
            {"T1",
             1e4,
             0.2,
             a1,
             th1,
             5,
             {4.48766435038798e-2, -.980699818724045, 2.20060790432724, -.567175992379851}},
            {"T3D1",
             1e4,
             0.25,
             a3,
             th3,
             1,
             {5.01498450242404e-2, .748731700999240, .634251498836777, -1.93932899459809}},
            {"T3D1",
             1e4,
             0.25,
             a3,
             th3,
             5,
             {4.19012468272190e-2, -.865267847355993, 2.76285694830776, 1.44899523392462}},
            {"T1",
             1e6,
             0.2,
             a1,
             th1,
             1,
             {2.44357620227337e-3, .837924985371004, 4.36126631619253, -1.58897219798180}},
            {"T1",
             1e6,
             0.2,
             a1,
             th1,
             5,
             {2.78578470223806e-3, -.980066398634213, -4.14955149386166, -.571704119142413}},
            {"T2",
             1e8,
             0.2,
             a2,
             th2,
             1,
             {-1.83631536463996e-4, .837943564473830, -4.64965642224187, -1.58899617267796}},
        };
        for (const Known& known : all) {
            const System s = laws::systemNamed("spring-pendulum", {{"k", known.k}});
            const double z = known.h * std::sqrt(known.k);
            std::vector<Table<double>> tables;
            for (const OscillatoryBasis& basis : {known.a, known.theta})
                tables.push_back(makeOscillatoryTable(basis, {z, 0}, FilonNodes::lobatto, 8, {12, 1}));
            GalerkinStep<double, 2> step(s.mechanics(), tables, known.h, {});
            double q[2] = {0.05 * std::sqrt(1e4 / known.k), 1}, p[2] = {0, 0};
            int iterations = 0;
            for (int i = 0; i < known.steps; ++i) {
                const StepReport report = step.advance(i * known.h, q, p, {});
                QCOMPARE(report.outcome, Outcome::converged);
                iterations += report.cost.iterations;
            }
            const std::array<double, 4> x = {q[0], q[1], p[0], p[1]};
            double worst = 0;
            for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, std::abs(x[i] / known.x[i] - 1));
            qInfo("%s k = %g, %d steps: relative difference %.1e, %.1f iterations per step", known.name,
                  known.k, known.steps, worst, 1.0 * iterations / known.steps);
            QVERIFY(worst < 1e-10);
        }
    }
};

EXTREMAL_TEST(OscillatoryStepTest)
}  // namespace extremal::oscillatory_step_test

#include "oscillatory_step_test.moc"
