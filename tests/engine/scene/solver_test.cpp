// SPDX-License-Identifier: GPL-3.0-or-later
/// A way of solving that a scheme does not have is an error of the scene: every method of every family, on
/// schemes of each.
#include <QTest>

#include <algorithm>
#include <set>

#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::solver_test {
namespace {

ReadScene withSolver(const std::string& model, const std::string& scheme, const std::string& method) {
    return readScene("{\"extremal\":1,\"model\":" + model + ",\"schemes\":[{" + scheme +
                     ",\"solver\":{\"method\":\"" + method + "\"}}]}");
}

std::set<std::string> allMethods() {
    std::set<std::string> all;
    for (const Family& family : families())
        all.insert(solverMethods(family).begin(), solverMethods(family).end());
    return all;
}

}  // namespace

class SolverTest : public QObject {
    Q_OBJECT
private slots:
    void otherMethodsThanThoseOfTheFamilyAreRefused_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("scheme");
        const auto row = [](const char* model, const char* scheme) {
            QTest::newRow(scheme) << QString(model) << QString(scheme);
        };
        row(R"({"type":"kepler"},"time":{"end":1},"initial":{"q":[0.4,0],"p":[0,2]})",
            R"("scheme":"galerkin-gauss-2","step":0.1)");
        row(R"({"type":"spring-pendulum"},"time":{"end":1},"initial":{"q":[0.05,1]})",
            R"("scheme":"multiscale-r1","step":0.2)");
        row(R"({"type":"rigid-body"},"time":{"end":1},"initial":{"momentum":[0.5,0.2,0.8]})",
            R"("scheme":"lie-2","step":0.1)");
        row(R"({"type":"schrodinger","modes":32,"potential":"1 - cos(x) "},"time":{"end":1},)"
            R"("initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":1,"wave_number":1}})",
            R"("scheme":"schrodinger-gauss-1","step":0.1)");
        row(R"({"type":"multiscale-elliptic","a":"10/(1+0.95*sin(2*pi*s)) ","epsilon":0.1,"f":"x","elements":5})",
            R"("scheme":"elliptic-linear")");
    }
    void otherMethodsThanThoseOfTheFamilyAreRefused() {
        QFETCH(QString, model);
        QFETCH(QString, scheme);
        const ReadScene plain = withSolver(model.toStdString(), scheme.toStdString(), "auto");
        QVERIFY2(plain.errors.empty(), plain.errors.empty() ? "" : plain.errors[0].message.c_str());
        const Family& family = *plain.resolved->schemes.front().family;
        int refused = 0;
        for (const std::string& method : allMethods()) {
            const ReadScene read = withSolver(model.toStdString(), scheme.toStdString(), method);
            const auto& own = solverMethods(family);
            if (std::find(own.begin(), own.end(), method) != own.end()) {
                QVERIFY2(read.errors.empty(), method.c_str());
                continue;
            }
            ++refused;
            QCOMPARE(read.errors.size(), std::size_t(1));
            QCOMPARE(read.errors[0].pointer, std::string("/schemes/0/solver/method"));
        }
        QVERIFY(refused >= 2);
    }
    void baselinesSolveInTheirOwnWay() {
        const std::string kepler = R"({"type":"kepler"},"time":{"end":1},"initial":{"q":[0.4,0],"p":[0,2]})";
        for (const std::string& method : allMethods()) {
            const ReadScene read = withSolver(kepler, R"("baseline":"implicit-midpoint","step":0.1)", method);
            QCOMPARE(read.errors.size(), std::size_t(1));
            QVERIFY2(read.errors[0].pointer.starts_with("/schemes/0/solver"), read.errors[0].pointer.c_str());
        }
    }
};

EXTREMAL_TEST(SolverTest)
}  // namespace extremal::solver_test

#include "solver_test.moc"
