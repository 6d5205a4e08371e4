// SPDX-License-Identifier: GPL-3.0-or-later
/// The page of notes: as they are read, and as they are written. Writing begins with a button or a double
/// click and ends with the button or Esc; one edit of the scene is made of it.
#pragma once

#include <QWidget>

class QPlainTextEdit;
class QPushButton;
class QStackedWidget;

namespace extremal {

class TextView;
class Workspace;

class NotesPage : public QWidget {
    Q_OBJECT
public:
    NotesPage(Workspace& workspace, TextView* view, QWidget* parent = nullptr);
    bool isWriting() const;
    void write();
    /// Takes what was written. False if nothing is.
    bool finish();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    Workspace& workspace_;
    TextView* view_;
    QPlainTextEdit* text_;
    QStackedWidget* stack_;
    QPushButton* button_;
};

}  // namespace extremal
