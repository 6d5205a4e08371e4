// SPDX-License-Identifier: GPL-3.0-or-later
/// What errors of fields are measured against, and how: the error of the interpolating function, references
/// computed on a finer mesh, orders of the mesh and the step together; and what is refused because it is not
/// determined.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/run/reference/reference.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/tools/test.hpp"

namespace extremal::field_error_test {
namespace {

/// A field on a circle of length 2 pi. `rest`: "potential", "cells" and further keys of the model; `schemes`:
/// an array.
std::string scene(const std::string& model, const std::string& initial, double end,
                  const std::string& schemes) {
    return R"({"extremal": 1, "model": {"type": "field", "domain": [0, "2*pi"], "boundary": "periodic", )" +
           model + R"(}, "initial": )" + initial + R"(, "time": {"end": )" + std::to_string(end) +
           R"(}, "observe": ["error", "order"], "schemes": )" + schemes + "}";
}

ResolvedScene resolved(const std::string& json) {
    const ReadScene read = readScene(json);
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return *read.resolved;
}

Comparison compared(const std::string& json) { return run(resolved(json).scene); }

/// Of a system that does not know its exact solution.
ResolvedScene withoutExact(ResolvedScene scene) {
    System system = *scene.system;
    system.exactFrom = {};
    scene.system = std::make_shared<const System>(std::move(system));
    return scene;
}

const char* const nonlinear = R"("potential": "sine-gordon", "cells": 40)";
const char* const swing = R"({"u": "1.5*cos(x) + 0.3*sin(2*x) ", "u_t": "0.4*cos(3*x) "})";

}  // namespace

class FieldErrorTest : public QObject {
    Q_OBJECT
private slots:
    void theErrorOfTheFunctionIsThatOfItsInterpolation() {
        // |u - I u| = dx^2 |u_xx| / sqrt(120) for hat functions, |u_xx| = 9 sqrt(pi).
        const Comparison c = compared(scene(R"("potential": "none", "cells": 100)",
                                            R"({"profile": "plane-wave", "wave_number": 3})", 1,
                                            R"([{"label": "a", "step": 0.02, "space": "tent"},
                               {"label": "b", "step": 0.02, "space": {"type": "tent", "degree": 2}}])"));
        const double dx = 2 * std::numbers::pi / 100,
                     expected = 9 * std::sqrt(std::numbers::pi) * dx * dx / std::sqrt(120.0);
        const Trajectory& a = c.schemes[0]->trajectory;
        const std::vector<double>& function = a.find("error.function")->values;
        QCOMPARE(a.find("error")->values.front(), 0.0);
        // 0.9993
        QVERIFY2(std::abs(function.front() / expected - 1) < 2e-3,
                 qPrintable(QString::number(function.front() / expected)));
        // Of quadratic functions it falls with the cube of dx: 57 times less.
        const double quadratic = c.schemes[1]->trajectory.find("error.function")->values.front();
        QVERIFY2(quadratic < expected / 50, qPrintable(QString::number(quadratic / expected)));
    }
    void aComputedReferenceKeepsWhatItPromises() {
        // Plane waves and a breather, whose exact solutions are taken away.
        for (const auto& [json, best] :
             {std::pair{scene(R"("potential": "klein-gordon", "cells": 40)",
                              R"({"profile": "plane-wave", "wave_number": 3})", 5,
                              R"([{"label": "a", "step": 0.05, "space": "tent"}])"),
                        1e-4},
              std::pair{std::string(R"({"extremal": 1, "model": {"type": "field", "potential": "sine-gordon",
                    "domain": [-32, 32], "cells": 256}, "initial": {"profile": "breather", "omega": 0.6},
                    "time": {"end": 5}, "observe": ["error"],
                    "schemes": [{"label": "a", "step": 0.1, "space": "tent"}]})"),
                        1e-4}}) {
            const ResolvedScene exact = resolved(json), unknown = withoutExact(exact);
            const Reference truth = makeReference(exact, {}), reference = makeReference(unknown, {});
            QCOMPARE(truth.info.type, std::string("exact"));
            QCOMPARE(reference.info.type, std::string("computed"));
            const ExactSolution a = truth.make(), b = reference.make();
            std::vector<double> x(exact.initial.x.size()), y = x;
            double worst = 0;
            for (int k = 1; k <= 20; ++k) {
                const double t = exact.scene.end.value * k / 20;
                double error = 0;
                a(t, x);
                b(t, y);
                exact.system->error.evaluate(x.data(), y.data(), &error);
                worst = std::max(worst, error);
            }
            qInfo("%s: good to %.2e, off by %.2e", reference.info.description.c_str(),
                  reference.info.estimatedError, worst);
            // 4.3e-10 of 4.8e-9, and 2.5e-9 of 1.9e-8
            QVERIFY(worst < reference.info.estimatedError);
            QVERIFY(worst < best);
        }
    }
    void itIsAsGoodBetweenItsNodes() {
        // At the nodes of elements of degree 3, which are not among its own.
        const ResolvedScene exact = resolved(scene(
            R"("potential": "klein-gordon", "cells": 40)", R"({"profile": "plane-wave", "wave_number": 3})",
            5, R"([{"label": "a", "step": 0.05, "space": {"type": "tent", "degree": 3, "cells": 22}}])"));
        const Reference reference = makeReference(withoutExact(exact), {});
        const std::shared_ptr<const System>& own = exact.schemes[0].ownSystem;
        const ExactSolution read = reference.onMesh.on(own),
                            truth = own->exactFrom(
                                Settings{"", {{"profile", "plane-wave"}, {"wave_number", 3.0}}, {}},
                                exact.schemes[0].ownInitial);
        std::vector<double> x(exact.schemes[0].ownInitial.x.size()), y = x;
        for (const double t : {0.0, 1.0, 5.0}) {
            double error = 0;
            read(t, x);
            truth(t, y);
            own->error.evaluate(x.data(), y.data(), &error);
            QVERIFY2(error < reference.info.estimatedError,
                     qPrintable(QString::number(error)));  // 5e-10 of 4.8e-9
        }
    }
    void schemesOnMeshesOfTheirOwnAreMeasuredByIt() {
        const Comparison c = compared(scene(nonlinear, swing, 2,
                                            R"([{"label": "a", "step": 0.05, "space": "tent"},
                      {"label": "b", "step": 0.05, "space": {"type": "tent", "cells": 80}},
                      {"label": "c", "step": 0.1, "space": {"type": "tent", "degree": 3, "cells": 20}}])"));
        const auto errorOf = [&](int i) { return c.schemes[static_cast<std::size_t>(i)]->summary.maxError; };
        for (int i = 0; i < 3; ++i) {
            QVERIFY(std::isfinite(errorOf(i)) && errorOf(i) > 0);
            QVERIFY(std::isfinite(
                c.schemes[static_cast<std::size_t>(i)]->trajectory.find("error.function")->values.back()));
        }
        QVERIFY2(errorOf(1) < errorOf(0) / 2, qPrintable(QString::number(errorOf(0) / errorOf(1))));
        QVERIFY2(errorOf(2) < errorOf(1) / 100, qPrintable(QString::number(errorOf(1) / errorOf(2))));
    }
    void ordersAreThoseOfMeshAndStepTogether() {
        const Comparison c = compared(scene(nonlinear, swing, 2,
                                            R"([{"label": "1", "step": 0.05, "space": "tent"},
                {"label": "2", "step": 0.2, "space": {"type": "tent", "degree": 2, "cells": 20}},
                {"label": "3", "step": 0.2, "space": {"type": "tent", "degree": 3, "cells": 20}},
                {"label": "leapfrog", "step": 0.05, "baseline": "leapfrog"},
                {"label": "lines", "step": 0.05, "baseline": "method-of-lines-rk4"},
                {"label": "composed", "step": 0.1, "space": "tent",
                 "composition": {"type": "suzuki", "order": 4}}])"));
        // Second differences hold RK4 back, and a composition in time.
        for (const auto& [i, order] : {std::pair{0, 2}, {1, 4}, {2, 6}, {3, 2}, {4, 2}, {5, 2}}) {
            const Summary& s = c.schemes[static_cast<std::size_t>(i)]->summary;
            QCOMPARE(s.orderClaimed, order);
            // 2.00, 3.93, 5.07, 2.00, 2.00, 2.00: inside elements of degree 3 values are of order 5 only.
            QVERIFY2(std::abs(s.orderMeasured - order) < (order == 6 ? 1.1 : 0.2),
                     qPrintable(QString("%1: %2").arg(s.label.c_str()).arg(s.orderMeasured)));
        }
    }
    /// Over rectangles too, of schemes that are not spectral in space, where the exact solution is known;
    /// those that are have the order of the step.
    void ordersOverRectangles_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("order");
        const char *const
            usual = R"("potential": "none", "cells": 16, "cells_y": 16)",
            *const edges = R"J("components": ["a", "b"], "places": {"a": "edges-x", "b": "edges-y"},
                              "lagrangian": "(a_t^2 + b_t^2)/2 - (b_x - a_y)^2/2", "cells": 16, "cells_y": 16)J",
            *const wave = R"({"profile": {"name": "plane-wave", "wave_vector": [1, 1], "amplitude": 1}})",
            *const light = R"J({"exact": {"a": "-sin(x + y - sqrt(2)*t)", "b": "sin(x + y - sqrt(2)*t)"}})J";
        QTest::newRow("leapfrog") << usual << wave << R"("baseline": "leapfrog")" << 2.0;
        QTest::newRow("elements") << usual << wave << R"("space": {"type": "tent", "degree": 2})" << 4.0;
        QTest::newRow("Fourier") << usual << wave << R"("scheme": "field-gauss-2")" << 4.0;
        QTest::newRow("edges") << edges << light << R"("baseline": "leapfrog")" << 2.0;
        QTest::newRow("implicit cells") << edges << light << R"("baseline": "implicit-cells")" << 2.0;
        // There is no room for a mesh that is twice as fine.
        QTest::newRow("no room") << QString(edges).replace("16", "40") << light
                                 << R"("baseline": "implicit-cells")" << std::nan("");
    }
    void ordersOverRectangles() {
        QFETCH(QString, model);
        QFETCH(QString, initial);
        QFETCH(QString, scheme);
        QFETCH(double, order);
        const Comparison c = compared(
            R"J({"extremal": 1, "model": {"type": "field-2d", "domain": [0, "2*pi"], "domain_y": [0, "2*pi"], )J" +
            model.toStdString() + R"(}, "initial": )" + initial.toStdString() +
            R"(, "time": {"end": 1}, "observe": ["error", "order"], "schemes": [{"step": 0.1, )" +
            scheme.toStdString() + "}]}");
        const double measured = c.schemes.front()->summary.orderMeasured;
        qInfo("%.2f", measured);
        if (std::isnan(order))
            QVERIFY(std::isnan(measured));
        else
            QVERIFY(std::abs(measured - order) < 0.2);
    }
    void whatWouldCostMinutesHasNoReference() {
        const ResolvedScene large =
            resolved(scene(R"("potential": "sine-gordon", "cells": 100000)", swing, 100,
                           R"([{"label": "a", "step": 5e-5, "space": "tent"}])"));
        QVERIFY(!makeReference(large, {}).make);
    }
    void aWaveWithoutMassIsRefused() {
        const auto read = [](const char* boundary, int cells, const char* time, int degree,
                             const char* more = "") {
            return readScene(
                R"({"extremal": 1, "model": {"type": "field", "potential": "sine-gordon", "domain": [0, 6],
                    "boundary": ")" +
                std::string(boundary) + R"(", "cells": )" + std::to_string(cells) +
                R"(}, "initial": {"u": "cos(x) "}, "time": {"end": 1}, "schemes": [{"step": 0.1,
                    "space": {"type": "tent", "degree": {"space": 1, "time": )" +
                std::to_string(degree) + R"(}}, "quadrature": {"space": "midpoint", "time": )" + time + "}" +
                more + "}]}");
        };
        const char* const gauss2 = R"({"type": "gauss", "nodes": 2})";
        QVERIFY(!read("periodic", 50, gauss2, 2).errors.empty());
        QVERIFY(!read("neumann", 51, gauss2, 2).errors.empty());
        QVERIFY(read("periodic", 51, gauss2, 2).errors.empty());
        QVERIFY(read("dirichlet", 50, gauss2, 2).errors.empty());
        QVERIFY(read("periodic", 50, gauss2, 2, R"(, "allow_unstable": true)").errors.empty());
        // The midpoint rule in time needs no velocity from a momentum: the box scheme.
        QVERIFY(read("periodic", 50, R"("midpoint")", 1).errors.empty());
        const Problem problem = read("periodic", 50, gauss2, 2).errors.front();
        QCOMPARE(problem.pointer, std::string("/schemes/0/quadrature"));
        QVERIFY(problem.message.find("alternates from node to node has no mass") != std::string::npos);
        QVERIFY(problem.hint.find("odd number of cells") != std::string::npos);
    }
    void whatIsNotRefusedIsDetermined() {
        // Half of a run, and the other half from its state with an integrator that has seen nothing, in
        // data that alternate from node to node.
        using namespace fields;
        for (const auto& [cells, degree, time] : {std::tuple{51, 2, rule("gauss", 2)}, {50, 1, midpoint()}}) {
            const System system = makeField({"sine-gordon", 0, 6, cells, "periodic", 1, 1});
            State state;
            for (int i = 0; i < 2 * cells; ++i)
                state.x.push_back(std::cos(0.3 * i) + (i % 2 == 0 ? 0.2 : -0.2));
            const Discretization d = tents(midpoint(), time, 1, degree);
            State whole = state;
            const auto one = makeIntegrator(system, d, {0, 0.05});
            QVERIFY(go(*one, whole, 20));
            State half = state;
            QVERIFY(go(*makeIntegrator(system, d, {0, 0.05}), half, 10));
            QVERIFY(go(*makeIntegrator(system, d, {0, 0.05}), half, 10));
            double away = 0;
            for (std::size_t i = 0; i < whole.x.size(); ++i)
                away = std::max(away, std::abs(whole.x[i] - half.x[i]));
            QVERIFY2(away < 1e-9, qPrintable(QString::number(away)));
        }
    }
};

EXTREMAL_TEST(FieldErrorTest)

}  // namespace extremal::field_error_test

#include "field_error_test.moc"
