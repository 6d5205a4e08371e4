// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook in the window: every page of it is listed, and its page of keys is what the actions say.
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QListWidget>
#include <QRegularExpression>
#include <QTabBar>
#include <QTest>
#include <QTextBrowser>

#include "engine/scene/preset.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/theme.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/study/study_page.hpp"
#include "ui/windows/help_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::help_test {
namespace {

QString keysPage(const Actions& actions) {
    QString text = QStringLiteral(
        "# Keys\n\nSingle letters and digits are left to a text field that has the focus. This page is "
        "written from the actions "
        "of the window.\n");
    QString menu;
    for (const QAction* action : actions.all()) {
        if (Actions::menuOf(action) != menu) {
            menu = Actions::menuOf(action);
            text += "\n## " + menu + "\n\n| key | does |\n| --- | --- |\n";
        }
        QStringList keys;
        for (const QKeySequence& key : action->shortcuts())
            keys << key.toString(QKeySequence::PortableText).replace("|", "\\|");
        text += "| " + keys.join(", ") + " | " + QString(action->text()).remove('&').remove("...") + " |\n";
    }
    return text;
}

}  // namespace

class HelpTest : public QObject {
    Q_OBJECT
private slots:
    void thePageOfKeysIsWhatTheActionsSay() {
        MainWindow window(Theme::light(), false);
        const QByteArray expected = keysPage(window.actions()).toUtf8();
        QFile page(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/keys.md"));
        if (page.open(QIODevice::ReadOnly) && page.readAll() == expected) return;
        QDir().mkpath(QStringLiteral(EXTREMAL_TEST_OUTPUT));
        QFile actual(QStringLiteral(EXTREMAL_TEST_OUTPUT "/keys.md"));
        QVERIFY(actual.open(QIODevice::WriteOnly));
        actual.write(expected);
        QFAIL(qPrintable("resources/handbook/keys.md is out of date: copy " + actual.fileName()));
    }
    void picturesOfPagesAreFound() {
        HelpWindow help;
        auto* text = help.findChild<QTextBrowser*>();
        help.open("filon");
        const QString html = text->toHtml();
        QVERIFY(html.contains("src=\"filon.svg\""));
        QVERIFY(!text->loadResource(QTextDocument::ImageResource, QUrl("filon.svg")).isNull());
        QVERIFY(text->loadResource(QTextDocument::ImageResource, QUrl("nowhere.svg")).isNull());
        // It is drawn: below the tables there is more than text and ground.
        const QImage picture = QImage(QStringLiteral(":/handbook/filon.svg"));

        QVERIFY(picture.width() > 600);
        QVERIFY(text->document()->size().height() > 400 + 600);
    }
    void everyPageIsListedAndShown() {
        HelpWindow help;
        const auto* pages = help.findChild<QListWidget*>();
        const auto* text = help.findChild<QTextBrowser*>();
        const QStringList files =
            QDir(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook")).entryList({"*.md"});
        QCOMPARE(pages->count(), files.size());
        for (const QString& file : files) {
            help.open(file.chopped(3));
            QVERIFY2(pages->currentItem()->data(Qt::UserRole).toString() == file.chopped(3),
                     qPrintable(file));
            QVERIFY2(text->toPlainText().size() > 200, qPrintable(file));
        }
    }
    void theSearchFindsPagesAndTheirPlaces() {
        HelpWindow help;
        auto* pages = help.findChild<QListWidget*>();
        auto* text = help.findChild<QTextBrowser*>();
        help.search("Chebyshev time");
        QStringList shown;
        for (int i = 0; i < pages->count(); ++i)
            if (!pages->item(i)->isHidden()) shown << pages->item(i)->data(Qt::UserRole).toString();
        QVERIFY(!shown.isEmpty() && shown.size() < pages->count() / 2);
        QVERIFY(shown.contains(help.page()));
        QVERIFY(text->toPlainText().contains("chebyshev", Qt::CaseInsensitive));
        QVERIFY(!text->extraSelections().isEmpty());
        QCOMPARE(text->textCursor().selectedText().toLower(), QString("chebyshev"));
        help.search("no page has these words xyzzy");
        for (int i = 0; i < pages->count(); ++i) QVERIFY(pages->item(i)->isHidden());
        help.search({});
        QVERIFY(!pages->item(0)->isHidden() && text->extraSelections().isEmpty());
    }
    /// What is typed brings page after page under the marks of the letter before: from every page of the
    /// handbook, letter by letter, there and back.
    void theSearchIsTypedLetterByLetterFromEveryPage() {
        const QStringList typed{"chaos",       "lobatto gauss", "zq9",  "f(x)",       "é α",
                                "  the  step", "symplectic",    "0.01", "`a*[b].\\$", "Kepler e"};
        HelpWindow help;
        help.show();
        const auto* pages = help.findChild<QListWidget*>();
        auto* search = help.findChild<QLineEdit*>("search");
        auto* text = help.findChild<QTextBrowser*>();
        for (int i = 0; i < pages->count(); ++i) {
            search->clear();
            help.open(pages->item(i)->data(Qt::UserRole).toString());
            const QString words = typed[i % typed.size()];
            for (const QChar letter : words) {
                search->insert(QString(letter));
                QApplication::processEvents();  // paints the marks
            }
            QCOMPARE(search->text(), words);
            for (const QTextEdit::ExtraSelection& mark : text->extraSelections())
                QCOMPARE(mark.cursor.document(), text->document());
            QTest::keyClick(search, Qt::Key_Return);
            while (!search->text().isEmpty()) {
                search->backspace();
                QApplication::processEvents();
            }
            QVERIFY(text->extraSelections().isEmpty());
        }
    }
    /// Other ways to another page, and other text in the same browser, under the marks of a search.
    void pagesAreReplacedUnderTheMarksOfASearch() {
        HelpWindow help;
        help.show();
        auto* text = help.findChild<QTextBrowser*>();
        help.open("tour");
        help.search("step");
        for (const char* place : {"schemes", "scenes#time", "keys", "index"}) {
            QVERIFY(!text->extraSelections().isEmpty());
            help.open(place);
            QApplication::processEvents();
            help.search("the step");
            help.search("step");
        }
        help.back();
        QApplication::processEvents();
        help.search("a");
        help.forward();
        help.search({});
        QVERIFY(text->extraSelections().isEmpty());
        help.open("keys");  // a page without marks: the words of a search are in others
        QApplication::processEvents();
        QVERIFY(text->toPlainText().contains("Keys"));
    }
    /// Return goes through all places with any of the words, page after page, and begins again.
    void returnGoesFromPlaceToPlace() {
        HelpWindow help;
        auto* text = help.findChild<QTextBrowser*>();
        auto* search = help.findChild<QLineEdit*>("search");
        help.search("chebyshev");
        QStringList pages{help.page()};
        for (int i = 0; i < 200 && pages.size() < 3; ++i) {
            QCOMPARE(text->textCursor().selectedText().toLower(), QString("chebyshev"));
            QTest::keyClick(search, Qt::Key_Return);
            if (help.page() != pages.back()) pages << help.page();
        }
        QCOMPARE(pages.size(), 3);
    }
    void theWayBackLeadsToWhereOneWas() {
        HelpWindow help;
        help.open("tour");
        help.open("scenes#time");
        help.open("keys");
        QCOMPARE(help.page(), QString("keys"));
        help.back();
        QCOMPARE(help.page(), QString("scenes"));
        help.back();
        QCOMPARE(help.page(), QString("tour"));
        help.forward();
        QCOMPARE(help.page(), QString("scenes"));
        help.open("orders");  // what was ahead is given up
        help.forward();
        QCOMPARE(help.page(), QString("orders"));
    }
    void examplesOpenInTheWindow() {
        const QString page = withPresetLinks(
            "Presets `kepler` and `nowhere`. Run `extremal run preset:pendulum --out x`.\n\n```console\n$ "
            "extremal run "
            "preset:duffing\n```\n");
        QVERIFY(page.contains("[kepler](preset:kepler)") && page.contains("`nowhere`"));
        QVERIFY(page.contains("--out x` ([open](preset:pendulum))"));
        QVERIFY(page.contains("[duffing](preset:duffing)"));
        QVERIFY(page.contains("$ extremal run preset:duffing\n"));  // the code stays as it is
        MainWindow window(Theme::light(), false);
        window.show();
        window.actions().find("paper")->trigger();
        auto* help = window.findChild<HelpWindow*>();
        QVERIFY(help && help->isVisible());
        emit help->findChild<QTextBrowser*>()->anchorClicked(QUrl("preset:seed-spring"));
        QCOMPARE(window.workspace().origin(), QString("preset:seed-spring"));
    }
    void f1OpensThePageOfWhatHasTheFocus() {
        MainWindow window(Theme::light(), false);
        QVERIFY(window.open("preset:spring-pendulum"));
        QTRY_VERIFY(window.discretizer().isCurrent());
        QCOMPARE(helpPageOf(window.findChild<QWidget*>("field.k")), QString("models"));
        QCOMPARE(helpPageOf(window.discretizer().cell(3, "lobatto")), QString("spaces"));
        QCOMPARE(helpPageOf(&window.studies()), QString("studies"));
        QCOMPARE(helpPageOf(window.findChild<QWidget*>("add")), QString("schemes"));
        QCOMPARE(helpPageOf(window.compareView().currentPlot()), QString("observables"));
        QCOMPARE(helpPageOf(nullptr), QString("index"));
        // Where what has the focus has no page of its own, that of what is shown.
        auto* tabs = window.findChild<QTabBar*>();
        QCOMPARE(helpPageOf(tabs), QString("index"));
        for (const auto& [tab, page] : {std::pair{2, "studies"}, {1, "scenes"}, {0, "observables"}}) {
            tabs->setCurrentIndex(tab);
            if (QWidget* focus = QApplication::focusWidget()) focus->clearFocus();
            window.actions().find("help")->trigger();
            auto* help = window.findChild<HelpWindow*>();
            QVERIFY(help);
            QCOMPARE(help->page(), QString(page));
        }
    }
    /// Every preset that shows something of the paper is on its map, and what the map names exists.
    void theMapOfThePaperIsComplete() {
        QFile file(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/paper.md"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QString page = QString::fromUtf8(file.readAll());
        static const QRegularExpression quoted("`([\\w.-]+)`");
        QStringList names;
        for (const QRegularExpressionMatch& match : quoted.globalMatch(page)) names << match.captured(1);
        for (const Preset& preset : presets()) {
            const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
            if (QByteArray(preset.json.data(), static_cast<qsizetype>(preset.json.size()))
                    .contains("\"source\": \"Leok"))
                QVERIFY2(names.contains(id), qPrintable(id));
        }
        for (const QString& name : names) {
            if (findPreset(name.toStdString())) continue;
            const QString test = QString(name).replace('.', '/');
            QVERIFY2(QFile::exists(QStringLiteral(EXTREMAL_SOURCE_DIR "/tests/%1_test.cpp").arg(test)),
                     qPrintable(name));
        }
    }
};

EXTREMAL_TEST(HelpTest)
}  // namespace extremal::help_test

#include "help_test.moc"
