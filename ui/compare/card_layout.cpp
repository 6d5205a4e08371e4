// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/card_layout.hpp"

#include <QWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace extremal {
namespace {

constexpr int gap = 10, stageHeight = 225, stageHeightAlone = 240, leastPlot = 168, easyPlot = 206;
constexpr int leastSquare = 210, largestSquare = 360;
constexpr int besideOthers = 60;    // what a square may take of the width of others
constexpr int leastJoined = 230;    // the width of a card that joins a full row
constexpr double stageShare = 1.4;  // of the width, where a plot has 1

}  // namespace

void CardLayout::clear() {
    for (const Placed& card : cards_) delete card.item;
    cards_.clear();
}

void CardLayout::addCard(QWidget* card, CardShape shape) {
    addChildWidget(card);
    cards_.push_back({new QWidgetItem(card), shape});
    invalidate();
}

void CardLayout::addItem(QLayoutItem* item) { cards_.push_back({item, CardShape::plot}); }

void CardLayout::setColumns(int columns) {
    columns_ = std::max(1, columns);
    invalidate();
}

QLayoutItem* CardLayout::itemAt(int index) const {
    return index >= 0 && index < count() ? cards_[static_cast<std::size_t>(index)].item : nullptr;
}

QLayoutItem* CardLayout::takeAt(int index) {
    QLayoutItem* item = itemAt(index);
    if (item) cards_.erase(cards_.begin() + index);
    return item;
}

void CardLayout::setSight(int height, int width) {
    const bool isOther = sight_ != height || sightWidth_ != width;
    sight_ = height;
    sightWidth_ = width;
    if (isOther) invalidate();
}

std::vector<CardLayout::Row> CardLayout::rows(int width) const {
    const auto heightOf = [](const std::vector<Row>& all) {
        int height = -gap;
        for (const Row& row : all) height += row.height + gap;
        return height;
    };
    // Decided in the width that there is without a scroll bar: squares are lower beside one, and would have
    // it go and come for ever.
    const QMargins margins = contentsMargins();
    const int whole = sightWidth_ > 0 ? sightWidth_ - margins.left() - margins.right() : width;
    if (sight_ <= 0 || heightOf(rows(whole, leastPlot)) <= sight_) return rows(width, leastPlot);
    std::vector<Row> all = rows(width, easyPlot);
    fillSight(all);
    if (const int missing = sight_ + 1 - heightOf(all); missing > 0) all.back().height += missing;
    return all;
}

/// The rows that can be seen whole share what is left of the sight; squares keep their shape.
void CardLayout::fillSight(std::vector<Row>& rows) const {
    constexpr int ofStage = 3, ofPlots = 1;
    const auto shareOf = [](const Row& row) {
        return row.hasStage ? ofStage : row.squares > 0 ? 0 : ofPlots;
    };
    int used = -gap, shares = 0;
    std::size_t count = 0;
    for (; count < rows.size() && used + gap + rows[count].height <= sight_; ++count) {
        used += gap + rows[count].height;
        shares += shareOf(rows[count]);
    }
    int left = sight_ - used;
    for (std::size_t i = 0; i < count && shares > 0; ++i) {
        const int share = shareOf(rows[i]), more = left * share / shares;
        rows[i].height += more;
        left -= more;
        shares -= share;
    }
}

std::vector<CardLayout::Row> CardLayout::rows(int width, int plotHeight) const {
    std::vector<Row> all;
    const auto most = static_cast<std::size_t>(columns_);
    const int square = std::clamp(static_cast<int>(0.36 * width), leastSquare, largestSquare);
    for (std::size_t i = 0; i < cards_.size(); ++i) {
        const bool isSquare = cards_[i].shape == CardShape::square,
                   isLast = i + 1 == cards_.size() && columns_ > 1;
        const bool isFull = all.empty() || all.back().to - all.back().from >= most;
        const bool mayJoin = isLast && !all.empty() && !all.back().hasStage &&
                             all.back().squares + (isSquare ? 1 : 0) > 0 &&
                             width / (columns_ + 1) >= leastJoined;
        if (isFull && !mayJoin) all.push_back({i, i, plotHeight});
        Row& row = all.back();
        row.to = i + 1;
        row.squares += isSquare;
        if (cards_[i].shape == CardShape::stage) {
            row.hasStage = true;
            row.height = columns_ > 1 ? stageHeight : stageHeightAlone;
        }
        if (isSquare) row.height = std::max(row.height, square);
    }
    return all;
}

/// The height of a row up to which its squares are about square.
int CardLayout::highest(const Row& row, int width) const {
    const auto count = static_cast<int>(row.to - row.from);
    return (width - gap * (count - 1)) / count + (row.squares < count ? besideOthers : 0);
}

/// Squares as wide as the row is high; the others share what is left, but no one is very narrow.
std::vector<int> CardLayout::widths(const Row& row, int width, int height) const {
    const auto count = static_cast<int>(row.to - row.from);
    const int room = width - gap * (count - 1);
    const bool isMixed = row.squares > 0 && row.squares < count;
    const int side = isMixed ? std::min(height, highest(row, width)) : 0;
    double shares = 0;
    const auto shareOf = [&](std::size_t i) {
        if (isMixed && cards_[i].shape == CardShape::square) return 0.0;
        return cards_[i].shape == CardShape::stage ? stageShare : 1.0;
    };
    for (std::size_t i = row.from; i < row.to; ++i) shares += shareOf(i);
    const double free = room - side * (isMixed ? row.squares : 0);
    std::vector<int> all;
    double done = 0;
    for (std::size_t i = row.from; i < row.to; ++i) {
        const double share = shareOf(i);
        const double before = done;
        done += share > 0 ? free * share / shares : 0;
        all.push_back(share > 0 ? static_cast<int>(std::lround(done) - std::lround(before)) : side);
    }
    return all;
}

int CardLayout::heightForWidth(int width) const {
    const QMargins m = contentsMargins();
    int height = -gap;
    for (const Row& row : rows(width - m.left() - m.right())) height += row.height + gap;
    return std::max(0, height) + m.top() + m.bottom();
}

void CardLayout::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    const QRect inside = rect.marginsRemoved(contentsMargins());
    std::vector<Row> all = rows(inside.width());
    int used = -gap, stretch = 0;
    // Squares grow where nothing else could.
    const bool onlySquares =
        std::all_of(all.begin(), all.end(), [](const Row& row) { return row.squares > 0; });
    const auto stretchOf = [&](const Row& row) {
        return row.squares > 0 && !onlySquares ? 0 : row.hasStage ? 6 : 5;
    };
    for (const Row& row : all) {
        used += row.height + gap;
        stretch += stretchOf(row);
    }
    const int spare = std::max(0, inside.height() - used);
    int y = inside.top(), given = 0, stretched = 0;
    for (const Row& row : all) {
        stretched += stretchOf(row);
        const int share = stretch > 0 ? spare * stretched / stretch : 0;
        int height = row.height + share - given;
        given = share;
        if (row.squares > 0 && all.size() > 1)
            height = std::min(height, std::max(row.height, highest(row, inside.width())));
        const std::vector<int> across = widths(row, inside.width(), height);
        int x = inside.left();
        for (std::size_t i = row.from; i < row.to; ++i) {
            const int width = across[i - row.from];
            cards_[i].item->setGeometry({x, y, width, height});
            x += width + gap;
        }
        y += height + gap;
    }
}

}  // namespace extremal
