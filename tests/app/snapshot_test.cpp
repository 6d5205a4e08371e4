// SPDX-License-Identifier: GPL-3.0-or-later
/// `extremal snapshot` run as a user runs it.
#include <QFile>
#include <QPainter>
#include <QTest>

#include <QImage>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::snapshot_test {

namespace {

using tests::Answer;

Answer snapshot(const QStringList& arguments,
                const QProcessEnvironment& environment = QProcessEnvironment::systemEnvironment()) {
    tests::Surroundings around;
    around.environment = environment;
    around.environment.remove("QT_QPA_PLATFORM");  // no display, and no help from outside
    around.environment.remove("DISPLAY");
    return tests::runProgram(QStringList{"snapshot"} + arguments, around);
}

}  // namespace

class SnapshotVerbTest : public QObject {
    Q_OBJECT

    QTemporaryDir dir_;
    QString path(const char* name) const { return dir_.filePath(name); }

private slots:
    void drawsEveryPresetsViewsWithoutADisplay() {
        for (const char* preset : {"spring-pendulum", "pendulum", "kepler", "harmonic-oscillator"}) {
            const Answer a = snapshot({QString("preset:") + preset, "--out", path("all.png")});
            QVERIFY2(a.code == 0 || a.code == 1,
                     qPrintable(a.err));  // 1: a scheme of the preset fails, as it should
            QCOMPARE(QImage(path("all.png")).size(), QSize(1200, 800));
        }
    }

    void twoRunsGiveTheSameBytes() {
        for (const char* kind : {"png", "pdf", "svg"}) {
            const QString a = path("a.") + kind, b = path("b.") + kind;
            QCOMPARE(snapshot({"preset:pendulum", "--size", "700x500", "--out", a}).code,
                     snapshot({"preset:pendulum", "--size", "700x500", "--threads", "1", "--out", b}).code);
            QVERIFY2(!tests::contentOf(a).isEmpty() && tests::contentOf(a) == tests::contentOf(b), kind);
        }
    }

    void saysInJsonWhatWasDrawn() {
        const Answer a = snapshot({"preset:kepler", "--view", "stage", "--time", "3.14", "--size", "320x200",
                                   "--json", "--out", path("k.png")});
        const QJsonObject json = QJsonDocument::fromJson(a.out.toUtf8()).object();
        QCOMPARE(json["file"].toString(), path("k.png"));
        QCOMPARE(json["width"].toInt(), 320);
        QCOMPARE(json["height"].toInt(), 200);
        QCOMPARE(json["view"].toString(), QString("stage"));
        QVERIFY(std::abs(json["time"].toDouble() - 3.14) <
                0.06);  // the nearest row: half the first scheme's step
    }

    void theTimeOfTheSceneIsThatOfItsPicture() {
        const auto pictureOf = [&](const QStringList& more) {
            const Answer a = snapshot(
                QStringList{"preset:kepler", "--size", "500x400", "--force", "--out", path("t.png")} + more);
            return a.code == 0 ? tests::contentOf(path("t.png")) : QByteArray();
        };
        const QByteArray asked = pictureOf({"--time", "7"}), shown = pictureOf({"--set", "/show/time=7"});
        QVERIFY(!asked.isEmpty() && asked == shown);
        QVERIFY(pictureOf({}) != shown);
        QCOMPARE(pictureOf({"--set", "/show/time=3", "--time", "7"}), asked);
    }

