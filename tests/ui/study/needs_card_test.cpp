// SPDX-License-Identifier: GPL-3.0-or-later
/// What the scene needs, as a card: a click on a step of the stair puts its scheme into the scene in one
/// edit, the wanted error marks its step, and joint wishes are checked beside their field.
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include <algorithm>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/study/needs_card.hpp"
#include "ui/study/study_form.hpp"
#include "ui/study/study_page.hpp"
#include "ui/study/wishes_edit.hpp"
#include "ui/workspace/wanted.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::needs_card_test {
namespace {

bool search(MainWindow& window) {
    window.actions().find("needs")->trigger();
    return window.needs().job().isRunning() &&
           QTest::qWaitFor([&] { return !window.needs().job().isRunning(); }, 120000);
}

/// On a slow machine the first search may end before the first step is reached: it is searched on.
bool measure(MainWindow& window) {
    if (!search(window)) return false;
    const auto& rungs = window.needs().job().rungs();
    return (!rungs.empty() && rungs.front().isReached) || search(window);
}

NeedsStep* chosenStep(MainWindow& window) {
    for (NeedsStep* step : window.needs().steps())
        if (step->isChosen()) return step;
    return nullptr;
}

}  // namespace

class NeedsCardTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    void aClickOnAStepIsOneEdit() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:spring-pendulum"));
        QVERIFY(waitForResults(window));
        QVERIFY(measure(window));
        const std::vector<NeedsRung>& rungs = window.needs().job().rungs();
        QVERIFY(!rungs.empty() && rungs.front().isReached);
        QCOMPARE(window.needs().steps().size(), rungs.size());
        const Value before = window.workspace().document();
        const std::string label = rungs.front().answers.back().scheme.label;
        window.wanted().setError(1e-15);  // stands on no step
        window.needs().steps().front()->click();
        const auto& schemes = window.workspace().scene().schemes;
        const auto found =
            std::find_if(schemes.begin(), schemes.end(), [&](const auto& s) { return s.label == label; });
        QVERIFY(found != schemes.end() && found->isEnabled);
        QCOMPARE(window.workspace().selectedScheme(), static_cast<int>(found - schemes.begin()));
        QVERIFY(waitForResults(window));
        QVERIFY(window.needs().job().isOf(window.workspace().scene()));  // another scheme is no other problem
        window.workspace().undo();
        QVERIFY(window.workspace().document() == before);
    }
    void theWantedErrorMarksItsStep() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:spring-pendulum"));
        QVERIFY(waitForResults(window));
        QVERIFY(measure(window));
        const std::vector<NeedsRung>& rungs = window.needs().job().rungs();
        window.wanted().setError(rungs.front().largest());
        QCOMPARE(chosenStep(window), window.needs().steps().front());
        QCOMPARE(rungs.front().answerFor(rungs.front().largest()).wish, rungs.front().largest());
        window.wanted().setError(5);  // no wish of the ladder is as large: the first step serves it as well
        QCOMPARE(chosenStep(window), window.needs().steps().front());
        window.wanted().setError(1e-15);
        QVERIFY(!chosenStep(window));
    }
    void aSearchIsStoppedByEsc() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:henon-heiles"));
        QVERIFY(waitForResults(window));
        window.actions().find("needs")->trigger();
        QVERIFY(window.needs().job().isRunning());
        window.actions().find("stop")->trigger();
        QVERIFY(!window.needs().job().isRunning() && window.needs().job().wasStopped());
    }
    void anotherParameterIsAnotherScene() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        QVERIFY(measure(window));
        QVERIFY(window.needs().job().isOf(window.workspace().scene()));
        QVERIFY(window.workspace().edit({{"/model/l", 1.5}}, "length"));
        QVERIFY(!window.needs().job().isOf(window.workspace().scene()));
        QCOMPARE(window.needs().findChild<QLabel*>("needsState")->text(),
                 QStringLiteral("of an earlier version of the scene"));
    }
    void thereIsOneWantedError() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        window.studies().askForError();
        auto* const number = window.studies().findChild<QLineEdit*>("wantedError");
        QVERIFY(number);
        number->setText("2e-4");
        emit number->editingFinished();
        QCOMPARE(window.wanted().error(), 2e-4);
        window.wanted().setError(3e-5);
        QCOMPARE(number->text(), QStringLiteral("3e-5"));
    }
    void wishesAreThoseOfTheCommandLine() {
        using Wishes = std::vector<std::string>;
        QVERIFY((wishesIn(" energy=1e-6, rms(error.x/own, 2*error.y/own)=1e-3;error=1") ==
                 Wishes{"energy=1e-6", "rms(error.x/own, 2*error.y/own)=1e-3", "error=1"}));
        QVERIFY(wishesIn(" , ;").empty());
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        StudyPage& page = window.studies();
        page.form().choose("cheapest");
        auto* const text = page.findChild<QLineEdit*>("wishes");
        auto* const field = page.findChild<WishesEdit*>();
        enter(text, "energie=1e-6");
        window.actions().find("runStudy")->trigger();
        QVERIFY(!page.job().isRunning());
        QVERIFY2(field->problem().contains("energie"), qPrintable(field->problem()));
        enter(text, "energy");
        QVERIFY2(field->problem().contains("METRIC=VALUE"), qPrintable(field->problem()));
        enter(text, "energy=1e-6");
        QVERIFY(field->problem().isEmpty());
        window.actions().find("runStudy")->trigger();
        QVERIFY(QTest::qWaitFor([&] { return !page.job().isRunning(); }, 60000));
        const Sweep& sweep = *page.job().as<Sweep>();
        QCOMPARE(sweep.metrics().size(), std::size_t{2});
        QCOMPARE(sweep.options().wishes.front().value, 1e-6);
        for (const SweepRow& row : sweep.rows())
            if (row.result.isDone()) QVERIFY(row.result.errorIn(1) <= 1e-6);
    }
};

EXTREMAL_TEST(NeedsCardTest)
}  // namespace extremal::needs_card_test

#include "needs_card_test.moc"
