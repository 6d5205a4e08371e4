// SPDX-License-Identifier: GPL-3.0-or-later
/// What a session must not lose, and what it must say: unsaved scenes, files that cannot be opened, runs that
/// are stopped.
#include <QApplication>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/seek_slider.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/workspace/autosave.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::session_test {
namespace {

/// Presses a button of the next message box.
void answer(QMessageBox::StandardButton button, bool& wasAsked) {
    wasAsked = false;
    QTimer::singleShot(0, qApp, [button, &wasAsked] {
        auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
        if (!box) return;
        wasAsked = true;
        box->button(button)->click();
    });
}

bool write(const QString& path, const QByteArray& text) {
    QFile file(path);
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size();
}

QString wordsOf(const QWidget& page) {
    QStringList words;
    for (const QLabel* label : page.findChildren<QLabel*>())
        if (label->isVisible()) words << label->text();
    return words.join('\n');
}

}  // namespace

class SessionTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        QStandardPaths::setTestModeEnabled(true);
        QCoreApplication::setApplicationName("ExtremalSessionTest");
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void init() { QDir(Autosave::defaultDirectory()).removeRecursively(); }

    void anotherSceneAsksAboutChanges() {
        MainWindow window(Theme::light());
        window.show();
        bool wasAsked = false;
        answer(QMessageBox::Cancel, wasAsked);
        QVERIFY(window.open("preset:pendulum"));
        QCoreApplication::processEvents();
        QVERIFY(!wasAsked);  // nothing is lost
        QVERIFY(window.workspace().edit({{"/time/end", Value(5.0)}}, "end"));
        const Value edited = window.workspace().document();
        answer(QMessageBox::Cancel, wasAsked);
        QVERIFY(!window.open("preset:kepler"));
        QVERIFY(wasAsked);
        QVERIFY(window.workspace().document() == edited);
        answer(QMessageBox::Discard, wasAsked);
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(wasAsked);
        QCOMPARE(window.workspace().fileName(), QString("kepler.json"));
    }
    void whatACrashLeavesIsOfferedOnTheStartPage() {
        QTemporaryDir folder;
        const QString path = folder.filePath("mine.json");
        Value edited;
        {
            // A window that ends without its destructor leaves its copy: taken over before it is removed.
            MainWindow window(Theme::light());
            QVERIFY(window.open("preset:pendulum"));
            QVERIFY(window.workspace().saveAs(path));
            QVERIFY(window.workspace().edit({{"/time/end", Value(5.0)}}, "end"));
            edited = window.workspace().document();
            window.findChild<Autosave*>()->writeNow();
            const QDir copies(Autosave::defaultDirectory());
            const QStringList names = copies.entryList({"*.json"});
            QCOMPARE(names.size(), 1);
            QVERIFY(QFile::copy(copies.filePath(names[0]), copies.filePath("left.json")));
        }
        MainWindow window(Theme::light());
        window.resize(1400, 900);
        window.show();
        auto* page = window.findChild<StartPage*>();
        QVERIFY(page && page->isVisible());
        auto* section = page->findChild<QWidget*>("unsaved");
        QVERIFY(section && section->isVisible());
        const auto cards = section->findChildren<Card*>();
        QCOMPARE(cards.size(), 1);
        QVERIFY(wordsOf(*section).contains("mine.json"));
        QVERIFY(wordsOf(*section).contains(QLocale().toString(QDate::currentDate(), "d MMMM")));
        const auto hasPicture = [&] {
            const auto labels = cards[0]->findChildren<QLabel*>();
            return std::any_of(labels.begin(), labels.end(),
                               [](const QLabel* label) { return !label->pixmap().isNull(); });
        };
        QTRY_VERIFY(hasPicture());
        QTest::mouseClick(cards[0], Qt::LeftButton);
        QVERIFY(window.workspace().document() == edited);
        QCOMPARE(window.workspace().path(), path);
        QVERIFY(window.workspace().isDirty());
        QVERIFY(!section->isVisible());
        // Still safe: the session has a copy of its own now.
        const QStringList copies = QDir(Autosave::defaultDirectory()).entryList({"*.json"});
        QCOMPARE(copies.size(), 1);
        QVERIFY(copies[0] != "left.json");
    }
    void whatIsNotValidYetIsKeptAsWell() {
        const QDir copies(Autosave::defaultDirectory());
        const QString typed = "m/2*x_t^2 - k*x^";
        {
            MainWindow window(Theme::light());
            QVERIFY(window.open("preset:duffing"));
            QVERIFY(!window.workspace().edit({{"/model/lagrangian", Value(typed.toStdString())}}, "formula"));
            bool wasAsked = false;
            answer(QMessageBox::Cancel, wasAsked);
            QVERIFY(!window.open("preset:kepler"));
            QVERIFY(wasAsked);
            window.findChild<Autosave*>()->writeNow();
            const QStringList names = copies.entryList({"*.json"});
            QCOMPARE(names.size(), 1);
            QVERIFY(QFile::copy(copies.filePath(names[0]), copies.filePath("left.json")));
        }
        MainWindow window(Theme::light());
        window.show();
        const auto cards = window.findChild<QWidget*>("unsaved")->findChildren<Card*>();
        QCOMPARE(cards.size(), 1);
        QTest::mouseClick(cards[0], Qt::LeftButton);
        QCOMPARE(window.workspace().fileName(), QString("duffing.json"));
        const Value* draft = window.workspace().draftAt("/model/lagrangian");
        QVERIFY(draft && *draft == Value(typed.toStdString()));
    }
    void aDiscardedSceneIsGone() {
        const QDir copies(Autosave::defaultDirectory());
        QVERIFY(QDir().mkpath(copies.path()));
        QVERIFY(write(copies.filePath("left.json"),
                      R"({"name":"x.json","path":"","origin":"preset:kepler","scene":{"extremal":1}})"));
        MainWindow window(Theme::light());
        window.show();
        auto* discard = window.findChild<QWidget*>("unsaved")->findChild<QPushButton*>();
        QVERIFY(discard);
        discard->click();
        QVERIFY(!copies.exists("left.json"));
        QVERIFY(!window.findChild<QWidget*>("unsaved")->isVisible());
    }
    void whatCannotBeOpenedIsSaidOnTheStartPage() {
        QTemporaryDir folder;
        const QString bad = folder.filePath("bad.json"), manyBad = folder.filePath("many.json");
        QVERIFY(
            write(bad, R"({"extremal":1,"model":{"type":"no-such-model"},"time":{"end":1},"schemes":[]})"));
        QVERIFY(write(manyBad, R"({"extremal":1,"model":{"type":"kepler"},"a":1,"b":2,"c":3,"d":4,"e":5})"));
        for (const QString& scene : {bad, folder.filePath("missing.json"), QString("preset:typo")}) {
            MainWindow window(Theme::light(), false);
            window.show();
            QVERIFY(!window.open(scene));
            auto* page = window.findChild<StartPage*>();
            QVERIFY(page->isVisible());
            QCoreApplication::processEvents();
            QVERIFY2(wordsOf(*page).contains("cannot be used"), qPrintable(scene));
            QVERIFY(!window.workspace().openProblems().empty());
        }
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(!window.open(manyBad));
        QCoreApplication::processEvents();
        QPushButton* show = nullptr;
        for (QPushButton* button : window.findChild<StartPage*>()->findChildren<QPushButton*>())
            if (button->text() == "Show the log") show = button;
        QVERIFY(show);
        show->click();
        auto* log = window.findChild<QWidget*>("log");
        QVERIFY(log && log->isVisible());
        const QString text = log->findChild<QPlainTextEdit*>()->toPlainText();
        for (const Problem& p : window.workspace().openProblems())
            QVERIFY2(text.contains(QString::fromStdString(p.message)), p.message.c_str());
    }
    void aFileOutsideTheFolderIsReadAfterAClick() {
        QTemporaryDir folder;
        QVERIFY(QDir(folder.path()).mkdir("scene"));
        const auto write = [&](const QString& name, const QByteArray& text) {
            QFile file(folder.filePath(name));
            return file.open(QIODevice::WriteOnly) && file.write(text) == text.size();
        };
        QVERIFY(write("outside.csv", "t,q.theta,p.theta\n0,1,0\n1,0.5,-0.5\n"));
        QVERIFY(
            write("scene/scene.json",
                  R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]}, "time": {"end": 1},
"schemes": [{"scheme": "midpoint", "step": 0.1}], "reference": {"type": "file", "path": "../outside.csv"}})"));
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(!window.open(folder.filePath("scene/scene.json")));
        QPushButton* read = nullptr;
        for (QPushButton* button : window.findChildren<QPushButton*>())
            if (button->text() == "Read it" && button->isVisible()) read = button;
        QVERIFY(read);
        read->click();
        QCOMPARE(window.workspace().fileName(), QString("scene.json"));
        QVERIFY(waitForResults(window));
        // Saved elsewhere, with the file beside it, it needs no question.
        QVERIFY(window.workspace().saveAs(folder.filePath("saved.json")));
        QVERIFY(tests::contentOf(folder.filePath("saved.json")).contains("\"path\": \"outside.csv\""));
        QVERIFY(window.open(folder.filePath("saved.json")));
    }
    void aStoppedRunSaysSo() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:kepler");
        QVERIFY(waitForResults(window));
        QVERIFY(window.workspace().edit({{"/time/end", Value(1e9)}}, "end"));
        window.runControl().start();
        QTRY_VERIFY(window.runControl().isRunning() && window.runControl().fraction() > 0);
        window.actions().find("stop")->trigger();
        QTRY_VERIFY(window.runControl().state() == RunControl::State::stopped);
        QVERIFY(wordsOf(*window.statusBar()).contains("stopped"));
        const auto& schemes = window.workspace().scene().schemes;
        for (std::size_t i = 0; i < schemes.size(); ++i) {
            const auto* card = window.findChild<SchemeCard*>(QString("scheme.%1").arg(i));
            for (const char* figure : {"error", "order"})
                QCOMPARE(card->findChild<QLabel*>(figure)->text(), QString::fromUtf8("–"));
        }
    }
    void aClickOnTheTimelineGoesThere() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        QVERIFY(QTest::qWaitForWindowExposed(&window));
        for (SeekSlider* slider : window.findChildren<SeekSlider*>()) {
            QTest::mouseClick(slider, Qt::LeftButton, {}, {slider->width() / 4, slider->height() / 2});
            const double part = (slider->value() - slider->minimum()) /
                                static_cast<double>(slider->maximum() - slider->minimum());
            QVERIFY2(std::abs(part - 0.25) < 0.05, qPrintable(slider->accessibleName()));
        }
        const Playback& time = window.playback();
        QVERIFY(std::abs(time.time() - 0.25 * time.end()) < 0.03 * time.end());
    }
    void digitsSayWhatTheySwitch() {
        MainWindow window(Theme::light(), false);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        window.actions().find("toggle2")->trigger();
        const auto& scheme = window.workspace().scene().schemes[1];
        QVERIFY(!scheme.isEnabled);
        QVERIFY(window.statusBar()->currentMessage().contains(QString::fromStdString(scheme.label)));
    }
    void digitsAtARowAreItsStep() {
        MainWindow window(Theme::light(), false);
        KeyGuard guard;
        qApp->installEventFilter(&guard);
        window.resize(1400, 900);
        window.show();
        window.open("preset:pendulum");
        QVERIFY(waitForResults(window));
        window.activateWindow();
        auto* card = window.findChild<SchemeCard*>("scheme.0");
        QTest::mouseClick(card, Qt::LeftButton, {}, {12, 40});
        QVERIFY(card->hasFocus());
        const Scene before = window.workspace().scene();
        for (const char c : {'0', '.', '0', '2'}) QTest::keyClick(QApplication::focusWidget(), c);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
        const Scene& after = window.workspace().scene();
        QCOMPARE(after.schemes[0].step.value, 0.02);
        for (std::size_t i = 0; i < after.schemes.size(); ++i)
            QCOMPARE(after.schemes[i].isEnabled, before.schemes[i].isEnabled);
    }
};

EXTREMAL_TEST(SessionTest)
}  // namespace extremal::session_test

#include "session_test.moc"
