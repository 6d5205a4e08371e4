/// The discretizer: function spaces as rows, quadratures as columns. A cell says which scheme the pair is and
/// its order; a click adds it to the comparison. Unsupported pairs are grey and show the reason.
#pragma once

#include <QAbstractButton>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "ui/panels/card.hpp"

class QGridLayout;

namespace extremal {

struct PairProperties;
struct Theme;
class Workspace;

/// One cell: a pair.
class DiscretizerCell : public QAbstractButton {
    Q_OBJECT
public:
    DiscretizerCell(Settings space, Settings quadrature, QWidget* parent = nullptr);

    const Settings& space() const { return space_; }
    const Settings& quadrature() const { return quadrature_; }
    void setTheme(const Theme& theme);
    void setPresent(bool isPresent);
    QSize sizeHint() const override { return {34, 23}; }
    QSize minimumSizeHint() const override { return {26, 23}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void nameByOrder(const PairProperties& known);
    QString tooltip(const PairProperties& known) const;

    Settings space_, quadrature_;
    QString name_, order_;
    bool isPresent_ = false;
    const Theme* theme_ = nullptr;
};

class Discretizer : public Card {
    Q_OBJECT
public:
    explicit Discretizer(Workspace& workspace, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    DiscretizerCell* cell(int degree, const QString& rule) const;

private:
    void fill(const std::string& space, bool isPeriodic);
    void fillElements(QGridLayout& grid);
    void addCell(QGridLayout& grid, const Settings& space, const Settings& rule, int row, int column);
    void refresh();
    void choose(const DiscretizerCell& cell);

    Workspace& workspace_;
    std::vector<DiscretizerCell*> cells_;
    std::string space_;       ///< of the cells
    bool isPeriodic_ = true;  ///< wave functions: no walls
    QWidget* grid_ = nullptr;
    const Theme* theme_ = nullptr;
};

}  // namespace extremal
