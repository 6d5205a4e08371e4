// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes with constraints and forces: what is refused, where, and with which remedy; and who takes them.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_scene_test {
namespace {

/// A pendulum in x and y whose model and start have these keys besides.
ReadScene read(const Value::Object& model, const Value::Object& initial = {},
               const char* scheme = "galerkin-gauss-2") {
    Value pendulum(Value::Object{{"type", "lagrangian"},
                                 {"coordinates", Value::Array{"x", "y"}},
                                 {"parameters", Value::Object{{"l", 1}}},
                                 {"lagrangian", "(x_t^2+y_t^2)/2 - y"}});
    for (const auto& [key, value] : model) pendulum.set(key, value);
    Value start(Value::Object{{"q", Value::Array{0.6, -0.8}}, {"v", Value::Array{0.8, 0.6}}});
    for (const auto& [key, value] : initial) start.set(key, value);
    return readScene(Value(
        Value::Object{{"extremal", 1},
                      {"model", pendulum},
                      {"initial", start},
                      {"time", Value::Object{{"end", 1}}},
                      {"schemes", Value::Array{Value(Value::Object{{"scheme", scheme}, {"step", 0.1}})}}}));
}
const Value::Object rod{{"constraints", Value::Object{{"rod", "x^2+y^2-l^2"}}}};

std::string textOf(const std::vector<Problem>& problems) {
    std::string all;
    for (const Problem& p : problems) all += p.pointer + ": " + p.message + " (" + p.hint + ")\n";
    return all;
}

}  // namespace

