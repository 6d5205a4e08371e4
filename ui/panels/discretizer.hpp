/// The discretizer: what the family of the model offers side by side (family/choices.hpp), usually function
/// spaces as rows and quadratures as columns. A cell says which scheme the discretization is and its order; a
/// click adds it to the comparison. Unsupported combinations are grey and say why.
#pragma once

#include <QAbstractButton>
#include <string>
#include <vector>

#include "engine/family/choices.hpp"
#include "ui/panels/card.hpp"

class QGridLayout;

namespace extremal {

struct Theme;
class Workspace;

/// One cell: a discretization.
class DiscretizerCell : public QAbstractButton {
    Q_OBJECT
public:
    explicit DiscretizerCell(ChoiceGrid::Cell choice, QWidget* parent = nullptr);

    const Settings& space() const { return choice_.discretization.space; }
    const Settings& quadrature() const { return choice_.discretization.quadrature; }
    void setTheme(const Theme& theme);
    /// Whether a scheme of the scene is this discretization, and whether it is switched on: filled, or
    /// outlined.
    enum class Use { none, off, on };
    void setUse(Use use);
    Use use() const { return use_; }
    QSize sizeHint() const override { return {34, 23}; }
    QSize minimumSizeHint() const override { return {26, 23}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString tooltip(const Properties& known) const;

    ChoiceGrid::Cell choice_;
    Use use_ = Use::none;
    const Theme* theme_ = nullptr;
};

class Discretizer : public Card {
    Q_OBJECT
public:
    explicit Discretizer(Workspace& workspace, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    DiscretizerCell* cell(int degree, const QString& rule) const;

private:
    void fill(const ChoiceGrid& grid);
    void refresh();
    void choose(const DiscretizerCell& cell);
    DiscretizerCell::Use useOf(const DiscretizerCell& cell) const;

    Workspace& workspace_;
    std::vector<DiscretizerCell*> cells_;
    std::vector<std::string> shown_;  ///< ids of the cells
    QWidget* grid_ = nullptr;
    const Theme* theme_ = nullptr;
};

}  // namespace extremal
