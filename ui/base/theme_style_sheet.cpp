// SPDX-License-Identifier: GPL-3.0-or-later
/// The one style sheet. It is a template: @name stands for a colour of the theme, @Npx for N pixels times the
/// font scale, @mode for the variant of an icon.
#include "ui/base/theme.hpp"

#include <QRegularExpression>
#include <cmath>

namespace extremal {
namespace {

constexpr const char* textsAndGrounds = R"(
* { outline: none; }
QMainWindow, QDialog, QWidget[ground="window"] { background: @window; }
QWidget[ground="panel"] { background: @panel; }
QLabel { background: transparent; }
QLabel[role="heading"] { font-size: @14px; font-weight: 600; }
QLabel[role="title"] { font-size: @13px; font-weight: 600; }
QLabel[role="strong"] { font-weight: 600; }
QLabel[role="caption"] { font-size: @11px; color: @muted; }
QLabel[problem="true"] { color: @error; }
QFrame[card="true"] { background: @panel; border: 1px solid @cardLine; border-radius: 8px; }
QFrame[card="true"][selected="true"] { border: 2px solid @accent; }
QFrame[banner="information"] { background: @panel; border: 1px solid @accent; border-radius: 8px; }
QFrame[banner="warning"] { background: @warningGround; border: 1px solid @warningLine; border-radius: 8px; }
QFrame[banner="error"] { background: @errorGround; border: 1px solid @errorLine; border-radius: 8px; }
QFrame[banner="error"] QLabel[role="strong"] { color: @error; }
QToolTip { background: @panel; color: @text; border: 1px solid @line; padding: 4px 6px; font-size: @11px; }
)";

constexpr const char* buttons = R"(
QPushButton { background: @panel; color: @text; border: 1px solid @line; border-radius: 6px; padding: 5px 12px; }
QAbstractScrollArea::corner { background: transparent; border: none; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QPushButton:hover { background: @field; }
QPushButton:pressed { background: @selection; }
QPushButton:checked { background: @selection; border-color: @accent; }
QPushButton:focus { border-color: @accent; }
QPushButton:disabled { color: @muted; background: @window; }
QPushButton[kind="primary"] { background: @accent; color: @onAccent; border-color: @accent; font-weight: 600; }
QPushButton[kind="primary"]:hover { background: @accentHover; }
QPushButton[kind="primary"]:disabled { background: @line; border-color: @line; color: @muted; }
QPushButton[kind="flat"] { background: transparent; border-color: transparent; color: @muted; padding: 3px 6px; }
QPushButton[kind="flat"]:hover { background: @field; color: @text; }
QPushButton[kind="flat"]:focus { border-color: @accent; }
QPushButton[kind="chip"] { background: @selection; color: @text; border: none; border-radius: 8px; padding: 1px 8px;
    font-size: @11px; }
QPushButton[kind="chip"]:hover, QPushButton[kind="chip"]:focus { background: @accent; color: @onAccent; }
QToolButton { background: transparent; color: @text; border: 1px solid transparent; border-radius: 6px; padding: 4px 8px; }
QToolButton:hover { background: @field; }
QToolButton:pressed, QToolButton:checked { background: @selection; }
QToolButton:focus { border-color: @accent; }
QToolButton:disabled { color: @muted; }
QToolButton::menu-indicator { image: none; }
QToolButton[kind="dots"] { padding: 0; }
QCheckBox, QRadioButton { background: transparent; spacing: 7px; }
QCheckBox::indicator, QRadioButton::indicator { width: 14px; height: 14px; border: 1px solid @control; background: @panel; }
QCheckBox::indicator { border-radius: 4px; }
QRadioButton::indicator { border-radius: 8px; }
QCheckBox::indicator:hover, QRadioButton::indicator:hover,
QCheckBox:focus::indicator, QRadioButton:focus::indicator { border-color: @accent; }
QCheckBox::indicator:checked { background: @accent; border-color: @accent; image: url(:/icons/check-@mode.svg); }
QCheckBox[invalid="true"]::indicator { border-color: @error; }
QRadioButton::indicator:checked { background: @panel; border: 5px solid @accent; width: 6px; height: 6px; }
)";

constexpr const char* inputs = R"(
QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox {
    background: @field; color: @text; border: 1px solid transparent; border-radius: 5px; padding: 4px 8px;
    selection-background-color: @accent; selection-color: @onAccent; }
QLineEdit:hover, QSpinBox:hover, QDoubleSpinBox:hover, QComboBox:hover { border-color: @line; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus, QComboBox:on { border-color: @accent; }
QLineEdit[invalid="true"], QSpinBox[invalid="true"], QDoubleSpinBox[invalid="true"], QComboBox[invalid="true"] {
    border-color: @error; background: @errorGround; }
QLineEdit:disabled, QSpinBox:disabled, QDoubleSpinBox:disabled, QComboBox:disabled { color: @muted; background: @window; }
QComboBox { padding-right: 24px; }
QComboBox::drop-down { border: none; width: 22px; }
QComboBox::down-arrow { image: url(:/icons/chevron-down-@mode.svg); width: 12px; height: 12px; }
QComboBox QAbstractItemView { background: @panel; color: @text; border: 1px solid @line; padding: 4px;
    selection-background-color: @selection; selection-color: @text; }
QComboBox QAbstractItemView::item { min-height: 24px; }
QSpinBox::up-button, QDoubleSpinBox::up-button, QSpinBox::down-button, QDoubleSpinBox::down-button {
    border: none; background: transparent; width: 18px; }
QSpinBox::up-arrow, QDoubleSpinBox::up-arrow { image: url(:/icons/chevron-up-@mode.svg); width: 10px; height: 10px; }
QSpinBox::down-arrow, QDoubleSpinBox::down-arrow {
    image: url(:/icons/chevron-down-@mode.svg); width: 10px; height: 10px; }
QPlainTextEdit, QTextEdit, QTextBrowser { background: @panel; color: @text; border: 1px solid @cardLine; border-radius: 6px;
    selection-background-color: @accent; selection-color: @onAccent; }
QPlainTextEdit:focus, QTextEdit:focus { border-color: @accent; }
QTextBrowser[fitted="true"] { background: transparent; border: none; border-radius: 0; }
QPlainTextEdit[role="formula"] { font-size: @12px; }
QLineEdit[room="name"] { min-width: @46px; max-width: @46px; }
QWidget[room="value"] { min-width: @56px; max-width: @84px; }
QLineEdit[room="step"] { min-width: @68px; max-width: @68px; }
QPushButton[room="play"] { min-width: @34px; max-width: @34px; }
QToolButton[room="mark"] { min-width: @18px; max-width: @18px; padding: 0; }
QWidget[room="side"] { min-width: @210px; max-width: @210px; }
QPlainTextEdit[invalid="true"] { border-color: @error; background: @errorGround; }
QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: @line; }
QSlider::sub-page:horizontal { height: 4px; border-radius: 2px; background: @accent; }
QSlider::handle:horizontal { width: 12px; height: 12px; margin: -4px 0; border-radius: 6px; background: @accent; }
QSlider::handle:horizontal:hover, QSlider::handle:horizontal:focus { width: 14px; height: 14px; margin: -5px 0;
    border-radius: 7px; background: @accentHover; }
QSlider::sub-page:horizontal:disabled, QSlider::handle:horizontal:disabled { background: @line; }
QProgressBar { background: @grid; border: none; border-radius: 2px; max-height: 4px; min-height: 4px; }
QProgressBar::chunk { background: @accent; border-radius: 2px; }
)";

