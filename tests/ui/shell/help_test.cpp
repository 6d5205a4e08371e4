/// The handbook in the window: every page of it is listed, and its page of keys is what the actions say.
#include <QDir>
#include <QFile>
#include <QListWidget>
#include <QTest>
#include <QTextBrowser>

#include "tests/tools/test.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/help_window.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/theme.hpp"

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
};

EXTREMAL_TEST(HelpTest)
}  // namespace extremal::help_test

#include "help_test.moc"
