// SPDX-License-Identifier: GPL-3.0-or-later
/// Every control has a name that a screen reader can say, in all windows and kinds of scenes.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QTest>
#include <QTextEdit>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/notices.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::names_test {
namespace {

/// "QLineEdit in SchemeCard in ...": where a control without a name is.
QString placeOf(const QWidget& widget) {
    QString place = widget.metaObject()->className();
    for (const QWidget* w = widget.parentWidget(); w; w = w->parentWidget())
        place += QStringLiteral(" in %1").arg(w->metaObject()->className());
    return place;
}

bool isControl(const QWidget& w) {
    if (w.inherits("QScrollBar") || w.inherits("QComboBoxPrivateContainer") || w.inherits("QHeaderView"))
        return false;
    if (qobject_cast<const QComboBox*>(w.parentWidget()) ||
        qobject_cast<const QAbstractSpinBox*>(w.parentWidget()))
        return false;  // the line of a box, which has the name
    return w.inherits("QAbstractButton") || w.inherits("QLineEdit") || w.inherits("QComboBox") ||
           w.inherits("QAbstractSpinBox") || w.inherits("QAbstractSlider") ||
           w.inherits("QAbstractItemView") || w.inherits("QTextEdit") || w.inherits("QPlainTextEdit") ||
           qobject_cast<const PlotWidget*>(&w) || qobject_cast<const StageWidget*>(&w) ||
           (w.focusPolicy() & Qt::TabFocus) != 0;
}

QStringList namelessIn(const QWidget& window) {
    QStringList found;
    for (const QWidget* w : window.findChildren<QWidget*>()) {
        if (!w->isVisibleTo(&window) || !isControl(*w)) continue;
        QAccessibleInterface* const face = QAccessible::queryAccessibleInterface(const_cast<QWidget*>(w));
        const QString name = face ? face->text(QAccessible::Name).trimmed() : QString();
        if (name.isEmpty() || name.contains('<')) found << placeOf(*w) + ' ' + name;
    }
    return found;
}

}  // namespace

class NamesTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }
    void everyControlHasAName_data() {
        QTest::addColumn<QString>("preset");
        for (const char* preset :
             {"pendulum", "kepler-sem", "coherent-state", "bar-notch", "satellite", "elliptic",
              "schrodinger-seed", "spring-pendulum-cartesian", "henon-heiles"})
            QTest::newRow(preset) << preset;
    }
    void everyControlHasAName() {
        QFETCH(QString, preset);
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:" + preset));
        QVERIFY(waitForResults(window));
        // With the editor and the discretizer of the scheme open.
        window.workspace().selectScheme(0);
        window.actions().find("rename")->trigger();
        for (const char* page : {"compare", "notes", "studies"}) {
            window.actions().find(page)->trigger();
            QCoreApplication::processEvents();
            const QStringList nameless = namelessIn(window);
            QVERIFY2(nameless.isEmpty(), qPrintable(page + (": " + nameless.join("\n"))));
        }
    }
    /// What is only said by its place or its colour.
    void positionsAndBannersAreSaid() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        const auto said = [](QWidget* widget, QAccessible::Text what) {
            return QAccessible::queryAccessibleInterface(widget)->text(what);
        };
        for (QSlider* slider : window.findChildren<QSlider*>()) {
            const QString name = said(slider, QAccessible::Name);
            if (name == "Time") QVERIFY(said(slider, QAccessible::Description).contains("60 s"));
            if (name == "Wanted error") QVERIFY(said(slider, QAccessible::Description).startsWith("1e-6"));
        }
        QStringList switches;
        for (const SchemeCard* card : window.findChildren<SchemeCard*>())
            for (QAbstractButton* button : card->findChildren<QAbstractButton*>())
                if (const QString name = said(button, QAccessible::Name); name.startsWith("Switch"))
                    switches << name;
        QCOMPARE(switches.size(), 4);
        QVERIFY(switches.contains("Switch Galerkin Gauss 4 on or off"));

        window.notices().post({Notice::Kind::error, "one", "The first one", "try this", {}});
        const auto banners = [&] {
            QList<QAccessible::Role> roles;
            for (QFrame* frame : window.findChildren<QFrame*>())
                if (frame->property("banner").isValid() && frame->isVisible())
                    roles << QAccessible::queryAccessibleInterface(frame)->role();
            return roles;
        };
        QCOMPARE(banners(), QList<QAccessible::Role>{QAccessible::AlertMessage});
        window.notices().post({Notice::Kind::warning, "two", "The second one", {}, {}});
        QTRY_COMPARE(banners().size(), 2);
        QCOMPARE(banners().count(QAccessible::AlertMessage), 1);  // what was said is not said again
    }
    void windowsBesideHaveNames() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        QVERIFY(namelessIn(window).isEmpty());  // the start page
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.workspace().selectScheme(0);
        for (const char* id : {"help", "log", "passport", "inspect", "own", "race", "perturb", "palette"}) {
            QAction* const action = window.actions().find(id);
            QVERIFY2(action, id);
            action->trigger();
            QCoreApplication::processEvents();
        }
        int windows = 0;
        for (const QWidget* top : QApplication::topLevelWidgets()) {
            if (!top->isVisible() || top->inherits("QTipLabel")) continue;
            ++windows;
            const QStringList nameless = namelessIn(*top);
            QVERIFY2(nameless.isEmpty(), qPrintable(top->windowTitle() + ": " + nameless.join("\n")));
            QVERIFY2(!top->windowTitle().isEmpty(), top->metaObject()->className());
        }
        QVERIFY2(windows >= 8, qPrintable(QString::number(windows)));
    }
};

EXTREMAL_TEST(NamesTest)

}  // namespace extremal::names_test

#include "names_test.moc"
