// SPDX-License-Identifier: GPL-3.0-or-later
/// Small windows and large letters: no word and no control is cut.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QSplitter>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QTest>
#include <QTextDocument>

#include <algorithm>
#include <cmath>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/panels/scheme_list.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::small_window_test {
namespace {

/// Words of a label that is wrapped or not: the widest, in pixels.
double widestWord(const QLabel& label) {
    QString text = label.text();
    if (label.textFormat() == Qt::RichText || Qt::mightBeRichText(text)) {
        QTextDocument document;
        document.setHtml(text);
        text = document.toPlainText();
    }
    double widest = 0;
    const QStringList words = label.wordWrap() ? text.simplified().split(' ') : text.split('\n');
    for (const QString& word : words)
        widest = std::max(widest, QFontMetricsF(label.font()).horizontalAdvance(word));
    return widest;
}

/// What is cut in a window, each with its text.
QStringList cutIn(QWidget& window) {
    QStringList cut;
    for (const QLabel* label : window.findChildren<QLabel*>()) {
        if (!label->isVisible() || label->text().isEmpty()) continue;
        const bool givesWay = label->minimumSizeHint().width() < 40 || label->inherits("QTipLabel");
        if (givesWay && !label->hasHeightForWidth()) continue;  // it has an ellipsis of its own
        const int width = label->contentsRect().width();
        const bool breaksWords = label->hasHeightForWidth() && !label->wordWrap();
        const bool isWide = !givesWay && !breaksWords && widestWord(*label) > width + 1.5;
        const bool isHigh =
            label->hasHeightForWidth() && label->heightForWidth(label->width()) > label->height() + 1;
        if (isWide || isHigh)
            cut << QString("%1 (%2 px of %3)").arg(label->text()).arg(width).arg(widestWord(*label));
    }
    for (const QAbstractButton* button : window.findChildren<QAbstractButton*>())
        if (button->isVisible() && !button->text().isEmpty() &&
            QFontMetricsF(button->font()).horizontalAdvance(QString(button->text()).remove('&')) >
                button->width())
            cut << button->text();
    // Fields of names, whose width is fixed, hold them.
    for (const QLineEdit* edit : window.findChildren<QLineEdit*>())
        if (edit->isVisible() && edit->property("room") == "name" &&
            QFontMetricsF(edit->font()).horizontalAdvance(edit->text()) > edit->contentsRect().width())
            cut << edit->text();
    for (const QComboBox* box : window.findChildren<QComboBox*>())
        if (box->isVisible() && !dynamic_cast<const ComboBox*>(box)) cut << box->currentText();
    return cut;
}

}  // namespace

class SmallWindowTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }
    void cleanup() { applyTheme(*qApp, Theme::light()); }

    void noWordIsCut_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QSize>("size");
        QTest::addColumn<double>("scale");
        for (const char* preset : {"spring-pendulum", "kepler-sem", "coherent-state", "bar-notch",
                                   "satellite", "elliptic", "double-slit", "forced-pendulum"})
            for (const auto& [size, scale] : {std::pair{QSize(800, 600), 1.0},
                                              {QSize(1024, 700), 1.0},
                                              {QSize(1024, 700), 1.6},
                                              {QSize(1600, 1000), 1.0},
                                              {QSize(1600, 1000), 1.6}})
                QTest::addRow("%s %d %.1f", preset, size.width(), scale) << preset << size << scale;
    }
    void noWordIsCut() {
        QFETCH(QString, preset);
        QFETCH(QSize, size);
        QFETCH(double, scale);
        Theme theme = Theme::light();
        theme.fontScale = scale;
        applyTheme(*qApp, theme);
        MainWindow window(theme, false);
        window.resize(size);
        window.show();
        QVERIFY(window.open("preset:" + preset));
        for (int i = 0; i < 30; ++i) QCoreApplication::processEvents();
        const QStringList cut = cutIn(window);
        QVERIFY2(cut.isEmpty(), qPrintable(cut.join(" | ")));
        // The panels stand side by side, and inside the window.
        const auto* splitter = window.findChild<QSplitter*>();
        for (int i = 0; i < splitter->count(); ++i) {
            const QRect here = splitter->widget(i)->geometry();
            const int end = i + 1 < splitter->count() ? splitter->widget(i + 1)->x() : splitter->width();
            QVERIFY2(here.x() + here.width() <= end,
                     qPrintable(QString("%1: %2 + %3 > %4").arg(i).arg(here.x()).arg(here.width()).arg(end)));
        }
        QVERIFY(splitter->width() <= window.width());
        // The panel of the scene is as wide as its fields; a body in space, with vectors and their units, has
        // room for large letters from 1100 pixels on, and scrolls below.
        if (size.width() < 1024 || (preset.endsWith("satellite") && size.width() < 1100 && scale > 1)) return;
        const auto* panel = splitter->widget(0)->findChild<QScrollArea*>();
        QVERIFY(panel);
        QVERIFY2(panel->horizontalScrollBar()->maximum() == 0,
                 qPrintable(QString("%1 px too wide").arg(panel->horizontalScrollBar()->maximum())));
    }
    /// Cards of schemes are as wide as their panel, also where the scheme is edited.
    void editorsFitTheirPanel_data() {
        QTest::addColumn<QString>("preset");
        for (const char* preset :
             {"compositions", "kepler", "kepler-sem", "multiscale-modes", "coherent-state", "bar-notch",
              "satellite", "elliptic", "born-infeld", "averaged-rotations", "free-knots", "sine-gordon-kink",
              "henon-heiles", "vortices"})
            QTest::addRow("%s", preset) << preset;
    }
    void editorsFitTheirPanel() {
        QFETCH(QString, preset);
        MainWindow window(Theme::light(), false);
        window.resize(1280, 800);
        window.show();
        QVERIFY(window.open("preset:" + preset));
        const auto* cards = window.findChild<SchemeList*>()->findChild<QScrollArea*>();
        QVERIFY(cards);
        const int schemes = static_cast<int>(window.workspace().scene().schemes.size());
        for (int i = 0; i < schemes; ++i) {
            SchemeCard* const card = window.findChild<SchemeList*>()->card(i);
            card->setEditing(true);
            for (int k = 0; k < 30; ++k) QCoreApplication::processEvents();
            const int needed = cards->widget()->minimumSizeHint().width(), room = cards->viewport()->width();
            QVERIFY2(needed <= room,
                     qPrintable(QString("scheme %1: %2 px in %3").arg(i).arg(needed).arg(room)));
            card->setEditing(false);
        }
    }
    /// Names have as many lines as they need, and single long words go on in the next.
    void longNamesOfSchemesAreWhole() {
        MainWindow window(Theme::light(), false);
        window.resize(800, 600);
        window.show();
        QVERIFY(window.open("preset:pendulum"));
        const std::string longName = "Galerkin-Lobatto-of-the-twenty-fourth-degree-with-Gauss-points",
                          longWord = std::string(60, 'W');
        QVERIFY(window.workspace().edit({{"/schemes/0/label", longName}, {"/schemes/1/label", longWord}},
                                        "name"));
        for (int i = 0; i < 30; ++i) QCoreApplication::processEvents();
        QVERIFY(cutIn(window).isEmpty());
        for (const std::string& name : {longName, longWord}) {
            QLabel* label = nullptr;
            for (QLabel* each : window.findChildren<QLabel*>())
                if (each->text().toStdString() == name && qobject_cast<SchemeCard*>(each->parentWidget()))
                    label = each;
            QVERIFY(label && label->isVisible());
            QVERIFY(label->height() >= 2 * label->fontMetrics().height());
            // All of it is painted: as many dark pixels as on one line, but for what is blended at the edges.
            const auto ink = [](QLabel& of, int width, int height) {
                of.resize(width, height);
                QImage image(width, height, QImage::Format_RGB32);
                image.fill(Qt::white);
                of.render(&image, {}, {}, {});
                double sum = 0;
                for (int y = 0; y < image.height(); ++y)
                    for (int x = 0; x < image.width(); ++x) sum += 255 - qGray(image.pixel(x, y));
                return sum;
            };
            QLabel* alone = makeWrappedLabel(label->text(), "strong");
            const double inLines = ink(*alone, label->width(), alone->heightForWidth(label->width()));
            const double inOne = ink(*alone, 2000, alone->heightForWidth(2000));
            delete alone;
            QVERIFY2(std::abs(inLines / inOne - 1) < 0.25, qPrintable(QString::number(inLines / inOne)));
        }
    }
    void aBoxWithoutRoomEndsInAnEllipsis() {
        ComboBox box;
        box.addItem("elliptic problem with a fast coefficient");
        box.resize(120, 28);
        box.show();
        (void)box.grab();
        QCOMPARE(box.toolTip(), box.currentText());
        box.resize(500, 28);
        (void)box.grab();
        QVERIFY(box.toolTip().isEmpty());
    }
};

EXTREMAL_TEST(SmallWindowTest)
}  // namespace extremal::small_window_test

#include "small_window_test.moc"
