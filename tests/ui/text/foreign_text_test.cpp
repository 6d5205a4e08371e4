// SPDX-License-Identifier: GPL-3.0-or-later
/// Texts of a scene load nothing: every place of the window in which one can stand is shown with texts that
/// name a file, and the kernel is asked whether the file was opened.
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QAbstractItemView>
#include <QApplication>
#include <QDesktopServices>
#include <QFile>
#include <QHelpEvent>
#include <QLabel>
#include <QMenu>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBlock>
#include <QTextBrowser>
#include <QToolTip>

#include "engine/passport/document.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/base/plain_tips.hpp"
#include "ui/panels/problem_text.hpp"
#include "ui/pictures/export_folder.hpp"
#include "ui/pictures/playing_page.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/text/foreign_text.hpp"
#include "ui/text/formula_text.hpp"
#include "ui/text/text_view.hpp"
#include "ui/text/typeset.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::foreign_text_test {

/// A file of which the kernel says whether somebody has opened it.
class WatchedFile {
public:
    WatchedFile() : path_(folder_.filePath("secret.png")), queue_(inotify_init1(IN_NONBLOCK)) {
        QImage picture(40, 40, QImage::Format_RGB32);
        picture.fill(Qt::red);
        picture.save(path_);
        inotify_add_watch(queue_, path_.toLocal8Bit(), IN_OPEN | IN_ACCESS);
    }
    ~WatchedFile() { close(queue_); }
    const QString& path() const { return path_; }
    QString folder() const { return folder_.path(); }
    bool wasOpened() {
        char events[4096];
        return read(queue_, events, sizeof events) > 0;
    }

private:
    QTemporaryDir folder_;
    QString path_;
    int queue_;
};

/// The targets that were handed to the desktop.
class Desktop : public QObject {
    Q_OBJECT
public:
    Desktop() {
        for (const char* scheme : {"http", "https", "file", "javascript", "data", "ftp", "mailto", "preset"})
            QDesktopServices::setUrlHandler(scheme, this, "take");
    }
    ~Desktop() override {
        for (const char* scheme : {"http", "https", "file", "javascript", "data", "ftp", "mailto", "preset"})
            QDesktopServices::unsetUrlHandler(scheme);
    }
    QStringList opened;

public slots:
    void take(const QUrl& url) { opened << url.toString(QUrl::FullyEncoded); }
};

/// The ways to name a file in Markdown and in HTML.
QStringList hostileTexts(const QString& file) {
    const QString address = QUrl::fromLocalFile(file).toString();
    return {
        "![x](" + file + ")",
        "![x](" + address + " \"title\")",
        "![x][r]\n\n[r]: " + file,
        "[![x](" + file + ")](https://example.org)",
        "<img src=\"" + file + "\">",
        "<IMG\nSRC='" + address + "' width=10>",
        "a <b><img src=" + file + "></b>",
        "<link rel=\"stylesheet\" href=\"" + file + "\">",
        "<style>@import url(" + file + "); p { background: url(" + file + ") }</style><p>x</p>",
        "<p style=\"background-image: url('" + file + "')\">x</p>",
        "<ul style=\"list-style-image: url(" + file + ")\"><li>x</li></ul>",
        "<table background=\"" + file + "\"><tr><td background='" + file + "'>x</td></tr></table>",
        "<body background=\"" + file + "\">",
        "<object data=\"" + file + "\"></object><iframe src='" + file + "'></iframe>",
        "[x](https://example.org \"<img src='" + file + "'>\")",
        "| a |\n|---|\n| ![x](" + file + ") <img src=" + file + "> |",
        "> - ![x](" + file + ")",
        "$\\frac{![x](" + file + ")}{<img src=" + file + ">}$",
        "&lt;img src=" + file + "&gt; <!-- --><img src=" + file + ">",
        "# ![x](" + file + ")\n\n![](" + file + ")",
    };
}

const QStringList& hostileLinks() {
    static const QStringList all{"file:///etc/passwd",
                                 "/etc/passwd",
                                 "//host/share",
                                 "../../x",
                                 "javascript:alert(1)",
                                 "JavaScript:alert(1)",
                                 "data:text/html,%3Cscript%3E",
                                 "ftp://example.org/x",
                                 "mailto:a@example.org",
                                 "ssh://example.org",
                                 "vnc://example.org",
                                 "http:///etc/passwd",
                                 "https:x",
                                 "qrc:/handbook/index.md",
                                 "handbook:../../etc/passwd",
                                 "preset:nothing",
                                 "preset:../x",
                                 " file:///etc/passwd",
                                 "x.desktop"};
    return all;
}

