// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/compare/card_layout.hpp"

#include <QWidget>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/compare/card_handle.hpp"

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
    edges_.clear();
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
    if (!item) return nullptr;
    cards_.erase(cards_.begin() + index);
    edges_.clear();
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
        return row.isOwn || (row.squares > 0 && !row.hasStage) ? 0 : row.hasStage ? ofStage : ofPlots;
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
    for (Row& row : all) {
        int height = 0;
        for (std::size_t i = row.from; i < row.to; ++i) height = std::max(height, ownOf(i).height);
        row.isOwn = height > 0;
        if (row.isOwn) row.height = height;
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
    bool isOwn = false;
    for (std::size_t i = row.from; i < row.to; ++i) isOwn = isOwn || ownOf(i).share > 0;
    const bool isMixed = !isOwn && row.squares > 0 && row.squares < count;
    const int side = isMixed ? std::min(height, highest(row, width)) : 0;
    double shares = 0;
    const auto shareOf = [&](std::size_t i) {
        if (isMixed && cards_[i].shape == CardShape::square) return 0.0;
        if (isOwn && ownOf(i).share > 0) return ownOf(i).share;
        return (cards_[i].shape == CardShape::stage ? stageShare : 1.0) * (isOwn ? width / count : 1);
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
        return row.isOwn || (row.squares > 0 && !onlySquares) ? 0 : row.hasStage ? 6 : 5;
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
        if (row.squares > 0 && all.size() > 1 && !row.isOwn)
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
    placeHandles();
    if (placed_) placed_();
}

CardLayout::Own CardLayout::ownOf(std::size_t card) const {
    const auto own = own_.find(cards_[card].item->widget());
    return own == own_.end() ? Own{} : own->second;
}

CardLayout::Own& CardLayout::keptOf(const QWidget* card) {
    if (!own_.contains(card)) connect(card, &QObject::destroyed, this, [this, card] { own_.erase(card); });
    return own_[card];
}

void CardLayout::setSize(const QWidget* card, CardSize size) {
    keptOf(card) = {size.height, static_cast<double>(size.width)};
    invalidate();
}

CardSize CardLayout::sizeOf(const QWidget* card) const {
    const auto own = own_.find(card);
    if (own == own_.end()) return {};
    const auto kept = [](double pixels) {
        return pixels > 0 ? std::clamp(static_cast<int>(std::lround(pixels)), CardSize::least, CardSize::most)
                          : 0;
    };
    return {kept(own->second.share), kept(own->second.height)};
}

std::pair<std::size_t, std::size_t> CardLayout::rowOf(std::size_t card) const {
    const auto top = [&](std::size_t i) { return cards_[i].item->geometry().top(); };
    std::size_t from = card, to = card + 1;
    while (from > 0 && top(from - 1) == top(card)) --from;
    while (to < cards_.size() && top(to) == top(card)) ++to;
    return {from, to};
}

void CardLayout::setRowHeight(std::size_t card, int height) {
    const auto [from, to] = rowOf(card);
    for (std::size_t i = from; i < to; ++i)
        keptOf(i).height = std::clamp(height, CardSize::least, CardSize::most);
    invalidate();
}

/// What a card gains its neighbour loses; the others of the row keep their widths.
void CardLayout::setRightEdge(std::size_t card, int x) {
    const auto [from, to] = rowOf(card);
    for (std::size_t i = from; i < to; ++i) keptOf(i).share = cards_[i].item->geometry().width();
    const QRect own = cards_[card].item->geometry(), next = cards_[card + 1].item->geometry();
    const int both = own.width() + next.width();
    const int width = std::clamp(x - own.left(), std::min(CardSize::least, both / 2),
                                 std::max(both - CardSize::least, both / 2));
    keptOf(card).share = width;
    keptOf(card + 1).share = both - width;
    invalidate();
}

void CardLayout::grow(const QWidget* card, int by) {
    for (std::size_t i = 0; i < cards_.size(); ++i)
        if (cards_[i].item->widget() == card)
            return setRowHeight(i, cards_[i].item->geometry().height() + by);
}

void CardLayout::forgetRow(std::size_t card) {
    const auto [from, to] = rowOf(card);
    for (std::size_t i = from; i < to; ++i) own_.erase(cards_[i].item->widget());
    invalidate();
}

void CardLayout::forgetSizes() {
    own_.clear();
    invalidate();
}

/// In the gaps below rows, and between cards.
void CardLayout::placeHandles() {
    edges_.clear();
    std::vector<QRect> places;
    for (std::size_t i = 0; i < cards_.size() && cards_.size() > 1; ++i) {
        const QRect card = cards_[i].item->geometry();
        const auto [from, to] = rowOf(i);
        if (i + 1 < to) {
            edges_.push_back({i, false});
            places.emplace_back(card.right() + 1, card.top(), gap, card.height());
        }
        if (i == from) {
            edges_.push_back({i, true});
            places.emplace_back(card.left(), card.bottom() + 1,
                                cards_[to - 1].item->geometry().right() - card.left() + 1, gap);
        }
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
        CardHandle* const one = handle(k);
        one->setUpright(edges_[k].isBelow);
        one->setGeometry(places[k]);
        one->show();
    }
    for (std::size_t k = places.size(); k < handles_.size(); ++k) handles_[k]->hide();
}

CardHandle* CardLayout::handle(std::size_t number) {
    while (handles_.size() <= number)
        handles_.push_back(new CardHandle(
            parentWidget(),
            [this, k = handles_.size()](QPoint at) {
                if (k >= edges_.size()) return;  // other cards since it was taken
                const Edge edge = edges_[k];
                const QRect card = cards_[edge.card].item->geometry();
                if (edge.isBelow)
                    setRowHeight(edge.card, at.y() - gap / 2 - card.top());
                else
                    setRightEdge(edge.card, at.x() - gap / 2);
            },
            [this, k = handles_.size()] {
                if (k < edges_.size()) forgetRow(edges_[k].card);
            }));
    return handles_[number];
}

}  // namespace extremal
