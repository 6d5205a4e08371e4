// SPDX-License-Identifier: GPL-3.0-or-later
/// Accounts of work: what is counted where, when they are exceeded, and that a remembered result costs the
/// same whoever made it.
#include <QTest>

#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/work.hpp"
#include "tests/tools/test.hpp"

namespace extremal::work_test {
namespace {

/// Whether it was stopped, where the account was exceeded.
template <class Work>
std::optional<bool> exceeded(const Work& work) {
    try {
        work();
    } catch (const work::Exceeded& e) {
        return e.isStopped;
    }
    return {};
}

}  // namespace

class WorkTest : public QObject {
    Q_OBJECT
private slots:
    void withoutAnAccountNothingIsCounted() {
        QVERIFY(!exceeded([] { work::spend(1e300); }));
        QVERIFY(!exceeded([] { work::spendOnce("key", 1e300); }));
    }

    void anAccountEndsAtItsLimit() {
        work::Account account(100);
        QVERIFY(!exceeded([] { work::spend(60); }));
        QVERIFY(!exceeded([] { work::spend(40); }));
        QCOMPARE(exceeded([] { work::spend(1); }), std::optional(false));
        QCOMPARE(account.spent(), 101.0);
    }

    void aRequestToStopIsMetAtTheNextCount() {
        std::stop_source source;
        const work::Account account(100, source.get_token());
        QVERIFY(!exceeded([] { work::spend(1); }));
        source.request_stop();
        QCOMPARE(exceeded([] { work::spend(1); }), std::optional(true));
    }

    void partsAndAccountsAreNested() {
        work::Account outer(100);
        {
            const work::Part part("/a");
            work::spend(1);
            {
                const work::Part inner("/a/b");
                work::spend(2);
            }
            work::spend(4);
            const work::Account other(10);
            work::spend(10);
        }
        work::spend(8);
        QCOMPARE(outer.spent(), 15.0);
        QCOMPARE(outer.parts().at("/a"), 5.0);
        QCOMPARE(outer.parts().at("/a/b"), 2.0);
        QCOMPARE(outer.parts().at(""), 8.0);
    }

    void aResultCostsTheSameForWhoMadeItAndWhoRemembersIt() {
        work::Account first(100);
        double cost = 0;
        {
            const work::Measured measured;
            work::spend(30);
            cost = measured.spent();
        }
        QCOMPARE(first.spent(), 0.0);
        work::spendOnce("result", cost);
        work::spendOnce("result", cost);
        QCOMPARE(first.spent(), 30.0);
        work::Account second(100);
        work::spendOnce("result", cost);
        QCOMPARE(second.spent(), 30.0);
    }

    void whatIsNotMadeIsSpentAllTheSame() {
        work::Account account(100);
        work::spend(50);
        QCOMPARE(exceeded([] {
                     const work::Measured measured;
                     work::spend(51);
                 }),
                 std::optional(false));
        QCOMPARE(account.spent(), 101.0);
        work::Account other(100);
        try {
            const work::Measured measured;
            work::spend(20);
            throw std::runtime_error("refused");
        } catch (const std::runtime_error&) {
        }
        QCOMPARE(other.spent(), 20.0);
    }

    void denseAlgebraCounts() {
        const work::Account account(1e9);
        const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(30, 30);
        double before = 0;
        const auto hasCounted = [&] {
            return account.spent() >= before + 30 * 30 * 10 && (before = account.spent(), true);
        };
        (void)dense::Lu<double>(A);
        QVERIFY(hasCounted());
        (void)dense::product<double>(A, A);
        QVERIFY(hasCounted());
        (void)dense::leastSquares<double>(A, A);
        QVERIFY(hasCounted());
        (void)dense::qr<double>(A);
        QVERIFY(hasCounted());
        (void)dense::symmetricEigen<double>(A);
        QVERIFY(hasCounted());
        (void)dense::rankPivots(A);
        QVERIFY(hasCounted());
        (void)dense::singularValues(A);
        QVERIFY(hasCounted());
    }
};

EXTREMAL_TEST(WorkTest)

}  // namespace extremal::work_test

#include "work_test.moc"