    void compareTellsEqualFromDifferent() {
        const QStringList common = {"preset:kepler", "--view", "stage", "--size", "400x300"};
        snapshot(common + QStringList{"--out", path("base.png")});
        const Answer same =
            snapshot(common + QStringList{"--out", path("new.png"), "--compare", path("base.png")});
        QCOMPARE(same.code, 0);
        const Answer other = snapshot(
            common + QStringList{"--out", path("new.png"), "--compare", path("base.png"), "--time", "3"});
        QCOMPARE(other.code, 1);
        // One mark of 6 x 6 pixels is 0.03 % of the picture, but is seen.
        QImage marked(path("base.png"));
        QPainter(&marked).fillRect(QRect(200, 20, 6, 6), Qt::red);
        marked.save(path("marked.png"));
        const QStringList withMark = {"--out", path("new.png"), "--compare", path("marked.png")};
        QCOMPARE(snapshot(common + withMark).code, 1);
        QCOMPARE(snapshot(common + withMark + QStringList{"--tolerance", "0.5"}).code, 0);
        QVERIFY(!QImage(path("new.png.diff.png")).isNull());
        QCOMPARE(snapshot(common + QStringList{"--out", path("new.png"), "--compare", path("base.png"),
                                               "--time", "3", "--tolerance", "50"})
                     .code,
                 0);
    }

    void unusableArgumentsAreNamedAndWriteNothing() {
        const auto check = [&](const QStringList& arguments, const char* word) {
            const Answer a = snapshot(QStringList{"preset:kepler"} + arguments);
            QCOMPARE(a.code, 2);
            QVERIFY2(a.err.contains(word), qPrintable(a.err));
            QVERIFY(a.err.startsWith("extremal: "));
        };
        check({"--out", path("x.gif")}, ".png");
        check({"--out", path("x.png"), "--size", "63x100"}, "64");
        check({"--out", path("x.png"), "--size", "100"}, "--size");
        check({"--out", path("x.png"), "--size", "100x9000"}, "8192");
        check({"--out", path("x.png"), "--view", "stge"}, "stage");
        check({"--out", path("x.png"), "--compare", path("missing.png")}, "missing.png");
        QVERIFY(!QFile::exists(path("x.png")));
    }

    void aPictureOfNothingIsExitTwo() {
        // In so short a run no column passes zero: all that could be drawn is a message.
        const Answer empty = snapshot({"preset:kepler", "--set", "/views=[\"section\"]", "--set",
                                       "/time/end=0.1", "--out", path("empty.png")});
        QCOMPARE(empty.code, 2);
        QVERIFY2(empty.err.contains("nothing of what was asked for can be drawn") &&
                     empty.err.contains("never passes zero upwards"),
                 qPrintable(empty.err));
        const Answer lacking = snapshot({"preset:kepler", "--view", "norm", "--out", path("empty.png")});
        QCOMPARE(lacking.code, 2);
        QVERIFY2(lacking.err.contains("norm is not defined for kepler"), qPrintable(lacking.err));
        const Answer silent = snapshot({"preset:kepler", "--set", "/views=[]", "--set", "/observe=[]",
                                        "--set", "/schemes/*/enabled=false", "--out", path("empty.png")});
        QCOMPARE(silent.code, 2);
        QVERIFY2(silent.err.contains("no scheme is switched on"), qPrintable(silent.err));
        QVERIFY(!QFile::exists(path("empty.png")));
    }

    void filesThatCannotBeWrittenAreExitThree() {
        const Answer a = snapshot({"preset:kepler", "--out", path("no/such/folder/x.png")});
        QCOMPARE(a.code, 3);
        QVERIFY(a.err.contains("folder"));
    }

    void aMissingOsmesaIsExitTwoNamingThePackage() {
        QTemporaryDir broken;
        for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}) {
            QFile f(broken.filePath(name));
            QVERIFY(f.open(QIODevice::WriteOnly) && f.write("not a library") > 0);
        }
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("LD_LIBRARY_PATH", broken.path());
        const Answer a = snapshot({"preset:kepler", "--out", path("stage.png")}, environment);
        QCOMPARE(a.code, 2);
        QVERIFY2(a.err.contains("libosmesa6"), qPrintable(a.err));
        QVERIFY(!QFile::exists(path("stage.png")));
        // What draws no stage still works.
        QCOMPARE(snapshot({"preset:kepler", "--view", "phase", "--out", path("phase.png")}, environment).code,
                 0);
    }
};

EXTREMAL_TEST(SnapshotVerbTest)
}  // namespace extremal::snapshot_test

#include "snapshot_test.moc"
