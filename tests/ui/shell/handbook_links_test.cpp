// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings and errors lead to the page of the handbook that explains them: by a click, and by F1.
#include <QDesktopServices>
#include <QLabel>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QTextBlock>

#include "engine/scene/outlook/topics.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/banners.hpp"
#include "ui/text/handbook_pages.hpp"
#include "ui/windows/help_window.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::handbook_links_test {
namespace {

const char* const nearResonance =
    "{\"extremal\":1,\"model\":{\"type\":\"spring-pendulum\",\"k\":1e6},\"initial\":{\"q\":[0.005,1],\"p\":["
    "0,0]},"
    "\"time\":{\"end\":1},\"schemes\":[{\"label\":\"R1\",\"step\":0.2008,\"scheme\":\"multiscale-r1\"}],"
    "\"observe\":[\"energy\"]}";

QString headingShown(const HelpWindow& help) {
    return help.findChild<QTextBrowser*>()->textCursor().block().text();
}

}  // namespace

class HandbookLinksTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        explicit Window(const QString& scene) : MainWindow(Theme::light(), false) {
            resize(1400, 900);
            show();
            open(scene);
        }
        HelpWindow* help() { return findChild<HelpWindow*>(); }
    };
    QString file(const char* text) {
        QFile out(folder_.filePath("scene.json"));
        if (!out.open(QIODevice::WriteOnly)) return {};
        out.write(text);
        return out.fileName();
    }
    QTemporaryDir folder_;

private slots:
    void everyTopicHasItsPlace() {
        QVERIFY(topics().size() > 60);
        for (const Topic& topic : topics()) {
            const QString place = QString::fromStdString(topic.place);
            QVERIFY2(handbookSection(place).size() > 40, qPrintable(place));
            QVERIFY2(handbookPages().contains(place.section('#', 0, 0)), qPrintable(place));
        }
        QVERIFY(handbookSection("multiscale#no-such-heading").isEmpty());
        QVERIFY(handbookSection("no-such-page").isEmpty());
    }
    void aSectionEndsAtTheNextHeadingOfItsLevel() {
        const QString section = handbookSection("waves#in-space");
        QVERIFY(section.startsWith("## In space\n"));
        QVERIFY(section.contains("### Dirichlet boundaries") && !section.contains("## In time"));
        // A comment of a program is not a heading.
        QVERIFY(handbookSection("scenes#views").contains("view"));
        QVERIFY(handbookSection("library").size() > handbookSection("library#an-example").size());
    }
    void theWarningOfASchemeHasALink() {
        Window window(file(nearResonance));
        QVERIFY(waitForResults(window));
        auto* card = window.findChild<SchemeCard*>("scheme.0");
        auto* caution = card->findChild<QLabel*>("caution");
        QVERIFY(caution && caution->isVisible());
        QVERIFY2(caution->text().contains("href=\"handbook:multiscale#resonances\""),
                 qPrintable(caution->text()));
        QVERIFY(caution->focusPolicy() & Qt::TabFocus);  // Tab and Return follow it as well
        QTest::mouseClick(card, Qt::LeftButton, {}, {8, 8});
        QCOMPARE(helpPageOf(card), QString("multiscale#resonances"));
        QVERIFY(QDesktopServices::openUrl(QUrl("handbook:multiscale#resonances")));  // what the label does
        QVERIFY(window.help() && window.help()->isVisible());
        QCOMPARE(window.help()->page(), QString("multiscale"));
        QCOMPARE(headingShown(*window.help()), QString("Resonances"));
        // Without the warning the card is like the others.
        QVERIFY(window.workspace().edit({{"/schemes/0/step", 0.2014}}, "step"));
        QCOMPARE(helpPageOf(card), QString("schemes"));
    }
    void aFailureHasALink() {
        Window window("preset:pendulum");
        QVERIFY(waitForResults(window));
        QVERIFY(window.workspace().edit({{"/model/l", 1e-9}}, "short"));
        QVERIFY(waitForResults(window));
        int links = 0;
        for (const SchemeCard* card : window.findChildren<SchemeCard*>()) {
            if (card->property("banner").toString().isEmpty()) continue;
            ++links;
            const QString text = card->findChild<QLabel*>("advice")->text();
            QVERIFY2(text.contains("href=\"handbook:"), qPrintable(text));
            QVERIFY(helpPageOf(card).contains('#'));
        }
        QVERIFY(links > 0);
    }
    void aBannerHasALink() {
        Window window(file("{\"extremal\":1,\"model\":{\"type\":\"kepler\",\"mu\":\"nonsense(\"}}"));
        const auto labels = window.findChild<Banners*>()->findChildren<QLabel*>();
        QVERIFY(!labels.isEmpty());
        QVERIFY2(labels.front()->text().contains("href=\"handbook:models#kepler\""),
                 qPrintable(labels.front()->text()));
        QCOMPARE(helpPageOf(labels.front()), QString("models#kepler"));
    }
    void aFieldThatIsRefusedHasALink() {
        Window window("preset:kepler");
        QVERIFY(waitForResults(window));
        auto* field = window.findChild<QLineEdit*>("field.mu");
        QVERIFY(field);
        enter(field, "-1");
        auto* problem = window.findChild<QLabel*>("problem.mu");
        QVERIFY(problem && problem->isVisible());
        QVERIFY2(problem->text().contains("href=\"handbook:models#kepler\""), qPrintable(problem->text()));
        QCOMPARE(helpPageOf(field), QString("models#kepler"));
        enter(field, "1");
        QCOMPARE(helpPageOf(field), QString("models"));
    }
};

EXTREMAL_TEST(HandbookLinksTest)
}  // namespace extremal::handbook_links_test

#include "handbook_links_test.moc"
