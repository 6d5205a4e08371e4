#include "ui/plots/plot_widget.hpp"

#include <qcustomplot.h>

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QFileDialog>
#include <QMenu>
#include <QPushButton>
#include <QSaveFile>
#include <QTimer>
#include <QVBoxLayout>

#include <cmath>

#include "engine/figure/sample.hpp"
#include "ui/plots/figure_plot.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/plots/value_colour.hpp"

namespace extremal {
namespace {

constexpr double hoverReach = 14, dragThreshold = 4, levelReach = 5, handleReach = 8;

double valueAtPixel(const PixelMap& map, PlotAxis axis, QPointF pixel) {
    const bool isX = axis == PlotAxis::x;
    const PlotRange r = isX ? map.x : map.y;
    const double f = isX ? (pixel.x() - map.rect.left()) / map.rect.width()
                         : (map.rect.bottom() - pixel.y()) / map.rect.height();
    const bool isLog = isX ? map.isXLog : map.isYLog;
    return isLog ? r.low * std::pow(r.high / r.low, f) : r.low + f * (r.high - r.low);
}

/// A plot that draws later when it is resized: the plots of a window would otherwise all be drawn within one
/// event.
class Canvas : public QCustomPlot {
public:
    using QCustomPlot::QCustomPlot;

protected:
    void resizeEvent(QResizeEvent*) override {
        setViewport(rect());
        replot(rpQueuedReplot);
    }
};

}  // namespace

struct PlotWidget::Impl {
    QCustomPlot* plot;
    std::unique_ptr<FigurePlot> content;
    Theme theme;
    QPushButton* chip;
    enum class Drag { none, maybe, pan, box, cursor, level, handle } drag = Drag::none;
    QPointF press, last;
    int leftMargin = 0;
    bool isClickable = false;
    int clicks = 0;                    ///< that chose a place, or the second of a double click
    std::optional<PlotRange> awaited;  ///< the time range of the group, until there is a figure

