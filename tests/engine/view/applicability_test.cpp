// SPDX-License-Identifier: GPL-3.0-or-later
/// Which system has which view: every view of the catalogue on every model, and what is said where one does
/// not apply.
#include <QTest>

#include <algorithm>

#include "engine/figure/figure.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/view_choices.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::applicability_test {
namespace {

/// A short run of the model as the window first shows it, with these views.
ReadScene exampleOf(const ModelEntry& entry, const Value::Array& views, const std::string& scheme,
                    const Value::Array& observe) {
    Value model(Value::Object{{"type", entry.item.id}});
    for (const FieldInfo& field : entry.item.parameters)
        if (!field.example.isNull()) model.set(field.key, field.example);
    Value first(Value::Object{{"label", "first"}, {"scheme", scheme}, {"step", entry.exampleStep}});
    Value document(Value::Object{{"extremal", 1}, {"model", model}, {"schemes", Value::Array{first}}});
    if (entry.item.id != "multiscale-elliptic" && entry.item.id != "static-profile")
        document.set("time", Value(Value::Object{{"end", 20 * entry.exampleStep}}));
    document.set("observe", observe);
    document.set("views", views);
    return readScene(document);
}

std::string schemeFor(const System& system) {
    if (system.parts.find<EllipticPart>()) return "elliptic-multiscale";
    if (system.parts.find<StaticPart>()) return "free-knots";
    if (system.parts.find<Wave>()) return "schrodinger-gauss-1";
    if (system.parts.find<Membrane>()) return "asynchronous-dyadic";
    if (system.parts.find<PlaneField>()) return "field-gauss-1";
    if (system.parts.find<ScalarField>())
        return system.fieldProblem().isBody ? "asynchronous-dyadic" : "multisymplectic-1";
    const Parts& parts = system.parts;
    const bool isOnGroup = parts.find<Body>() || parts.find<LieGroup>() || parts.find<Spheres>();
    return isOnGroup ? "lie-2" : "galerkin-gauss-2";
}

Value::Array observablesOf(const System& system) {
    Value::Array all;
    for (const ObservableEntry& entry : observableEntries())
        if (appliesTo(entry, system) && entry.item.id != "order") all.emplace_back(entry.item.id);
    return all;
}

Value asked(const std::string& id, double step) {
    if (id != mapView) return id;
    return Value::Object{{"view", id},
                         {"cells", Value::Array{2, 2}},
                         {"steps", Value::Array{step, 2 * step}},
                         {"duration", 10 * step},
                         {"value", "error"}};
}

ReadScene kepler(const std::string& views, const std::string& schemes = R"({"step": 0.1, "baseline": "rk4"})",
                 const std::string& observe = R"(["energy"])") {
    const std::string text =
        R"({"extremal": 1, "model": {"type": "kepler"}, "initial": {"q": [1, 0], "p": [0, 1]},
        "time": {"end": 1}, "schemes": [)" +
        schemes + R"(], "observe": )" + observe + R"(, "views": )" + views + "}";
    return readScene(std::string_view(text));
}

}  // namespace