/// Draws it, so that everything is laid out that can be.
void drawAll(QTextBrowser& browser) {
    browser.resize(500, 400);
    browser.show();
    QCoreApplication::processEvents();
    browser.grab();
    browser.selectAll();
    browser.copy();
}

QStringList linksOf(const QTextDocument& document) {
    QStringList links;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
        for (auto it = block.begin(); !it.atEnd(); ++it)
            if (const QTextCharFormat f = it.fragment().charFormat();
                f.isAnchor() || !f.anchorHref().isEmpty())
                links << f.anchorHref();
    return links;
}

/// A scene of which every text is hostile.
std::string hostileScene(const QString& file) {
    const std::string image = "<img src='" + file.toStdString() + "'>",
                      markdown = "![x](" + file.toStdString() + ")";
    const std::string both = image + " " + markdown;
    Value::Array schemes;
    for (const char* scheme : {"galerkin-gauss-2", "galerkin-gauss-1"})
        schemes.emplace_back(Value::Object{
            {"label", Value(scheme + (" " + image))}, {"step", Value(0.1)}, {"scheme", Value(scheme)}});
    const Value::Object step{{"text", Value(both + " [a](file:///etc/passwd)")}};
    const Value scene(Value::Object{
        {"extremal", Value(1)},
        {"title", Value(both)},
        {"source", Value(both)},
        {"lesson", Value(both)},
        {"notes", Value(both + "\n\n" + both)},
        {"model", Value(Value::Object{{"type", Value("kepler")}})},
        {"initial", Value(Value::Object{{"q", Value(Value::Array{Value(0.4), Value(0)})},
                                        {"p", Value(Value::Array{Value(0), Value(2)})}})},
        {"time", Value(Value::Object{{"end", Value(2)}})},
        {"schemes", Value(schemes)},
        {"reference", Value(Value::Object{{"type", Value("exact")}})},
        {"events",
         Value(Value::Array{Value(Value::Object{{"label", Value(image)}, {"expression", Value("y")}})})},
        {"views", Value(Value::Array{Value("stage"), Value("energy"), Value("phase"), Value("error")})},
        {"steps", Value(Value::Array{Value(step)})}});
    return writeJson(scene);
}

void sendTip(QWidget& widget, QPoint at) {
    QHelpEvent event(QEvent::ToolTip, at, widget.mapToGlobal(at));
    QApplication::sendEvent(&widget, &event);
    QCoreApplication::processEvents();
}

/// Every tip of a window.
void showTips(QWidget& window) {
    for (QWidget* widget : window.findChildren<QWidget*>()) {
        if (!widget->toolTip().isEmpty()) sendTip(*widget, {1, 1});
        if (auto* view = qobject_cast<QAbstractItemView*>(widget); view && view->model())
            for (int row = 0; row < std::min(view->model()->rowCount(), 30); ++row)
                sendTip(*view->viewport(), view->visualRect(view->model()->index(row, 0)).center());
        if (auto* menu = qobject_cast<QMenu*>(widget))
            for (QAction* action : menu->actions()) sendTip(*menu, menu->actionGeometry(action).center());
    }
    QToolTip::hideText();
}

