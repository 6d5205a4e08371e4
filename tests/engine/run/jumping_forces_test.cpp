// SPDX-License-Identifier: GPL-3.0-or-later
/// Forces that jump, begin, pulse or are zero at a start from rest: steps that are right are not called lost.
/// Roots that jump over a singularity still are (motion_check_test.cpp).
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::jumping_forces_test {
namespace {

std::vector<Summary> summariesOf(const char* lagrangian, const char* initial, double end) {
    QByteArray schemes;
    for (const char* name : {"midpoint", "trapezoidal", "galerkin-gauss-2", "galerkin-gauss-3",
                             "galerkin-gauss-4", "galerkin-lobatto-3", "spectral-clenshaw-curtis-4"})
        for (const double h : {0.01, 0.05, 0.1, 0.3, 0.5, 1.0})
            schemes += (schemes.isEmpty() ? "" : ",") + QByteArray("{\"scheme\":\"") + name +
                       "\",\"step\":" + QByteArray::number(h) + "}";
    const ReadScene read = readScene(QByteArray(R"json({"extremal":1,
            "model":{"type":"lagrangian","coordinates":["x"],"lagrangian":"LAGRANGIAN"},
            "initial":INITIAL,"time":{"end":END},"reference":"none","schemes":[SCHEMES]})json")
                                         .replace("LAGRANGIAN", lagrangian)
                                         .replace("INITIAL", initial)
                                         .replace("END", QByteArray::number(end))
                                         .replace("SCHEMES", schemes)
                                         .toStdString());
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    std::vector<Summary> all;
    for (const auto& scheme : run(read.scene).schemes) all.push_back(scheme->summary);
    return all;
}

}  // namespace

class JumpingForcesTest : public QObject {
    Q_OBJECT
private slots:
    void rightStepsAreNotLost_data() {
        QTest::addColumn<QByteArray>("lagrangian");
        QTest::addColumn<QByteArray>("initial");
        const char *rest = R"({"q":[0]})", *aside = R"({"q":[1]})";
        const auto add = [](const char* lagrangian, const char* initial) {
            QTest::addRow("%s from %s", lagrangian, initial) << QByteArray(lagrangian) << QByteArray(initial);
        };
        for (const char* initial : {rest, aside}) {
            add("x_t^2/2 - x^2/2 + x*sign(sin(3*t))", initial);
            add("x_t^2/2 + x*sign(sin(3*t))", initial);
            add("x_t^2/2 + cos(x) + x*sign(sin(3*t))", initial);
            add("x_t^2/2 - x^2/2 + x*(1+sign(t-3.05))", initial);
            add("x_t^2/2 - x^2/2 + 10*x*exp(-100*(t-3)^2)", initial);
        }
        add("x_t^2/2 - x^4/4 + 5*x*exp(-100*(t-0.2)^2)", rest);
        add("x_t^2/2 + x*exp(-20*(t-3)^2)", rest);
        add("x_t^2/2 + x*sin(pi*t)", rest);
        add("x_t^2/2 + x*t^12", rest);
        add("x_t^2/2 - x^2/2 + x*(1+sign(sin(t)))/2", rest);
    }
    void rightStepsAreNotLost() {
        QFETCH(QByteArray, lagrangian);
        QFETCH(QByteArray, initial);
        for (const Summary& s : summariesOf(lagrangian.constData(), initial.constData(), 4))
            QVERIFY2(s.status == RunStatus::done,
                     (s.label + " at t = " + std::to_string(s.failedAt) + ": " + std::string(name(s.cause)))
                         .c_str());
    }
};

EXTREMAL_TEST(JumpingForcesTest)
}  // namespace extremal::jumping_forces_test
#include "jumping_forces_test.moc"
