// SPDX-License-Identifier: GPL-3.0-or-later
/// Spaces, rules and schemes of one's own: the cells of the discretizer, the editor while one types, a rule
/// for each term, and the user's catalogue, whose faults are named and which loses nothing.
#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/own/own_list.hpp"
#include "ui/own/own_window.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/panels/formula_edit.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/term_strip.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/own_schemes.hpp"
#include "ui/workspace/scheme_finder.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::own_test {
namespace {

const char* const fitted =
    R"~({"label": "fitted", "step": 0.1, "space": {"type": "typed", "functions": ["1", "tau", "cos(tau)", "sin(tau)"]}})~";

std::string catalogueOf(const std::string& entries) {
    return "{\"extremal-schemes\": 1, \"schemes\": [" + entries + "]}";
}

QByteArray contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void write(const QString& path, const std::string& text) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text.data(), static_cast<qint64>(text.size()));
}

template <class Act>
QString problemOf(const Act& act) {
    try {
        act();
    } catch (const InvalidScene& e) {
        return QString::fromUtf8(e.what());
    }
    return {};
}

}  // namespace

class OwnTest : public QObject {
    Q_OBJECT

    QTemporaryDir folder_;

    struct Window : MainWindow {
        explicit Window(const char* preset = "preset:pendulum") : MainWindow(Theme::light(), false) {
            resize(1400, 900);
            show();
            open(preset);
            QVERIFY(waitForResults(*this));
        }
        const SchemeSpec& last() { return workspace().scene().schemes.back(); }
        OwnWindow* own() { return findChild<OwnWindow*>("ownScheme"); }
        DiscretizerCell* cell(const char* id) { return findChild<DiscretizerCell*>(QString("cell.") + id); }
        void type(const char* field, const char* text) {
            own()->findChild<FormulaEdit*>(field)->setPlainText(text);
        }
        QString said(const char* label) { return own()->findChild<QLabel*>(label)->text(); }
    };

    QString file() const { return folder_.filePath("schemes.json"); }

private slots:
    void initTestCase() { qputenv("EXTREMAL_SCHEMES", file().toUtf8()); }
    void cleanup() { QFile::remove(file()); }

