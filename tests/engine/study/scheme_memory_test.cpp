// SPDX-License-Identifier: GPL-3.0-or-later
/// What runs of schemes hold in memory, and searches within a limit of it.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/request.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/test.hpp"

namespace extremal::scheme_memory_test {
namespace {

/// A kink on so many cells; the first scheme is explicit, the second implicit.
ResolvedScene kinkOn(int cells) {
    Value document = parseJson(findPreset("sine-gordon-kink")->json);
    document.find("model")->set("cells", static_cast<double>(cells));
    document.find("time")->set("end", 50.0 / cells);
    Value::Array schemes;
    for (Value scheme : document.find("schemes")->asArray()) {
        scheme.set("step", 10.0 / cells);
        schemes.push_back(std::move(scheme));
    }
    document.set("schemes", Value(std::move(schemes)));
    return *readScene(document).resolved;
}

double bytesOf(const ResolvedScene& scene, std::size_t scheme) {
    const Metric metric = metricOf("energy", false, *scene.system, scene.initial);
    const StudyPoint point{scheme, scene.schemes[scheme].spec.step.value};
    return runPoint(scene, point, {&metric, 1}, {}, 0, {.bytes = 1e12}, {}).bytes;
}

}  // namespace

class SchemeMemoryTest : public QObject {
    Q_OBJECT

private slots:
    /// States of fields are two numbers a node; a banded matrix has some for each node, and no scheme holds a
    /// full one.
    void itGrowsWithTheMesh() {
        constexpr int few = 4000, many = 8000;
        const ResolvedScene small = kinkOn(few), large = kinkOn(many);
        for (const std::size_t scheme : {0U, 1U}) {
            const double a = bytesOf(small, scheme), b = bytesOf(large, scheme);
            qInfo("%s: %.0f and %.0f numbers a node", small.schemes[scheme].spec.label.c_str(), a / 8 / few,
                  b / 8 / many);
            QVERIFY(a >= 2.0 * 8 * few);
            QVERIFY2(b / a > 1.9 && b / a < 2.1, qPrintable(QString::number(b / a)));
            QVERIFY(b < 200.0 * 8 * many);
        }
        QVERIFY(bytesOf(small, 1) > 1.5 * bytesOf(small, 0));
        QVERIFY(std::abs(bytesOf(small, 1) / bytesOf(small, 1) - 1) < 0.01);
    }
    /// A wave function by its eigenstates holds its coefficients; the matrix belongs to all runs.
    void tablesThatAreSharedDoNotCount() {
        const ResolvedScene scene = *readScene(findPreset("coherent-state")->json).resolved;
        const double bytes = bytesOf(scene, 1);
        qInfo("%.0f bytes; the eigenstates alone have %d", bytes, 8 * 128 * 128);
        QVERIFY(bytes >= 16 * 128 && bytes < 8 * 128 * 128);
    }
    void searchesKeepWithinALimit() {
        const auto searched = [](double most) {
            SweepOptions options;
            options.repeat = 0;
            options.wantedError = 1e-2;
            options.knobs.isCells = false;
            options.mostBytes = most;
            options.only = {"trapezoid (leapfrog)", "Gauss 2", "degree 2"};
            Sweep sweep(*readScene(findPreset("sine-gordon-kink")->json).resolved, options);
            sweep.run({}, {}, {});
            return sweep;
        };
        const Sweep all = searched(1e9);
        std::vector<double> bytes;
        for (const SweepRow& row : all.rows()) {
            QVERIFY(row.result.bytes > 0);
            bytes.push_back(row.result.bytes);
            qInfo("%s: %.0f bytes", all.scene().schemes[row.point.scheme].spec.label.c_str(), bytes.back());
        }
        std::sort(bytes.begin(), bytes.end());
        QVERIFY(bytes.back() > 2 * bytes.front());
        const double most = std::sqrt(bytes.front() * bytes.back());
        const Sweep some = searched(most);
        int refused = 0, kept = 0;
        for (std::size_t i = 0; i < some.rows().size(); ++i) {
            const PointResult &r = some.rows()[i].result, &free = all.rows()[i].result;
            if (free.bytes > 1.02 * most) {
                QVERIFY2(!r.isDone() && r.reason.starts_with("refused: holds "), r.reason.c_str());
                ++refused;
            } else if (free.bytes < 0.98 * most) {
                QCOMPARE(r.isDone(), free.isDone());
                if (free.isDone()) QCOMPARE(r.steps, free.steps);
                ++kept;
            }
        }
        QVERIFY(refused > 0 && kept > 0);
        // The column is there where a limit is given, and nowhere else.
        const auto columnsOf = [](const Sweep& sweep) {
            return tablesOf(*findStudy("cheapest"), sweep).front().columns;
        };
        QCOMPARE(columnsOf(some).back(), std::string("bytes"));
        QVERIFY(columnsOf(searched(0)).back() != "bytes");
    }
    void sizesAreRead() {
        const ResolvedScene scene = *readScene(findPreset("kepler")->json).resolved;
        const auto bytesBy = [&](const char* text) {
            StudyRequest request;
            request.kind = "cheapest";
            request.error = 1e-4;
            request.memory = text;
            return std::get<Sweep>(makeStudy(*findStudy("cheapest"), request, &scene, 1)).options().mostBytes;
        };
        QCOMPARE(bytesBy("64kB"), 64e3);
        QCOMPARE(bytesBy("1.5MB"), 1.5e6);
        QCOMPARE(bytesBy("2GB"), 2e9);
        QCOMPARE(bytesBy("4096"), 4096.0);
        QCOMPARE(bytesBy("100B"), 100.0);
        for (const char* wrong : {"much", "-1MB", "0", "1TB ", "nan", "inf"})
            QVERIFY_EXCEPTION_THROWN(bytesBy(wrong), InvalidScene);
    }
};

EXTREMAL_TEST(SchemeMemoryTest)

}  // namespace extremal::scheme_memory_test

#include "scheme_memory_test.moc"
