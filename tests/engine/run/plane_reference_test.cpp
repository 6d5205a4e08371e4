// SPDX-License-Identifier: GPL-3.0-or-later
/// Computed references of fields over rectangles: as good as they say, where one fast oscillation has to be
/// resolved too, and not begun where they would take minutes.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/family/family.hpp"
#include "engine/run/reference/reference.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::plane_reference_test {
namespace {

ResolvedScene sceneOf(const char* potential, double mass, int cells, double end) {
    const QString text =
        QString(R"~({"extremal": 1, "model": {"type": "field-2d", "potential": "%1", "mass": %2,
        "domain": [0, 6], "domain_y": [0, 4], "cells": %3, "cells_y": %3},
        "initial": {"u": "0.4 + 0.3*cos(pi*x/3)*sin(pi*y/2)", "u_t": "0.2*sin(pi*x/3 + pi*y/2)"},
        "time": {"end": %4}, "schemes": [{"step": %5, "baseline": "leapfrog"}]})~")
            .arg(potential)
            .arg(mass)
            .arg(cells)
            .arg(end)
            .arg(end / 2000);
    const ReadScene read = readScene(text.toStdString());
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return *read.resolved;
}

}  // namespace

class PlaneReferenceTest : public QObject {
    Q_OBJECT
private slots:
    void saysItsError_data() {
        QTest::addColumn<QString>("potential");
        QTest::addColumn<double>("mass");
        QTest::newRow("phi4") << "phi4" << 1.0;
        QTest::newRow("sine-gordon") << "sine-gordon" << 1.0;
        QTest::newRow("a fast oscillation") << "mass^2*(u^2/2 + u^4/8)" << 40.0;
    }
    void saysItsError() {
        // Against Gauss of degree 8 in steps that are shorter by far.
        QFETCH(QString, potential);
        QFETCH(double, mass);
        constexpr double end = 3;
        constexpr int steps = 300;
        const ResolvedScene scene = sceneOf(qPrintable(potential), mass, 16, end);
        const Reference reference = makeReference(scene, {});
        QVERIFY(reference.make);
        std::vector<double> x(scene.initial.x.size());
        const double last = end;
        reference.make()(std::span(&last, 1), x.data(), x.size());
        State state = scene.initial;
        const auto integrator = makeIntegrator(*scene.system,
                                               {{"fourier-field", {{"degree", 8.0}, {"nodes", "same"}}, {}},
                                                {"gauss", {{"nodes", 8.0}, {"panels", 1.0}}, {}},
                                                {}},
                                               {0, end / steps});
        for (int k = 0; k < steps; ++k) QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
        double sum = 0;
        const std::size_t nodes = x.size() / 2;
        for (std::size_t i = 0; i < nodes; ++i) sum += (x[i] - state.x[i]) * (x[i] - state.x[i]);
        const double error = std::sqrt(24 * sum / static_cast<double>(nodes));
        qInfo("%.1e, said %.1e by %s", error, reference.info.estimatedError,
              reference.info.description.c_str());
        constexpr double roundOffOfGauss8 = 2e-14;
        QVERIFY(error <= reference.info.estimatedError + roundOffOfGauss8);
        QVERIFY(reference.info.estimatedError < 1e-10);
    }
    void isNotBegunWhereItWouldTakeMinutes() {
        const ResolvedScene scene = sceneOf("phi4", 1, 1024, 3);
        const Reference reference = makeReference(scene, {});
        QVERIFY(!reference.make);
        QCOMPARE(reference.info.problems.size(), std::size_t{1});
        const Problem& problem = reference.info.problems.front();
        QCOMPARE(problem.pointer, std::string("/reference"));
        qInfo("%s", problem.message.c_str());
        QVERIFY(problem.message.find("on a mesh of this size at most") != std::string::npos);
    }
};

EXTREMAL_TEST(PlaneReferenceTest)

}  // namespace extremal::plane_reference_test

#include "plane_reference_test.moc"
