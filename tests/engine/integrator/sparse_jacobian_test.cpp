// SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method by the entries of the Hessian against the dense one, on Lagrangians of many coordinates
/// with couplings of several kinds.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/family/scheme.hpp"
#include "engine/family/table_of.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sparse_jacobian_test {
namespace {

/// Coordinates x1 .. x<n>.
ReadScene sceneOf(int n, QString lagrangian) {
    QStringList names, q, v;
    for (int i = 1; i <= n; ++i) {
        names << QString(R"j("x%1")j").arg(i);
        q << QString::number(0.3 * std::sin(1.7 * i * i));
        v << QString::number(0.2 * std::cos(2.3 * i * i));
    }
    lagrangian.replace("n-1", QString::number(n - 1)).replace("..n", ".." + QString::number(n));
    return readScene(QString(R"j({"extremal":1,"model":{"type":"lagrangian","coordinates":[%1],
        "lagrangian":"%2"},"initial":{"q":[%3],"v":[%4]},"time":{"end":1},
        "schemes":[{"step":0.1,"scheme":"midpoint"}]})j")
                         .arg(names.join(','), lagrangian, q.join(','), v.join(','))
                         .toStdString());
}

SolverPolicy newton() {
    SolverPolicy policy;
    policy.method = SolverMethod::newton;
    return policy;
}

/// Of a scheme of the catalogue, with or without entries.
std::unique_ptr<Integrator> integratorOf(const System& system, const char* scheme, double step,
                                         bool isSparse) {
    const Discretization d = *namedScheme(scheme);
    const auto tables = [d](double) { return std::vector{tableOf(d.space, d.quadrature)}; };
    const auto* const entries = system.parts.find<LagrangianEntries>();
    if (!entries) qFatal("no entries");
    return makeCondensed(system.mechanics(), tables, step, newton(), {}, isSparse ? entries : nullptr);
}

}  // namespace

class SparseJacobianTest : public QObject {
    Q_OBJECT
private slots:
    void itIsTheDenseOne_data() {
        QTest::addColumn<QString>("lagrangian");
        const char* const kinetic = "sum(i, 1..n, x[i]_t^2/2)";
        const auto row = [](const char* name, const QString& lagrangian) {
            QTest::newRow(name) << lagrangian;
        };
        row("stiff chain",
            QString("%1 - 500*sum(i, 1..n-1, (x[i+1]-x[i])^2 + (x[i+1]-x[i])^4)").arg(kinetic));
        row("coupled masses",
            "sum(i, 1..n, x[i]_t^2) + sum(i, 1..n-1, x[i]_t*x[i+1]_t*cos(x[i])/4) - "
            "sum(i, 1..n, x[i]^2/2)");
        row("gyroscopic",
            QString("%1 + sum(i, 1..n-1, x[i]^2*x[i+1]_t) - sum(i, 1..n, x[i]^4/4)").arg(kinetic));
        row("star", QString("%1 - 40*sum(i, 1..n-1, (x[i+1] - x1)^2)").arg(kinetic));
        row("driven",
            QString("%1*(2 + cos(t))/2 - 90*sum(i, 1..n-1, cosh(x[i+1] - x[i])) + x1*sin(3*t)").arg(kinetic));
        row("free bodies", QString("%1 - 30*sum(i, 1..n, x[i]^4)").arg(kinetic));
    }
    void itIsTheDenseOne() {
        QFETCH(QString, lagrangian);
        const ReadScene read = sceneOf(80, lagrangian);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const System& system = *read.resolved->system;
        for (const char* scheme :
             {"midpoint", "galerkin-gauss-2", "galerkin-lobatto-3", "galerkin-gauss-4"}) {
            State sparse = read.resolved->initial, dense = sparse;
            const double step = 0.05;
            const auto by = integratorOf(system, scheme, step, true),
                       with = integratorOf(system, scheme, step, false);
            by->begin(sparse);
            with->begin(dense);
            long long solves = 0;
            double most = 0, size = 0;
            for (int k = 1; k <= 12; ++k) {
                const StepReport report = by->advance(sparse, k * step);
                QCOMPARE(report.outcome, Outcome::converged);
                QCOMPARE(with->advance(dense, k * step).outcome, Outcome::converged);
                solves += report.cost.linearSolves;
            }
            for (std::size_t i = 0; i < sparse.x.size(); ++i) {
                most = std::max(most, std::abs(sparse.x[i] - dense.x[i]));
                size = std::max(size, std::abs(dense.x[i]));
            }
            qInfo("%s: %.1e of %.1e", scheme, most, size);
            QVERIFY(solves >= 24);
            QVERIFY(most < 1e-13 * std::max(size, 1.0));
            // The tangent map is that of the same step.
            std::vector<double> a(sparse.x.size(), 0), b(a.size(), 0);
            a[7] = b[7] = 1;
            QVERIFY(by->applyTangent(a) && with->applyTangent(b));
            double apart = 0;
            for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
            QVERIFY(apart < 1e-11);
        }
    }
    /// Masses 0.1 and 0.9 with 0.3 between them: nothing but round-off says how fast one direction moves. A
    /// step then asks the dense matrix whether it is singular.
    void whatIsSingularIsSeen() {
        LagrangianEntries entries;
        entries.hessian = {{2, 2}, {3, 2}, {3, 3}};
        entries.jet = [](const void*, double, const double*, const double*, double*, double* hessian) {
            hessian[0] = 0.1;
            hessian[1] = 0.3;
            hessian[2] = 0.9;
        };
        SparseJacobian jacobian(entries, 1, {1, 1});
        const double place[2] = {0, 0}, weight = 1, value = 0.5, slope = 1;
        jacobian.evaluate(0, 0, place, place);
        const Outcome outcome = jacobian.factorise(&weight, [&](int) {
            return SparseJacobian::Functions{&value, &slope};
        });
        QVERIFY(outcome != Outcome::converged || jacobian.pivotRatio() < 1e-14);
    }
    /// Where every pair of coordinates is coupled it is left alone.
    void aFullMatrixIsDense() {
        const ReadScene read =
            sceneOf(66, "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, sum(j, 1..n, cos(x[i] - x[j])))/50");
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const auto& entries = read.resolved->system->part<LagrangianEntries>();
        const SparseJacobian jacobian(entries, 2, std::vector<int>(66, 2));
        QVERIFY(!jacobian.isWorthwhile());
    }
    /// A stiff chain of a thousand masses by the scheme of a scene, whose first step takes no dense matrix.
    void aThousandStiffSprings() {
        const ReadScene read =
            sceneOf(1000, "sum(i, 1..n, x[i]_t^2/2) - 5e5*sum(i, 1..n-1, (x[i+1]-x[i])^2)");
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ResolvedScheme& scheme = read.resolved->schemes.front();
        State state = read.resolved->initial;
        const auto integrator = scheme.make(*read.resolved->system, 0.1, state);
        integrator->begin(state);
        const auto& m = read.resolved->system->mechanics();
        const double before = m.energy(m.model.get(), 0, state.x.data(), state.x.data() + 1000);
        for (int k = 1; k <= 10; ++k)
            QCOMPARE(integrator->advance(state, 0.1 * k).outcome, Outcome::converged);
        // The midpoint rule keeps quadratic energies.
        const double after = m.energy(m.model.get(), 0, state.x.data(), state.x.data() + 1000);
        qInfo("%.1e", after / before - 1);
        QVERIFY(std::abs(after / before - 1) < 1e-12);
    }
};

EXTREMAL_TEST(SparseJacobianTest)

}  // namespace extremal::sparse_jacobian_test

#include "sparse_jacobian_test.moc"