class ApplicabilityTest : public QObject {
    Q_OBJECT
private slots:
    void aViewIsAnErrorOfTheSceneOrShowsSomething_data() {
        QTest::addColumn<QString>("model");
        for (const ModelEntry& entry : modelCatalog())
            QTest::newRow(entry.item.id.c_str()) << QString::fromStdString(entry.item.id);
    }
    void aViewIsAnErrorOfTheSceneOrShowsSomething() {
        QFETCH(QString, model);
        const ModelEntry& entry = *findModel(model.toStdString());
        const System system = makeSystem(exampleOf(entry, {}, "midpoint", {}).scene);
        const std::string scheme = schemeFor(system);
        const ReadScene plain = exampleOf(entry, {}, scheme, {});
        const Value::Array observe = observablesOf(system);
        Value::Array fitting;
        for (const ViewEntry& view : viewEntries()) {
            const ReadScene read =
                exampleOf(entry, {asked(view.item.id, entry.exampleStep)}, scheme, observe);
            const std::string missing = missingFor({view.item.id, "", ""}, system);
            // A model whose parameters the user names may have none; and a coefficient that is a thousand
            // times faster takes long.
            const bool isMap = view.item.id == mapView;
            if (isMap && (!system.isMotion() || parametersOf(read.scene).empty())) continue;
            // Other schemes for the system have it, and this one says why it has not.
            const std::string unsuitable = unsuitableFor(view, resolve(plain.scene.schemes[0], &system));
            if (missing.empty() && !unsuitable.empty()) {
                QCOMPARE(read.errors.size(), std::size_t(1));
                QCOMPARE(read.errors[0].hint, "first is " + unsuitable);
                continue;
            }
            if (missing.empty()) {
                QVERIFY2(read.errors.empty(),
                         (view.item.id + (read.errors.empty() ? "" : ": " + read.errors[0].message)).c_str());
                fitting.push_back(asked(view.item.id, entry.exampleStep));
                continue;
            }
            if (missing == "a symmetry" && system.hasCoordinates()) {
                QVERIFY(read.errors.empty());
                const auto own = std::find_if(read.warnings.begin(), read.warnings.end(),
                                              [](const Problem& p) { return p.pointer == "/views/0"; });
                QVERIFY(own != read.warnings.end());
                QCOMPARE(own->message, view.item.id + " stays empty: " + entry.item.id +
                                           " with these parameters has no symmetry");
                continue;
            }
            QCOMPARE(read.errors.size(), std::size_t(1));
            QCOMPARE(read.errors[0].pointer, std::string("/views/0"));
            QCOMPARE(read.errors[0].message,
                     view.item.id + " is not defined for " + entry.item.id + "; remove the view");
            const std::string& hint = read.errors[0].hint;
            QVERIFY2(hint.starts_with("it needs " + missing + "; " + entry.item.id + " has "), hint.c_str());
            QVERIFY2(hint.find("work-precision") != std::string::npos, hint.c_str());
        }
        const ReadScene all = exampleOf(entry, fitting, scheme, observe);
        QVERIFY(all.errors.empty());
        const Comparison comparison = run(all.scene);
        for (const View& view : plotViews(all.scene)) {
            const Figure figure = makeFigure(comparison, view, &system);
            // In so short a run a column may never pass zero.
            QVERIFY2(!isEmpty(figure) || view.id == "section", (view.id + ": " + figure.message).c_str());
        }
    }
    void whatTheModelLacksIsNamed() {
        const auto hint = [](const std::string& id) {
            const ReadScene read = kepler("[\"" + id + "\"]");
            return read.errors.size() == 1 ? read.errors[0].hint : "";
        };
        const std::string has =
            "; kepler has amplification, basis, curve-error, discrete-energy, discrete-lagrangian, energy, "
            "error, "
            "floquet, "
            "local-error, loop, lyapunov, "
            "megno, mesh, modified-energy, momentum, monitor, multiplier, parameter-map, phase, "
            "reversibility, ring, "
            "section, "
            "solvability, "
            "sparsity, "
            "stage, step, symplecticity, symplecticity-accumulated, trajectory, transported-error, volume "
            "and work-precision";
        QCOMPARE(hint("carpet"), "it needs a field or a wave function" + has);
        QCOMPARE(hint("norm"), "it needs a wave function or spins" + has);
        QCOMPARE(hint("polhode"), "it needs a rigid body" + has);
        QCOMPARE(hint("fast-energy"), "it needs a fast oscillation of its own" + has);
        QCOMPARE(hint("shape-function"), "it needs the elliptic problem" + has);
    }
    void presetsHaveOnlyViewsThatApply() {
        for (const Preset& preset : presets()) {
            const ReadScene read = readScene(preset.json);
            QVERIFY2(read.errors.empty(), std::string(preset.id).c_str());
        }
    }
    void defaultViewsAreThoseThatApply() {
        const auto ids = [](const char* preset) {
            Value document{Value::Object{}};
            const Value whole = toValue(readScene(findPreset(preset)->json).scene);
            for (const auto& [key, value] : whole.asObject())
                if (key != "views") document.set(key, value);
            const ReadScene read = readScene(document);
            std::string all;
            for (const View& view : read.scene.views) all += view.id + " ";
            return all;
        };
        QCOMPARE(ids("kepler"), std::string("stage energy momentum error trajectory phase "));
        QCOMPARE(ids("elliptic"), std::string("error trajectory phase "));
        QVERIFY(ids("tunnelling").find("phase") == std::string::npos);
        QVERIFY(ids("tunnelling").starts_with("stage "));
    }
    void columnsGivenByNameMakeAPhasePortraitOfAnything() {
        const Scene scene = readScene(findPreset("tunnelling")->json).scene;
        const auto errors = [&](const Value& view) {
            return readScene(toValue(scene),
                             {{"/observe", Value::Array{"position"}}, {"/views", Value::Array{view}}})
                .errors;
        };
        QVERIFY(errors(Value::Object{{"view", "phase"}, {"x", "t"}, {"y", "position"}}).empty());
        QCOMPARE(errors(Value::Object{{"view", "phase"}, {"y", "position"}}).size(), std::size_t(1));
        QCOMPARE(errors("phase").at(0).message,
                 std::string("phase is not defined for schrodinger; remove the view"));
    }
    void theEquationsOfASchemeNeedADiscretization() {
        const std::string
            rk4 = R"({"label": "RK4", "step": 0.1, "baseline": "rk4"})",
            gauss = R"({"label": "Gauss", "step": 0.1, "scheme": "galerkin-gauss-1"})",
            yoshida = R"({"label": "Y", "step": 0.1, "scheme": "midpoint", "composition": "yoshida"})";
        for (const char* id : {"sparsity", "discrete-lagrangian"}) {
            const std::string views = std::string("[\"") + id + "\"]";
            const ReadScene none = kepler(views, rk4 + "," + yoshida);
            QCOMPARE(none.errors.size(), std::size_t(1));
            QCOMPARE(none.errors[0].message,
                     id + std::string(" is not defined for any scheme of this scene; remove the view"));
            QCOMPARE(
                none.errors[0].hint,
                std::string("RK4 is a baseline, which no discrete action defines; Y is a composition, whose "
                            "step is several elements"));
            QVERIFY(kepler(views, rk4 + "," + gauss).errors.empty());
        }
        // The kind decides: bodies have both, and wave functions no two positions to join.
        for (const char* id : {"sparsity", "discrete-lagrangian"})
            QVERIFY(exampleOf(*findModel("rigid-body"), {Value(id)}, "lie-2", {}).errors.empty());
        const auto wave =
            exampleOf(*findModel("schrodinger"), {Value("discrete-lagrangian")}, "schrodinger-gauss-1", {})
                .errors;
        QCOMPARE(wave.size(), std::size_t(1));
        QVERIFY(wave[0].hint.find("linear in the velocity") != std::string::npos);
        const auto symmetric =
            exampleOf(*findModel("rigid-body"), {Value("sparsity")}, "lie-symmetric-2", {}).errors;
        QCOMPARE(symmetric.size(), std::size_t(1));
        QVERIFY(symmetric[0].hint.find("two half steps") != std::string::npos);
    }
    void theMultiplierBelongsToCoordinates() {
        for (const char* id : {"rigid-body", "schrodinger"}) {
            const ModelEntry& entry = *findModel(id);
            const System system = makeSystem(exampleOf(entry, {}, "midpoint", {}).scene);
            const ReadScene read = exampleOf(entry, {}, schemeFor(system), {Value("multiplier")});
            QCOMPARE(read.errors.size(), std::size_t(1));
            QCOMPARE(read.errors[0].pointer, std::string("/observe/0"));
            QCOMPARE(read.errors[0].message, "multiplier is not defined for " + std::string(id) +
                                                 ": it needs a Lagrangian in coordinates or a field");
            QVERIFY(read.errors[0].hint.find("energy") != std::string::npos);
        }
        QVERIFY(kepler("[]", R"({"step": 0.1, "scheme": "midpoint"})", R"(["multiplier"])").errors.empty());
    }
    /// A symmetry is lost with a parameter, and the scene goes on without its momentum.
    void aMomentumWithoutASymmetryIsAWarning() {
        for (const char* force : {"0", "0.3"}) {
            const ReadScene read = readScene(
                std::string(R"~({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x", "y"],
                "parameters": {"F": 0}, "lagrangian": "x_t^2/2 + y_t^2/2 - x^4 - F*sin(3*y + x)"},
                "initial": {"q": [1, 0], "v": [0, 1]}, "time": {"end": 1},
                "schemes": [{"label": "s", "scheme": "midpoint", "step": 0.1}],
                "observe": ["energy", "momentum"], "views": ["momentum", "energy"]})~"),
                {{"/model/parameters/F", parseJson(force)}});
            QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
            const bool isLost = std::string(force) != "0";
            QStringList pointers;
            for (const Problem& p : read.warnings) pointers << QString::fromStdString(p.pointer);
            QCOMPARE(pointers.contains("/observe/1") && pointers.contains("/views/0"), isLost);
            QCOMPARE(read.scene.observe.size(), std::size_t(2));
            const Comparison comparison = run(read.scene);
            const Trajectory& rows = comparison.schemes[0]->trajectory;
            QCOMPARE(rows.find("momentum_error") == nullptr, isLost);
            QVERIFY(rows.find("energy_error"));
            const Figure figure = makeFigure(comparison, read.scene.views[0], read.resolved->system.get());
            QCOMPARE(figure.message == "This model has no conserved momentum", isLost);
        }
    }
    void aViewOfWhatIsNotObservedIsAWarning() {
        const ReadScene read = kepler(R"(["momentum"])");
        QVERIFY(read.errors.empty());
        const auto own = std::find_if(read.warnings.begin(), read.warnings.end(),
                                      [](const Problem& p) { return p.pointer == "/views/0"; });
        QVERIFY(own != read.warnings.end());
        QCOMPARE(own->message, std::string("momentum stays empty: momentum is not observed"));
    }
};

EXTREMAL_TEST(ApplicabilityTest)
}  // namespace extremal::applicability_test

#include "applicability_test.moc"
