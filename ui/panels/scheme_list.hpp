// SPDX-License-Identifier: GPL-3.0-or-later
/// The right column: all schemes of the comparison, and the menu to add more.
#pragma once

#include <QWidget>
#include <vector>

#include "engine/core/value.hpp"

class QMenu;
class QPushButton;
class QVBoxLayout;

namespace extremal {

class ColumnArea;
class RunControl;
class SchemeCard;
struct Theme;
class Workspace;

class SchemeList : public QWidget {
    Q_OBJECT
public:
    SchemeList(Workspace& workspace, RunControl& run, const Theme& theme, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    SchemeCard* card(int index) const;
    /// As wide as its cards ask for, an open editor among them, within these limits, in pixels.
    void setWidths(int least, int most);
    /// Below the schemes, where it stays in sight while they scroll.
    void addFoot(QWidget* foot);

    void openAddMenu();
    /// Adds it to the scene and selects it.
    void add(const Value& scheme);
    /// Gives a row the focus, and so selects it.
    void focusRow(int index);
    bool closeEditors();  ///< false if none was open
    void editSelected();
    void renameSelected();
    /// Selects a scheme and opens its step, or its tolerance, for typing.
    void editStep(int index);
    void duplicateSelected();
    void soloSelected();
    void removeSelected();
    void moveSelected(int by);
    void toggle(int index);

protected:
    void mousePressEvent(QMouseEvent* event) override;

signals:
    void catalogueRequested();  ///< the window of the user's own schemes

private:
    void rebuild();
    void showResults();
    void showSelection();
    void fillAddMenu();

    Workspace& workspace_;
    RunControl& run_;
    const Theme* theme_;
    QPushButton* addButton_;
    QMenu* addMenu_;
    QVBoxLayout* cardsLayout_;
    ColumnArea* scroll_;
    std::vector<SchemeCard*> cards_;
};

}  // namespace extremal
