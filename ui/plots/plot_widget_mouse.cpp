// SPDX-License-Identifier: GPL-3.0-or-later
#include <QContextMenuEvent>
#include <QClipboard>
#include <QMenu>

#include "ui/plots/plot_impl.hpp"
#include "ui/plots/value_colour.hpp"

namespace extremal {

bool PlotWidget::eventFilter(QObject* watched, QEvent* event) {
    if (watched != impl_->plot) return QWidget::eventFilter(watched, event);
    Impl& s = *impl_;
    ViewState& view = s.content->view();
    const auto afterZoom = [&] {
        s.chip->setVisible(true);
        if (s.isTime() && view.isUserChosen(PlotAxis::x)) emit timeRangeChanged(view.range(PlotAxis::x));
        s.replot();
    };
    const auto leaveCell = [&] {
        if (!s.content->cursors().hoverCell) return;
        s.content->cursors().hoverCell.reset();
        emit cellLeft();
    };
    const auto clearHover = [&] {
        if (s.table) s.table->hide();
        leaveCell();
        if (s.content->cursors().hoverTime) emit hoverMoved(std::nullopt);
        if (s.content->cursors().hoverText.isEmpty()) return;
        s.content->cursors().hoverText.clear();
        s.replotCursor();
    };
    switch (event->type()) {
        case QEvent::Wheel: {
            auto* wheel = static_cast<QWheelEvent*>(event);
            const QPointF at = wheel->position();
            const auto [onX, onY] = s.axesAt(at);
            const double factor = std::pow(0.85, wheel->angleDelta().y() / 120.0);
            const PixelMap map = s.content->pixelMap();
            view.remember();
            if (onX) view.zoom(PlotAxis::x, factor, valueAtPixel(map, PlotAxis::x, at));
            if (onY) view.zoom(PlotAxis::y, factor, valueAtPixel(map, PlotAxis::y, at));
            afterZoom();
            return true;
        }
        case QEvent::MouseButtonPress: {
            auto* mouse = static_cast<QMouseEvent*>(event);
            setFocus(Qt::MouseFocusReason);
            if (mouse->button() != Qt::LeftButton) return false;
            s.press = s.last = mouse->position();
            s.drag = mouse->modifiers() & Qt::ControlModifier ? Impl::Drag::box
                     : s.isOnHandle(s.press)                  ? Impl::Drag::handle
                     : s.isOnLevel(s.press)                   ? Impl::Drag::level
                                                              : Impl::Drag::maybe;
            clearHover();
            return true;
        }
        case QEvent::MouseMove: {
            auto* mouse = static_cast<QMouseEvent*>(event);
            const QPointF at = mouse->position();
            const PixelMap map = s.content->pixelMap();
            if (s.drag == Impl::Drag::maybe && QLineF(s.press, at).length() > dragThreshold) {
                view.remember();
                s.drag = Impl::Drag::pan;
                s.plot->setCursor(Qt::ClosedHandCursor);
            }
            if (s.drag == Impl::Drag::handle) {
                const QPointF place = s.placeAt(at);
                s.content->cursors().handle = place;
                s.replotCursor();
                emit handleMoved(place.x(), place.y());
            } else if (s.drag == Impl::Drag::level) {
                emit levelMoved(valueAtPixel(
                    map, PlotAxis::y, {at.x(), std::clamp(at.y(), map.rect.top(), map.rect.bottom())}));
            } else if (s.drag == Impl::Drag::pan) {
                const auto [onX, onY] = s.axesAt(s.press);
                if (onX)
                    view.pan(PlotAxis::x, valueAtPixel(map, PlotAxis::x, s.last),
                             valueAtPixel(map, PlotAxis::x, at));
                if (onY)
                    view.pan(PlotAxis::y, valueAtPixel(map, PlotAxis::y, s.last),
                             valueAtPixel(map, PlotAxis::y, at));
                s.last = at;
                afterZoom();
            } else if (s.drag == Impl::Drag::box) {
                s.content->cursors().box = QRectF(s.press, at).normalized();
                s.replotCursor();
            } else if (s.drag == Impl::Drag::none) {
                PlotCursors& c = s.content->cursors();
                s.plot->setCursor(s.isOnHandle(at)  ? Qt::SizeAllCursor
                                  : s.isOnLevel(at) ? Qt::SizeVerCursor
                                                    : Qt::ArrowCursor);
                if (const auto cell = s.cellAt(at)) {
                    c.hoverText = QString::fromStdString(cell->text);
                    c.hoverPoint = at;
                    c.hoverCell = s.rectOf(*cell);
                    s.replotCursor();
                    emit cellHovered(cell->x, cell->y);
                    return true;
                }
                const auto hit = s.content->hit(at, hoverReach);
                leaveCell();
                if (s.isTime() && map.rect.contains(at) && !figure().series().empty()) {
                    showValues(at, hit ? figure().series()[hit->series].label : std::string());
                    return true;
                }
                if (!hit) {
                    clearHover();
                    return true;
                }
                const Series& series = figure().series()[hit->series];
                c.hoverText = QStringLiteral("%1\n%2, %3")
                                  .arg(QString::fromStdString(seriesName(series)))
                                  .arg(series.x[hit->row], 0, 'g', 6)
                                  .arg(series.y[hit->row], 0, 'g', 6);
                c.hoverPoint = hit->at;
                c.hoverColor = series.shade ? valueColour(*series.shade) : s.theme.series(series.style).color;
                s.replotCursor();
            }
            return true;
        }
        case QEvent::MouseButtonRelease: {
            auto* mouse = static_cast<QMouseEvent*>(event);
            if (mouse->button() != Qt::LeftButton) return false;
            const PixelMap map = s.content->pixelMap();
            const Impl::Drag was = s.drag;
            s.drag = Impl::Drag::none;
            s.plot->unsetCursor();
            if (was == Impl::Drag::box) {
                const QRectF box = s.content->cursors().box.value_or(QRectF()).intersected(map.rect);
                s.content->cursors().box.reset();
                if (box.width() > dragThreshold && box.height() > dragThreshold) {
                    view.remember();
                    view.choose(PlotAxis::x, {valueAtPixel(map, PlotAxis::x, box.topLeft()),
                                              valueAtPixel(map, PlotAxis::x, box.bottomRight())});
                    view.choose(PlotAxis::y, {valueAtPixel(map, PlotAxis::y, box.bottomRight()),
                                              valueAtPixel(map, PlotAxis::y, box.topLeft())});
                    afterZoom();
                } else {
                    s.replotCursor();
                }
            } else if (was == Impl::Drag::level) {
                const bool isClick = QLineF(s.press, mouse->position()).length() <= dragThreshold;
                if (const auto row = s.rowAt(mouse->position()); row && isClick) emit rowChosen(*row);
            } else if (was == Impl::Drag::maybe) {
                if (const auto cell = s.cellAt(mouse->position()))
                    emit cellChosen(cell->x, cell->y);
                else if (const auto row = s.rowAt(mouse->position()))
                    emit rowChosen(*row);
                else if (const auto hit =
                             s.content->hit(mouse->position(), s.isClickable ? dragThreshold : hoverReach);
                         hit && figure().series()[hit->series].style >= 0)
                    emit pointClicked(figure().series()[hit->series].style);
                else if (s.isClickable && map.rect.contains(mouse->position()))
                    s.waitForSecondClick(s.placeAt(mouse->position()), *this);
                if (s.isTime() && map.rect.contains(mouse->position()))
                    emit cursorMoved(valueAtPixel(map, PlotAxis::x, mouse->position()));
            }
            return true;
        }
        case QEvent::MouseButtonDblClick:
            ++s.clicks;
            fit();
            return true;
        case QEvent::Leave:
            clearHover();
            return false;
        case QEvent::ContextMenu:
            openMenu(*static_cast<QContextMenuEvent*>(event));
            return true;
        default:
            return QWidget::eventFilter(watched, event);
    }
}

/// All values at the time under the pointer, beside it; in the other plots a line marks the time.
void PlotWidget::showValues(QPointF at, const std::string& nearest) {
    Impl& s = *impl_;
    const double t = valueAtPixel(s.content->pixelMap(), PlotAxis::x, at);
    emit hoverMoved(t);
    if (!s.table) return;
    s.table->show(figure(), t, s.content->cursors().pinned, nearest, s.theme);
    s.table->placeBeside(s.plot->mapTo(window(), at.toPoint()));
}

void PlotWidget::openMenu(const QContextMenuEvent& context) {
    Impl& s = *impl_;
    const double t = valueAtPixel(s.content->pixelMap(), PlotAxis::x, context.pos());
    QMenu menu(this);
    menu.addAction(tr("Fit"), this, &PlotWidget::fit);
    if (figure().x.whole) menu.addAction(tr("Show all data"), this, &PlotWidget::showAll);
    menu.addAction(tr("Previous view"), this, &PlotWidget::back);
    menu.addSeparator();
    if (s.isTime()) {
        menu.addAction(tr("Pin a second cursor here"), this, [this, t] { emit pinRequested(t); });
        if (s.content->cursors().pinned)
            menu.addAction(tr("Remove the second cursor"), this, [this] { emit pinRequested(std::nullopt); });
        menu.addSeparator();
    }
    if (const auto row = s.rowAt(context.pos())) {
        menu.addAction(tr("Load this run"), this, [this, row] { emit rowChosen(*row); });
        menu.addSeparator();
    }
    if (s.isClickable && s.content->pixelMap().rect.contains(context.pos())) {
        const QPointF place = s.placeAt(context.pos());
        menu.addAction(tr("Start a motion here"), this,
                       [this, place] { emit placeClicked(place.x(), place.y()); });
        menu.addSeparator();
    }
    if (const auto cell = s.cellAt(context.pos())) {
        menu.addAction(tr("Load this case"), this, [this, at = *cell] { emit cellChosen(at.x, at.y); });
        menu.addSeparator();
    }
    menu.addAction(tr("Copy picture"), this, &PlotWidget::copyImage);
    menu.addAction(tr("Copy visible data"), this, [this] {
        Figure visible = figure();
        const PlotRange x = visibleRange(PlotAxis::x), y = visibleRange(PlotAxis::y);
        visible.x.range = {x.low, x.high};
        visible.y.range = {y.low, y.high};
        QApplication::clipboard()->setText(QString::fromStdString(figureCsv(visible, true)));
    });
    menu.addAction(tr("Save as..."), this, &PlotWidget::saveDialog);
    menu.exec(context.globalPos());
}

}  // namespace extremal
