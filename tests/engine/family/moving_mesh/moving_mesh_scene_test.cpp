// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes with moving meshes: what is refused, what a run makes of them, and their pictures.
#include <QDir>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <string>

#include "engine/family/family.hpp"
#include "engine/figure/figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::moving_mesh_scene_test {
namespace {

constexpr const char* meeting = R"~({"profile": "kink-antikink", "v": 0.9})~";

std::string sceneText(const std::string& space, const std::string& boundary = "dirichlet",
                      const std::string& initial = meeting) {
    std::string text = R"~({"extremal": 1, "model": {"type": "field", "potential": "sine-gordon",
        "domain": [-15, 15], "boundary": "BOUNDARY", "cells": 32}, "initial": INITIAL,
        "time": {"start": -2, "end": 1}, "schemes": [{"label": "moving", "step": 0.05, "space": SPACE},
        {"label": "at rest", "step": 0.05, "scheme": "multisymplectic-1"}],
        "observe": ["energy", "translation-momentum", "mesh-residual", "multiplier", "h-min", "error"]})~";
    const auto put = [&](const std::string& name, const std::string& value) {
        text.replace(text.find(name), name.size(), value);
    };
    put("BOUNDARY", boundary);
    put("INITIAL", initial);
    put("SPACE", space);
    return text;
}

std::string firstError(const std::string& text) {
    const ReadScene read = readScene(std::string_view(text));
    return read.errors.empty() ? "" : read.errors[0].pointer + ": " + read.errors[0].message;
}

}  // namespace

