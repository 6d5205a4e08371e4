// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of wave functions: their pictures, their files, and what they say when the grid is too coarse.
#include <QDir>
#include <QFile>
#include <QTest>

#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::field_test {

namespace {

Scene scene(int modes, double waveNumber,
            const char* schemes = R"([{"scheme":"schrodinger-gauss-4","step":0.01}])") {
    const std::string text =
        R"~({"extremal":1,"model":{"type":"schrodinger","potential":"1 - cos(x)","hbar":0.05,"modes":)~" +
        std::to_string(modes) +
        R"(},"initial":{"psi":{"packet":"periodic-gaussian","kappa":20,"centre":1,"wave_number":)" +
        std::to_string(waveNumber) + R"(}},"time":{"end":0.5},"schemes":)" + schemes +
        R"(,"observe":["norm","error"]})";
    const ReadScene read = readScene(std::string_view(text));
    if (!read.errors.empty()) qWarning("%s", read.errors[0].message.c_str());
    return read.scene;
}

}  // namespace

class FieldTest : public QObject {
    Q_OBJECT
private slots:
    void picturesAreThoseOfTheRows() {
        const Comparison result = run(scene(128, 10));
        const SchemeResult& s = *result.schemes.at(0);
        QCOMPARE(s.products.find<FieldFrames>()->all.size(), s.trajectory.rows());
        QCOMPARE(s.products.find<FieldFrames>()->all.back().t, s.trajectory["t"].back());
        QCOMPARE(s.products.find<FieldFrames>()->all[0].values->size(), std::size_t{256});
        QVERIFY(s.summary.caution.empty());
        QVERIFY(s.summary.about.find("banded") != std::string::npos);
        QVERIFY(s.summary.maxNormError < 1e-13);
        QVERIFY(s.summary.maxError < 1e-6);
    }
    void filesHoldTheWaveFunction() {
        const Comparison result = run(scene(64, 5));
        const QString folder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/field");
        QDir(folder).removeRecursively();
        const auto files = exportComparison(result, folder.toStdString());
        QVERIFY(std::find(files.begin(), files.end(), "schrodinger-gauss-4.field.csv") != files.end());
        QFile file(folder + "/schrodinger-gauss-4.field.csv");
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QList<QByteArray> lines = file.readAll().split('\n');
        QCOMPARE(lines[0], QByteArray("t,x,re,im"));
        QCOMPARE(lines.size(), static_cast<qsizetype>(
                                   2 + 64 * result.schemes[0]->products.find<FieldFrames>()->all.size()));
        double norm = 0;
        for (int j = 1; j <= 64; ++j) {
            const auto cells = lines[j].split(',');
            norm += cells[2].toDouble() * cells[2].toDouble() + cells[3].toDouble() * cells[3].toDouble();
        }
        QVERIFY(std::abs(norm * 2 * 3.14159265358979323846 / 64 - 1) < 1e-12);
    }
    void filesOfARectangleHaveBothPlaces() {
        const ReadScene read = readScene(
            std::string_view(R"~({"extremal":1,"model":{"type":"schrodinger-2d","modes":64,"modes_y":32,
            "domain_y":[0,3]},"initial":{"psi":{"packet":"gaussian","centre":2,"width":0.3,"width_y":0.2}},"time":{"end":1},
            "schemes":[{"baseline":"strang","step":0.001}],"observe":["norm","position","momentum"]})~"));
        QVERIFY(read.errors.empty());
        const Comparison result = run(read.scene);
        const SchemeResult& s = *result.schemes.at(0);
        QVERIFY(s.trajectory.find("position_y") && s.trajectory.find("momentum_y"));
        QVERIFY(std::abs(s.trajectory["position_y"].front() - 1.5) < 1e-12);
        QVERIFY(std::abs(s.trajectory["position"].front() - 2) < 1e-8);
        const QString folder = QStringLiteral(EXTREMAL_TEST_OUTPUT "/rectangle");
        QDir(folder).removeRecursively();
        (void)exportComparison(result, folder.toStdString());
        QFile file(folder + "/strang.field.csv");
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QList<QByteArray> lines = file.readAll().split('\n');
        QCOMPARE(lines[0], QByteArray("t,x,y,re,im"));
        // Half a million rows at most, whole pictures, the last one among them.
        constexpr int places = 64 * 32;
        const auto rows = static_cast<int>(lines.size()) - 2;
        QCOMPARE(rows % places, 0);
        QVERIFY(s.products.find<FieldFrames>()->all.size() * places > 1 << 19);
        QVERIFY(rows > 1 << 18 && rows <= (1 << 19) + places);
        QCOMPARE(lines[rows].split(',')[0].toDouble(), 1.0);
        double norm = 0;
        for (int j = 1; j <= places; ++j) {
            const auto cells = lines[j].split(',');
            norm += cells[3].toDouble() * cells[3].toDouble() + cells[4].toDouble() * cells[4].toDouble();
        }
        QVERIFY(std::abs(norm * 2 * 3.14159265358979323846 * 3 / places - 1) < 1e-12);
        QCOMPARE(lines[65].split(',')[2].toDouble(), 3.0 / 32);
    }
    void aGridTooCoarseIsSaid() {
        const Comparison result = run(scene(32, 10));
        const std::string& caution = result.schemes.at(0)->summary.caution;
        qInfo("%s", caution.c_str());
        QVERIFY(caution.find("under-resolved") == 0);
        const Comparison fine = run(scene(256, 10));
        QVERIFY(fine.schemes.at(0)->summary.caution.empty());
        // Schemes that are right about the wrong problem agree with its exact solution all the same.
        QVERIFY(result.schemes.at(0)->summary.maxError < 1e-5);
    }
    void schemesGiveTheSameBytesWithAnyThreads() {
        const char* schemes =
            R"([{"scheme":"schrodinger-gauss-4","step":0.01},{"baseline":"strang","step":0.01},
                                  {"scheme":"schrodinger-gauss-2","step":0.01,"solver":{"method":"krylov"}}])";
        const Comparison one = run(scene(64, 5, schemes), {1}), two = run(scene(64, 5, schemes), {2});
        for (std::size_t i = 0; i < one.schemes.size(); ++i) {
            QCOMPARE(csvText(one.schemes[i]->trajectory), csvText(two.schemes[i]->trajectory));
            for (std::size_t k = 0; k < one.schemes[i]->products.find<FieldFrames>()->all.size(); ++k)
                QCOMPARE(*one.schemes[i]->products.find<FieldFrames>()->all[k].values,
                         *two.schemes[i]->products.find<FieldFrames>()->all[k].values);
        }
    }
};

EXTREMAL_TEST(FieldTest)
}  // namespace extremal::field_test

#include "field_test.moc"
