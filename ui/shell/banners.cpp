// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/banners.hpp"

#include <QAccessibleWidget>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/base/card.hpp"
#include "ui/base/notices.hpp"
#include "ui/panels/problem_text.hpp"

namespace extremal {
namespace {

/// A banner that was not there before: screen readers say it when it is shown.
class AlertFace : public QAccessibleWidget {
public:
    explicit AlertFace(QWidget* banner) : QAccessibleWidget(banner, QAccessible::AlertMessage) {}
};
constexpr const char* isNew = "isNew";
QAccessibleInterface* faceOf(const QString&, QObject* object) {
    auto* const widget = qobject_cast<QFrame*>(object);
    return widget && widget->property(isNew).toBool() ? new AlertFace(widget) : nullptr;
}

/// In the style sheet.
const char* nameOf(Notice::Kind kind) {
    return kind == Notice::Kind::error ? "error" : kind == Notice::Kind::warning ? "warning" : "information";
}

}  // namespace

Banners::Banners(Notices& notices, QWidget* parent)
    : QWidget(parent), notices_(notices), layout_(new QVBoxLayout(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(6);
    QAccessible::installFactory(faceOf);
    connect(&notices_, &Notices::changed, this, &Banners::rebuild);
    rebuild();
}

void Banners::rebuild() {
    while (QLayoutItem* item = layout_->takeAt(0)) {
        if (item->widget()) item->widget()->deleteLater();
        delete item;
    }
    QStringList said;
    for (const Notice& notice : notices_.all()) {
        const QString words =
            notice.hint.isEmpty() ? notice.text : notice.text + QStringLiteral("  ·  ") + notice.hint;
        said << words;
        auto* banner = new QFrame;
        banner->setProperty(isNew, !said_.contains(words));  // before it has a face
        banner->setParent(this);
        banner->setAccessibleName(words);
        banner->setProperty("banner", nameOf(notice.kind));
        auto* row = new QHBoxLayout(banner);
        row->setContentsMargins(12, 6, 8, 6);
        auto* text = makeLinkLabel("", banner);
        text->setText(words.toHtmlEscaped() + QStringLiteral("  ") + handbookLink(notice.place));
        setHelp(*banner, notice.place);
        row->addWidget(text, 1);
        const QString key = notice.key;
        for (const Notice::Choice& choice : notice.choices) {
            auto* button = new QPushButton(choice.text, banner);
            connect(button, &QPushButton::clicked, this, [this, act = choice.act, key] {
                notices_.dismiss(key);
                if (act) act();
            });
            row->addWidget(button);
        }
        auto* close = new QPushButton(tr("Dismiss"), banner);
        close->setProperty("kind", "flat");
        connect(close, &QPushButton::clicked, this, [this, key] { notices_.dismiss(key); });
        row->addWidget(close);
        layout_->addWidget(banner);
    }
    said_ = said;
    setVisible(!notices_.all().empty());
}

}  // namespace extremal
