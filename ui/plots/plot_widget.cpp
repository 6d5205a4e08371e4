// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_widget.hpp"

#include <QClipboard>
#include <QCoreApplication>
#include <QEvent>
#include <QPointer>
#include <QSaveFile>
#include <QVBoxLayout>

#include "ui/base/save_dialog.hpp"
#include "ui/plots/plot_impl.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal {
namespace {

/// A plot that is drawn in its turn when it is new or resized, and is on the screen with the window's next
/// update: the plots of a window would otherwise all be drawn, and the window painted for each, within one
/// event.
class Canvas : public QCustomPlot {
public:
    explicit Canvas(QWidget* parent) : QCustomPlot(parent) {
        setPlottingHint(QCP::phImmediateRefresh, false);
        // The drawing that the constructor asks for, still without a size.
        QCoreApplication::removePostedEvents(this, QEvent::MetaCall);
    }

protected:
    void resizeEvent(QResizeEvent*) override {
        setViewport(rect());
        queueReplot(*this);
    }
};

}  // namespace

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
    impl_->table = new HoverTable(this);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Plot"));  // until it has a figure
    impl_->plot->installEventFilter(this);
}

PlotWidget::~PlotWidget() {
    impl_->plot->removeEventFilter(this);
    delete impl_->table.data();
}

void PlotWidget::setFigure(Figure figure) {
    if (const std::string& name = figure.title.empty() ? figure.message : figure.title; !name.empty())
        setAccessibleName(QString::fromStdString(name));
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
    if (impl_->content->setTime(t))
        impl_->replot();
    else
        impl_->replotCursor();
}

void PlotWidget::setPinned(std::optional<double> t) {
    impl_->content->cursors().pinned = t;
    impl_->replotCursor();
}

void PlotWidget::setHover(std::optional<double> t) {
    if (std::exchange(impl_->content->cursors().hoverTime, t) != t) impl_->replotCursor();
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
    if (impl_->content->view().back()) showOtherView();
}

void PlotWidget::forward() {
    if (impl_->content->view().forward()) showOtherView();
}

void PlotWidget::showOtherView() {
    impl_->chip->setVisible(isUserZoomed());
    if (impl_->isTime())
        emit timeRangeChanged(impl_->content->view().isUserChosen(PlotAxis::x)
                                  ? std::optional(impl_->content->view().range(PlotAxis::x))
                                  : std::nullopt);
    impl_->replot();
}

const Figure& PlotWidget::figure() const { return impl_->content->figure(); }
Figure PlotWidget::visibleFigure() const {
    Figure visible = figure();
    if (!isUserZoomed()) return visible;
    const PlotRange x = visibleRange(PlotAxis::x), y = visibleRange(PlotAxis::y);
    visible.x.range = {x.low, x.high};
    visible.y.range = {y.low, y.high};
    return visible;
}
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
    const QPointer<PlotWidget> guard(this);  // a plot may leave the page meanwhile
    const QString path = askForSave(this, tr("Save plot"), QString::fromStdString(figure().view) + ".png",
                                    tr("Picture (*.png);;PDF (*.pdf);;SVG (*.svg);;Data (*.csv)"));
    QString error;
    if (guard && !path.isEmpty() && !save(path, 2, &error)) emit saveFailed(tr("%1: %2").arg(path, error));
}

void PlotWidget::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    impl_->chip->adjustSize();
    impl_->chip->move(width() - impl_->chip->width() - 14, 2);
}

void PlotWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Backspace)
        (event->modifiers() & Qt::ShiftModifier) ? forward() : back();
    else if (event->matches(QKeySequence::Copy))
        copyImage();
    else if (const auto cell = impl_->cellAt(impl_->content->cursors().hoverPoint);
             cell && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        emit cellChosen(cell->x, cell->y);
    else if (const auto row = impl_->rowAt(impl_->content->cursors().hoverPoint);
             row && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        emit rowChosen(*row);
    else if (event->key() == Qt::Key_Plus || event->key() == Qt::Key_Equal)
        zoomAboutMiddle(0.8);
    else if (event->key() == Qt::Key_Minus)
        zoomAboutMiddle(1.25);
    else if (level() && (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down))
        emit levelMoved(*level() * std::pow(10, event->key() == Qt::Key_Up ? 0.1 : -0.1));
    else
        QWidget::keyPressEvent(event);
}

}  // namespace extremal
