// SPDX-License-Identifier: GPL-3.0-or-later
/// The discretizer: what each family of the model offers side by side (family/choices.hpp), usually function
/// spaces as rows and quadratures as columns, and one's own functions and nodes last. A cell says which
/// scheme the discretization is and its order; a click adds it to the comparison. Unsupported combinations
/// are grey. A strip below the cells, which stays in sight, says what the one is that is pointed at, or why
/// it is not a scheme; cells in use have the colour of their scheme. Where the cells are wide they are named
/// in words. Once it has been measured what the wanted error costs with each, the cheap ones are darker.
#pragma once

#include <QAbstractButton>
#include <QTimer>

#include <optional>
#include <vector>

#include "engine/family/choices.hpp"
#include "ui/base/card.hpp"
#include "ui/workspace/fitting.hpp"

class QGridLayout;
class QLabel;
class QPushButton;

namespace extremal {

struct Theme;
class SidewaysArea;
class Workspace;

/// What the wanted error costs with a cell.
struct CellCost {
    double seconds = 0;  ///< 0: not reached
    double times = 0;    ///< over the cheapest cell
    QString words;       ///< for the strip
};

/// One cell: a discretization.
class DiscretizerCell : public QAbstractButton {
    Q_OBJECT
public:
    DiscretizerCell(ChoiceGrid::Cell choice, const Properties& known, QWidget* parent = nullptr);

    const ChoiceGrid::Cell& choice() const { return choice_; }
    const Settings& space() const { return choice_.discretization.space; }
    const Settings& quadrature() const { return choice_.discretization.quadrature; }
    void setTheme(const Theme& theme);
    /// Whether a scheme of the scene is this discretization, and whether it is switched on: filled with its
    /// colour, or outlined.
    enum class Use { none, off, on };
    void setUse(Use use, int style);
    Use use() const { return use_; }
    /// Its ground becomes darker the cheaper it is; nothing: not measured.
    void setCost(std::optional<CellCost> cost);
    const std::optional<CellCost>& cost() const { return cost_; }
    /// "Gauss 2, order 4".
    const QString& words() const { return words_; }
    /// What there is to say of it, as rich text: name, order, properties, or why it is not a scheme.
    const QString& about() const { return about_; }
    QSize sizeHint() const override { return {34, 23}; }
    QSize minimumSizeHint() const override { return {24, 23}; }

signals:
    void pointedAt(bool isPointedAt);  ///< by the mouse, or with the focus of the keyboard

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    void paintText(QPainter& painter, const QColor& colour) const;
    QString wordsOf(const Properties& known) const;
    QString textAbout(const Properties& known) const;

    ChoiceGrid::Cell choice_;
    QString about_, words_;
    std::optional<CellCost> cost_;
    Use use_ = Use::none;
    int style_ = 0;
    const Theme* theme_ = nullptr;
};

class Discretizer : public Card {
    Q_OBJECT
public:
    explicit Discretizer(Workspace& workspace, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    DiscretizerCell* cell(int degree, const QString& rule) const;
    /// Whether the cells are those of the scene's model; they are looked for in the background.
    bool isCurrent() const;
    const std::vector<DiscretizerCell*>& cells() const { return cells_; }
    /// Switches the shading by costs on or off; pressed by the user, it tells costsWanted().
    QPushButton& costs() const { return *costs_; }
    /// The third choice beside space and rule: while it is pressed, cells keep the energy in place of the
    /// symplectic form.
    QPushButton& energy() const { return *energy_; }
    /// What the strip says while no cell is pointed at, in place of the usual words; empty: those.
    void setStripText(const QString& text);

signals:
    void filled();  ///< with other cells
    /// A cell of one's own functions or nodes was clicked, and its scheme is selected: they are to be typed.
    void ownChosen();

private:
    void refresh();
    void look();
    void take(const Settings& model, std::vector<DescribedGrid> offered);
    void fill();
    void addGrid(const DescribedGrid& offered, QGridLayout& grid);
    void showUses();
    void choose(const DiscretizerCell& cell);
    void showAbout(const DiscretizerCell* cell);

    Workspace& workspace_;
    std::vector<DiscretizerCell*> cells_;
    Settings model_;                      ///< that the cells are of
    std::vector<DescribedGrid> offered_;  ///< what the cells show
    bool isLooking_ = false;
    QTimer later_;
    SidewaysArea* room_;  ///< with large letters the columns need more than a narrow panel has
    QWidget* grid_ = nullptr;
    QLabel* about_;  ///< of the cell that is pointed at
    QPushButton *costs_, *energy_;
    QString strip_;
    const Theme* theme_ = nullptr;
};

}  // namespace extremal