    void everyCellOfOnesOwnIsAScheme_data() {
        QTest::addColumn<QByteArray>("cell");
        QTest::addColumn<QString>("space");
        QTest::addColumn<QString>("rule");
        QTest::newRow("own space") << QByteArray("own0.gauss") << "typed"
                                   << "gauss";
        QTest::newRow("own rule") << QByteArray("3.nodes") << "polynomial"
                                  << "nodes";
        QTest::newRow("both") << QByteArray("own0.nodes") << "typed"
                              << "nodes";
        QTest::newRow("splines, own rule") << QByteArray("spline2.nodes") << "spline"
                                           << "nodes";
    }
    void everyCellOfOnesOwnIsAScheme() {
        QFETCH(QByteArray, cell);
        QFETCH(QString, space);
        QFETCH(QString, rule);
        Window window;
        const std::size_t before = window.workspace().scene().schemes.size();
        QVERIFY(window.cell(cell) && window.cell(cell)->isEnabled());
        QVERIFY(window.cell(cell)->use() == DiscretizerCell::Use::none);
        QTest::mouseClick(window.cell(cell), Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes.size(), before + 1);
        QCOMPARE(QString::fromStdString(window.last().space.type), space);
        QCOMPARE(QString::fromStdString(window.last().quadrature.type), rule);
        QTRY_VERIFY(window.cell(cell)->use() == DiscretizerCell::Use::on);
        QVERIFY(window.own() && window.own()->isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QVERIFY2(window.own()->sketch().errors.empty(), qPrintable(window.said("ownProblem")));
        // Other formulas are still in this cell, which is theirs.
        QTest::mouseClick(window.cell(cell), Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes.size(), before + 1);
    }

    void theEditorSaysWhatIsTyped() {
        Window window;
        QTest::mouseClick(window.cell("own0.nodes"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QCOMPARE(window.own()->sketch().order, 6);
        QCOMPARE(window.own()->sketch().functions.all<Series>().size(), std::size_t{6});  // and dots at nodes
        QVERIFY(!window.own()->sketch().amplification.series().empty());
        const Figure& pattern = window.own()->sketch().pattern;
        QVERIFY(!pattern.series().empty());
        // Blocks have names, the first of them at the left and at the top.
        QVERIFY(pattern.x.ticks.size() >= 2 && pattern.x.ticks.size() == pattern.y.ticks.size());
        QCOMPARE(pattern.x.ticks.front().second, std::string("p₀"));
        QCOMPARE(pattern.y.ticks.front().second, std::string("p₀"));
        QVERIFY(pattern.x.ticks.front().first < pattern.x.ticks.back().first);
        QVERIFY(pattern.y.ticks.front().first > pattern.y.ticks.back().first);

        window.type("ownFunctionTexts", "1\ntau\ntau^2");
        window.type("ownNodes", "0\n1/2\n1");
        window.type("ownWeights", "1/6\n2/3\n1/6");
        QVERIFY(!window.own()->isCurrent());
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QCOMPARE(window.own()->sketch().order, 4);
        QVERIFY2(window.said("ownFacts").contains("below 2.83"), qPrintable(window.said("ownFacts")));
        const QString measured = window.said("ownMeasured");
        QVERIFY2(measured.contains("measured order 4.") || measured.contains("measured order 3.9"),
                 qPrintable(measured));

        window.type("ownFunctionTexts", "1\ntau\ncos(2*tau)\nsin(tau)^2");
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QVERIFY2(window.said("ownProblem").contains("follows from the others"),
                 qPrintable(window.said("ownProblem")));
        QVERIFY(!window.own()->findChild<QPushButton*>("ownApply")->isEnabled());

        window.type("ownFunctionTexts", "1\ntau\ntau^2");
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QCOMPARE(window.last().space.find("functions")->asArray().size(), std::size_t{4});  // not yet
        QTest::mouseClick(window.own()->findChild<QPushButton*>("ownApply"), Qt::LeftButton);
        QCOMPARE(window.last().space.find("functions")->asArray().size(), std::size_t{3});
        QVERIFY(waitForResults(window));
    }

    void aBaselineIsNoHindrance() {
        Window window("preset:harmonic-oscillator");
        window.workspace().selectScheme(4);
        window.actions().find("own")->trigger();
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QVERIFY(window.own()->sketch().errors.empty());
        QTest::mouseClick(window.own()->findChild<QPushButton*>("ownApply"), Qt::LeftButton);
        QCOMPARE(window.workspace().scene().schemes[4].space.type, std::string("typed"));
    }

    /// The editor begins with the selected scheme, and says so where it cannot.
    void theEditorBeginsWithTheScheme() {
        Window window("preset:harmonic-oscillator");
        const auto& schemes = window.workspace().scene().schemes;
        const auto open = [&](std::size_t i) {
            window.workspace().selectScheme(static_cast<int>(i));
            window.actions().find("own")->trigger();
            QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        };
        const auto text = [&](const char* field) {
            return window.own()->findChild<FormulaEdit*>(field)->toPlainText();
        };
        std::size_t named = 0;
        while (named < schemes.size() && schemes[named].kind != SchemeSpec::Kind::named) ++named;
        QVERIFY(named < schemes.size());
        const ResolvedScheme resolved = resolve(schemes[named]);
        const int degree = resolved.plain()->space.integer("degree");
        open(named);
        QCOMPARE(window.own()->sketch().order, resolved.claims.order);
        QVERIFY(window.own()->findChild<QLabel*>("ownExample")->isHidden());
        QCOMPARE(text("ownFunctionTexts").count('\n'), qsizetype(degree));
        // The same scheme, as functions and nodes that are typed.
        for (const char* box : {"ownSpace", "ownRule"}) {
            auto* choice = window.own()->findChild<QComboBox*>(box);
            choice->setCurrentIndex(0);
            emit choice->activated(0);
        }
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QVERIFY2(window.own()->sketch().errors.empty(), qPrintable(window.said("ownProblem")));
        QCOMPARE(window.own()->sketch().order, resolved.claims.order);
        QVERIFY(window.own()->findChild<QLabel*>("ownExample")->isHidden());
        open(4);  // a baseline
        QVERIFY(window.own()->findChild<QLabel*>("ownExample")->isVisible());
        QVERIFY(window.said("ownExample").contains(QString::fromStdString(schemes[4].label)));
    }

    void everyFamilyHasItsGrid_data() {
        QTest::addColumn<QByteArray>("preset");
        QTest::addColumn<QByteArray>("cell");
        QTest::newRow("oscillatory") << QByteArray("preset:spring-pendulum")
                                     << QByteArray("multiscale-r1.filon-lobatto");
        QTest::newRow("moving time") << QByteArray("preset:kepler-sem") << QByteArray("sem1.gauss");
        QTest::newRow("exact") << QByteArray("preset:lattice") << QByteArray("three-level1.exact");
        QTest::newRow("space-time") << QByteArray("preset:lattice") << QByteArray("space-time16.gauss");
    }
    void everyFamilyHasItsGrid() {
        QFETCH(QByteArray, preset);
        QFETCH(QByteArray, cell);
        Window window(preset);
        DiscretizerCell* const there = window.cell(cell);
        QVERIFY(there);
        QVERIFY2(there->isEnabled(), qPrintable(there->about()));
        const bool isUsed = findScheme(*window.workspace().resolved(), there->choice()) >= 0;
        QCOMPARE(there->use() != DiscretizerCell::Use::none, isUsed);
        if (isUsed) return;
        there->click();
        QCoreApplication::processEvents();  // the marks follow in the next turn
        QVERIFY2(findScheme(*window.workspace().resolved(), there->choice()) >= 0,
                 qPrintable(QString::fromStdString(writeCompactJson(window.workspace().document()))));
        // Nothing else is marked by it.
        int marked = 0;
        for (const DiscretizerCell* each : window.findChildren<DiscretizerCell*>())
            marked += each->use() != DiscretizerCell::Use::none &&
                      findScheme(*window.workspace().resolved(), each->choice()) ==
                          static_cast<int>(window.workspace().scene().schemes.size()) - 1;
        QCOMPARE(marked, 1);
    }

    void theStripSetsARuleForATerm() {
        Window window("preset:spring-pendulum");
        window.cell("2.gauss")->click();
        const int index = window.workspace().selectedScheme();
        SchemeCard* const card = window.findChild<SchemeCard*>(QString("scheme.%1").arg(index));
        card->setEditing(true);
        auto* const rule = card->findChild<QComboBox*>("term.slow");
        QVERIFY(rule);
        rule->setCurrentIndex(rule->findData("lobatto"));
        emit rule->activated(rule->currentIndex());
        const auto quadrature = [&] {
            return window.workspace().scene().schemes[static_cast<std::size_t>(index)].quadrature;
        };
        QVERIFY(isTermRule(quadrature()));
        QCOMPARE(termPart(quadrature(), "slow").type, std::string("lobatto"));
        QCOMPARE(termPart(quadrature(), otherTerms).type, std::string("gauss"));
        auto* const nodes = card->findChild<QSpinBox*>("nodes.slow");
        QVERIFY(nodes && nodes->isEnabled());
        nodes->setValue(4);
        QCOMPARE(termPart(quadrature(), "slow").integer("nodes"), 4);
        rule->setCurrentIndex(0);
        emit rule->activated(0);
        QCOMPARE(quadrature().type, std::string("gauss"));  // one rule again
    }

    void schemesAreKeptUnderNames() {
        Window window;
        QTest::mouseClick(window.cell("own0.gauss"), Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(window.own()->isCurrent(), 20000);
        QTest::mouseClick(window.own()->findChild<QPushButton*>("ownKeep"), Qt::LeftButton);
        auto* const list = window.findChild<OwnList*>("ownSchemes");
        QVERIFY(list && list->isVisible());
        QCOMPARE(list->schemes().names().size(), std::size_t{1});
        auto* const names = list->findChild<QListWidget*>();
        names->item(0)->setText("my quartic");
        QTRY_COMPARE(ownSchemes().names(), (std::vector<std::string>{"my quartic"}));
        QTest::mouseClick(list->findChild<QPushButton*>("ownAdd"), Qt::LeftButton);
        QCOMPARE(window.last().label, std::string("my quartic"));
        QCOMPARE(window.last().space.type, std::string("typed"));
        QVERIFY(list->exportTo(folder_.filePath("export.json")));
        QTest::mouseClick(list->findChild<QPushButton*>("ownRemove"), Qt::LeftButton);
        QVERIFY(ownSchemes().names().empty());
        QVERIFY(list->importFrom(folder_.filePath("export.json")));
        QCOMPARE(ownSchemes().names(), (std::vector<std::string>{"my quartic"}));
    }

    void catalogueNamesItsFaultsAndLosesNothing() {
        const std::string broken = R"({"label": "", "space": {"type": "polynomial"}})",
                          twice = R"({"label": "fitted", "baseline": "rk4"})", other = R"({"note": [1, 2]})";
        OwnSchemes all =
            OwnSchemes::parse(catalogueOf(std::string(fitted) + "," + broken + "," + twice + "," + other));
        QCOMPARE(all.names(), (std::vector<std::string>{"fitted"}));
        QCOMPARE(all.faults().size(), std::size_t{3});
        QCOMPARE(all.faults()[0].pointer, std::string("/schemes/1/label"));
        QCOMPARE(all.faults()[1].pointer, std::string("/schemes/2/label"));
        QCOMPARE(all.faults()[2].pointer, std::string("/schemes/3"));
        all.add("another", parseJson(fitted));
        all.rename("fitted", "trigonometric");
        const OwnSchemes again = OwnSchemes::parse(all.text());
        QCOMPARE(again.names(), (std::vector<std::string>{"trigonometric", "fitted", "another"}));
        for (const std::string& kept : {broken, twice, other})
            QVERIFY(all.text().find(writeCompactJson(parseJson(kept)).substr(1, 12)) != std::string::npos);
        QVERIFY(problemOf([&] { all.add("another", parseJson(fitted)); }).contains("is taken already"));
        QVERIFY(problemOf([&] { all.add(" ", parseJson(fitted)); }).contains("is empty"));
        QVERIFY(problemOf([] { (void)OwnSchemes::parse("[1]"); }).contains("not a catalogue"));

        write(file(), "no JSON");
        QVERIFY(problemOf([&] { (void)OwnSchemes::load(ownSchemesFile()); }).contains(file()));
        Window window;
        window.actions().find("ownSchemes")->trigger();
        auto* const list = window.findChild<OwnList*>("ownSchemes");
        QVERIFY(list->findChild<QLabel*>("ownFaults")->text().contains("schemes.json"));
        list->keep(parseJson(fitted));
        QCOMPARE(contentOf(file()), QByteArray("no JSON"));
        QVERIFY(std::any_of(window.notices().all().begin(), window.notices().all().end(),
                            [](const Notice& n) { return n.key == "ownSchemes"; }));
    }
};

EXTREMAL_TEST(OwnTest)

}  // namespace extremal::own_test

#include "own_test.moc"
