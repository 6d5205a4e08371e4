// SPDX-License-Identifier: GPL-3.0-or-later
/// `extremal figure` run as a user runs it, and the sheet of the window, which makes the same files.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHash>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/windows/figure_sheet.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::figure_test {

using tests::Answer;
using tests::contentOf;

class FigureVerbTest : public QObject {
    Q_OBJECT

    QTemporaryDir dir_;
    QString path(const QString& name) const { return dir_.filePath(name); }
    Answer figure(const QStringList& arguments) const {
        tests::Surroundings around;
        around.environment = QProcessEnvironment::systemEnvironment();
        around.environment.remove("QT_QPA_PLATFORM");
        around.environment.remove("DISPLAY");
        return tests::runProgram(QStringList{"figure"} + arguments, around);
    }

private slots:
    void theSheetMakesTheSameFiles() {
        QHashSeed::setDeterministicGlobalSeed();  // as the program does: it orders the fonts of a PDF
        loadFonts();
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(waitForResults(window));
        QVERIFY(window.workspace().saveAs(path("scene.json")));
        QVERIFY(waitForResults(window));
        window.actions().find("figureSheet")->trigger();
        auto* const sheet = window.findChild<FigureSheet*>();
        QVERIFY(sheet && sheet->isVisible());
        PaperStyle style;
        style.width = 178;
        style.letters = 9;
        style.colours = PaperColours::grey;
        style.legend = LegendPlace::right;
        style.portraits = Portraits::density;
        style.caption = "It's \"mine\" & 100 %";
        sheet->setStyle(style);
        QCOMPARE(sheet->style(), style);
        QDir(dir_.path()).mkdir("window");
        sheet->save(path("window/figure.pdf"));
        // The call that the sheet shows, as a shell reads it.
        QProcess shell;
        shell.setWorkingDirectory(dir_.path());
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("PATH", QFileInfo(EXTREMAL_BINARY).path() + ':' + environment.value("PATH"));
        shell.setProcessEnvironment(environment);
        shell.start("sh", {"-c", sheet->command()});
        QVERIFY(shell.waitForFinished(120000));
        QVERIFY2(shell.exitCode() <= 1, shell.readAllStandardError().constData());
        for (const char* name : {"figure.pdf", "figure.csv", "figure.tex"}) {
            QVERIFY2(contentOf(path(name)).size() > 100, name);
            QVERIFY2(contentOf(path(name)) == contentOf(path(QString("window/") + name)), name);
        }
        QVERIFY(contentOf(path("figure.tex")).contains("It's \"mine\" \\& 100 \\%"));
    }

    void thePreviewFollowsEveryChoice() {
        MainWindow window(Theme::light(), false);
        window.resize(1600, 1000);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.actions().find("figureSheet")->trigger();
        auto* const sheet = window.findChild<FigureSheet*>();
        QImage last = sheet->preview();
        QVERIFY(!last.isNull());
        const auto follows = [&](const auto& change) {
            PaperStyle style = sheet->style();
            style.schemes.clear();
            change(style);
            sheet->setStyle(style);
            const bool has = QTest::qWaitFor([&] { return sheet->preview() != last; });
            last = sheet->preview();
            return has;
        };
        QVERIFY(follows([](PaperStyle& s) { s.letters = 11; }));
        QVERIFY(follows([](PaperStyle& s) { s.ratio = 0.5; }));
        QVERIFY(follows([](PaperStyle& s) { s.lines = 2; }));
        QVERIFY(follows([](PaperStyle& s) { s.legend = LegendPlace::none; }));
        QVERIFY(follows([](PaperStyle& s) { s.colours = PaperColours::screen; }));
        QVERIFY(follows([](PaperStyle& s) { s.portraits = Portraits::over; }));
        QVERIFY(follows([](PaperStyle& s) { s.hasTitles = false; }));
        QVERIFY(follows([](PaperStyle& s) { s.columns = 2; }));
        // Two columns of these letters leave no room for curves.
        QVERIFY(follows([](PaperStyle& s) { s.columns = 1; }));
        QVERIFY(!last.allGray());
        sheet->setSight(Sight::grey);
        QTRY_VERIFY_WITH_TIMEOUT(sheet->preview() != last, 20000);
        QVERIFY(sheet->preview().allGray());
    }

    void mistakesSayWhatWouldDo_data() {
        QTest::addColumn<QString>("more");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* more, const char* said) { QTest::newRow(more) << more << said; };
        row("--view enrgy", "energy");
        row("--view stage", "extremal snapshot");
        row("--only RK5", "RK4");
        row("--width 10", "30 to 1000");
        row("--width colum", "column");
        row("--legend belo", "below");
        row("--times 5:1", "FROM below TO");
        row("--times 5", "FROM:TO");
        row("--font Intre", "Inter");
        row("--letters 1", "4 to 48");
        row("--out fig.jpg", ".pdf, .svg or .png");
    }
    void mistakesSayWhatWouldDo() {
        QFETCH(QString, more);
        QFETCH(QString, said);
        QStringList arguments{"preset:kepler"};
        if (!more.contains("--out")) arguments << "--out" << path("wrong.pdf");
        const Answer a = figure(arguments + more.split(' '));
        QCOMPARE(a.code, 2);
        QVERIFY2(QString(a.err).contains(said), qPrintable(a.err));
        QVERIFY(!QFile::exists(path("wrong.pdf")));
    }
};

EXTREMAL_TEST(FigureVerbTest)

}  // namespace extremal::figure_test

#include "figure_test.moc"
