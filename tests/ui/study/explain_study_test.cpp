// SPDX-License-Identifier: GPL-3.0-or-later
/// Every number of every table of studies says what it is, and a click on it shows that.
#include <QSignalSpy>
#include <QTableWidget>
#include <QTest>
#include <QToolTip>

#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/study/explain_study.hpp"
#include "ui/study/study_form.hpp"
#include "ui/study/study_page.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::explain_study_test {
namespace {

ResolvedScene shortKepler() {
    return *readScene(std::string(findPreset("kepler")->json), {{"/time/end", Value(2.0)}}).resolved;
}

/// The columns that the window shows of a study.
template <class S>
void explainsAll(const StudyEntry& entry, const S& study) {
    const AnyStudy any = study;
    for (const std::string& column : summaryOf(entry, study).columns) {
        const QString text = explainStudyCell(any, column, Value(0.25));
        QVERIFY2(text.size() > 20, (entry.item.id + ": " + column).c_str());
        QVERIFY(text.contains(QStringLiteral("0.25")));
        QVERIFY(explainStudyCell(any, column, Value(nullptr)).contains(QStringLiteral("empty")));
    }
}

}  // namespace

class ExplainStudyTest : public QObject {
    Q_OBJECT
private slots:
    void everyColumnOfEveryStudyIsExplained() {
        for (const StudyEntry& entry : studyEntries()) {
            switch (entry.over) {
                case StudyEntry::Over::steps:
                    explainsAll(entry, Sweep(shortKepler(), {}));
                    break;
                case StudyEntry::Over::wantedError: {
                    SweepOptions options;
                    options.wantedError = 1e-6;
                    explainsAll(entry, Sweep(shortKepler(), options));
                    break;
                }
                case StudyEntry::Over::wishes: {
                    SweepOptions options;
                    options.rungs = {1e-2, 1e-4};
                    explainsAll(entry, Sweep(shortKepler(), options));
                    break;
                }
                case StudyEntry::Over::numbers: {
                    StabilityOptions options;
                    options.x = {"/schemes/*/step", 0.01, 1, 3, true};
                    explainsAll(entry, StabilityStudy(shortKepler(), options));
                    options.findsLimits = true;
                    explainsAll(entry, StabilityStudy(shortKepler(), options));
                    break;
                }
                case StudyEntry::Over::testEquation:
                    explainsAll(entry, LinearStudy(shortKepler(), {}));
                    break;
                case StudyEntry::Over::usableSteps:
                    explainsAll(entry, LimitsStudy(shortKepler(), {}));
                    break;
                case StudyEntry::Over::extremes:
                    explainsAll(entry, ExtremesStudy());
                    break;
            }
        }
        // The proposals for a wanted error, which no study of the command line has.
        const AnyStudy sweep = Sweep(shortKepler(), {});
        for (const char* column :
             {"scheme", "step", "tolerance", "predicted cpu", "ratio", "nearest error", "nearest cpu"})
            QVERIFY2(explainStudyCell(sweep, column, Value(1.0)).size() > 20, column);
        QVERIFY(explainStudyCell(sweep, "no such column", Value(1.0)).isEmpty());
    }
    /// Which observable, over which nodes, and in which unit.
    void anErrorSaysWhatItIsOf() {
        SweepOptions options;
        const auto text = [&] {
            return explainStudyCell(AnyStudy(Sweep(shortKepler(), options)), "error", {});
        };
        QVERIFY(text().contains("Distance from the reference") && text().contains("over all nodes"));
        options.metric = "energy";
        options.isAtEnd = true;
        QVERIFY(text().contains("observable energy") && text().contains("at the last node"));
        const ResolvedScene pendulum = *readScene(std::string(findPreset("pendulum")->json)).resolved;
        QVERIFY(explainStudyCell(AnyStudy(Sweep(pendulum, {})), "error", {}).contains(" rad"));
    }
    void aClickOnANumberShowsIt() {
        MainWindow window(Theme::light(), false);
        window.show();
        QVERIFY(window.open("preset:kepler") && window.workspace().edit({{"/time/end", 2.0}}, "Shorter"));
        StudyPage& page = window.studies();
        page.form().choose("convergence");
        window.actions().find("runStudy")->trigger();
        QVERIFY(QTest::qWaitFor([&] { return !page.job().isRunning(); }, 60000));
        QTableWidget* table = nullptr;
        for (QTableWidget* each : page.findChildren<QTableWidget*>())
            if (each->accessibleName() == QStringLiteral("Results of the study")) table = each;
        QVERIFY(table && table->rowCount() > 0);
        for (int row = 0; row < table->rowCount(); ++row)
            for (int column = 0; column < table->columnCount(); ++column)
                QVERIFY(!table->item(row, column)->toolTip().isEmpty());
        int order = 0;
        while (table->horizontalHeaderItem(order)->text() != QStringLiteral("order")) ++order;
        const QRect cell = table->visualItemRect(table->item(0, order));
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, cell.center());
        QVERIFY(QToolTip::isVisible() && QToolTip::text().contains(QStringLiteral("Slope of the line")));
        QToolTip::hideText();
    }
};

EXTREMAL_TEST(ExplainStudyTest)
}  // namespace extremal::explain_study_test

#include "explain_study_test.moc"
