// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme of the comparison: its line, name, step, what it cost and how wrong it was. After a failure the
/// card is amber and says what happened, when, and what to try.
#pragma once

#include <QFrame>
#include <memory>

#include "engine/run/comparison.hpp"
#include "ui/workspace/document.hpp"

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QProgressBar;
class QMenu;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace extremal {

class LineSample;
class SchemeEditor;
class ScrubLabel;
struct Theme;
class Workspace;

class SchemeCard : public QFrame {
    Q_OBJECT
public:
    SchemeCard(Workspace& workspace, int index, const Theme& theme, QWidget* parent = nullptr);

    int index() const { return index_; }
    const std::string& shownLabel() const { return shownLabel_; }
    /// The scheme has this place now.
    void setIndex(int index);
    void setTheme(const Theme& theme);
    /// Shows the scheme as it stands in the scene.
    void showSpec();
    /// Shows results, null if there are none; stale ones are dimmed.
    void showResult(const SchemeResult* result, bool isStale, const ReferenceInfo& reference);
    void setSelected(bool isSelected);
    void editName();
    /// Opens the step for editing; typing at a selected card begins with what was typed.
    void editStep(const QString& typed = {});
    void setEditing(bool isOpen);
    bool isEditing() const { return editor_ != nullptr; }

signals:
    void moveRequested(int index, int by);
    void neighbourRequested(int index, int by);  ///< the focus is to go to the row so far below

protected:
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;

private:
    struct Figure {
        QLabel *caption, *value;
    };
    void makeHeader();
    void placeStep();
    void makeFigures();
    void makeMenu(QToolButton& dots);
    void fillColours(QMenu& menu);
    void toggleOrSolo();
    void scaleStep(double factor);
    void showFailure(const Summary& summary);
    void showCaution();
    void takeRemedy();
    void finishName();
    void finishStep();
    void showRefusal();
    std::string stepPlace() const;
    const SchemeSpec& spec() const;
    bool hasElements() const;  ///< in place of steps: a boundary problem
    QString typedStep() const;
    Edit stepEdit(const Value& typed) const;

    Workspace& workspace_;
    int index_;
    std::string shownLabel_;
    const Theme* theme_;
    QVBoxLayout* layout_;
    QHBoxLayout *first_, *second_;
    LineSample* line_;
    QToolButton* dots_;
    ScrubLabel* step_;
    QLabel *name_, *parts_, *refusal_, *caution_, *events_, *failure_, *advice_;
    QPushButton* remedy_;
    QLineEdit *nameEdit_, *stepEdit_;
    QWidget* figures_;
    Figure cost_, error_, order_, steps_;
    QProgressBar* progress_;
    SchemeEditor* editor_ = nullptr;
    /// Of the card, and of name and step, where the step was put below the name.
    int widthBelow_ = 0, neededBelow_ = 0;
};

}  // namespace extremal