class ForeignTextTest : public QObject {
    Q_OBJECT

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
        showTipsAsPlainText(*qApp);
    }

    void theWatchSeesAFileThatIsOpened() {
        WatchedFile file;
        QVERIFY(!file.wasOpened());
        QTextBrowser careless;  // what the notes were shown in
        careless.setMarkdown("![x](" + file.path() + ")");
        drawAll(careless);
        QVERIFY(file.wasOpened());
    }
    void aViewOpensNoFile() {
        WatchedFile file;
        for (const QString& text : hostileTexts(file.path())) {
            TextView view;
            view.showText(text);
            drawAll(view);
            view.setFitted(5);
            view.showText(text);
            drawAll(view);
            view.showPage({text.toStdString(), {Document::Paragraph{text.toStdString()}}});
            drawAll(view);
            if (file.wasOpened()) QFAIL(qPrintable(text));
            QVERIFY2(!view.document()->toHtml().contains("<img"), qPrintable(text));
        }
    }
    void nothingWaitsForAPipeOrReadsADevice() {
        QTemporaryDir folder;
        const QString pipe = folder.filePath("pipe");
        QCOMPARE(mkfifo(pipe.toLocal8Bit(), 0600), 0);
        for (const QString& file : {pipe, QString("/dev/zero"), QString("/dev/stdin")})
            for (const QString& text : hostileTexts(file)) {
                TextView view;
                view.showText(text);
                drawAll(view);
            }
    }
    void aPictureLeavesItsDescription() {
        ForeignDocument document;
        document.read("see ![a *red* square](/x.png) and ![](y.png)");
        QCOMPARE(document.toPlainText(), QString("see [picture, not loaded: a red square] and "));
    }
    void htmlIsShownAsItWasTyped() {
        ForeignDocument document;
        document.read("x <img src='a'> <b>y</b>\n\n<div>z</div>");
        QVERIFY2(document.toPlainText().contains("<img src='a'> <b>y</b>"),
                 qPrintable(document.toPlainText()));
        QVERIFY(document.toPlainText().contains("<div>z</div>"));
    }
    void onlyLinksToTheNetAndToOwnPagesRemain() {
        ForeignDocument document;
        for (const QString& link : hostileLinks()) {
            document.read("[words](<" + link + ">) and [words][r] and <" + link + ">\n\n[r]: <" + link + ">");
            QVERIFY2(linksOf(document).isEmpty(), qPrintable(link));
            QVERIFY(document.toPlainText().contains("words and words"));
        }
        document.read("<a href='https://example.org'>x</a>");
        QCOMPARE(linksOf(document), QStringList());
        document.read(
            "[a](https://example.org/x?y=1) [b](http://example.org) [c](handbook:scenes#notes) "
            "[d](schemes.md#passport) [e](preset:kepler) <https://example.org/z>");
        QCOMPARE(linksOf(document),
                 QStringList({"https://example.org/x?y=1", "http://example.org", "handbook:scenes#notes",
                              "handbook:schemes#passport", "preset:kepler", "https://example.org/z"}));
        document.keepOutsideLinks();
        QCOMPARE(linksOf(document),
                 QStringList({"https://example.org/x?y=1", "http://example.org", "https://example.org/z"}));
    }
    void aLinkNamesItsTargetAndOpensWithTheSecondClick() {
        Desktop desktop;
        TextView view;
        view.showText("[my bank](https://bank.example@evil.example/a&b)");
        drawAll(view);
        emit view.anchorClicked(QUrl(linksOf(*view.document()).value(0)));
        QCOMPARE(desktop.opened, QStringList());
        auto* const menu = view.findChild<QMenu*>("linkTarget");
        QVERIFY(menu);
        QVERIFY(menu->actions().at(0)->text().contains("evil.example"));
        QVERIFY(!menu->actions().at(0)->text().contains("bank.example"));
        QVERIFY(menu->actions().at(1)->text().startsWith("https://evil.example/a"));
        menu->actions().at(1)->trigger();
        QCOMPARE(desktop.opened.size(), 1);
        QVERIFY(desktop.opened.at(0).contains("evil.example/a"));
    }
    void noOtherSchemeReachesTheDesktop() {
        Desktop desktop;
        QWidget parent;
        for (const QString& link : hostileLinks()) followLink(QUrl(link), parent, {});
        QCOMPARE(desktop.opened, QStringList());
        QVERIFY(!parent.findChild<QMenu*>("linkTarget"));
        followLink(QUrl("preset:kepler"), parent, {});
        QCOMPARE(desktop.opened, QStringList("preset:kepler"));
    }
    void lookAlikeLettersOfAHostAreEncoded() {
        TextView view;
        view.show();
        followLink(QUrl(QString::fromUtf8("https://b\xd0\xb0nk.example/")), view, {});
        auto* const menu = view.findChild<QMenu*>("linkTarget");
        QVERIFY(menu && menu->actions().at(0)->text().contains("xn--"));
        QVERIFY(menu->actions().at(1)->text().contains("xn--"));
    }
    void labelsAndTipsShowTheirCharacters() {
        WatchedFile file;
        const QString text = "<img src='" + file.path() + "'> &lt;b&gt;";
        QWidget window;
        Card card(text, &window);
        card.setSubtitle(text);
        for (QLabel* label : {makeLabel(text, "body", &window), makeElidedLabel(text, "body", &window),
                              makeWrappedLabel(text, "body", &window)}) {
            QCOMPARE(label->textFormat(), Qt::PlainText);
            label->setToolTip(text);
        }
        QLabel* linked = makeLinkLabel("body", &window);
        linked->setText(problemText({"/a", text.toStdString(), text.toStdString()}));
        window.resize(300, 200);
        window.show();
        window.grab();
        showTips(window);
        QVERIFY(!file.wasOpened());
        sendTip(*window.findChild<QLabel*>(), {1, 1});
        QVERIFY(Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) == plainTip(text));
        QCOMPARE(plainTip("a < b, 5 > 3"), QString("a < b, 5 > 3"));
    }
    void everyWindowOpensNoFile() {
        WatchedFile file;
        const QString path = file.folder() + "/scene.json";
        writeFile(path.toStdString(), hostileScene(file.path()));
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY2(window.open(path),
                 qPrintable(QString::fromStdString(window.workspace().openProblems().empty()
                                                       ? std::string()
                                                       : window.workspace().openProblems().front().message)));
        QVERIFY(waitForResults(window));
        auto* const tabs = window.findChild<QTabBar*>();
        for (int tab = 0; tab < tabs->count(); ++tab) {
            tabs->setCurrentIndex(tab);
            QCoreApplication::processEvents();
            window.grab();
        }
        tabs->setCurrentIndex(0);
        for (const char* action :
             {"lesson", "passport", "inspect", "race", "perturb", "own", "ownSchemes", "log"}) {
            QAction* const found = window.actions().find(action);
            if (found && found->isEnabled()) found->trigger();
            QCoreApplication::processEvents();
        }
        window.notices().post({Notice::Kind::error,
                               "x",
                               QString::fromStdString(window.workspace().scene().title),
                               QString::fromStdString(window.workspace().scene().title),
                               {}});
        QCoreApplication::processEvents();
        QVERIFY(window.findChild<LessonBar*>("lesson")->isVisible());
        QVERIFY(window.findChild<TextView*>("notes")->toPlainText().contains("<img"));
        QVERIFY(window.findChild<TextView*>("lessonText")->toPlainText().contains("<img"));
        for (QWidget* top : QApplication::topLevelWidgets()) {
            top->grab();
            showTips(*top);
        }
        QVERIFY(!file.wasOpened());
    }
    void theReportHasNoPicturesAndLinksOfTheScene() {
        Scene scene;
        scene.notes =
            "![x](https://example.org/x.png) <img src=x> [a](javascript:alert(1)) "
            "[b](https://example.org) [c](preset:kepler) <script>alert(1)</script>";
        Comparison comparison;
        comparison.scene = scene;
        comparison.reference.type = "none";
        QString page = reportPage({std::make_shared<const Comparison>(comparison), {}, {}});
        page.remove("<script>" + playScript() + "</script>");  // its own
        QVERIFY(!page.contains("<img"));
        QVERIFY(!page.contains("<script"));
        QVERIFY(!page.contains("=\"javascript"));  // the scene stands below as text
        QVERIFY(!page.contains("preset:kepler\""));
        QVERIFY(page.contains("href=\"https://example.org\""));
    }
    void longAndDeepTextsEnd() {
        const QString deep = QString("{").repeated(100000), powers = QString("^").repeated(100000);
        QVERIFY(withFormulas("$" + deep + "$").size() > 0);
        QVERIFY(withFormulas("$" + powers + "$").size() > 0);
        QVERIFY(withFormulas("$" + QString("\\sqrt").repeated(50000) + "$").size() > 0);
        QCOMPARE(withFormulas("$\\frac{a}{b}$").size(), 7);
        ForeignDocument document;
        document.read(QString("$x$ ").repeated(ForeignDocument::mostShown));
        QVERIFY(document.toPlainText().contains("more characters"));
        // Each of them takes minutes where every change of the text looks at its whole paragraph.
        for (const char* part : {"> ", "- ", "[", "*a ", "![", "<", "`", "[a](", "\n|a", "&", "- a\n",
                                 "|a|\n|-|\n", "1. a\n", "a\n", "![a](b) "})
            document.read(QString(part).repeated(ForeignDocument::mostShown));
    }
    void theHandbookHasItsOwnPicturesAlone() {
        WatchedFile file;
        QTextBrowser browser;
        showMarkdown(browser, "![x](filon.svg)");
        QVERIFY(browser.document()->resource(QTextDocument::ImageResource, QUrl("filon.svg")).isValid());
        for (const QString& name : {file.path(), QUrl::fromLocalFile(file.path()).toString(),
                                    "../.." + file.path(), QString(":/icons/extremal.svg")})
            QVERIFY2(!browser.document()->resource(QTextDocument::ImageResource, QUrl(name)).isValid(),
                     qPrintable(name));
        QVERIFY(!file.wasOpened());
    }
};

EXTREMAL_TEST(ForeignTextTest)

}  // namespace extremal::foreign_text_test

#include "foreign_text_test.moc"
