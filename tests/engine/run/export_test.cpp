// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

#include "engine/run/files/export.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::export_test {
namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> filesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::shared_ptr<SchemeResult> result(const std::string& label, std::size_t rows) {
    auto r = std::make_shared<SchemeResult>();
    r->summary.label = label;
    r->summary.status = RunStatus::failed;
    r->summary.cause = Outcome::notFinite;
    r->summary.failedAt = 0.3;
    r->summary.tEnd = 0.2;
    r->summary.steps = 10000000000;
    r->summary.orderClaimed = 4;
    r->trajectory.columns = {{"t", "t", "", {}}, {"q.x", "x", "", {}}};
    for (std::size_t i = 0; i < rows; ++i) {
        r->trajectory.columns[0].values.push_back(0.1 * static_cast<double>(i));
        r->trajectory.columns[1].values.push_back(i == 1 ? std::nan("") : 1.0 / 3);
    }
    return r;
}

Comparison comparison(std::size_t rows = 3) {
    Comparison c;
    c.scene = readScene(findPreset("kepler")->json).scene;
    c.scene.title = "a \"title\"";
    c.schemes = {result("RK4, h = 0.1", rows), result("rk4 h 0.1", rows), result("Summary", rows)};
    return c;
}

}  // namespace

class ExportTest : public QObject {
    Q_OBJECT
private slots:
    void filesFollowTheContract() {
        QTemporaryDir temporary;
        const fs::path folder = fs::path(temporary.path().toStdString()) / "made" / "here";
        const auto names = exportComparison(comparison(), folder);
        QCOMPARE(names, (std::vector<std::string>{"scene.json", "rk4-h-0-1.csv", "rk4-h-0-1-2.csv",
                                                  "summary-2.csv", "summary.csv", "summary.json"}));
        QCOMPARE(contents(folder / "rk4-h-0-1.csv"),
                 std::string("t,q.x\n0,0.3333333333333333\n0.1,\n0.2,0.3333333333333333\n"));
        const std::string summary = contents(folder / "summary.csv");
        QCOMPARE(
            summary.substr(0, summary.find('\n')),
            std::string(
                "label,status,cause,failed_at,t_end,steps,rejected,newton_iterations,evaluations,"
                "linear_solves,cpu_seconds,max_energy_error,energy_drift_per_unit_time,max_momentum_error,"
                "max_norm_error,max_error,final_error,order_claimed,order_measured,error_bar_opens_at,max_"
                "constraint,impacts,floor,floor_of"));
        QVERIFY(summary.find(
                    "\n\"RK4, h = 0.1\",failed,not-finite,0.3,0.2,10000000000,0,0,0,0,0,,,,,,,4,,,,,,\n") !=
                std::string::npos);
        const Value document = parseJson(contents(folder / "summary.json"));
        QCOMPARE(document.find("title")->asString(), std::string("a \"title\""));
        QVERIFY(document.find("schemes")->asArray()[1].find("max_error")->isNull());
        QCOMPARE(document.find("files")->asArray().size(), names.size());
        QCOMPARE(contents(folder / "scene.json"), writeScene(comparison().scene));
        auto expected = names;
        std::sort(expected.begin(), expected.end());
        QCOMPARE(filesIn(folder), expected);
    }

    /// Each number of a summary has its own column.
    void numbersStandBelowTheirNames() {
        Comparison c = comparison();
        auto known = result("known", 3);
        Summary& s = known->summary;
        s.maxEnergyError = 1;
        s.energyDrift = 2;
        s.maxMomentumError = 3;
        s.maxNormError = 4;
        s.maxError = 5;
        s.finalError = 6;
        s.orderClaimed = 7;
        s.orderMeasured = 8;
        s.opensAt = 9;
        s.maxConstraint = 10;
        s.impacts = 11;
        s.floor = 12;
        s.floorOf = "reference";
        c.schemes = {known};
        QTemporaryDir temporary;
        const fs::path folder = temporary.path().toStdString();
        exportComparison(c, folder);
        const std::string table = contents(folder / "summary.csv");
        QVERIFY2(table.ends_with(",1,2,3,4,5,6,7,8,9,10,11,12,reference\n"), table.c_str());
    }

    void aFullDiskLeavesNoHalfFile() {
        QTemporaryDir temporary;
        const fs::path folder = temporary.path().toStdString();
        exportComparison(comparison(), folder);
        const std::string before = contents(folder / "rk4-h-0-1.csv");
        const auto namesBefore = filesIn(folder);
        // A limit on the size of files fails as a full disk does, in the middle of a write.
        rlimit previous{};
        getrlimit(RLIMIT_FSIZE, &previous);
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit small{20000, previous.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
        QString reason;
        try {
            exportComparison(comparison(20000), folder);
        } catch (const ExportError& e) {
            reason = QString::fromStdString(e.path.filename().string()) + ": " + e.what();
        }
        setrlimit(RLIMIT_FSIZE, &previous);
        QCOMPARE(reason, QString("rk4-h-0-1.csv: File too large"));
        QCOMPARE(filesIn(folder), namesBefore);
        QCOMPARE(contents(folder / "rk4-h-0-1.csv"), before);
    }

    void whatCannotBeAFolderIsNamed() {
        QTemporaryDir temporary;
        const fs::path file = fs::path(temporary.path().toStdString()) / "file";
        std::ofstream(file) << "x";
        QVERIFY_EXCEPTION_THROWN(prepareFolder(file), ExportError);
        QVERIFY_EXCEPTION_THROWN(prepareFolder(file / "below"), ExportError);
        QVERIFY_EXCEPTION_THROWN(prepareFolder("/proc/nowhere"), ExportError);
        QVERIFY_EXCEPTION_THROWN(writeFile("/proc/nowhere/a.csv", "x"), ExportError);
    }
};

EXTREMAL_TEST(ExportTest)
}  // namespace extremal::export_test

#include "export_test.moc"
