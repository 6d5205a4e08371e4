// SPDX-License-Identifier: GPL-3.0-or-later
#include <QClipboard>
#include <QContextMenuEvent>
#include <QMenu>

#include "ui/plots/plot_impl.hpp"
#include "ui/plots/value_colour.hpp"

namespace extremal {

bool PlotWidget::eventFilter(QObject* watched, QEvent* event) {
    if (watched != impl_->plot) return QWidget::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::Wheel:
            zoomAt(*static_cast<QWheelEvent*>(event));
            return true;
        case QEvent::MouseButtonPress:
            return press(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseMove:
            moveTo(static_cast<QMouseEvent*>(event)->position());
            return true;
        case QEvent::MouseButtonRelease:
            return release(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseButtonDblClick:
            ++impl_->clicks;
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

void PlotWidget::afterZoom() {
    Impl& s = *impl_;
    const ViewState& view = s.content->view();
    s.chip->setVisible(true);
    if (s.isTime() && view.isUserChosen(PlotAxis::x)) emit timeRangeChanged(view.range(PlotAxis::x));
    s.replot();
}

void PlotWidget::leaveCell() {
    PlotCursors& cursors = impl_->content->cursors();
    if (!cursors.hoverCell) return;
    cursors.hoverCell.reset();
    emit cellLeft();
}

void PlotWidget::clearHover() {
    Impl& s = *impl_;
    PlotCursors& cursors = s.content->cursors();
    if (s.table) s.table->hide();
    leaveCell();
    if (cursors.hoverTime) emit hoverMoved(std::nullopt);
    if (cursors.hoverText.isEmpty()) return;
    cursors.hoverText.clear();
    s.replotCursor();
}

void PlotWidget::zoomAt(const QWheelEvent& wheel) {
    Impl& s = *impl_;
    ViewState& view = s.content->view();
    const QPointF at = wheel.position();
    const auto [onX, onY] = s.axesAt(at);
    const double factor = std::pow(0.85, wheel.angleDelta().y() / 120.0);
    const PixelMap map = s.content->pixelMap();
    view.remember();
    if (onX) view.zoom(PlotAxis::x, factor, valueAtPixel(map, PlotAxis::x, at));
    if (onY) view.zoom(PlotAxis::y, factor, valueAtPixel(map, PlotAxis::y, at));
    afterZoom();
}

void PlotWidget::zoomAboutMiddle(double factor) {
    ViewState& view = impl_->content->view();
    const PixelMap map = impl_->content->pixelMap();
    view.remember();
    view.zoom(PlotAxis::x, factor, valueAtPixel(map, PlotAxis::x, map.rect.center()));
    view.zoom(PlotAxis::y, factor, valueAtPixel(map, PlotAxis::y, map.rect.center()));
    afterZoom();
}

/// What a drag from here will do.
bool PlotWidget::press(const QMouseEvent& mouse) {
    Impl& s = *impl_;
    setFocus(Qt::MouseFocusReason);
    if (mouse.button() != Qt::LeftButton) return false;
    s.press = s.last = mouse.position();
    s.drag = mouse.modifiers() & Qt::ControlModifier ? Impl::Drag::box
             : s.isOnHandle(s.press)                 ? Impl::Drag::handle
             : s.isOnLevel(s.press)                  ? Impl::Drag::level
                                                     : Impl::Drag::maybe;
    clearHover();
    return true;
}

/// The pointer is somewhere else: with the button down it drags, else it hovers.
void PlotWidget::moveTo(QPointF at) {
    Impl& s = *impl_;
    if (s.drag == Impl::Drag::maybe && QLineF(s.press, at).length() > dragThreshold) {
        s.content->view().remember();
        s.drag = Impl::Drag::pan;
        s.plot->setCursor(Qt::ClosedHandCursor);
    }
    switch (s.drag) {
        case Impl::Drag::handle: {
            const QPointF place = s.placeAt(at);
            s.content->cursors().handle = place;
            s.replotCursor();
            emit handleMoved(place.x(), place.y());
            break;
        }
        case Impl::Drag::level: {
            const PixelMap map = s.content->pixelMap();
            emit levelMoved(valueAtPixel(map, PlotAxis::y,
                                         {at.x(), std::clamp(at.y(), map.rect.top(), map.rect.bottom())}));
            break;
        }
        case Impl::Drag::pan:
            panTo(at);
            break;
        case Impl::Drag::box:
            s.content->cursors().box = QRectF(s.press, at).normalized();
            s.replotCursor();
            break;
        case Impl::Drag::none:
            hoverAt(at);
            break;
        case Impl::Drag::maybe:
            break;
    }
}

void PlotWidget::panTo(QPointF at) {
    Impl& s = *impl_;
    ViewState& view = s.content->view();
    const PixelMap map = s.content->pixelMap();
    const auto [onX, onY] = s.axesAt(s.press);
    if (onX)
        view.pan(PlotAxis::x, valueAtPixel(map, PlotAxis::x, s.last), valueAtPixel(map, PlotAxis::x, at));
    if (onY)
        view.pan(PlotAxis::y, valueAtPixel(map, PlotAxis::y, s.last), valueAtPixel(map, PlotAxis::y, at));
    s.last = at;
    afterZoom();
}

/// Tells what is under the pointer: a cell of a map, else all values at its time, else the nearest point.
void PlotWidget::hoverAt(QPointF at) {
    Impl& s = *impl_;
    PlotCursors& cursors = s.content->cursors();
    s.plot->setCursor(s.isOnHandle(at)  ? Qt::SizeAllCursor
                      : s.isOnLevel(at) ? Qt::SizeVerCursor
                                        : Qt::ArrowCursor);
    if (const auto cell = s.cellAt(at)) {
        cursors.hoverText = QString::fromStdString(cell->text);
        cursors.hoverPoint = at;
        cursors.hoverCell = s.rectOf(*cell);
        s.replotCursor();
        emit cellHovered(cell->x, cell->y);
        return;
    }
    const auto hit = s.content->hit(at, hoverReach);
    leaveCell();
    if (s.isTime() && s.content->pixelMap().rect.contains(at) && !figure().series().empty())
        return showValues(at, hit ? figure().series()[hit->series].label : std::string());
    if (!hit) return clearHover();
    const Series& series = figure().series()[hit->series];
    cursors.hoverText = QStringLiteral("%1\n%2, %3")
                            .arg(QString::fromStdString(seriesName(series)))
                            .arg(series.x[hit->row], 0, 'g', 6)
                            .arg(series.y[hit->row], 0, 'g', 6);
    cursors.hoverPoint = hit->at;
    cursors.hoverColor = series.shade ? valueColour(*series.shade) : s.theme.series(series.style).color;
    s.replotCursor();
}

bool PlotWidget::release(const QMouseEvent& mouse) {
    Impl& s = *impl_;
    if (mouse.button() != Qt::LeftButton) return false;
    const Impl::Drag was = std::exchange(s.drag, Impl::Drag::none);
    s.plot->unsetCursor();
    if (was == Impl::Drag::box) {
        zoomToBox();
    } else if (was == Impl::Drag::level) {
        const bool isClick = QLineF(s.press, mouse.position()).length() <= dragThreshold;
        if (const auto row = s.rowAt(mouse.position()); row && isClick) emit rowChosen(*row);
    } else if (was == Impl::Drag::maybe) {
        click(mouse.position());
    }
    return true;
}

void PlotWidget::zoomToBox() {
    Impl& s = *impl_;
    ViewState& view = s.content->view();
    const PixelMap map = s.content->pixelMap();
    const QRectF box = s.content->cursors().box.value_or(QRectF()).intersected(map.rect);
    s.content->cursors().box.reset();
    if (box.width() <= dragThreshold || box.height() <= dragThreshold) return s.replotCursor();
    view.remember();
    view.choose(PlotAxis::x, {valueAtPixel(map, PlotAxis::x, box.topLeft()),
                              valueAtPixel(map, PlotAxis::x, box.bottomRight())});
    view.choose(PlotAxis::y, {valueAtPixel(map, PlotAxis::y, box.bottomRight()),
                              valueAtPixel(map, PlotAxis::y, box.topLeft())});
    afterZoom();
}

/// Chooses what is there: a cell, a row of a study, a scheme, or a place; over a time axis the time as well.
void PlotWidget::click(QPointF at) {
    Impl& s = *impl_;
    const PixelMap map = s.content->pixelMap();
    if (const auto cell = s.cellAt(at))
        emit cellChosen(cell->x, cell->y);
    else if (const auto row = s.rowAt(at))
        emit rowChosen(*row);
    else if (const auto hit = s.content->hit(at, s.isClickable ? dragThreshold : hoverReach);
             hit && figure().series()[hit->series].style >= 0)
        emit pointClicked(figure().series()[hit->series].style);
    else if (s.isClickable && map.rect.contains(at))
        s.waitForSecondClick(s.placeAt(at), *this);
    if (s.isTime() && map.rect.contains(at)) emit cursorMoved(valueAtPixel(map, PlotAxis::x, at));
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
    QMenu menu;  // without a parent, which may go away while the menu is open
    menu.addAction(tr("Fit"), this, &PlotWidget::fit);
    if (figure().x.whole) menu.addAction(tr("Show all data"), this, &PlotWidget::showAll);
    menu.addAction(tr("Previous view"), this, &PlotWidget::back);
    menu.addAction(tr("Next view"), this, &PlotWidget::forward);
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
        menu.addAction(tr("Find a periodic orbit near here"), this,
                       [this, place] { emit orbitAsked(place.x(), place.y()); });
        menu.addSeparator();
    }
    if (const auto cell = s.cellAt(context.pos())) {
        menu.addAction(tr("Load this case"), this, [this, at = *cell] { emit cellChosen(at.x, at.y); });
        menu.addSeparator();
    }
    menu.addAction(tr("Copy picture"), this, &PlotWidget::copyImage);
    menu.addAction(tr("Copy visible data"), this, [this] {
        QApplication::clipboard()->setText(QString::fromStdString(figureCsv(visibleFigure(), true)));
    });
    menu.addAction(tr("Save as..."), this, &PlotWidget::saveDialog);
    menu.exec(context.globalPos());
}

}  // namespace extremal