    explicit Impl(const Theme& t) : theme(t) {}
    void replot() { plot->replot(QCustomPlot::rpQueuedReplot); }
    void replotCursor() { plot->layer("cursor")->replot(); }
    /// The cell of a map under a pixel.
    std::optional<HeatCell> cellAt(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        if (!map.rect.contains(pixel)) return {};
        return extremal::cellAt(content->figure(), valueAtPixel(map, PlotAxis::x, pixel),
                                valueAtPixel(map, PlotAxis::y, pixel));
    }
    QRectF rectOf(const HeatCell& cell) const {
        const HeatMap& heat = *content->figure().heat();
        const PixelMap map = content->pixelMap();
        const QPointF corner = map(heat.left, heat.bottom), opposite = map(heat.right, heat.top);
        const double width = (opposite.x() - corner.x()) / heat.columns,
                     height = (opposite.y() - corner.y()) / heat.rows;
        return QRectF(corner.x() + width * static_cast<double>(cell.column),
                      corner.y() + height * static_cast<double>(cell.row), width, height)
            .normalized();
    }
    /// The row of a study that a point stands for.
    std::optional<std::size_t> rowAt(QPointF pixel) const {
        const auto hit = content->hit(pixel, hoverReach);
        if (!hit) return {};
        const std::vector<std::size_t>& rows = content->figure().series()[hit->series].rows;
        return hit->row < rows.size() ? std::optional(rows[hit->row]) : std::nullopt;
    }
    bool isOnLevel(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const std::optional<double> level = content->cursors().level;
        if (!level || !map.rect.contains(pixel)) return false;
        const double y = map(map.x.low, *level).y();
        return std::abs(std::clamp(y, map.rect.top() + 2, map.rect.bottom() - 2) - pixel.y()) <= levelReach;
    }
    /// A double click fits the view, and chooses no place.
    void waitForSecondClick(QPointF place, PlotWidget& widget) {
        QTimer::singleShot(QApplication::doubleClickInterval(), &widget,
                           [this, place, &widget, n = ++clicks] {
                               if (n == clicks) emit widget.placeClicked(place.x(), place.y());
                           });
    }
    bool isOnHandle(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const std::optional<QPointF> handle = content->cursors().handle;
        if (!handle || !map.rect.contains(pixel)) return false;
        return QLineF(map(handle->x(), handle->y()), pixel).length() <= handleReach;
    }
    QPointF placeAt(QPointF pixel) const {
        const PixelMap map = content->pixelMap();
        const QPointF inside(std::clamp(pixel.x(), map.rect.left(), map.rect.right()),
                             std::clamp(pixel.y(), map.rect.top(), map.rect.bottom()));
        return {valueAtPixel(map, PlotAxis::x, inside), valueAtPixel(map, PlotAxis::y, inside)};
    }
    bool isTime() const { return content->figure().x.isTime; }
    /// Whether a pixel lies on the x axis, the y axis, or (neither) in the plot.
    std::pair<bool, bool> axesAt(QPointF p) const {
        const QRectF r = plot->axisRect()->rect();
        if (p.y() > r.bottom()) return {true, false};
        if (p.x() < r.left()) return {false, true};
        return {true, true};
    }
};

PlotWidget::PlotWidget(const Theme& theme, QWidget* parent) : QWidget(parent), impl_(new Impl(theme)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    impl_->plot = new Canvas(this);
    impl_->plot->setMouseTracking(true);
    impl_->plot->setFocusPolicy(Qt::NoFocus);
    impl_->content = std::make_unique<FigurePlot>(*impl_->plot, impl_->theme);
    layout->addWidget(impl_->plot);
    connect(impl_->plot, &QCustomPlot::beforeReplot, this,
            [this] { impl_->content->prepare(impl_->plot->size()); });
    impl_->chip = new QPushButton(tr("auto"), this);
    impl_->chip->setToolTip(tr("Fit the view to the data again, and keep it fitted (double click)"));
    impl_->chip->setAccessibleName(tr("Fit the view"));
    impl_->chip->setFocusPolicy(Qt::NoFocus);
    impl_->chip->hide();
    connect(impl_->chip, &QPushButton::clicked, this, &PlotWidget::fit);
    setFocusPolicy(Qt::ClickFocus);
    impl_->plot->installEventFilter(this);
}

PlotWidget::~PlotWidget() { impl_->plot->removeEventFilter(this); }

void PlotWidget::setFigure(Figure figure) {
    setAccessibleName(QString::fromStdString(figure.title));
    setAccessibleDescription(QString::fromStdString(figure.summary));
    impl_->content->setFigure(std::move(figure));
    if (impl_->awaited) setTimeRange(std::exchange(impl_->awaited, std::nullopt));
    impl_->chip->setVisible(isUserZoomed());
    impl_->replot();
}

void PlotWidget::setStale(bool isStale) {
    if (impl_->content->setStale(isStale)) impl_->replot();
}

void PlotWidget::setTheme(const Theme& theme) {
    impl_->theme = theme;
    impl_->content->setTheme(theme);
    impl_->replot();
}

void PlotWidget::setCursor(std::optional<double> t) {
    impl_->content->cursors().time = t;
    impl_->replotCursor();
}

void PlotWidget::setPinned(std::optional<double> t) {
    impl_->content->cursors().pinned = t;
    impl_->replotCursor();
}

void PlotWidget::setHighlighted(const QString& label) {
    if (impl_->content->setHighlighted(label)) impl_->replot();
}

void PlotWidget::setLevel(std::optional<double> y, const QString& text) {
    PlotCursors& cursors = impl_->content->cursors();
    if (cursors.level == y && cursors.levelText == text) return;
    cursors.level = y;
    cursors.levelText = text;
    impl_->replotCursor();
}

void PlotWidget::setHandle(std::optional<QPointF> at) {
    PlotCursors& cursors = impl_->content->cursors();
    if (cursors.handle == at || impl_->drag == Impl::Drag::handle) return;
    cursors.handle = at;
    impl_->replotCursor();
}

void PlotWidget::setClickable(bool isClickable) { impl_->isClickable = isClickable; }

std::optional<double> PlotWidget::level() const { return impl_->content->cursors().level; }

void PlotWidget::fit() {
    impl_->content->view().remember();
    impl_->content->view().fit();
    impl_->chip->hide();
    if (impl_->isTime()) emit timeRangeChanged(std::nullopt);
    impl_->replot();
}

void PlotWidget::showAll() {
    const Figure& f = figure();
    if (!f.x.whole || !f.y.whole) return fit();
    ViewState& view = impl_->content->view();
    view.remember();
    view.choose(PlotAxis::x, {f.x.whole->first, f.x.whole->second});
    view.choose(PlotAxis::y, {f.y.whole->first, f.y.whole->second});
    impl_->chip->setVisible(true);
    if (impl_->isTime()) emit timeRangeChanged(view.range(PlotAxis::x));
    impl_->replot();
}

void PlotWidget::back() {
    if (!impl_->content->view().back()) return;
    impl_->chip->setVisible(isUserZoomed());
    if (impl_->isTime())
        emit timeRangeChanged(impl_->content->view().isUserChosen(PlotAxis::x)
                                  ? std::optional(impl_->content->view().range(PlotAxis::x))
                                  : std::nullopt);
    impl_->replot();
}

const Figure& PlotWidget::figure() const { return impl_->content->figure(); }
bool PlotWidget::isUserZoomed() const { return impl_->content->view().isUserChosen(); }
bool PlotWidget::isUserZoomed(PlotAxis axis) const { return impl_->content->view().isUserChosen(axis); }
PlotRange PlotWidget::visibleRange(PlotAxis axis) const { return impl_->content->view().range(axis); }

void PlotWidget::setTimeRange(std::optional<PlotRange> range) {
    if (figure().view.empty()) impl_->awaited = range;
    if (!impl_->isTime()) return;
    if (range)
        impl_->content->view().choose(PlotAxis::x, *range);
    else
        impl_->content->view().fit(PlotAxis::x);
    impl_->chip->setVisible(isUserZoomed());
    impl_->replot();
}

int PlotWidget::leftMargin() const { return impl_->plot->axisRect()->margins().left(); }

void PlotWidget::setLeftMargin(int pixels) {
    if (impl_->leftMargin == pixels) return;
    impl_->leftMargin = pixels;
    QMargins margins = impl_->plot->axisRect()->minimumMargins();
    margins.setLeft(std::max(8, pixels));
    impl_->plot->axisRect()->setMinimumMargins(margins);
    impl_->replot();
}

void PlotWidget::copyImage() {
    QApplication::clipboard()->setImage(renderFigure(figure(), size(), Theme::light(), 2));
}

bool PlotWidget::save(const QString& path, double scale, QString* error) {
    QString problem;
    if (path.endsWith(".csv", Qt::CaseInsensitive)) {
        QSaveFile file(path);
        if (!file.open(QIODevice::WriteOnly) ||
            file.write(QByteArray::fromStdString(figureCsv(figure(), false))) < 0 || !file.commit())
            problem = file.errorString();
    } else {
        problem = saveFigure(path, figure(), size().expandedTo(QSize(480, 320)), Theme::light(), scale);
    }
    if (error) *error = problem;
    return problem.isEmpty();
}

void PlotWidget::saveDialog() {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Save plot"), QString::fromStdString(figure().view) + ".png",
                                     tr("Picture (*.png);;PDF (*.pdf);;SVG (*.svg);;Data (*.csv)"));
    QString error;
    if (!path.isEmpty() && !save(path, 2, &error)) emit saveFailed(tr("%1: %2").arg(path, error));
}

