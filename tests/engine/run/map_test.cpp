// SPDX-License-Identifier: GPL-3.0-or-later
/// Maps of a parameter against the step: cells are plain runs, and what they show of the stiff spring is what
/// is known.
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stop_token>

#include "engine/run/cases/map_run.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::map_test {
namespace {

const std::string stiffSchemes = R"({"label":"SV","step":0.05,"baseline":"stormer-verlet"},
    {"label":"midpoint","step":0.05,"scheme":"midpoint"},{"label":"R1","step":0.05,"scheme":"multiscale-r1"},
    {"label":"R2","step":0.05,"scheme":"multiscale-r2"})";

std::string stiffScene(const std::string& view, const std::string& schemes = stiffSchemes) {
    return R"x({"extremal":1,"model":{"type":"spring-pendulum","k":1e4},"initial":{"q":["0.05*sqrt(1e4/k)",1],"p":[0,0]},
        "time":{"end":4},"schemes":[)x" +
           schemes + R"(],
        "reference":{"type":"scheme","scheme":{"label":"R3","step":0.1,"scheme":"multiscale-r3"}},
        "observe":["energy","error"],"views":[)" +
           view + "]}";
}

ReadScene readStiff(const std::string& view, const std::string& schemes = stiffSchemes) {
    return readScene(stiffScene(view, schemes));
}

Comparison runStiff(const std::string& view, unsigned threads = 0,
                    const std::string& schemes = stiffSchemes) {
    const ReadScene read = readStiff(view, schemes);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return run(read.scene, {threads});
}

const ParameterMap& mapOf(const Comparison& c, const std::string& scheme) {
    for (const auto& map : c.products.find<ParameterMaps>()->all)
        if (map->scheme == scheme) return *map;
    throw std::runtime_error("no map of " + scheme);
}

std::string fileOf(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

}  // namespace

