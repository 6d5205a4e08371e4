/// The page of studies: points arrive while it runs, it stops at once and keeps them, and a row goes into the
/// scene as an edit.
#include <QTest>

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include "engine/scene/codec.hpp"
#include "engine/scene/preset.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/workspace.hpp"
#include "ui/study/study_page.hpp"

namespace extremal::study_page_test {
namespace {

bool waitForStudy(StudyPage& page) {
    return QTest::qWaitFor([&] { return !page.job().isRunning(); }, 60000);
}

template <class Box>
Box* named(QWidget& inside, const QString& name) {
    for (Box* box : inside.findChildren<Box*>())
        if (box->accessibleName() == name) return box;
    return nullptr;
}

void choose(StudyPage& page, const char* study) {
    auto* kind = named<QComboBox>(page, QStringLiteral("Study"));
    kind->setCurrentIndex(kind->findData(QString::fromLatin1(study)));
}

QString stateOf(StudyPage& page) { return page.findChild<QLabel*>(QStringLiteral("studyState"))->text(); }

}  // namespace

class StudyPageTest : public QObject {
    Q_OBJECT
private slots:
    void theCheapestSchemeGoesIntoTheScene() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        StudyPage& page = window.studies();
        choose(page, "cheapest");
        window.actions().find("runStudy")->trigger();
        QVERIFY(page.isVisible() && page.job().isRunning());
        QVERIFY(waitForStudy(page));
        const Sweep& sweep = *page.job().sweep();
        QVERIFY(sweep.isComplete());
        auto* table = named<QTableWidget>(page, QStringLiteral("Results of the study"));
        QVERIFY(table->rowCount() >= 2);
        QVERIFY(!page.findChild<PlotWidget*>()->figure().series().empty());

        table->selectRow(0);
        const QString label = table->item(0, 1)->text();
        const double step = table->item(0, 2)->data(Qt::UserRole).toDouble();
        QVERIFY(step > 0);
        const Scene before = window.workspace().scene();
        page.findChild<QPushButton*>(QStringLiteral("useStudy"))->click();
        const Scene& after = window.workspace().scene();
        const auto used = std::find_if(after.schemes.begin(), after.schemes.end(),
                                       [&](const SchemeSpec& s) { return s.label == label.toStdString(); });
        QVERIFY(used != after.schemes.end());
        QCOMPARE(used->step.value, step);
        QVERIFY(stateOf(page).contains("earlier version"));
        window.workspace().undo();
        QVERIFY(window.workspace().scene() == before);
        QVERIFY(!stateOf(page).contains("earlier version"));
    }
    void aStoppedStudyKeepsItsPoints() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        StudyPage& page = window.studies();
        choose(page, "work-precision");
        window.actions().find("runStudy")->trigger();
        const auto known = [&] {
            const auto& rows = page.job().sweep()->rows();
            return std::count_if(rows.begin(), rows.end(),
                                 [](const SweepRow& row) { return row.result.status != RunStatus::waiting; });
        };
        QVERIFY(QTest::qWaitFor([&] { return known() > 0; }, 60000));
        window.actions().find("stop")->trigger();
        QVERIFY(!page.job().isRunning() && page.job().wasStopped());
        QVERIFY(stateOf(page).contains("stopped"));
        const auto kept = known();
        QVERIFY(kept > 0 && kept < static_cast<long>(page.job().sweep()->rows().size()));
        QTest::qWait(0);
        QCOMPARE(known(), kept);
    }
    void whatIsWrongIsSaid() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler"));
        StudyPage& page = window.studies();
        choose(page, "cheapest");
        named<QLineEdit>(page, QStringLiteral("Wanted error"))->setText("-1");
        window.actions().find("runStudy")->trigger();
        QVERIFY(!page.job().isRunning());
        QVERIFY2(stateOf(page).contains("must be a number above 0"), qPrintable(stateOf(page)));
    }
    void aPointBecomesEdits() {
        const Scene scene = readScene(findPreset("kepler")->json).scene;
        const std::string label = scene.schemes.front().label;
        const std::vector<Edit> edits = editsForPoint(scene, label, 0.25, 0);
        QCOMPARE(edits.size(), std::size_t(1));
        QCOMPARE(edits.front().pointer, std::string("/schemes/0/step"));
        QVERIFY(editsForPoint(scene, "no such scheme", 0.25, 0).empty());
        Scene off = scene;
        off.schemes.front().isEnabled = false;
        QCOMPARE(editsForPoint(off, label, 0.25, 0).size(), std::size_t(2));
    }
};

EXTREMAL_TEST(StudyPageTest)
}  // namespace extremal::study_page_test

#include "study_page_test.moc"
