// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/card.hpp"

#include <QLabel>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QTextLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "ui/base/theme.hpp"

namespace extremal {

namespace {

/// The words of a text that have room, and an ellipsis; a first word that has none is cut.
QString shortenedTo(const QString& text, const QFontMetrics& metrics, int room) {
    const QString cut = metrics.elidedText(text, Qt::ElideRight, room);
    if (cut == text) return text;
    const qsizetype kept = cut.size() - 1;
    const bool isBetweenWords = kept < text.size() && text[kept] == ' ';
    const qsizetype end = isBetweenWords ? kept : text.lastIndexOf(' ', std::max<qsizetype>(0, kept - 1));
    if (end <= 0 || end > kept) return cut;
    QString words = text.left(end);
    while (!words.isEmpty() && !words.back().isLetterOrNumber() && words.back() != ')') words.chop(1);
    if (words.isEmpty()) return cut;
    const QString spaced = words + QStringLiteral(" …");
    return metrics.horizontalAdvance(spaced) <= room ? spaced : words + QStringLiteral("…");
}

/// QLabel has no ellipsis of its own.
class ElidedLabel : public QLabel {
public:
    using QLabel::QLabel;
    QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.setFont(font());
        painter.setPen(palette().color(foregroundRole()));
        const QString shown = shortenedTo(text(), fontMetrics(), width());
        if (shown != text() && (toolTip().isEmpty() || toolTip() == ownTip_)) setToolTip(ownTip_ = text());
        painter.drawText(rect(), Qt::AlignVCenter | static_cast<int>(alignment() & Qt::AlignHorizontal_Mask),
                         shown);
    }

private:
    QString ownTip_;  ///< the whole text, where it is shortened
};

/// QLabel breaks no words, and asks for the width of the longest.
class WrappedLabel : public QLabel {
public:
    using QLabel::QLabel;
    QSize sizeHint() const override {
        return {static_cast<int>(std::ceil(fontMetrics().horizontalAdvance(text()))) + 1,
                fontMetrics().height()};
    }
    QSize minimumSizeHint() const override {
        constexpr int leastLetters = 5;
        return {leastLetters * fontMetrics().averageCharWidth(), fontMetrics().height()};
    }
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override {
        int height = 0;
        forEachLine(width,
                    [&](const QTextLine& line) { height += static_cast<int>(std::ceil(line.height())); });
        return std::max(height, fontMetrics().height());
    }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.setPen(palette().color(foregroundRole()));
        double y = std::max(0, (height() - heightForWidth(width())) / 2);
        forEachLine(width(), [&](const QTextLine& line) {
            line.draw(&painter, {0, y});
            y += std::ceil(line.height());
        });
    }

private:
    template <class Act>
    void forEachLine(int width, const Act& act) const {
        QTextLayout layout(text(), font());
        QTextOption option;
        option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
        layout.setTextOption(option);
        layout.beginLayout();
        for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine())
            line.setLineWidth(std::max(1, width));
        layout.endLayout();
        for (int i = 0; i < layout.lineCount(); ++i) act(layout.lineAt(i));
    }
};

}  // namespace

QLabel* makeWrappedLabel(const QString& text, const char* role, QWidget* parent) {
    auto* label = new WrappedLabel(text, parent);
    label->setTextFormat(Qt::PlainText);
    label->setProperty("role", role);
    QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    label->setSizePolicy(policy);
    return label;
}

QLabel* makeLabel(const QString& text, const char* role, QWidget* parent) {
    auto* label = new QLabel(parent);
    label->setTextFormat(Qt::PlainText);
    label->setText(text);
    label->setProperty("role", role);
    return label;
}

QLabel* makeElidedLabel(const QString& text, const char* role, QWidget* parent) {
    auto* label = new ElidedLabel(text, parent);
    label->setTextFormat(Qt::PlainText);
    label->setProperty("role", role);
    label->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
    return label;
}

Card::Card(const QString& title, QWidget* parent) : QFrame(parent) {
    setProperty("card", true);
    setAccessibleName(title);
    body_ = new QVBoxLayout(this);
    body_->setContentsMargins(12, 9, 12, 11);
    body_->setSpacing(6);
    header_ = new QHBoxLayout;
    header_->setSpacing(6);
    title_ = makeElidedLabel(title, "title");
    subtitle_ = makeElidedLabel({}, "caption");
    header_->addWidget(title_);
    header_->addWidget(subtitle_, 1);
    header_->addStretch();
    body_->addLayout(header_);
    subtitle_->hide();
    title_->setVisible(!title.isEmpty());  // not before it has a parent: it would be a window for a moment
}

void Card::setTitle(const QString& title) {
    title_->setToolTip({});
    title_->setText(title);
    title_->setVisible(!title.isEmpty());
    setAccessibleName(title);
    shareHeader();
}

/// The title has room first; what is left for the subtitle must be worth showing.
void Card::shareHeader() {
    constexpr int leastSubtitle = 48;
    const QMargins m = body_->contentsMargins();
    int room = width() - m.left() - m.right();
    for (int i = 2; i < header_->count(); ++i)
        if (const QWidget* other = header_->itemAt(i)->widget(); other && !other->isHidden())
            room -= other->sizeHint().width() + header_->spacing();
    const int left = room - title_->sizeHint().width() - header_->spacing();
    subtitle_->setVisible(!subtitle_->text().isEmpty() &&
                          left >= std::min(leastSubtitle, subtitle_->sizeHint().width()));
    subtitle_->setMaximumWidth(std::max(0, left));
}

void Card::resizeEvent(QResizeEvent* event) {
    QFrame::resizeEvent(event);
    shareHeader();
}

void Card::setSubtitle(const QString& subtitle) {
    subtitle_->setToolTip({});
    subtitle_->setText(subtitle);
    shareHeader();
}

void Card::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->position().y() <= header_->geometry().bottom() + body_->spacing())
        emit headerDoubleClicked();
    else
        QFrame::mouseDoubleClickEvent(event);
}

void Card::setSelected(bool isSelected) {
    if (property("selected").toBool() == isSelected) return;
    setProperty("selected", isSelected);
    repolish(*this);
}

QMenu* Card::menu() {
    if (!dots_) {
        dots_ = new QToolButton;
        dots_->setText(QStringLiteral("⋯"));
        dots_->setPopupMode(QToolButton::InstantPopup);
        dots_->setMenu(new QMenu(dots_));
        dots_->setAccessibleName(tr("More"));
        dots_->setToolTip(tr("More"));
        dots_->setFocusPolicy(Qt::TabFocus);
        dots_->setFixedSize(26, 20);
        dots_->setProperty("kind", "dots");
        header_->addWidget(dots_);
    }
    return dots_->menu();
}

}  // namespace extremal
