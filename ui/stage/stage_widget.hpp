// SPDX-License-Identifier: GPL-3.0-or-later
/// The animated stage of the window.
///
///     auto* stage = new StageWidget;
///     stage->setTheme(theme);
///     stage->setComparison(comparison);   // again whenever there are new rows: the view stays where the
///     user put it stage->setTime(6.2);
///
/// The wheel zooms at the pointer, dragging pans, a double click (or fit()) shows everything again. A body
/// under the pointer lights up, and dragging it says where it goes; with Shift, or let go while the mouse
/// moves, it says with which velocity. While drawing is on, and with Ctrl, dragging makes strokes in place of
/// panning, where the picture is flat. The picture comes from the graphics card, or through OSMesa where
/// there is no real OpenGL (a remote or virtual display, the offscreen platform); where neither is to be had
/// the widget says what to install.
#pragma once

#include <QWidget>

#include <memory>
#include <vector>

#include "engine/model/drawing.hpp"
#include "engine/run/comparison.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal {

struct Theme;

class StageWidget : public QWidget {
    Q_OBJECT
public:
    explicit StageWidget(QWidget* parent = nullptr);
    ~StageWidget() override;

    void setTheme(const Theme& theme);
    /// Null empties the stage. Another model brings back the full view.
    void setComparison(std::shared_ptr<const Comparison> comparison);
    /// The same with what may take a while made before, in another thread.
    void setPlayer(StagePlayer player);
    void setTime(double t);
    double time() const;
    /// For use without a list of schemes beside the stage.
    void setLegendShown(bool isShown);
    void setGridShown(bool isShown);
    /// Schemes beside each other, each with its name, or on top of each other.
    void setSideBySide(bool isSideBySide);
    bool isSideBySide() const;
    void setTrails(StageTrails trails);
    StageTrails trails() const;
    /// Level lines or the graph of the potential, where the player has found it.
    void setPotentialShown(bool isShown);
    bool isPotentialShown() const;
    bool hasPotential() const;
    void fit();
    void zoom(double factor);              ///< about the middle
    Camera camera() const;                 ///< of the present view
    void setCamera(const Camera& camera);  ///< as if the user had zoomed and panned
    bool isFitted() const;                 ///< false once the user has zoomed or panned
    bool usesGraphicsCard() const;
    /// What draws it: the graphics card or software, as OpenGL names itself, or what is missing.
    QString drawingBackend() const;
    void setDrawing(bool isOn);
    bool isDrawing() const;
    /// Shapes above the picture, as a body that is dragged has them. Null: none.
    void setGhost(std::optional<Drawing> ghost);
    /// A line above the picture, in the model's coordinates: what is being drawn. Empty: none.
    void setSketch(std::vector<Point> points);

    /// The stage as shown, words included, with this many device pixels per logical one: for copying and
    /// saving.
    QImage picture(double pixelRatio);

    QSize sizeHint() const override { return {520, 320}; }
    QSize minimumSizeHint() const override { return {160, 120}; }

signals:
    void fittedChanged(bool isFitted);
    void strokeStarted();
    void stroke(const Point& from, const Point& to);  ///< in the model's coordinates
    void strokeEnded();
    void bodyTaken(const StagePlayer::Grip& grip);
    /// Where the pointer wants it, in the model's coordinates; with Shift the end of its velocity.
    void bodyMoved(const Point& target, bool isVelocity);
    /// With the velocity of the pointer per second, 0 where it was at rest.
    void bodyLet(const Point& velocity);

protected:
    void resizeEvent(QResizeEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void mouseDoubleClickEvent(QMouseEvent*) override;
    void leaveEvent(QEvent*) override;

private:
    void moveBody(const QMouseEvent& event);
    void letBody(quint64 now);  ///< in milliseconds, of the event
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace extremal
