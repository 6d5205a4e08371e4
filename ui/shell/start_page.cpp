// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/start_page.hpp"

#include <QFileInfo>
#include <QGridLayout>
#include <QHideEvent>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/base/background.hpp"
#include "ui/base/card.hpp"
#include "ui/pictures/card_picture.hpp"
#include "ui/shell/banners.hpp"
#include "ui/stage/gl/surface.hpp"

namespace extremal {

StartPage::StartPage(const Theme& theme, Notices& notices, QWidget* parent)
    : QWidget(parent), theme_(&theme), timer_(new QTimer(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("Presets"));
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    inside_ = new QWidget;
    inside_->setProperty("ground", "window");
    auto* column = new QVBoxLayout(inside_);
    column->setContentsMargins(24, 20, 24, 20);
    column->setSpacing(14);
    makeHead(*column);
    column->addWidget(new Banners(notices));
    unsaved_ = new QWidget;
    unsaved_->setObjectName("unsaved");
    auto* unsavedColumn = new QVBoxLayout(unsaved_);
    unsavedColumn->setContentsMargins(0, 0, 0, 0);
    unsavedColumn->addWidget(
        makeLabel(tr("Continue: not saved when the program ended unexpectedly"), "title"));
    unsavedGrid_ = new QGridLayout;
    unsavedGrid_->setSpacing(12);
    unsavedColumn->addLayout(unsavedGrid_);
    unsaved_->hide();
    column->addWidget(unsaved_);
    gallery_ = new QVBoxLayout;
    gallery_->setSpacing(14);
    column->addLayout(gallery_);
    column->addStretch();
    scroll->setWidget(inside_);
    layout->addWidget(scroll);
    timer_->setInterval(25);
    connect(timer_, &QTimer::timeout, this, &StartPage::work);
}

void StartPage::makeHead(QVBoxLayout& column) {
    auto* head = new QHBoxLayout;
    back_ = new QPushButton;
    back_->setObjectName("back");
    back_->setToolTip(tr("To the scene as it was (Esc)"));
    back_->hide();
    connect(back_, &QPushButton::clicked, this, &StartPage::backRequested);
    auto* words = new QVBoxLayout;
    words->setSpacing(3);
    words->addWidget(makeLabel(tr("Choose a comparison"), "heading"));
    auto* about = makeLabel(
        tr("Pick a function space and a quadrature rule: the stationarity of the discrete action is the "
           "integrator. Each card is a finished comparison; change anything in it."),
        "caption");
    about->setWordWrap(true);
    words->addWidget(about);
    head->addWidget(back_, 0, Qt::AlignVCenter);
    head->addSpacing(10);
    head->addLayout(words, 1);
    search_ = new QLineEdit;
    search_->setObjectName("search");
    search_->setPlaceholderText(tr("Search"));
    search_->setAccessibleName(tr("Search the presets"));
    search_->setClearButtonEnabled(true);
    search_->setMinimumWidth(160);
    connect(search_, &QLineEdit::textChanged, this, [this] {
        columns_ = 0;
        arrange();
    });
    connect(search_, &QLineEdit::returnPressed, this, [this] {
        if (const QStringList shown = shownPresets(); !shown.isEmpty()) emit presetChosen(shown.front());
    });
    head->addWidget(search_, 0, Qt::AlignVCenter);
    auto* first = new QPushButton(tr("Why the energy stays"));
    first->setObjectName("firstLesson");
    first->setProperty("kind", "primary");
    first->setToolTip(tr("A lesson of five steps, on a planet whose energy one scheme loses"));
    connect(first, &QPushButton::clicked, this, [this] { emit lessonChosen(QStringLiteral("kepler")); });
    head->addWidget(first, 0, Qt::AlignVCenter);
    auto* lessons = new QPushButton(tr("Lessons"));
    lessons->setObjectName("lessons");
    lessons->setToolTip(tr("Presets with steps that lead through them"));
    connect(lessons, &QPushButton::clicked, this, [this] { search(tr("lesson steps")); });
    head->addWidget(lessons, 0, Qt::AlignVCenter);
    auto* lagrangian = new QPushButton(tr("New from a Lagrangian"));
    lagrangian->setObjectName("newLagrangian");
    connect(lagrangian, &QPushButton::clicked, this, &StartPage::newRequested);
    head->addWidget(lagrangian, 0, Qt::AlignVCenter);
    auto* open = new QPushButton(tr("Open a scene..."));
    connect(open, &QPushButton::clicked, this, &StartPage::openRequested);
    head->addWidget(open, 0, Qt::AlignVCenter);
    column.addLayout(head);
    recent_ = new QWidget;
    recentRow_ = new QHBoxLayout(recent_);
    recentRow_->setContentsMargins(0, 0, 0, 0);
    recent_->hide();
    column.addWidget(recent_);
}

void StartPage::makeSections() {
    for (const GallerySection& section : readGallery()) {
        auto* box = new QWidget;
        auto* inBox = new QVBoxLayout(box);
        inBox->setContentsMargins(0, 4, 0, 0);
        auto* title = new QHBoxLayout;
        title->addWidget(makeLabel(section.title, "title"));
        title->addWidget(makeElidedLabel(section.about, "caption"), 1);
        inBox->addLayout(title);
        auto* grid = new QGridLayout;
        grid->setSpacing(12);
        inBox->addLayout(grid);
        gallery_->addWidget(box);
        Section& made = sections_.emplace_back(Section{box, grid, {}});
        for (const GalleryItem& item : section.items) {
            made.entries.push_back(entries_.size());
            auto* card = new GalleryCard(item.title, item.lesson, box);
            card->setObjectName("preset." + item.id);
            connect(card, &GalleryCard::chosen, this, [this, id = item.id] { emit presetChosen(id); });
            if (item.steps > 0) card->offerLesson(item.steps);
            connect(card, &GalleryCard::lessonChosen, this, [this, id = item.id] { emit lessonChosen(id); });
            entries_.push_back(std::make_unique<Entry>(Entry{card, item.id, item}));
        }
    }
}

void StartPage::setRecent(const QStringList& files) {
    while (QLayoutItem* item = recentRow_->takeAt(0)) {
        if (item->widget()) item->widget()->deleteLater();
        delete item;
    }
    recentRow_->addWidget(makeLabel(tr("Recent"), "title"));
    for (const QString& file : files) {
        auto* button = new QPushButton(QFileInfo(file).fileName());
        button->setProperty("kind", "flat");
        button->setToolTip(file);
        connect(button, &QPushButton::clicked, this, [this, file] { emit fileChosen(file); });
        recentRow_->addWidget(button);
    }
    recentRow_->addStretch();
    recent_->setVisible(!files.isEmpty());
}

void StartPage::offer(std::vector<UnsavedScene> scenes) {
    waiting_.clear();
    run_.reset();
    for (const auto& entry : unsavedEntries_) entry->card->deleteLater();
    unsavedEntries_.clear();
    for (const UnsavedScene& scene : scenes) {
        ReadScene read = readScene(scene.document);
        const QString when = QLocale().toString(scene.time, "d MMMM, HH:mm"),
                      title = QString::fromStdString(read.scene.title);
        auto* card = new GalleryCard(
            scene.name, title.isEmpty() ? when : title + QStringLiteral("  ·  ") + when, unsaved_);
        connect(card, &GalleryCard::chosen, this, [this, scene] { emit restoreRequested(scene); });
        auto* discard = new QPushButton(tr("Discard"), card);
        discard->setProperty("kind", "flat");
        discard->setAccessibleName(tr("Discard %1").arg(scene.name));
        connect(discard, &QPushButton::clicked, this, [this, scene] { emit discardRequested(scene); });
        card->header()->addWidget(discard);
        Entry& entry = *unsavedEntries_.emplace_back(std::make_unique<Entry>(Entry{card, {}}));
        if (!read.errors.empty()) continue;
        entry.scene = std::move(read.scene);
        waiting_.push_back(&entry);
    }
    unsaved_->setVisible(!scenes.empty());
    columns_ = 0;
    arrange();
    if (hasLoaded_) loadPictures();
}

void StartPage::setTheme(const Theme& theme) {
    theme_ = &theme;
    waiting_.clear();
    run_.reset();  // it was of one that no longer waits
    for (const auto& entry : unsavedEntries_)
        if (entry->scene) waiting_.push_back(entry.get());
    hasLoaded_ = false;
    if (isVisible()) loadPictures();
}

void StartPage::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (sections_.empty()) {
        makeSections();
        columns_ = 0;
        arrange();
        hasLoaded_ = false;
    }
    if (!hasLoaded_) loadPictures();
    timer_->start();
}

