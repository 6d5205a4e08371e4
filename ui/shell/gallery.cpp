// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/gallery.hpp"

#include <QFile>
#include <QImage>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <set>
#include <string>

#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/pictures/card_picture.hpp"

namespace extremal {
namespace {

QString textAt(const Value& value, const char* key) {
    const Value* found = value.find(key);
    return found && found->isString() ? QString::fromStdString(found->asString()) : QString();
}

GalleryItem itemOf(const Preset& preset) {
    const Value scene = parseJson(preset.json);
    GalleryItem item{QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size())),
                     textAt(scene, "title"),
                     textAt(scene, "lesson"),
                     {}};
    item.words = (QStringList{item.id, item.title, item.lesson, textAt(scene, "source")}).join(' ').toLower();
    if (const Value* steps = scene.find("steps")) {
        item.steps = static_cast<int>(steps->asArray().size());
        item.words += QStringLiteral(" lesson steps");
    }
    if (const Value* model = scene.find("model")) item.words += ' ' + textAt(*model, "type");
    return item;
}

}  // namespace

std::vector<GallerySection> readGallery() {
    QFile file(QStringLiteral(":/gallery.json"));
    std::vector<GallerySection> sections;
    if (!file.open(QIODevice::ReadOnly)) return sections;
    const Value gallery = parseJson(file.readAll().toStdString());
    std::set<std::string, std::less<>> named;
    for (const Value& entry : gallery.find("sections")->asArray()) {
        GallerySection& section =
            sections.emplace_back(GallerySection{textAt(entry, "title"), textAt(entry, "about"), {}});
        for (const Value& id : entry.find("presets")->asArray())
            if (const Preset* preset = findPreset(id.asString())) {
                section.items.push_back(itemOf(*preset));
                named.insert(id.asString());
            }
    }
    for (const Preset& preset : presets())
        if (!named.contains(preset.id) && !sections.empty()) sections.back().items.push_back(itemOf(preset));
    return sections;
}

bool matches(const GalleryItem& item, const QString& search) {
    const QStringList words = search.toLower().split(' ', Qt::SkipEmptyParts);
    return std::all_of(words.begin(), words.end(),
                       [&](const QString& word) { return item.words.contains(word); });
}

GalleryCard::GalleryCard(const QString& title, const QString& text, QWidget* parent) : Card(title, parent) {
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    picture_ = new QLabel(this);
    picture_->setFixedHeight(cardPictureSize.height());
    picture_->setAlignment(Qt::AlignCenter);
    body()->addWidget(picture_);
    auto* label = makeLabel(text, "caption", this);
    label->setWordWrap(true);
    label->setMinimumHeight(34);
    label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    body()->addWidget(label);
    body()->addStretch();
}

void GalleryCard::setPicture(const QImage& image) {
    hasPicture_ = !image.isNull();
    picture_->setPixmap(QPixmap::fromImage(image));
}

void GalleryCard::offerLesson(int steps) {
    auto* button = new QPushButton(tr("Lesson in %n steps", nullptr, steps), this);
    button->setObjectName("lesson");
    button->setProperty("kind", "chip");
    connect(button, &QPushButton::clicked, this, &GalleryCard::lessonChosen);
    header()->addWidget(button);
}

void GalleryCard::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && rect().contains(event->pos())) emit chosen();
}

void GalleryCard::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter || event->key() == Qt::Key_Space)
        emit chosen();
    else
        Card::keyPressEvent(event);
}

void GalleryCard::enterEvent(QEnterEvent*) { setSelected(true); }
void GalleryCard::leaveEvent(QEvent*) { setSelected(hasFocus()); }
void GalleryCard::focusInEvent(QFocusEvent*) { setSelected(true); }
void GalleryCard::focusOutEvent(QFocusEvent*) { setSelected(false); }

}  // namespace extremal
