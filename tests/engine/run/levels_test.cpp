// SPDX-License-Identifier: GPL-3.0-or-later
/// Energy levels in the files of a run.
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/core/text/text.hpp"
#include "engine/figure/figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::levels_test {
namespace {

Comparison resultOf(const std::string& views, const std::string& potential) {
    const ReadScene read = readScene(
        R"~({"extremal": 1, "model": {"type": "schrodinger", "potential": ")~" + potential +
        R"~(", "domain": [-10, 10], "modes": 64}, "initial": {"psi": {"packet": "gaussian", "centre": 0, "width": 1}},
        "time": {"end": 0.2}, "schemes": [{"label": "s", "scheme": "schrodinger-gauss-2", "step": 0.1}],
        "observe": [], "views": [)~" +
        views + "]}");
    if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
    return run(read.scene);
}

}  // namespace

class LevelsTest : public QObject {
    Q_OBJECT
private slots:
    void theFilesHaveTheLevelsThatAreDrawn() {
        const Comparison result = resultOf("\"levels\"", "x^2/2");
        const Value summary = summaryValue(result);
        const Value::Array& levels = summary.find("schemes")->asArray()[0].find("levels")->asArray();
        QVERIFY(levels.size() >= 8);
        for (std::size_t k = 0; k < 8; ++k)  // measured: 4e-14
            QVERIFY(std::abs(levels[k].asNumber() - (static_cast<double>(k) + 0.5)) < 1e-12);
        QVERIFY(writeCompactJson(*summary.find("files")).find("s.levels.csv") != std::string::npos);
        const Figure figure = makeFigure(result, result.scene.views[0], result.system.get());
        QCOMPARE(figure.series().size(), levels.size() + 1);  // and the potential
        QTemporaryDir folder;
        const auto path = std::filesystem::path(folder.path().toStdString());
        exportComparison(result, path);
        std::ifstream file(path / "s.levels.csv");
        std::stringstream text;
        text << file.rdbuf();
        QVERIFY(text.str().starts_with("level,energy\n0," + formatNumber(levels[0].asNumber()) + "\n1,"));
        QCOMPARE(static_cast<std::size_t>(std::ranges::count(text.str(), '\n')), levels.size() + 1);
    }
    void whereNoneAreDrawnThereIsNoFile() {
        const Value summary = summaryValue(resultOf("\"stage\"", "x^2/2"));
        QVERIFY(!summary.find("schemes")->asArray()[0].find("levels"));
        QVERIFY(writeCompactJson(*summary.find("files")).find("levels") == std::string::npos);
    }
    /// Between walls one step of the series may take minutes: predicted from its products with H.
    void aLongChebyshevSeriesIsAnnounced() {
        const auto durations = [](int modes, double step) {
            const ReadScene read = readScene(
                R"~({"extremal": 1, "model": {"type": "schrodinger", "domain": [0, "pi"], "boundary": "dirichlet",
                "modes": )~" +
                std::to_string(modes) +
                R"~(}, "initial": {"psi": {"packet": "gaussian", "centre": 1, "width": 0.2}}, "time": {"end": 12},
                "schemes": [{"label": "s", "baseline": "chebyshev-propagation", "step": )~" +
                formatNumber(step) + R"~(}], "observe": [], "views": ["stage"]})~");
            if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
            return std::ranges::count_if(read.warnings, [](const Problem& p) {
                return p.topic == "duration" &&
                       p.message.find("products with H for each step") != std::string::npos;
            });
        };
        QCOMPARE(durations(160, 0.1), 1);
        QCOMPARE(durations(160, 0.01), 1);  // as much work in more steps
        QCOMPARE(durations(24, 0.1), 0);
    }
};

EXTREMAL_TEST(LevelsTest)

}  // namespace extremal::levels_test

#include "levels_test.moc"