void PlotWidget::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    impl_->chip->adjustSize();
    impl_->chip->move(width() - impl_->chip->width() - 14, 2);
}

void PlotWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Backspace)
        back();
    else if (event->matches(QKeySequence::Copy))
        copyImage();
    else if (const auto cell = impl_->cellAt(impl_->content->cursors().hoverPoint);
             cell && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        emit cellChosen(cell->x, cell->y);
    else if (const auto row = impl_->rowAt(impl_->content->cursors().hoverPoint);
             row && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        emit rowChosen(*row);
    else if (level() && (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down))
        emit levelMoved(*level() * std::pow(10, event->key() == Qt::Key_Up ? 0.1 : -0.1));
    else
        QWidget::keyPressEvent(event);
}

bool PlotWidget::eventFilter(QObject* watched, QEvent* event) {
    if (watched != impl_->plot) return QWidget::eventFilter(watched, event);
    Impl& s = *impl_;
    ViewState& view = s.content->view();
    const auto afterZoom = [&] {
        s.chip->setVisible(true);
        if (s.isTime() && view.isUserChosen(PlotAxis::x)) emit timeRangeChanged(view.range(PlotAxis::x));
        s.replot();
    };
    const auto clearHover = [&] {
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
                    return true;
                }
                const auto hit = s.content->hit(at, hoverReach);
                c.hoverCell.reset();
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
        case QEvent::ContextMenu: {
            auto* context = static_cast<QContextMenuEvent*>(event);
            const double t = valueAtPixel(s.content->pixelMap(), PlotAxis::x, context->pos());
            QMenu menu(this);
            menu.addAction(tr("Fit"), this, &PlotWidget::fit);
            if (figure().x.whole) menu.addAction(tr("Show all data"), this, &PlotWidget::showAll);
            menu.addAction(tr("Previous view"), this, &PlotWidget::back);
            menu.addSeparator();
            if (s.isTime()) {
                menu.addAction(tr("Pin a second cursor here"), this, [this, t] { emit pinRequested(t); });
                if (s.content->cursors().pinned)
                    menu.addAction(tr("Remove the second cursor"), this,
                                   [this] { emit pinRequested(std::nullopt); });
                menu.addSeparator();
            }
            if (const auto row = s.rowAt(context->pos())) {
                menu.addAction(tr("Load this run"), this, [this, row] { emit rowChosen(*row); });
                menu.addSeparator();
            }
            if (s.isClickable && s.content->pixelMap().rect.contains(context->pos())) {
                const QPointF place = s.placeAt(context->pos());
                menu.addAction(tr("Start a motion here"), this,
                               [this, place] { emit placeClicked(place.x(), place.y()); });
                menu.addSeparator();
            }
            if (const auto cell = s.cellAt(context->pos())) {
                menu.addAction(tr("Load this case"), this,
                               [this, at = *cell] { emit cellChosen(at.x, at.y); });
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
            menu.exec(context->globalPos());
            return true;
        }
        default:
            return QWidget::eventFilter(watched, event);
    }
}

}  // namespace extremal
