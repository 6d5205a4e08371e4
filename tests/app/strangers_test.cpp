/// Scenes from strangers read nothing outside their own folder before the user agrees; what a run writes can
/// be taken anywhere.
#include <QDir>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::strangers_test {
namespace {

using tests::Answer;
using tests::contentOf;
using tests::runProgram;

void write(const QString& path, const QByteArray& text) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(text), text.size());
}

QByteArray sceneWith(const QByteArray& reference) {
    QByteArray text = R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]},
        "time": {"end": 1}, "schemes": [{"label": "reference", "scheme": "midpoint", "step": 0.1}],
        "reference": {"type": "file", "path": "PATH"}})";
    return text.replace("PATH", reference);
}

const QByteArray orbit = "t,q.theta,p.theta\n0,1,0\n1,0.5,-0.5\n";

}  // namespace

class StrangersTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        QVERIFY(QDir(folder_.path()).mkdir("scene"));
        write(at("outside.csv"), orbit);
        write(at("scene/inside.csv"), orbit);
        QVERIFY(QFile::link(at("outside.csv"), at("scene/link.csv")));
    }

    void filesOutsideTheFolderAreReadWithConsentOnly_data() {
        QTest::addColumn<QByteArray>("path");
        QTest::addColumn<bool>("isInside");
        QTest::newRow("beside the scene") << QByteArray("inside.csv") << true;
        QTest::newRow("beside the scene, absolute") << at("scene/inside.csv").toUtf8() << true;
        QTest::newRow("there and back") << QByteArray("../scene/inside.csv") << true;
        QTest::newRow("above") << QByteArray("../outside.csv") << false;
        QTest::newRow("absolute") << at("outside.csv").toUtf8() << false;
        QTest::newRow("by a link") << QByteArray("link.csv") << false;
    }
    void filesOutsideTheFolderAreReadWithConsentOnly() {
        QFETCH(QByteArray, path);
        QFETCH(bool, isInside);
        const QString scene = at("scene/scene.json");
        write(scene, sceneWith(path));
        for (const QStringList& verb : {QStringList{"check", scene}, {"run", scene, "--out", at("out")}}) {
            const Answer plain = runProgram(verb + QStringList{"--quiet"});
            QCOMPARE(plain.code, isInside ? 0 : 2);
            QCOMPARE(plain.err.contains("/reference/path: lies outside the folder of the scene"), !isInside);
            QCOMPARE(runProgram(verb + QStringList{"--quiet", "--trust"}).code, 0);
        }
        QCOMPARE(
            runProgram({"check", scene, "--quiet", "--set", "/reference/path=\"" + at("outside.csv") + "\""})
                .code,
            0);
    }

    void aRunTakesItsReferenceWithIt() {
        const QString scene = at("scene/scene.json");
        write(scene, sceneWith("inside.csv"));
        QCOMPARE(runProgram({"run", scene, "--quiet", "--out", at("first")}).code, 0);
        QCOMPARE(contentOf(at("first/reference.csv")), orbit);
        QVERIFY(contentOf(at("first/scene.json")).contains("\"path\": \"reference.csv\""));
        // In another place, without the first file, the same bytes; a scheme named so has another file.
        QVERIFY(QDir(folder_.path()).rename("first", "moved"));
        QVERIFY(QFile::remove(at("scene/inside.csv")));
        QCOMPARE(runProgram({"run", at("moved/scene.json"), "--quiet", "--out", at("second")}).code, 0);
        const QStringList files{"reference-2.csv", "reference.csv", "scene.json", "summary.csv",
                                "summary.json"};
        QCOMPARE(QDir(at("moved")).entryList(QDir::Files), files);
        QCOMPARE(QDir(at("second")).entryList(QDir::Files), files);
        for (const QString& name : files)
            if (!name.startsWith("summary"))
                QCOMPARE(contentOf(at("second/" + name)), contentOf(at("moved/" + name)));
        // Into its own folder again.
        QCOMPARE(runProgram({"run", at("second/scene.json"), "--quiet", "--out", at("second")}).code, 0);
        QCOMPARE(contentOf(at("second/reference.csv")), orbit);
    }

private:
    QString at(const QString& name) const { return folder_.filePath(name); }

    QTemporaryDir folder_;
};

EXTREMAL_TEST(StrangersTest)

}  // namespace extremal::strangers_test

#include "strangers_test.moc"