constexpr const char* containers = R"(
QMenuBar { background: @panel; color: @text; padding: 2px 6px; }
QMenuBar::item { background: transparent; padding: 4px 9px; border-radius: 5px; }
QMenuBar::item:selected { background: @field; }
QMenu { background: @panel; color: @text; border: 1px solid @line; padding: 5px; }
QMenu::item { padding: 5px 26px 5px 24px; border-radius: 5px; }
QMenu::item:selected { background: @selection; color: @text; }
QMenu::item:disabled { color: @muted; }
QMenu::separator { height: 1px; background: @grid; margin: 5px 8px; }
QToolBar { background: @panel; border: none; border-bottom: 1px solid @cardLine; padding: 7px 12px; spacing: 7px; }
QToolBar::separator { width: 1px; background: @grid; margin: 4px 6px; }
QStatusBar { background: @panel; color: @muted; border-top: 1px solid @cardLine; font-size: @11px; }
QStatusBar::item { border: none; }
QStatusBar QLabel { color: @muted; font-size: @11px; }
QTabWidget::pane { border: none; }
QTabBar { background: transparent; qproperty-drawBase: 0; }
QTabBar::tab { background: transparent; color: @muted; padding: 8px 16px; border: none; border-bottom: 1px solid @line; }
QTabBar::tab:hover { color: @text; }
QTabBar::tab:selected { color: @text; font-weight: 600; border-bottom: 2px solid @accent; }
QTabBar::tab:focus { color: @accent; }
QDockWidget { titlebar-close-icon: none; titlebar-normal-icon: none; font-weight: 600; }
QDockWidget::title { background: @window; padding: 8px 12px; text-align: left; }
QMainWindow::separator { background: @window; width: 5px; height: 5px; }
QMainWindow::separator:hover { background: @line; }
QSplitter::handle { background: transparent; }
QSplitter::handle:hover { background: @line; }
QScrollArea, QScrollArea > QWidget > QWidget[ground="window"] { background: transparent; border: none; }
QScrollBar { background: transparent; border: none; }
QScrollBar:vertical { width: 10px; }
QScrollBar:horizontal { height: 10px; }
QScrollBar::handle { background: @line; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::handle:hover { background: @muted; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QGroupBox { border: none; margin-top: 18px; font-weight: 600; }
QGroupBox::title { subcontrol-origin: margin; left: 0; }
)";

constexpr const char* itemViews = R"(
QAbstractItemView { background: @panel; color: @text; alternate-background-color: @field; border: none;
    selection-background-color: @selection; selection-color: @text; }
QListView::item, QTreeView::item, QTableView::item { padding: 3px 6px; border: none; }
QListView::item:hover, QTreeView::item:hover { background: @field; }
QListView::item:selected, QTreeView::item:selected, QTableView::item:selected { background: @selection; color: @text; }
QTableView { gridline-color: @grid; }
QHeaderView, QHeaderView::section { background: @panel; }
QHeaderView::section { color: @muted; border: none; border-bottom: 1px solid @cardLine; padding: 4px 6px;
    font-size: @11px; }
QTableCornerButton::section { background: @panel; border: none; }
)";

}  // namespace

