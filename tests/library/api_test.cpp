// SPDX-License-Identifier: GPL-3.0-or-later
/// The public interface: scenes, runs, figures, catalogues and studies.
#include <QDir>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "extremal/extremal.hpp"
#include "tests/tools/test.hpp"

namespace extremal::api_test {
namespace {

const char* const pendulum =
    R"({"extremal": 1, "title": "P", "model": {"type": "pendulum"}, "initial": {"q": [1]},
    "time": {"end": 5}, "observe": ["energy", "error"], "views": ["energy", "error", "phase"], "schemes": [
    {"label": "midpoint", "scheme": "midpoint", "step": 0.1}, {"label": "rk4", "baseline": "rk4", "step": 0.1}]})";

std::vector<Problem> problemsOf(const std::string& json) {
    try {
        (void)api::Scene::parse(json);
    } catch (const InvalidScene& e) {
        return e.problems();
    }
    return {};
}

}  // namespace

class ApiTest : public QObject {
    Q_OBJECT
private slots:
    void aSceneIsReadWithAllItsErrors() {
        const api::Scene scene = api::Scene::parse(pendulum, {{"/time/end=6", "/schemes/*/step=0.2"}});
        QCOMPARE(scene.title(), std::string("P"));
        QCOMPARE(scene.value().find("time")->find("end")->asNumber(), 6.0);
        QCOMPARE(api::Scene::parse(scene.json()).json(), scene.json());
        QCOMPARE(api::Scene::from(api::parseJson(pendulum)).json(), api::Scene::parse(pendulum).json());
        QCOMPARE(problemsOf(
                     R"({"extremal": 1, "model": {"type": "pendulum", "g": -1}, "time": {"end": 1, "ende": 2},
            "initial": {"q": [1]}, "schemes": []})")
                     .size(),
                 std::size_t{3});
        QVERIFY_EXCEPTION_THROWN(api::Scene::load("preset:keppler"), InvalidScene);
        QVERIFY(api::Scene::load("preset:kepler").warnings().empty());
        QVERIFY(std::string(api::version()).find('.') != std::string::npos);
    }

    void filesOutsideTheFolderNeedTrust() {
        QTemporaryDir folder;
        QVERIFY(QDir(folder.path()).mkdir("inner"));
        QFile file(folder.filePath("orbit.csv"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("t,q.theta,p.theta\n0,1,0\n5,0.5,-0.5\n");
        file.close();
        std::string json = pendulum;
        json.insert(json.size() - 1, R"(, "reference": {"type": "file", "path": "../orbit.csv"})");
        const std::string inner = folder.filePath("inner").toStdString();
        QVERIFY_EXCEPTION_THROWN(api::Scene::parse(json, {{}, inner}), InvalidScene);
        QCOMPARE(api::Scene::parse(json, {{}, inner, true}).title(), std::string("P"));
        QCOMPARE(
            api::Scene::parse(json, {{}, folder.filePath("inner/..").toStdString() + "/inner", true}).title(),
            std::string("P"));
    }

    void aRunGivesColumnsAndFiles() {
        const api::Comparison result = api::run(api::Scene::parse(pendulum), 1);
        QVERIFY(result.isFinished());
        QCOMPARE(result.size(), std::size_t{2});
        const api::SchemeResult rk4 = result["rk4"];
        QCOMPARE(rk4.status(), std::string("done"));
        QCOMPARE(rk4.cause(), std::string());
        QCOMPARE(rk4.rows(), std::size_t{51});
        QCOMPARE(rk4["t"].back(), 5.0);
        QCOMPARE(rk4.unit("q.theta"), std::string("rad"));
        QCOMPARE(rk4.summary().find("steps")->asNumber(), 50.0);
        QCOMPARE(result[1].label(), std::string("rk4"));
        // A span lives as long as a copy of its owner.
        const std::span<const double> energy = result["midpoint"]["energy_error"];
        QVERIFY(std::abs(*std::max_element(energy.begin(), energy.end())) < 1e-2);
        QVERIFY_EXCEPTION_THROWN(rk4["q.thta"], std::out_of_range);
        QVERIFY_EXCEPTION_THROWN(result["rk5"], std::out_of_range);
        QVERIFY_EXCEPTION_THROWN(result[2], std::out_of_range);
        QTemporaryDir folder;
        const auto files = result.write(folder.filePath("out").toStdString());
        QVERIFY(std::find(files.begin(), files.end(), "midpoint.csv") != files.end());
        QVERIFY(QFile::exists(folder.filePath("out/summary.json")));
        QVERIFY_EXCEPTION_THROWN(result.write("/dev/null/out"), std::runtime_error);
    }

    void fieldsHaveFrames() {
        const api::SchemeResult field = api::run(api::Scene::load("preset:breather", {{"/time/end=1"}}))[0];
        QCOMPARE(field.components(), (std::vector<std::string>{"u", "u_t"}));
        QVERIFY(field.frames() > 1);
        const api::Frame last = field.frame(field.frames() - 1);
        QCOMPARE(last.values.size(), 2 * last.x.size());
        QVERIFY(last.t > 0 && std::is_sorted(last.x.begin(), last.x.end()));
        QVERIFY_EXCEPTION_THROWN(field.frame(field.frames()), std::out_of_range);
        QVERIFY(api::run(api::Scene::parse(pendulum))[0].components().empty());
    }

    void progressCanStopARun() {
        const api::Scene slow =
            api::Scene::parse(pendulum, {{"/time/end=1e6", "/schemes/*/step=0.001", "/reference=none",
                                          "/observe=[\"energy\"]", "/views=[\"energy\"]"}});
        int calls = 0;
        const api::Comparison partial =
            api::run(slow, 0, [&](double fraction) { return fraction >= 0 && fraction < 1 && ++calls < 3; });
        QCOMPARE(calls, 3);
        QCOMPARE(partial[0].status(), std::string("partial"));
        QVERIFY(partial[0].rows() > 1);
        api::Run watched(slow);
        watched.start();
        while (watched.latest()[0].rows() < 2 && !watched.isFinished()) QTest::qSleep(1);
        QVERIFY(watched.fraction() < 1);
        watched.stop();
        watched.wait();
        QVERIFY(watched.isFinished());
    }

    void manyMotionsEndWhereEachOfThemDoes() {
        const api::Scene scene = api::Scene::load(
            "preset:kepler",
            {{"/schemes=[{\"label\":\"SV\",\"baseline\":\"stormer-verlet\",\"step\":0.02}]", "/time/end=5"}});
        std::vector<double> starts;
        for (int i = 0; i < 40; ++i)
            for (const double x : {0.4 + 0.01 * i, 0.0, 0.0, 2.0}) starts.push_back(x);
        const api::Motions many = api::runMany(scene, starts);
        QCOMPARE(many.columns, (std::vector<std::string>{"q.x", "q.y", "p.x", "p.y"}));
        QCOMPARE(many.together, std::size_t{40});
        for (const std::size_t i : {0, 17, 39}) {
            const api::Scene one = api::Scene::from(
                scene.value(), {{"/initial/q/0=" + std::to_string(0.4 + 0.01 * static_cast<double>(i))}});
            const api::Comparison run = api::run(one);
            const auto x = run[0]["q.x"];
            QVERIFY(std::abs(many.states[4 * i] - x.back()) < 1e-13);
            QVERIFY(many.causes[i].empty() && many.steps[i] == 250 && std::abs(many.t[i] - 5) < 1e-12);
        }
        int calls = 0;
        const api::Motions stopped = api::runMany(api::Scene::from(scene.value(), {{"/schemes/0/step=1e-7"}}),
                                                  starts, "SV", 2, [&](double) { return ++calls < 3; });
        QCOMPARE(stopped.causes[39], std::string("stopped"));
        QCOMPARE(stopped.states.size(), starts.size());
        QVERIFY_EXCEPTION_THROWN((void)api::runMany(scene, starts, "no such"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN((void)api::runMany(scene, std::span(starts).first(7)), InvalidScene);
        QVERIFY_EXCEPTION_THROWN((void)api::runMany(api::Scene::load("preset:membrane"), starts),
                                 InvalidScene);
    }

    void figuresAreDataAndPictures() {
        const api::Comparison result = api::run(api::Scene::parse(pendulum));
        const std::vector<api::Figure> all = api::figures(result);
        QCOMPARE(all.size(), std::size_t{3});
        const api::Figure energy = api::figure(result, "energy");
        QCOMPARE(energy.view(), std::string("energy"));
        QCOMPARE(energy.curves().size(), std::size_t{2});
        QCOMPARE(energy.curves()[1].label, std::string("rk4"));
        QCOMPARE(energy.curves()[1].x.size(), std::size_t{51});
        QVERIFY(energy.csv().starts_with("scheme,"));
        QXmlStreamReader xml(QByteArray::fromStdString(energy.svg(500, 300, true)));
        while (!xml.atEnd()) xml.readNext();
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        // A view that the rows are enough for need not be in the scene; others say what is missing.
        QCOMPARE(api::figure(result, "trajectory").view(), std::string("trajectory"));
        QVERIFY_EXCEPTION_THROWN(api::figure(result, "energie"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN(api::figure(result, "momentum"), InvalidScene);
        QVERIFY_EXCEPTION_THROWN(api::figure(result, "stage"), InvalidScene);
    }

    void catalogueAndPresetsAreThoseOfTheProgram() {
        for (const std::string& name : api::catalogueNames()) {
            const Value all = api::catalogue(name);
            QVERIFY2(!all.asArray().empty(), name.c_str());
            for (const Value& entry : all.asArray())
                QVERIFY2(!entry.find("title")->asString().empty(), name.c_str());
        }
        QCOMPARE(api::presets().size(), api::catalogue("presets").asArray().size());
        QVERIFY_EXCEPTION_THROWN(api::catalogue("model"), InvalidScene);
    }

    void studiesGiveTablesAndFigures() {
        api::StudyOptions options;
        options.steps = {0.05, 0.025, 0.0125};
        options.repeat = 0;
        api::Study study("convergence", api::Scene::parse(pendulum), options);
        QVERIFY(!study.isComplete());
        QVERIFY(study.run());
        QVERIFY(study.isComplete());
        const api::Table table = study.tables().front();
        QCOMPARE(table.name, std::string("convergence"));
        QCOMPARE(table.rows.size(), std::size_t{6});
        const auto order =
            std::find(table.columns.begin(), table.columns.end(), "order") - table.columns.begin();
        QVERIFY(std::abs(table.rows[0][static_cast<std::size_t>(order)].asNumber() - 2) < 0.1);
        QCOMPARE(study.figures().front().curves().size(), std::size_t{2});
        options.error = 1e-3;
        QVERIFY_EXCEPTION_THROWN(api::Study("convergence", api::Scene::parse(pendulum), options),
                                 InvalidScene);
        QVERIFY_EXCEPTION_THROWN(api::Study("converge", api::Scene::parse(pendulum)), InvalidScene);
        QVERIFY_EXCEPTION_THROWN(api::Study("extremes", api::Scene::parse(pendulum)), InvalidScene);
    }
};

EXTREMAL_TEST(ApiTest)
}  // namespace extremal::api_test

#include "api_test.moc"
