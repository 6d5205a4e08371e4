// SPDX-License-Identifier: GPL-3.0-or-later
/// The cards of the Compare page: rows that fill the width. The stage stands first and is wider than what is
/// beside it; cards of plots with equal scales are about square, and share their row with others.
///
/// With n columns a row takes n cards; one card that would be left over joins the row before it if that has a
/// square, else it has a row to itself. What height the window has beyond the least that all rows need goes
/// to the rows without squares, or where there are none to the squares. Where the rows have to scroll, those
/// in sight at first fill it, so that none is cut, and the stage has the largest share.
///
/// The gaps between cards are handles: rows and cards have the sizes that a hand gave them, until these are
/// given back.
#pragma once

#include <QLayout>

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "engine/view/view.hpp"

namespace extremal {

class CardHandle;

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
    /// Makes the row of a card higher by so many pixels.
    void grow(const QWidget* card, int by);
    void forgetSizes();
    /// Called after the cards have been placed.
    void setPlaced(std::function<void()> placed) { placed_ = std::move(placed); }
    /// The size of a card as if a hand had given it, and the one that a hand gave.
    void setSize(const QWidget* card, CardSize size);
    CardSize sizeOf(const QWidget* card) const;

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
        bool isOwn = false;  ///< its height was given by hand
    };
    std::vector<Row> rows(int width) const;
    std::vector<Row> rows(int width, int plotHeight) const;
    void fillSight(std::vector<Row>& rows) const;
    int highest(const Row& row, int width) const;
    std::vector<int> widths(const Row& row, int width, int height) const;

    /// What was given by hand; 0: nothing.
    struct Own {
        int height = 0;
        double share = 0;  ///< of the width of its row
    };
    Own ownOf(std::size_t card) const;
    Own& keptOf(const QWidget* card);
    Own& keptOf(std::size_t card) { return keptOf(cards_[card].item->widget()); }
    std::pair<std::size_t, std::size_t> rowOf(std::size_t card) const;  ///< from, to; as it is placed
    void setRowHeight(std::size_t card, int height);
    void setRightEdge(std::size_t card, int x);
    void forgetRow(std::size_t card);
    void placeHandles();
    CardHandle* handle(std::size_t number);

    std::vector<Placed> cards_;
    std::map<const QWidget*, Own> own_;
    struct Edge {
        std::size_t card;
        bool isBelow;
    };
    std::vector<Edge> edges_;  ///< one for each handle that is shown
    std::vector<CardHandle*> handles_;
    int columns_ = 2, sight_ = 0, sightWidth_ = 0;
    std::function<void()> placed_;
};

}  // namespace extremal