QString Theme::styleSheet() const {
    const QHash<QString, QString> names = {
        {"window", window.name()},
        {"panel", panel.name()},
        {"field", field.name()},
        {"text", text.name()},
        {"muted", muted.name()},
        {"grid", grid.name()},
        {"line", line.name()},
        {"accent", accent.name()},
        {"onAccent", onAccent.name()},
        {"selection", selection.name()},
        {"warning", warning.name()},
        {"warningGround", warningGround.name()},
        {"warningLine", warningLine.name()},
        {"error", error.name()},
        {"errorGround", errorGround.name()},
        {"errorLine", errorLine.name()},
        {"good", good.name()},
        {"cardLine", isDark ? grid.name() : QStringLiteral("#dfe3e8")},
        {"control", isDark ? QStringLiteral("#66717f") : QStringLiteral("#8a939e")},
        {"accentHover", isDark ? accent.lighter(112).name() : accent.darker(112).name()},
        {"mode", isDark ? QStringLiteral("dark") : QStringLiteral("light")}};
    static const QRegularExpression token(QStringLiteral("@(?:(\\d+)px|([A-Za-z]+))"));
    const QString source = QLatin1String(textsAndGrounds) + QLatin1String(buttons) + QLatin1String(inputs) +
                           QLatin1String(containers) + QLatin1String(itemViews);
    QString result;
    qsizetype done = 0;
    for (auto it = token.globalMatch(source); it.hasNext();) {
        const QRegularExpressionMatch match = it.next();
        result += source.mid(done, match.capturedStart() - done);
        done = match.capturedEnd();
        if (match.hasCaptured(1))
            result +=
                QString::number(std::lround(match.captured(1).toInt() * fontScale)) + QStringLiteral("px");
        else if (names.contains(match.captured(2)))
            result += names.value(match.captured(2));
        else
            qFatal("The style sheet names an unknown colour: @%s", qPrintable(match.captured(2)));
    }
    return result + source.mid(done);
}

}  // namespace extremal
