// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/text_view.hpp"

#include <QCursor>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/passport/document.hpp"
#include "ui/text/foreign_text.hpp"
#include "ui/text/formula_text.hpp"
#include "ui/text/typeset.hpp"

namespace extremal {
namespace {

constexpr double marginOfPage = 18;

}  // namespace

TextView::TextView(QWidget* parent) : QTextBrowser(parent) {
    setOpenLinks(false);
    connect(this, &QTextBrowser::anchorClicked, this, [this](const QUrl& url) {
        const QPoint link = viewport()->mapToGlobal(cursorRect().bottomLeft());
        followLink(url, *this, underMouse() ? QCursor::pos() : link);
    });
}

void TextView::showText(const QString& markdown) {
    auto document = std::make_unique<ForeignDocument>(this);
    document->setDefaultFont(font());
    document->read(markdown);
    document->setDocumentMargin(mostLines_ > 0 ? 0 : marginOfPage);
    showTypeset(*this, document.release());
    fit();
}

void TextView::showPage(const Document& page, const QString& ending) {
    auto document = std::make_unique<ForeignDocument>(this);
    document->setDefaultFont(font());
    document->readPage(QString::fromStdString(written(page, PageFormat::markdown)) + ending);
    document->setDocumentMargin(marginOfPage);
    formatPage(*document);
    showTypeset(*this, document.release());
}

void TextView::setFitted(int mostLines) {
    mostLines_ = mostLines;
    setProperty("fitted", true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    fit();
}

/// The bar appears only above the limit: shown for a moment, it would narrow the text and so keep itself.
void TextView::fit() {
    if (mostLines_ <= 0) return;
    const int most = mostLines_ * fontMetrics().lineSpacing();
    document()->setTextWidth(viewport()->width());
    const int wanted = static_cast<int>(std::ceil(document()->size().height()));
    setVerticalScrollBarPolicy(wanted > most ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
    setFixedHeight(std::clamp(wanted, fontMetrics().height(), most));
}

void TextView::resizeEvent(QResizeEvent* event) {
    QTextBrowser::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) fit();
}

}  // namespace extremal
