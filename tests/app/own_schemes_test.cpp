// SPDX-License-Identifier: GPL-3.0-or-later
/// Schemes of the user's catalogue and of exported files, on the command line.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::own_schemes_test {

using tests::Answer;

class OwnSchemesTest : public QObject {
    Q_OBJECT

    QTemporaryDir folder_;

    QString write(const char* name, const QByteArray& text) {
        QFile file(folder_.filePath(name));
        if (file.open(QIODevice::WriteOnly)) file.write(text);
        return file.fileName();
    }

private slots:
    void schemesAreAddedByNameOrFile() {
        const QByteArray scheme =
            R"~({"label": "fitted", "step": 0.1, "space": {"type": "typed", "functions": ["1", "tau", "cos(tau)", "sin(tau)"]}})~";
        const QByteArray catalogue = R"({"extremal-schemes": 1, "schemes": [)" + scheme + "]}";
        const QString file = write("fitted.json", catalogue), single = write("single.json", scheme);
        qputenv("EXTREMAL_SCHEMES", write("schemes.json", catalogue).toUtf8());
        for (const QString& added : {QString("fitted"), file, single}) {
            const Answer a = tests::runProgram({"run", "preset:harmonic-oscillator", "--add", added, "--set",
                                                "/time/end=2", "--json", "--out", folder_.filePath("out")});
            QVERIFY2(a.code == 0, qPrintable(a.err));
            QVERIFY(QFile::exists(folder_.filePath("out/fitted.csv")));
            QVERIFY(QFile::remove(folder_.filePath("out/fitted.csv")));
        }
        const auto problemOf = [](const QString& added) {
            const Answer a = tests::runProgram({"check", "preset:kepler", "--add", added});
            return a.code == 2 ? a.err : QString();
        };
        QVERIFY(problemOf("fited").contains("did you mean \"fitted\""));
        QVERIFY(problemOf("missing.json").contains("there is no file"));
        QVERIFY(problemOf(write("bad.json", R"({"extremal-schemes": 1, "schemes": [{"label": "x"}]})"))
                    .contains("/schemes/0"));
    }
};

EXTREMAL_TEST(OwnSchemesTest)

}  // namespace extremal::own_schemes_test

#include "own_schemes_test.moc"