class MechanismSceneTest : public QObject {
    Q_OBJECT
private slots:
    void aPendulumIsRead() {
        const ReadScene scene = read(rod);
        QVERIFY2(scene.errors.empty() && scene.warnings.empty(),
                 (textOf(scene.errors) + textOf(scene.warnings)).c_str());
        QVERIFY(scene.resolved->system->parts.find<Constraint>());
    }
    void whatIsWrongIsSaidWithItsPlace_data() {
        QTest::addColumn<QString>("key");
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("formula");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* what, const char* key, const char* name, const char* formula,
                            const char* pointer, const char* words) {
            QTest::newRow(what) << key << name << formula << pointer << words;
        };
        row("velocity in a constraint", "constraints", "rod", "x*x_t", "/model/constraints/rod",
            "has a velocity");
        row("nothing is constrained", "constraints", "rod", "t-1", "/model/constraints/rod", "no coordinate");
        row("unknown name", "constraints", "rod", "x+zz", "/model/constraints/rod", "unknown name");
        row("unknown coordinate", "forces", "u", "-u_t", "/model/forces/u", "no coordinate");
        row("unknown name in a force", "forces", "x", "-c*x_t", "/model/forces/x", "unknown name");
        row("rate of time", "forces", "x", "t_t", "/model/forces/x", "unknown name");
        row("not finite at the start", "constraints", "rod", "log(x-5)", "/model/constraints/rod",
            "not finite");
        row("gradient of 0", "constraints", "rod", "(x-0.6)^2+(y+0.8)^2", "/model/constraints/rod",
            "gradient of 0");
        row("dry friction", "forces", "x", "-sign(x_t)", "/model/forces/x", "jumps where x_t passes 0");
        row("dry friction as a ratio", "forces", "x", "-x_t/abs(x_t)", "/model/forces/x",
            "jumps where x_t passes 0");
        row("dry friction in the plane", "forces", "x", "-x_t/sqrt(x_t^2+y_t^2)", "/model/forces/x",
            "jumps where the velocities are 0");
        row("dry friction on a belt", "forces", "y", "-heaviside(2*y_t-3)", "/model/forces/y",
            "jumps where y_t passes 1.5");
        row("a brake that begins", "forces", "x", "-piecewise(x_t > 0.5, 2, x_t)", "/model/forces/x",
            "jumps where x_t passes 0.5");
    }
    /// Of the second kind, and smoothed, friction has no jump; walls have none.
    void frictionThatDoesNotJump() {
        for (const char* force : {"-sign(x_t)*x_t^2", "-x_t*abs(x_t)", "-tanh(x_t/1e-4)",
                                  "-x_t/sqrt(x_t^2+1e-8)", "-sign(x)", "-piecewise(x_t > 0.5, x_t, 0.5)"}) {
            const std::string said = textOf(read({{"forces", Value::Object{{"x", force}}}}).errors);
            QVERIFY2(said.empty(), said.c_str());
        }
        const std::string dissipation = textOf(read({{"dissipation", "0.3*abs(x_t)"}}).errors);
        QVERIFY2(dissipation.starts_with("/model/dissipation: jumps"), dissipation.c_str());
        const std::string wall = textOf(
            read({{"walls", Value::Object{{"floor", Value::Object{{"gap", "y+2"}, {"friction", 0.3}}}}}})
                .errors);
        QVERIFY2(wall.starts_with("/model/walls/floor/friction: is not modelled"), wall.c_str());
    }
    void whatIsWrongIsSaidWithItsPlace() {
        QFETCH(QString, key);
        QFETCH(QString, name);
        QFETCH(QString, formula);
        QFETCH(QString, pointer);
        QFETCH(QString, words);
        const ReadScene scene =
            read({{key.toStdString(), Value::Object{{name.toStdString(), formula.toStdString()}}}});
        const std::string said = textOf(scene.errors);
        QVERIFY2(std::any_of(scene.errors.begin(), scene.errors.end(),
                             [&](const Problem& p) {
                                 return p.pointer == pointer.toStdString() &&
                                        QString::fromStdString(p.message).contains(words);
                             }),
                 said.c_str());
    }
    /// Impacts with equal discrete energies are for what follows from an action and loses nothing.
    void variationalImpactsAreRefusedWhereTheyMeanNothing_data() {
        QTest::addColumn<QString>("lagrangian");
        QTest::addColumn<double>("restitution");  // 0: no wall
        QTest::addColumn<QString>("force");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("words");
        const char *const L = "x_t^2/2 - x", *const gauss = "galerkin-gauss-2";
        QTest::newRow("taken") << L << 1.0 << "" << gauss << "";
        QTest::newRow("no wall") << L << 0.0 << "" << gauss << "the model has none";
        QTest::newRow("a loss") << L << 0.5 << "" << gauss << "restitutions are below 1";
        QTest::newRow("a force") << L << 1.0 << "-x_t" << gauss << "not in the action";
        QTest::newRow("time") << "x_t^2/2 - x*(1+t)" << 1.0 << "" << gauss << "depends on time";
        QTest::newRow("another family") << L << 1.0 << ""
                                        << "sem-2"
                                        << "times of impacts";
        QTest::newRow("no such law") << L << 1.0 << ""
                                     << "impact"
                                     << "must be \"energy\"";
    }
    void variationalImpactsAreRefusedWhereTheyMeanNothing() {
        QFETCH(QString, lagrangian);
        QFETCH(double, restitution);
        QFETCH(QString, force);
        QFETCH(QString, scheme);
        QFETCH(QString, words);
        Value model(Value::Object{{"type", "lagrangian"},
                                  {"coordinates", Value::Array{"x"}},
                                  {"lagrangian", lagrangian.toStdString()}});
        if (restitution > 0)
            model.set("walls",
                      Value::Object{{"floor", Value::Object{{"gap", "x"}, {"restitution", restitution}}}});
        if (!force.isEmpty()) model.set("forces", Value::Object{{"x", force.toStdString()}});
        const bool isNoLaw = scheme == "impact";
        const Value row = Value::Object{{"scheme", isNoLaw ? "galerkin-gauss-2" : scheme.toStdString()},
                                        {"step", 0.1},
                                        {"impact", isNoLaw ? "elastic" : "variational"}};
        const ReadScene read = readScene(
            Value(Value::Object{{"extremal", 1},
                                {"model", model},
                                {"initial", Value::Object{{"q", Value::Array{1}}, {"v", Value::Array{0}}}},
                                {"time", Value::Object{{"end", 3}}},
                                {"schemes", Value::Array{row}}}));
        const std::string said = textOf(read.errors);
        if (words.isEmpty()) {
            QVERIFY2(said.empty(), said.c_str());
            const Scene& scene = read.scene;
            QVERIFY(scene.schemes.front().impact == ImpactLaw::variational);
            const ReadScene again = readScene(toValue(scene));
            QVERIFY(again.errors.empty() && again.scene.schemes.front() == scene.schemes.front());
            return;
        }
        QVERIFY2(said.starts_with("/schemes/0/impact: "), said.c_str());
        QVERIFY2(QString::fromStdString(said).contains(words), said.c_str());
    }
    /// Rules of constraints that lose order are named where they stand, and friction that is smoothed is
    /// stiff where its velocity changes sign, however fast the start is.
    void rulesAndStiffFriction() {
        Value scene = Value(Value::Object{
            {"extremal", 1},
            {"model", Value::Object{{"type", "lagrangian"},
                                    {"coordinates", Value::Array{"x", "y"}},
                                    {"lagrangian", "(x_t^2+y_t^2)/2 - y"},
                                    {"constraints", Value::Object{{"rod", "x^2+y^2-1"}}}}},
            {"initial", Value::Object{{"q", Value::Array{0.6, -0.8}}, {"v", Value::Array{0.8, 0.6}}}},
            {"time", Value::Object{{"end", 1}}}});
        const Value gauss = Value::Object{{"type", "gauss"}, {"nodes", 2}};
        const Value space = Value::Object{{"type", "polynomial"}, {"degree", 2}};
        scene.set("schemes", Value::Array{Value::Object{
                                 {"space", space},
                                 {"quadrature", Value::Object{{"otherwise", gauss}, {"constraints", gauss}}},
                                 {"step", 0.1}}});
        const std::string said = textOf(readScene(scene).errors);
        QVERIFY2(said.starts_with("/schemes/0/quadrature: constraints by gauss"), said.c_str());
        const ReadScene friction = read({{"forces", Value::Object{{"x", "-tanh(x_t/1e-4)"}}}});
        const std::string warned = textOf(friction.warnings);
        QVERIFY2(warned.find("damping is stiff") != std::string::npos, warned.c_str());
    }
    /// Names of parts among each other, and with those of formulas.
    void namesHaveOneMeaning_data() {
        QTest::addColumn<QString>("key");
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("words");
        for (const char* key : {"constraints", "rolling", "walls"}) {
            QTest::addRow("%s, coordinate", key) << key << "x"
                                                 << "that of a coordinate";
            QTest::addRow("%s, parameter", key) << key << "l"
                                                << "that of a parameter";
            QTest::addRow("%s, control", key) << key << "u"
                                              << "that of a control";
            QTest::addRow("%s, term", key) << key << "kinetic"
                                           << "that of a term";
        }
        QTest::newRow("rolling, constraint") << "rolling"
                                             << "rod"
                                             << "that of a constraint";
        QTest::newRow("walls, constraint") << "walls"
                                           << "rod"
                                           << "that of a constraint";
    }
    void namesHaveOneMeaning() {
        QFETCH(QString, key);
        QFETCH(QString, name);
        QFETCH(QString, words);
        const std::string formula = key == "rolling" ? "x_t + y_t" : key == "walls" ? "y + 2" : "x^2+y^2-1";
        Value::Object model{
            {"lagrangian", Value::Object{{"kinetic", "(x_t^2+y_t^2)/2"}, {"potential", "-y"}}},
            {"controls", Value::Object{{"u", "sin(t)"}}},
            {"constraints", Value::Object{{"rod", "x^2+y^2-l^2"}}}};
        const Value own(Value::Object{{name.toStdString(), formula}});
        if (key == "constraints")
            model.back().second = own;
        else
            model.push_back({key.toStdString(), own});
        const std::string said = textOf(read(model).errors),
                          place = "/model/" + key.toStdString() + "/" + name.toStdString() + ": the name";
        QVERIFY2(said.find(place) != std::string::npos && said.find(words.toStdString()) != std::string::npos,
                 said.c_str());
    }
    /// A table that bends inside a step is warned of; one whose times are ends of steps is not.
    void tablesBendBetweenSteps() {
        const auto warnings = [](const Value::Array& rows, const char* interpolation, const char* scheme) {
            return textOf(
                read({{"forces", Value::Object{{"x", "u"}}},
                      {"controls", Value::Object{{"u", Value::Object{{"table", rows},
                                                                     {"interpolation", interpolation}}}}}},
                     {}, scheme)
                    .warnings);
        };
        const Value::Array inside{Value::Array{0, 1}, Value::Array{0.25, 2}, Value::Array{2, 0}},
            atEnds{Value::Array{-0.05, 1}, Value::Array{0.3, 2}, Value::Array{1.05, 0}};
        const std::string said = warnings(inside, "linear", "galerkin-gauss-2");
        QVERIFY2(said.find("bends at t = 0.25, inside a step") != std::string::npos, said.c_str());
        QCOMPARE(warnings(atEnds, "linear", "galerkin-gauss-2"), std::string());
        QCOMPARE(warnings(inside, "cubic", "galerkin-gauss-2"), std::string());
    }
    void aFormulaWithoutANameIsRefused() {
        const ReadScene scene = read({{"constraints", "x^2+y^2-1"}});
        QVERIFY2(textOf(scene.errors).find("needs a name") != std::string::npos,
                 textOf(scene.errors).c_str());
    }
    void aConstraintThatRepeatsAnotherIsNamed() {
        const ReadScene scene =
            read({{"coordinates", Value::Array{"x", "y", "z"}},
                  {"lagrangian", "(x_t^2+y_t^2+z_t^2)/2"},
                  {"constraints", Value::Object{{"a", "x^2+y^2-1"}, {"b", "2*x^2+2*y^2-2"}}}},
                 {{"q", Value::Array{0.6, -0.8, 0}}, {"v", Value::Array{0, 0, 1}}});
        const std::string said = textOf(scene.errors);
        QVERIFY2(said.find("/model/constraints/b: depends on the other") != std::string::npos, said.c_str());
        const std::string against =
            textOf(read({{"coordinates", Value::Array{"x", "y", "z"}},
                         {"lagrangian", "(x_t^2+y_t^2+z_t^2)/2"},
                         {"constraints", Value::Object{{"a", "x^2+y^2-1"}, {"b", "x^2+y^2-2"}}}},
                        {{"q", Value::Array{0.6, -0.8, 0}}, {"v", Value::Array{0, 0, 1}}})
                       .errors);
        QVERIFY2(against.find("/model/constraints/b: is not met") != std::string::npos, against.c_str());
    }
    /// A start that misses the constraint is refused with the place that would do, which then does.
    void aStartOffTheConstraint() {
        const ReadScene missed = read(rod, {{"q", Value::Array{0.6, -0.9}}});
        const std::string said = textOf(missed.errors);
        QVERIFY2(said.find("/initial/q: misses the constraint rod by 0.17") != std::string::npos,
                 said.c_str());
        QVERIFY2(said.find("\"project\": true") != std::string::npos, said.c_str());
        const ReadScene moved = read(rod, {{"q", Value::Array{0.6, -0.9}}, {"project", true}});
        QVERIFY2(moved.errors.empty(), textOf(moved.errors).c_str());
        const std::vector<double>& x = moved.resolved->initial.x;
        QVERIFY(std::abs(std::hypot(x[0], x[1]) - 1) < 1e-15);
        QVERIFY(std::abs(x[0] * x[2] + x[1] * x[3]) < 1e-15);
    }
    void aVelocityOffTheConstraintIsProjectedWithAWarning() {
        const ReadScene scene = read(rod, {{"v", Value::Array{1, 1}}});
        QVERIFY2(scene.errors.empty(), textOf(scene.errors).c_str());
        QVERIFY2(textOf(scene.warnings).find("constraints do not allow") != std::string::npos,
                 textOf(scene.warnings).c_str());
        const std::vector<double>& x = scene.resolved->initial.x;
        QVERIFY(std::abs(x[0] * x[2] + x[1] * x[3]) < 1e-15);
    }
    /// Who does not know of constraints and forces says that it is these.
    void othersRefuse_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme : {"sem-2", "multiscale-r1", "product-form", "stormer-verlet"})
            QTest::newRow(scheme) << scheme;
    }
    void othersRefuse() {
        QFETCH(QString, scheme);
        const System system = *read(rod).resolved->system;
        std::string said;
        try {
            if (const auto named = namedScheme(scheme.toStdString()))
                said = mismatch(*named, system);
            else
                said =
                    canIntegrate(*findBaseline(scheme.toStdString()), system) ? "" : "without a constraint";
        } catch (const InvalidScene& e) {
            said = e.what();
        }
        QVERIFY2(said.find("without a constraint") != std::string::npos, said.c_str());
    }
    /// A cyclic coordinate that a constraint or a force acts on has no conserved momentum.
    void momentaThatArePulledAtAreNotKept() {
        const auto momenta = [](const Value::Object& model) {
            return read(model).resolved->system->momenta.size();
        };
        QCOMPARE(momenta({}), std::size_t{1});
        QCOMPARE(momenta(rod), std::size_t{0});
        QCOMPARE(momenta({{"forces", Value::Object{{"x", "-x_t"}}}}), std::size_t{0});
        QCOMPARE(momenta({{"dissipation", "y_t^2"}}), std::size_t{1});
    }
};

EXTREMAL_TEST(MechanismSceneTest)
}  // namespace extremal::mechanism_scene_test
#include "mechanism_scene_test.moc"