/// The cards are made anew when the page is shown again: a change of theme would style all of them.
void StartPage::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    if (event->spontaneous()) return;
    run_.reset();
    std::erase_if(waiting_, [](const Entry* entry) { return !entry->preset.isEmpty(); });
    for (const Section& section : sections_) section.box->deleteLater();
    sections_.clear();
    entries_.clear();
}

void StartPage::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void StartPage::setBack(const QString& title) {
    constexpr int room = 240;
    back_->setText(
        tr("Back to %1").arg(fontMetrics().elidedText(title, Qt::ElideRight, room)).replace('&', "&&"));
    back_->setAccessibleName(tr("Back to %1").arg(title));
    back_->setVisible(!title.isEmpty());
}

void StartPage::search(const QString& text) { search_->setText(text); }

QStringList StartPage::shownPresets() const {
    QStringList shown;
    for (const Section& section : sections_)
        for (const std::size_t i : section.entries)
            if (!entries_[i]->card->isHidden()) shown << entries_[i]->preset;
    return shown;
}

void StartPage::arrange() {
    const int columns = std::max(1, (width() - 40) / (cardPictureSize.width() + 44));
    if (columns == columns_) return;
    columns_ = columns;
    const auto fill = [&](QGridLayout& grid, const std::vector<GalleryCard*>& cards) {
        while (QLayoutItem* item = grid.takeAt(0)) delete item;
        int at = 0;
        for (GalleryCard* card : cards) {
            grid.addWidget(card, at / columns, at % columns);
            ++at;
        }
        for (int c = 0; c < std::max(columns, grid.columnCount()); ++c) {
            grid.setColumnStretch(c, c < columns ? 1 : 0);  // one card alone is as wide as the others
            grid.setColumnMinimumWidth(c, c < columns ? 1 : 0);
        }
    };
    std::vector<GalleryCard*> cards;
    for (const auto& entry : unsavedEntries_) cards.push_back(entry->card);
    fill(*unsavedGrid_, cards);
    const QString text = search_->text();
    for (const Section& section : sections_) {
        cards.clear();
        for (const std::size_t i : section.entries) {
            const bool isFound = matches(entries_[i]->item, text);
            entries_[i]->card->setVisible(isFound);
            if (isFound) cards.push_back(entries_[i]->card);
        }
        fill(*section.grid, cards);
        section.box->setVisible(!cards.empty());
    }
}