class MovingMeshSceneTest : public QObject {
    Q_OBJECT
private slots:
    void whatCannotBeIsRefused_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("error");
        const auto row = [](const char* name, const std::string& text, const char* error) {
            QTest::newRow(name) << QString::fromStdString(text) << error;
        };
        row("sound", sceneText(R"~({"type": "moving-mesh", "nodes": 31, "alpha": 2})~"), "");
        row("periodic", sceneText("\"moving-mesh\"", "periodic", R"~({"profile": "breather"})~"),
            "need two ends");
        row("alpha", sceneText(R"~({"type": "moving-mesh", "alpha": -1})~"), "alpha is neither auto nor");
        row("alpha text", sceneText(R"~({"type": "moving-mesh", "alpha": "much"})~"),
            "alpha is neither auto nor");
        row("nodes", sceneText(R"~({"type": "moving-mesh", "nodes": 2})~"), "/schemes/0/space/nodes");
        const std::string kink = R"~({"profile": "kink", "v": 0.9})~";
        row("monitor",
            sceneText(R"~({"type": "moving-mesh", "nodes": 31, "monitor": "curvature"})~", "dirichlet", kink),
            "");
        row("nearly free",
            sceneText(R"~({"type": "moving-mesh", "nodes": 127, "monitor": "curvature"})~", "dirichlet",
                      kink),
            "leaves the nodes nearly free");
        row("nearly free, explicit",
            sceneText(
                R"~({"type": "moving-mesh", "nodes": 127, "monitor": "curvature", "method": "explicit"})~",
                "dirichlet", kink),
            "");
        row("times", sceneText(R"~({"type": "moving-mesh", "method": "explicit", "times": "energy"})~"),
            "the energy of a mesh that is prescribed is not constant");
        row("rule", sceneText(R"~("moving-mesh", "quadrature": "gauss")~"), "quadrature");
        row("method", sceneText(R"~({"type": "moving-mesh", "method": "magic"})~"),
            "/schemes/0/space/method");
        row("values",
            R"~({"extremal": 1, "model": {"type": "field", "boundary": "dirichlet", "cells": 2},
                "initial": {"values": {"u": [0, 1, 0]}}, "time": {"end": 1},
                "schemes": [{"step": 0.1, "space": "moving-mesh"}]})~",
            "/schemes/0/space");
    }
    void whatCannotBeIsRefused() {
        QFETCH(QString, text);
        QFETCH(QString, error);
        const std::string found = firstError(text.toStdString());
        if (error.isEmpty())
            QCOMPARE(found, std::string());
        else
            QVERIFY2(found.find(error.toStdString()) != std::string::npos, found.c_str());
    }
    void whatCannotBeFollowedIsSaidAtTheStart() {
        // A kink and an antikink: nothing holds the variation of u, which a monitor of u needs.
        const auto warnings = [](const std::string& space) {
            return readScene(std::string_view(sceneText(space))).warnings;
        };
        const auto found = warnings(R"~({"type": "moving-mesh", "nodes": 31})~");
        QCOMPARE(found.size(), std::size_t{1});
        QVERIFY(found[0].pointer == "/schemes/0/space");
        QVERIFY(found[0].message.find("explicitly") != std::string::npos);
        QVERIFY(warnings(R"~({"type": "moving-mesh", "nodes": 31, "fallback": false})~").empty());
        QVERIFY(warnings(R"~({"type": "moving-mesh", "nodes": 31, "method": "explicit"})~").empty());
    }
    void framesCarryTheirNodes() {
        const ReadScene read =
            readScene(std::string_view(sceneText(R"~({"type": "moving-mesh", "nodes": 31, "alpha": 1})~")));
        QVERIFY(read.errors.empty());
        const Comparison result = run(read.scene);
        const SchemeResult& moving = *result.schemes.at(0);
        QCOMPARE(moving.summary.status, RunStatus::done);
        // the fallback is in the record
        QVERIFY(moving.events.counts[static_cast<int>(StepEvent::meshFallback)] > 10);
        QVERIFY(!moving.events.marks.empty() && moving.events.marks[0].t < 0);
        const FieldFrames* frames = moving.products.find<FieldFrames>();
        QVERIFY(frames);
        const FieldSampling& field = moving.scheme->ownSystem->field;
        const auto first = field.nodesOf(*frames->all.front().values),
                   last = field.nodesOf(*frames->all.back().values);
        QCOMPARE(first.size(), std::size_t{33});
        QCOMPARE(first.front(), -15.0);
        QCOMPARE(last.back(), 15.0);
        QVERIFY(first[10] != last[10]);
        // all observables have numbers, and those that a scheme does not have are unknown
        for (const char* column :
             {"error", "error.function", "energy", "translation_momentum", "h_min", "mesh_residual"})
            QVERIFY2(std::isfinite(moving.trajectory[column].back()), column);
        QVERIFY(std::isnan(moving.trajectory["multiplier"][1]));  // explicit from the start
        const SchemeResult& atRest = *result.schemes.at(1);
        QVERIFY(!std::isfinite(atRest.trajectory["multiplier"].back()));
        QCOMPARE(atRest.trajectory["h_min"].back(), 30.0 / 32);
        QVERIFY(std::isfinite(atRest.trajectory["error.function"].back()));

        const QString folder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/moving");
        QDir(folder).removeRecursively();
        const auto files = exportComparison(result, folder.toStdString());
        QVERIFY(std::find(files.begin(), files.end(), "moving.mesh.csv") != files.end());
        QVERIFY(std::find(files.begin(), files.end(), "at-rest.mesh.csv") == files.end());
        QFile file(folder + "/moving.mesh.csv");
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QList<QByteArray> lines = file.readAll().split('\n');
        QCOMPARE(lines[0], QByteArray("t,node,x"));
        QCOMPARE(lines.size(), static_cast<qsizetype>(2 + 33 * frames->all.size()));
        QCOMPARE(lines[1], QByteArray("-2,0,-15"));
    }
    void methodsAreRowsOfTheDiscretizer() {
        const auto countIn = [](const std::string& text, bool isPossible) {
            const ChoiceGrid grid = choicesFor(makeSystem(readScene(std::string_view(text)).scene));
            return std::count_if(grid.cells.begin(), grid.cells.end(), [&](const ChoiceGrid::Cell& cell) {
                return cell.discretization.space.type == "moving-mesh" &&
                       describe(cell.discretization).refusal.empty() == isPossible;
            });
        };
        const std::string between = sceneText("\"moving-mesh\"");
        QCOMPARE(countIn(between, true), 4);  // under the midpoint rule in time
        QCOMPARE(countIn(between, false), 16);
        const std::string around = sceneText("\"tent\"", "periodic", R"~({"profile": "breather"})~");
        QCOMPARE(countIn(around, true) + countIn(around, false), 0);
    }
    void picturesShowTheNodes() {
        const ReadScene read =
            readScene(std::string_view(sceneText(R"~({"type": "moving-mesh", "nodes": 31, "alpha": 1})~")));
        const Comparison result = run(read.scene);
        const Figure carpet = makeFigure(result, {"carpet", "", ""});
        QVERIFY(carpet.heat());
        const Guide* paths = carpet.find<Guide>();
        QVERIFY(paths);
        QVERIFY(paths->x.size() == paths->y.size() && paths->x.size() > 33 * 10);
        View view{"mesh-map", "", ""};
        for (const char* show : {"map", "density", "field"}) {
            view.keys.keys = {{"show", show}};
            const Figure map = makeFigure(result, view);
            QCOMPARE(map.series().size(), std::size_t{3});  // at the start and at the end, and at rest
            QVERIFY(map.message.empty());
        }
    }
};

EXTREMAL_TEST(MovingMeshSceneTest)
}  // namespace extremal::moving_mesh_scene_test

#include "moving_mesh_scene_test.moc"
