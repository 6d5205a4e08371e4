// SPDX-License-Identifier: GPL-3.0-or-later
/// A card: a titled panel with rounded corners; what the whole window is made of.
#pragma once

#include <QFrame>

class QBoxLayout;
class QLabel;
class QMenu;
class QToolButton;
class QVBoxLayout;

namespace extremal {

class Card : public QFrame {
    Q_OBJECT
public:
    explicit Card(const QString& title = {}, QWidget* parent = nullptr);

    void setTitle(const QString& title);
    void setSubtitle(const QString& subtitle);  ///< muted, beside the title
    void setSelected(bool isSelected);
    /// The menu behind the three dots; the dots appear with the first use.
    QMenu* menu();
    QVBoxLayout* body() const { return body_; }
    /// The row of the title, for what belongs at its right end.
    QBoxLayout* header() const { return header_; }

signals:
    void headerDoubleClicked();

protected:
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void shareHeader();
    QVBoxLayout* body_;
    QBoxLayout* header_;
    QLabel *title_, *subtitle_;
    QToolButton* dots_ = nullptr;
};

/// A label with a role of the style sheet ("caption", "strong", "title", "heading").
QLabel* makeLabel(const QString& text, const char* role, QWidget* parent = nullptr);

/// A label that gives way when there is little room: the text is shortened with an ellipsis and the whole of
/// it is in the tooltip.
QLabel* makeElidedLabel(const QString& text, const char* role, QWidget* parent = nullptr);

/// A label whose text goes on in further lines: between words, and inside one that is longer than a line.
QLabel* makeWrappedLabel(const QString& text, const char* role, QWidget* parent = nullptr);

}  // namespace extremal
