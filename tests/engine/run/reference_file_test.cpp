// SPDX-License-Identifier: GPL-3.0-or-later
/// References from CSV files: rows are found although times are rounded, and wrong rows are named.
#include <QTest>

#include <cmath>
#include <sstream>

#include "engine/core/problem.hpp"
#include "engine/run/reference/reference_file.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::reference_file_test {
namespace {

Reference read(const std::string& rows, const std::string& header = "t,q.theta,p.theta") {
    static const ReadScene pendulum = readScene(findPreset("pendulum")->json);
    std::istringstream in(header + "\n" + rows);
    return readReference(in, "reference.csv", *pendulum.resolved->system);
}

std::string refusal(const std::string& rows, const std::string& header = "t,q.theta,p.theta") {
    try {
        (void)read(rows, header);
        return {};
    } catch (const InvalidScene& e) {
        return e.problems().front().message + " | " + e.problems().front().hint;
    }
}

}  // namespace

class ReferenceFileTest : public QObject {
    Q_OBJECT
private slots:
    /// 3 * 0.1 is not 0.3, which is what a file says.
    void rowsAreFoundAtRoundedTimes() {
        const ExactSolution solution = read("0,1,0\n0.3,0.5,0.25\n1000,2,3\n").make();
        double x[2];
        QVERIFY(3 * 0.1 != 0.3);
        solution(3 * 0.1, x);
        QCOMPARE(x[0], 0.5);
        QCOMPARE(x[1], 0.25);
        solution(1000 * (1 + 1e-10), x);
        QCOMPARE(x[0], 2.0);
    }
    void betweenRowsNothingIsKnown() {
        const ExactSolution solution = read("0,1,0\n0.3,0.5,0.25\n").make();
        double x[2];
        for (const double t : {0.3 + 1e-8, 0.3 - 1e-8, 0.2, 1.0}) {
            solution(t, x);
            QVERIFY(std::isnan(x[0]) && std::isnan(x[1]));
        }
    }
    /// What was measured has no momenta: the error of the positions is known, that of the momenta is not.
    void columnsOfTheStateMayBeMissing() {
        double x[2];
        read("0,1\n0.5,2\n", "t,q.theta").make()(0.5, x);
        QCOMPARE(x[0], 2.0);
        QVERIFY(std::isnan(x[1]));
        read("7,0,1\n8,0.5,2\n", "camera,t,p.theta").make()(0.5, x);
        QCOMPARE(x[1], 2.0);
        QVERIFY(std::isnan(x[0]));
        QVERIFY(refusal("0,1\n", "t,theta").find("has no column of the state | one or more of q.theta") !=
                std::string::npos);
        QVERIFY(refusal("0,1\n", "time,q.theta").find("has no column \"t\"") != std::string::npos);
    }
    void separatorsAndDecimalCommasAreNamed() {
        const std::string remedy = " | commas between cells, and numbers with a decimal point: 0.5,1.25";
        QVERIFY(refusal("0;1;0\n", "t;q.theta;p.theta").find("has semicolons between its cells" + remedy) !=
                std::string::npos);
        QVERIFY(refusal("0\t1\t0\n", "t\tq.theta\tp.theta").find("has tabs between its cells" + remedy) !=
                std::string::npos);
        for (const char* row : {"0,0,1,5,0,25\n", "\"0,5\",1,0\n"})
            QVERIFY2(refusal(row).find(": a decimal comma, perhaps" + remedy) != std::string::npos, row);
        QVERIFY(refusal("0,1;5,0\n").find("\"1;5\" is not a number" + remedy) != std::string::npos);
    }
    void wrongRowsAreNamed_data() {
        QTest::addColumn<QString>("rows");
        QTest::addColumn<QString>("message");
        QTest::newRow("time") << "0,1,0\nnan,1,0\n"
                              << "line 3: has no time";
        QTest::newRow("empty time") << ",1,0\n"
                                    << "line 2: has no time";
        QTest::newRow("cell") << "0,1,0\n\n1,x,0\n"
                              << "line 4: \"x\" is not a number";
        QTest::newRow("short") << "0,1\n"
                               << "line 2: has 2 cells";
        QTest::newRow("twice") << "0,1,0\n1,1,0\n0,2,0\n"
                               << "two rows at t = 0";
        QTest::newRow("none") << ""
                              << "has no rows";
    }
    void wrongRowsAreNamed() {
        QFETCH(QString, rows);
        QFETCH(QString, message);
        const std::string found = refusal(rows.toStdString());
        QVERIFY2(found.find(message.toStdString()) != found.npos, found.c_str());
    }
};

EXTREMAL_TEST(ReferenceFileTest)

}  // namespace extremal::reference_file_test

#include "reference_file_test.moc"