class MapTest : public QObject {
    Q_OBJECT
private slots:
    /// Also in the parameter's own terms: the amplitude of the spring is an expression in k.
    void cellsArePlainRuns() {
        const Comparison c = runStiff(
            R"({"view":"parameter-map","from":1e4,"to":1e8,"steps":[0.01,0.16],"cells":[3,3],"duration":2})");
        int compared = 0;
        const MapGrid& grid = mapOf(c, "R1").grid;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const ReadScene single =
                    readScene(stiffScene("\"energy\""), {{"/model/k", grid.values[i]},
                                                         {"/schemes/*/step", grid.steps[j]},
                                                         {"/time/end", 2.0},
                                                         {"/observe", Value::Array{"energy"}}});
                QVERIFY(single.errors.empty());
                for (const auto& scheme : run(single.scene).schemes) {
                    const MapCell& cell = mapOf(c, scheme->spec.label).at(i, j);
                    const bool isDone = scheme->summary.status == RunStatus::done;
                    // A state that has blown up may go on for a while: SV at k = 10^4 and h = 0.16 fails
                    // later.
                    if (cell.end == MapCell::End::blownUp) continue;
                    QCOMPARE(cell.isDone(), isDone);
                    if (isDone) QVERIFY(cell.value == scheme->summary.maxEnergyError);
                    if (!isDone) QCOMPARE(cell.cause, scheme->summary.cause);
                    ++compared;
                }
            }
        QVERIFY(compared >= 27);
    }
    /// w = sqrt(k/m): 100, 1000, 10^4. Explicit schemes end at h w = 2, the implicit one does not.
    void verletBlowsUpRightOfItsLimit() {
        const Comparison c = runStiff(
            R"({"view":"parameter-map","from":100,"to":1e8,"steps":[0.001,0.1],"cells":[13,9],"duration":2})");
        const ParameterMap &verlet = mapOf(c, "SV"), &midpoint = mapOf(c, "midpoint");
        int stable = 0, unstable = 0;
        for (std::size_t i = 0; i < verlet.grid.values.size(); ++i)
            for (std::size_t j = 0; j < verlet.grid.steps.size(); ++j) {
                const double product = verlet.grid.steps[j] * std::sqrt(verlet.grid.values[i]);
                if (product < 1.8) {
                    ++stable;
                    QCOMPARE(verlet.at(i, j).end, MapCell::End::done);
                } else if (product > 2.2) {
                    ++unstable;
                    QCOMPARE(verlet.at(i, j).end, MapCell::End::blownUp);
                }
                QVERIFY(midpoint.at(i, j).end != MapCell::End::blownUp);
                // Measured: at most 0.75 J where it is computed, of 12.5 J in the spring.
                if (midpoint.at(i, j).isDone())
                    QVERIFY2(midpoint.at(i, j).value < 2, std::to_string(midpoint.at(i, j).value).c_str());
            }
        QVERIFY(stable > 20 && unstable > 50);
    }
    void errorsWithoutAReferenceStayUnknown() {
        const ReadScene read = readScene(
            stiffScene(
                R"({"view":"parameter-map","from":1e8,"to":1e9,"steps":[0.1,0.2],"cells":[2,2],"duration":2,"value":"error.p"})"),
            {{"/reference", "none"}});
        QVERIFY(read.errors.empty());
        const MapCell cell = mapOf(run(read.scene), "R1").at(0, 0);
        QVERIFY(cell.isDone() && std::isnan(cell.value));
    }
    /// The momenta, of size 5 whatever k is: an implicit scheme is stable and wrong, the multiscale ones are
    /// right.
    void errorsTellWhatEnergiesDoNot() {
        const Comparison c = runStiff(
            R"({"view":"parameter-map","from":1e8,"to":1e9,"steps":[0.1,0.2],"cells":[2,2],"duration":2,"value":"error.p"})");
        const auto value = [&](const char* label) { return mapOf(c, label).at(0, 1).value; };
        qInfo("midpoint %g, R1 %g, R2 %g", value("midpoint"), value("R1"), value("R2"));
        QVERIFY(value("midpoint") > 1);
        QVERIFY(value("R1") < 1e-4);
        QVERIFY(value("R2") < 1e-9);

        // The same by a plain run: h = 0.2 is twice the step of the reference, whose nodes are then those of
        // the run.
        const ReadScene plain = readScene(stiffScene("\"energy\""),
                                          {{"/model/k", 1e8}, {"/schemes/*/step", 0.2}, {"/time/end", 2}});
        for (const auto& scheme : run(plain.scene).schemes) {
            double largest = 0;
            for (const double e : scheme->trajectory["error.p"]) largest = std::max(largest, std::abs(e));
            if (!mapOf(c, scheme->spec.label).at(0, 1).isDone()) continue;  // SV has blown up
            qInfo("%s: %g, plain %g", scheme->spec.label.c_str(), value(scheme->spec.label.c_str()), largest);
            // Times that differ by round-off, 4e-16, are 2e-11 of a momentum of 5 that turns with 10^4.
            QVERIFY(std::abs(value(scheme->spec.label.c_str()) - largest) <= 3e-11);
        }
    }
    /// Multiscale R1 along h at k = 1e8: single steps stand out of their neighbours by orders of magnitude.
    void resonancesAreSeen() {
        const Comparison c = runStiff(
            R"({"view":"parameter-map","from":1e8,"to":1.001e8,"steps":[0.05,0.0504],"cells":[2,121],"duration":1})",
            0, R"({"label":"R1","step":0.05,"scheme":"multiscale-r1"})");
        const ParameterMap& map = mapOf(c, "R1");
        std::vector<double> all;
        for (std::size_t j = 0; j < 121; ++j)
            all.push_back(map.at(0, j).isDone() ? map.at(0, j).value : 1e300);
        std::sort(all.begin(), all.end());
        qInfo("median %g, largest %g", all[60], all.back());
        QVERIFY(all[60] < 1e-7);
        QVERIFY(all.back() > 1e3 * all[60]);
    }
    void threadsChangeNothing() {
        // Steps of their own: nothing is remembered from other tests, nor of one run for the other.
        const std::string view =
            R"({"view":"parameter-map","from":1e4,"to":1e6,"steps":[0.0211,0.16],"cells":[4,3],"duration":1})";
        const std::string other =
            R"({"view":"parameter-map","from":1e4,"to":1e6,"steps":[0.0211,0.16],"cells":[4,3],"duration":1,"value":"energy"})";
        const Comparison one = runStiff(view, 1), two = runStiff(view + "," + other, 2);
        for (const auto& map : one.products.find<ParameterMaps>()->all)
            for (std::size_t i = 0; i < map->cells.size(); ++i) {
                QCOMPARE(map->cells[i].end, mapOf(two, map->scheme).cells[i].end);
                if (map->cells[i].isDone())
                    QCOMPARE(map->cells[i].value, mapOf(two, map->scheme).cells[i].value);
            }
        QCOMPARE(two.products.find<ParameterMaps>()->all.size(), std::size_t(8));
    }
    void whatWasComputedIsRemembered() {
        const std::string view =
            R"({"view":"parameter-map","from":1e4,"to":1e6,"steps":[0.0203,0.16],"cells":[12,12],"duration":4})";
        QCOMPARE(runStiff(view).products.find<ParameterMaps>()->all.size(), std::size_t(4));
        // Another title, another step of the scene itself, one scheme less: the same cells.
        const ReadScene changed =
            readScene(stiffScene(view),
                      {{"/title", "other"}, {"/schemes/1/step", 0.02}, {"/schemes/0/enabled", false}});
        // A run that is stopped before it starts computes nothing, but has what is remembered.
        std::stop_source stopped;
        stopped.request_stop();
        const auto fractionOf = [&](const Scene& scene) {
            MapRun map(scene);
            for (std::size_t task = 0; task < map.tasks(); ++task) map.run(task, stopped.get_token());
            return map.fraction();
        };
        QCOMPARE(fractionOf(changed.scene), 1.0);
        const ReadScene other = readScene(stiffScene(view), {{"/model/m", 1.01}});
        QCOMPARE(fractionOf(other.scene), 0.0);
    }
    void stoppingKeepsWhatIsDone() {
        const ReadScene read = readStiff(
            R"({"view":"parameter-map","from":1e3,"to":1e9,"steps":[0.0041,0.5],"cells":[60,30],"value":"error.p"})");
        QVERIFY(read.errors.empty());
        Run r(read.scene, {1});
        r.start();
        const auto doneCells = [&] {
            std::ptrdiff_t n = 0;
            const Comparison latest = r.latest();
            for (const auto& map : latest.products.find<ParameterMaps>()->all)
                n += std::count_if(map->cells.begin(), map->cells.end(),
                                   [](const MapCell& c) { return c.end != MapCell::End::waiting; });
            return n;
        };
        QTRY_VERIFY_WITH_TIMEOUT(doneCells() > 0, 60000);
        r.stop();
        r.wait();
        QVERIFY(doneCells() > 0 && doneCells() < 4 * 60 * 30);
        QVERIFY(r.fraction() > 0 && r.fraction() < 1);
        QVERIFY(r.isFinished());
    }
    void whatIsLeftOutFollowsFromTheScene() {
        const ReadScene read = readStiff("\"parameter-map\"");
        QVERIFY(read.errors.empty());
        const Settings& keys = read.scene.views.at(0).keys;
        QCOMPARE(keys.text("parameter"), std::string("k"));
        QCOMPARE(keys.number("from"), 10.0);
        QCOMPARE(keys.number("to"), 1e7);
        QCOMPARE(keys.numbers("steps"), (std::vector<double>{0.005, 0.5}));
        QCOMPARE(keys.number("duration"), 4.0);
        const std::string text = writeScene(read.scene);
        QCOMPARE(writeScene(readScene(text).scene), text);
    }
    void gridsCanBeWrittenDown() {
        const ReadScene read =
            readStiff(R"({"view":"parameter-map","from":100,"to":1e10,"steps":[0.02,1],"cells":[25,18]})");
        const MapGrid grid = mapGridOf(read.scene, read.scene.views.at(0));
        QCOMPARE(grid.pointer, std::string("/model/k"));
        QCOMPARE(grid.values.front(), 100.0);
        QCOMPARE(grid.values.back(), 1e10);
        QCOMPARE(grid.values[1], 215.4);
        QCOMPARE(grid.steps.size(), std::size_t(18));
    }
    void wrongMapsAreErrors_data() {
        QTest::addColumn<QString>("keys");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("message");
        QTest::newRow("parameter") << R"("parameter":"kk")"
                                   << "/views/0/parameter"
                                   << "unknown parameter";
        QTest::newRow("reversed") << R"("from":1e6,"to":1e3)"
                                  << "/views/0/to"
                                  << "above \"from\"";
        QTest::newRow("from") << R"("from":-1)"
                              << "/views/0/from"
                              << "must be a positive";
        QTest::newRow("steps reversed") << R"("steps":[0.2,0.1])"
                                        << "/views/0/steps"
                                        << "smallest step and a larger one";
        QTest::newRow("steps of zero") << R"("steps":[0,0.1])"
                                       << "/views/0/steps/0"
                                       << "must be a positive";
        QTest::newRow("too many cells") << R"("cells":[200,200])"
                                        << "/views/0/cells"
                                        << "40000 cells, the limit is 10000";
        QTest::newRow("half a cell") << R"("cells":[2.5,20])"
                                     << "/views/0/cells/0"
                                     << "must be an integer";
        QTest::newRow("one cell") << R"("cells":[1,20])"
                                  << "/views/0/cells/0"
                                  << "2";
        QTest::newRow("short cases") << R"("duration":0.1)"
                                     << "/views/0/steps"
                                     << "longer than the run";
        QTest::newRow("too many steps") << R"("steps":[1e-9,0.1])"
                                        << "/views/0/steps"
                                        << "the limit is";
        QTest::newRow("column") << R"("value":"energi_error")"
                                << "/views/0/value"
                                << "unknown column";
        QTest::newRow("key") << R"("colour":1)"
                             << "/views/0/colour"
                             << "unknown key";
    }
    void wrongMapsAreErrors() {
        QFETCH(QString, keys);
        QFETCH(QString, pointer);
        QFETCH(QString, message);
        const ReadScene read = readStiff(R"({"view":"parameter-map",)" + keys.toStdString() + "}");
        QCOMPARE(read.errors.size(), std::size_t(1));
        QCOMPARE(QString::fromStdString(read.errors[0].pointer), pointer);
        QVERIFY2(QString::fromStdString(read.errors[0].message).contains(message),
                 read.errors[0].message.c_str());
    }
    void parametersOfTypedModelsVary() {
        const ReadScene read =
            readScene(std::string(R"({"extremal":1,"model":{"type":"lagrangian","coordinates":["x"],
            "parameters":{"w":10},"lagrangian":"x_t^2/2-w^2*x^2/2"},"initial":{"q":[1],"p":[0]},"time":{"end":2},
            "schemes":[{"label":"SV","step":0.01,"scheme":"stormer-verlet-pair"}],"observe":["energy"],
            "views":[{"view":"parameter-map","parameter":"w","from":10,"to":1000,"steps":[0.01,0.1],"cells":[3,2]}]})"));
        for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
        const Comparison c = run(read.scene);
        const ParameterMap& map = mapOf(c, "SV");
        QCOMPARE(map.grid.pointer, std::string("/model/parameters/w"));
        QCOMPARE(map.at(0, 0).end, MapCell::End::done);
        QCOMPARE(map.at(2, 0).end, MapCell::End::blownUp);
    }
    void whatMakesNoSceneIsRefused() {
        // The amplitude is not a number where k is below 10.
        const ReadScene read =
            readScene(std::string(R"x({"extremal":1,"model":{"type":"harmonic-oscillator","k":100},
            "initial":{"q":["sqrt(k-10)"],"p":[0]},"time":{"end":1},"schemes":[{"label":"midpoint","step":0.01,"scheme":"midpoint"}],
            "observe":["energy"],"views":[{"view":"parameter-map","from":1,"to":100,"steps":[0.01,0.1],"cells":[3,2]}]})x"));
        QVERIFY(read.errors.empty());
        const Comparison c = run(read.scene);
        const ParameterMap& map = mapOf(c, "midpoint");
        QCOMPARE(map.at(0, 0).end, MapCell::End::refused);
        QVERIFY2(map.problems[0].starts_with("/initial/q"), map.problems[0].c_str());
        QVERIFY(map.at(2, 1).isDone() && map.problems[2].empty());
    }
    void exportsHaveARowForEachCell() {
        const std::string view =
            R"({"view":"parameter-map","from":1e4,"to":1e8,"steps":[0.01,0.16],"cells":[3,3],"duration":2})";
        const Comparison c = runStiff(view);
        QTemporaryDir folder;
        const auto files = exportComparison(c, folder.path().toStdString());
        QVERIFY(std::find(files.begin(), files.end(), "parameter-map.csv") != files.end());
        const std::string text = fileOf(folder.path().toStdString() + "/parameter-map.csv");
        QCOMPARE(std::count(text.begin(), text.end(), '\n'), std::ptrdiff_t(1 + 4 * 9));
        QVERIFY(text.starts_with("scheme,parameter,step,value,outcome\nSV,10000,0.01,"));
        QVERIFY(text.find("\nSV,1e+08,0.16,,blow-up\n") != std::string::npos ||
                text.find("\nSV,100000000,0.16,,blow-up\n") != std::string::npos);
    }
};

EXTREMAL_TEST(MapTest)
}  // namespace extremal::map_test

#include "map_test.moc"
