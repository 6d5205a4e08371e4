// SPDX-License-Identifier: GPL-3.0-or-later
/// The cards of the Compare page: rows that fill the width. The stage stands first and is wider than what is
/// beside it; cards of plots with equal scales are about square, and share their row with others.
///
/// With n columns a row takes n cards; one card that would be left over joins the row before it if that has a
/// square, else it has a row to itself. What height the window has beyond the least that all rows need goes
/// to the rows without squares, or where there are none to the squares. Where the rows have to scroll, those in sight at first fill it, so that none
/// is cut, and the stage has the largest share.
#pragma once

#include <QLayout>

#include <vector>

namespace extremal {

enum class CardShape { stage, plot, square };

class CardLayout : public QLayout {
public:
    explicit CardLayout(QWidget* parent) : QLayout(parent) {}
    ~CardLayout() override { clear(); }

    /// Takes all cards out; their widgets stay where they are.
    void clear();
    void addCard(QWidget* card, CardShape shape);
    void setColumns(int columns);
    /// The height that can be seen at once, where rows that have to scroll anyway are higher; and the width
    /// without a scroll bar, 0: that of the layout.
    void setSight(int height, int width = 0);

    void addItem(QLayoutItem* item) override;
    int count() const override { return static_cast<int>(cards_.size()); }
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override;
    QSize sizeHint() const override { return minimumSize(); }
    QSize minimumSize() const override { return {200, 160}; }
    Qt::Orientations expandingDirections() const override { return Qt::Horizontal | Qt::Vertical; }
    void setGeometry(const QRect& rect) override;

private:
    struct Placed {
        QLayoutItem* item;
        CardShape shape;
    };
    struct Row {
        std::size_t from, to;
        int height;  ///< at least
        bool hasStage = false;
        int squares = 0;
    };
    std::vector<Row> rows(int width) const;
    std::vector<Row> rows(int width, int plotHeight) const;
    void fillSight(std::vector<Row>& rows) const;
    int highest(const Row& row, int width) const;
    std::vector<int> widths(const Row& row, int width, int height) const;

    std::vector<Placed> cards_;
    int columns_ = 2, sight_ = 0, sightWidth_ = 0;
};

}  // namespace extremal