/// Pictures come from files, read in another thread; what has none is made afterwards.
void StartPage::loadPictures() {
    hasLoaded_ = true;
    QStringList presets;
    for (const auto& entry : entries_) presets << entry->preset;
    runInBackground(
        [self = QPointer(this), presets, folder = presetPictureFolder(), isDark = theme_->isDark] {
            for (qsizetype i = 0; i < presets.size(); ++i) {
                QImage image(presetPictureFile(folder, presets[i], isDark));
                image.setDevicePixelRatio(cardPictureRatio);
                sendToWindow([self, i, image, isDark] {
                    if (!self || self->theme_->isDark != isDark) return;
                    if (static_cast<std::size_t>(i) >= self->entries_.size()) return;  // hidden meanwhile
                    Entry& entry = *self->entries_[static_cast<std::size_t>(i)];
                    if (!image.isNull()) return entry.card->setPicture(image);
                    self->waiting_.push_back(&entry);
                    self->timer_->start();
                });
            }
        });
    timer_->start();
}

void StartPage::work() {
    if (isReading_) return;
    if (!isVisible() || waiting_.empty()) {
        timer_->stop();
        run_.reset();
        return;
    }
    Entry& entry = *waiting_.front();
    if (!entry.scene) {  // some presets take a while to be read
        isReading_ = true;
        runInBackground([self = QPointer(this), id = entry.preset] {
            const Preset* preset = findPreset(id.toStdString());
            auto read = std::make_shared<ReadScene>(readScene(preset->json));
            sendToWindow([self, read, id] {
                if (!self) return;
                self->isReading_ = false;
                for (const auto& e : self->entries_)
                    if (e->preset == id) e->scene = sceneOfPicture(std::move(read->scene));
            });
        });
        return;
    }
    if (!entry.result) {
        if (!run_) {
            RunOptions options{.threads = 1, .products = {Product::denseOutput}};
            options.isTimed = false;
            run_ = std::make_unique<Run>(sceneOfPicture(*entry.scene), options);
            run_->start();
        }
        if (!run_->isFinished()) return;
        entry.result = std::make_shared<const Comparison>(run_->latest());
        run_.reset();
    }
    try {
        entry.card->setPicture(cardPicture(entry.result, *theme_, devicePixelRatioF()));
    } catch (const OpenGlUnavailable&) {
        // A card without a picture.
    }
    waiting_.pop_front();
}

}  // namespace extremal
