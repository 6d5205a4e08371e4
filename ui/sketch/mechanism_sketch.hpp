// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawing a mechanism on the stage: the palette, the sheet and the line of values, and what becomes of the
/// drawing in the scene.
///
/// Every change of the drawing is tried as an edit of the scene. A drawing that is sound is the model of the
/// scene at once, and runs behind the sheet; one that is not yet so waits, with the reason at the top of the
/// sheet, and what is a mistake is a banner besides. Observables and plots of a scene that was drawn here
/// follow what is in it, as long as they are not chosen by hand.
#pragma once

#include <QWidget>

#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"

class QAbstractButton;
class QHBoxLayout;

namespace extremal {

class ElementLine;
class SketchCanvas;
class StageWidget;
class Workspace;
struct Edit;
struct Theme;

/// A scene to draw a mechanism in.
Value newMechanismScene();

class MechanismSketch : public QWidget {
    Q_OBJECT
public:
    /// The sheet lies over the stage; this widget has the palette and the line of values.
    MechanismSketch(Workspace& workspace, StageWidget& stage, QWidget* parent = nullptr);

    void setTheme(const Theme& theme);
    /// Begins with the mechanism of the scene, or where `isEmpty` with an empty sheet.
    void begin(bool isEmpty = false);
    void end();
    bool isOpen() const { return isOpen_; }
    SketchCanvas& canvas() { return *canvas_; }

signals:
    void openChanged(bool isOpen);
    void played();  ///< a drawing runs: from its start
    void refused(const QString& reason, const QString& remedy);
    void accepted();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void makePalette(QHBoxLayout& row);
    void fitEmptySheet();
    void apply();
    std::vector<Edit> edits() const;
    void followScene();
    void showProblems(const std::vector<Problem>& problems);

    Workspace& workspace_;
    StageWidget& stage_;
    SketchCanvas* canvas_;
    ElementLine* line_;
    std::vector<QAbstractButton*> buttons_;
    bool isOpen_ = false, isApplying_ = false;
};

}  // namespace extremal
