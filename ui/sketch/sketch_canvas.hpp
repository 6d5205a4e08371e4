// SPDX-License-Identifier: GPL-3.0-or-later
/// The sheet on which a mechanism is drawn, laid over the stage: it has the stage's camera, so that the
/// motion is seen behind the drawing.
///
/// Each tool has a key. Places snap to points, else to a grid that follows the zoom; Alt leaves them free. A
/// link is dragged from point to point, or made by two clicks. What is drawn is a state of the drawing, which
/// undo takes back.
#pragma once

#include <QWidget>

#include <optional>
#include <vector>

#include "ui/sketch/mechanism_drawing.hpp"
#include "ui/stage/camera.hpp"

class QKeyEvent;
class QPainter;

namespace extremal {

struct Theme;

/// What a press on the sheet does.
struct SketchTool {
    enum class Kind { select, point, fixedPoint, rod, spring, damper, pin, body, slider, motor, wall };
    Kind kind = Kind::select;
    QString name;  ///< of the button
    Qt::Key key = Qt::Key_unknown;
    QString hint;  ///< how to use it
};
const std::vector<SketchTool>& sketchTools();

class SketchCanvas : public QWidget {
    Q_OBJECT
public:
    explicit SketchCanvas(QWidget* parent);

    void setTheme(const Theme& theme);
    void setCamera(const Camera& camera);
    const Camera& camera() const { return camera_; }
    /// Whether the stage behind it is hidden, as one that shows something else.
    void setOpaque(bool isOpaque);
    /// A line at the top: why it does not run yet. Empty: how to use the tool.
    void setNote(const QString& note);

    const MechanismDrawing& drawing() const { return drawing_; }
    /// Changes from outside: `change` gets the drawing.
    template <class Change>
    void change(Change change) {
        change(drawing_);
        afterChange();
    }
    /// Another drawing, with a history of its own.
    void begin(const MechanismDrawing& drawing);
    const std::optional<MechanismDrawing::Element>& selected() const { return selected_; }
    void select(std::optional<MechanismDrawing::Element> element);
    SketchTool::Kind tool() const { return tool_; }
    void setTool(SketchTool::Kind tool);

signals:
    void changed();  ///< the drawing is another one
    void selectionChanged();
    void toolChanged();
    void cameraChanged();
    void left();  ///< Esc where there is nothing else to leave

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void leaveEvent(QEvent*) override;

private:
    using Place = MechanismDrawing::Place;
    void afterChange();
    Place under(QPointF at) const;
    QPointF onSheet(const Place& place) const;
    double reach() const;  ///< of the pointer, in lengths of the model
    double gridStep() const;
    Place snapped(QPointF at, Qt::KeyboardModifiers modifiers) const;
    void pressSelect(QPointF at);
    void click(const Place& place);
    void drag(const Place& from, const Place& to);
    void clickLink(const Place& place);
    bool takesKey(const QKeyEvent& key) const;

    void paintGrid(QPainter& painter) const;
    void paintDrawing(QPainter& painter, const MechanismDrawing& drawing) const;
    void paintLine(QPainter& painter, const MechanismDrawing::Line& line) const;
    void paintPoint(QPainter& painter, const MechanismDrawing& drawing,
                    const MechanismDrawing::Line& point) const;
    void paintHand(QPainter& painter) const;

    const Theme* theme_;
    Camera camera_;
    MechanismDrawing drawing_;
    std::optional<MechanismDrawing> moving_;  ///< while a point is dragged
    SketchTool::Kind tool_ = SketchTool::Kind::select;
    std::optional<MechanismDrawing::Element> selected_, dragged_;
    std::optional<Place> from_;  ///< where a link begins
    std::optional<QPointF> pressed_, panned_;
    Place pointer_{};
    bool hasPointer_ = false, isOpaque_ = false;
    bool firstClick_ = false;  ///< of a link that is made by two
    QString note_;
};

}  // namespace extremal
