// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems with constraints node by node: the solution on what these leave free is that of the whole system.
#include <QTest>

#include <random>
#include <tuple>

#include "engine/core/algebra/dense.hpp"
#include "engine/solve/null_space_lu.hpp"
#include "tests/tools/test.hpp"

namespace extremal::null_space_lu_test {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The system, and the whole matrix with unknowns as the class has them.
struct Whole {
    Whole(int m, int d, int n, bool hasEmpty = false)
        : lu(m, d, n), A(Matrix::Zero(m * (d + n), m * (d + n))) {
        std::mt19937_64 generator(11);
        std::normal_distribution<double> any;
        lu.clear();
        for (int k = 0; k < d; ++k)
            for (int j = 0; j < m; ++j)
                for (int i = 0; i < m * d; ++i) A(i, k * m + j) = lu.column(k, j)[i] = any(generator);
        for (int j = 0; j <= m; ++j)
            for (int c = 0; c < n; ++c)
                for (int k = 0; k < d; ++k) {
                    // Some coordinates, others at each node, are not seen at all.
                    double G = (k + j) % 4 == 3 && d > n + 1 ? 0 : any(generator);
                    if (hasEmpty && c > 0) G = 0;
                    lu.constraints(j)[c * d + k] = G;
                    const int row = m * d + n * j + c;
                    if (j < m) A(k * m + j, row) = G;
                    if (j > 0) A(row - n, k * m + j - 1) = G;
                }
    }
    NullSpaceLu lu;
    Matrix A;
};

class NullSpaceLuTest : public QObject {
    Q_OBJECT
private slots:
    void solutionsAreThoseOfTheWholeSystem() {
        for (const auto& [m, d, n] : {std::tuple{1, 2, 1}, {3, 4, 3}, {8, 4, 3}, {4, 5, 2}, {2, 9, 8}}) {
            Whole whole(m, d, n);
            QCOMPARE(whole.lu.factorise(), Outcome::converged);
            Vector given(whole.A.rows());
            for (Eigen::Index i = 0; i < given.size(); ++i) given(i) = 1 + static_cast<double>(i % 5);
            Vector x = given;
            whole.lu.solve(x.data(), x.data() + m * d);
            QVERIFY2((x - dense::solve<double>(whole.A, given)).norm() < 1e-9 * x.norm(),
                     qPrintable(QString::number(m)));
            x = given;
            whole.lu.solveTransposed(x.data(), x.data() + m * d);
            QVERIFY2((x - dense::solve<double>(Matrix(whole.A.transpose()), given)).norm() < 1e-9 * x.norm(),
                     qPrintable(QString::number(m)));
        }
    }
    void aConstraintOfNothingIsSaid() { QCOMPARE(Whole(3, 4, 2, true).lu.factorise(), Outcome::singular); }
};

EXTREMAL_TEST(NullSpaceLuTest)

}  // namespace extremal::null_space_lu_test

#include "null_space_lu_test.moc"
