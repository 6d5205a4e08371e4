// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure on the screen, to look into: the same drawing as in snapshots, with zoom, cursors and saving.
///
/// Wheel: zoom at the pointer, on an axis only that axis; drag: pan; Ctrl+drag: zoom into a box; double
/// click: fit; Backspace: previous view; + and -: zoom by keys; right click or the menu key: menu; a click on
/// a cell of a map, or Return over it, chooses its case, and a click on a point with a row of a study that
/// row; a line across (setLevel) is dragged, or moved with Up and Down; the handle (setHandle) is dragged;
/// where places can be clicked (setClickable), a click beside the curves is one. Once the user has zoomed,
/// new data do not move the view; the "auto" chip gives that back. The cursor is a time, shared with other
/// plots through PlotGroup.
#pragma once

#include <QPointF>
#include <QWidget>

#include <memory>
#include <optional>

#include "engine/figure/figure.hpp"
#include "ui/plots/view_state.hpp"

class QContextMenuEvent;

namespace extremal {

struct Theme;

class PlotWidget : public QWidget {
    Q_OBJECT
public:
    explicit PlotWidget(const Theme& theme, QWidget* parent = nullptr);
    ~PlotWidget() override;

    void setFigure(Figure figure);
    void setStale(bool isStale);
    void setTheme(const Theme& theme);
    /// A time to mark; none removes the line.
    void setCursor(std::optional<double> t);
    void setPinned(std::optional<double> t);
    /// A time that the pointer is at, here or in a linked plot: a faint line.
    void setHover(std::optional<double> t);
    void setHighlighted(const QString& label);
    /// A value of y as a line that the user can move; none removes it.
    void setLevel(std::optional<double> y, const QString& text = {});
    std::optional<double> level() const;
    /// A point that the user can drag; none removes it. While it is dragged the user's place stays.
    void setHandle(std::optional<QPointF> at);
    /// Whether clicks choose places.
    void setClickable(bool isClickable);
    void fit();      ///< to the part the view asks for, else to all data
    void showAll();  ///< all data, also where the view asks for a part
    void back();     ///< to the view before
    void forward();  ///< to the view that back() left
    void copyImage();
    void saveDialog();
    /// PNG, PDF, SVG or CSV by the ending. False, with the reason, if it cannot be written.
    bool save(const QString& path, double scale = 1, QString* error = nullptr);
    const Figure& figure() const;
    Figure visibleFigure() const;  ///< with the ranges that are in sight
    bool isUserZoomed() const;
    bool isUserZoomed(PlotAxis axis) const;
    PlotRange visibleRange(PlotAxis axis) const;
    /// Follows another plot's time axis; an empty range fits.
    void setTimeRange(std::optional<PlotRange> range);
    /// The room that the axis on the left needs, and is given, for plots above each other to align.
    int leftMargin() const;
    void setLeftMargin(int pixels);

    QSize sizeHint() const override { return {360, 240}; }
    QSize minimumSizeHint() const override { return {140, 110}; }

signals:
    void cursorMoved(double t);
    void hoverMoved(std::optional<double> t);  ///< over a time axis; none: it has left
    void pointClicked(int style);
    void cellChosen(double x, double y);   ///< of a map with a scale: what the cell stands for
    void cellHovered(double x, double y);  ///< of the same
    void cellLeft();
    void rowChosen(std::size_t row);  ///< of a study: what the point stands for
    void levelMoved(double y);
    void placeClicked(double x, double y);
    void orbitAsked(double x, double y);  ///< a periodic orbit near a place
    void handleMoved(double x, double y);
    void pinRequested(std::optional<double> t);
    void timeRangeChanged(std::optional<PlotRange> range);
    void saveFailed(const QString& reason);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void zoomAt(const QWheelEvent& wheel);
    void zoomAboutMiddle(double factor);  ///< by keys, both axes
    bool press(const QMouseEvent& mouse);
    void moveTo(QPointF at);
    void panTo(QPointF at);
    bool release(const QMouseEvent& mouse);
    void zoomToBox();
    void click(QPointF at);
    void afterZoom();
    void showOtherView();
    void hoverAt(QPointF at);
    void leaveCell();
    void clearHover();
    void showValues(QPointF at, const std::string& nearest);
    void openMenu(const QContextMenuEvent& context);
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace extremal
