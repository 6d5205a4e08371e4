// SPDX-License-Identifier: GPL-3.0-or-later
/// The last force of one part of a composition is the first of the next: half the evaluations, the same bits.
#include <QTest>

#include <cmath>
#include <numeric>

#include "engine/baseline/catalog.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/scene/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::shared_force_test {

class SharedForceTest : public QObject {
    Q_OBJECT
private slots:
    void compositionsEvaluateEachForceOnce() {
        const ReadScene read = readScene(std::string(R"json({"extremal":1,"model":{"type":"kepler"},
            "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":10},"schemes":[{"scheme":"midpoint","step":0.1}]})json"));
        const System& system = *read.resolved->system;
        const BaselineEntry* verlet = findBaseline("stormer-verlet");
        for (const char* type : {"yoshida", "suzuki"}) {
            const Settings keys{type, {{"order", 4.0}}, {}};
            const std::vector<double> parts = compositionParts(keys, 2);
            constexpr double h = 0.1;
            constexpr int steps = 100;
            const auto whole = composed(parts, *verlet->make(system, {h, {}, 0, {}}));
            State together{0, 0, {0.4, 0, 0, 2}, {}}, apart = together;
            whole->begin(together);
            long long evaluations = 0;
            for (int k = 0; k < steps; ++k) {
                const StepReport report = whole->advance(together, (k + 1) * h);
                QCOMPARE(report.outcome, Outcome::converged);
                evaluations += report.cost.evaluations;
                for (const double part : parts) {
                    const auto alone = verlet->make(system, {part * h, {}, 0, {}});
                    QCOMPARE(alone->advance(apart, apart.t + part * h).outcome, Outcome::converged);
                }
            }
            QCOMPARE(evaluations, static_cast<long long>(steps * parts.size() + 1));
            QVERIFY(together.x == apart.x);
        }
    }
};

EXTREMAL_TEST(SharedForceTest)
}  // namespace extremal::shared_force_test
#include "shared_force_test.moc"
