#include "ui/shell/start_page.hpp"

#include <QApplication>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QMouseEvent>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <functional>
#include <optional>

#include "engine/figure/figure.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/preset.hpp"
#include "ui/panels/card.hpp"
#include "ui/plots/plot_renderer.hpp"
#include "ui/shell/background.hpp"
#include "ui/shell/banners.hpp"

namespace extremal {
namespace {

constexpr QSize pictureSize(300, 170);

/// A card that is one big button.
class PresetCard : public Card {
public:
    PresetCard(const QString& title, std::function<void()> act, QWidget* parent)
        : Card(title, parent), act_(std::move(act)) {
        setFocusPolicy(Qt::StrongFocus);
        setCursor(Qt::PointingHandCursor);
        setAccessibleName(title);
    }

protected:
    void mouseReleaseEvent(QMouseEvent* event) override {
        if (event->button() == Qt::LeftButton && rect().contains(event->pos())) act_();
    }
    void keyPressEvent(QKeyEvent* event) override {
        if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Space)
            act_();
        else
            Card::keyPressEvent(event);
    }
    void enterEvent(QEnterEvent*) override { setSelected(true); }
    void leaveEvent(QEvent*) override { setSelected(hasFocus()); }
    void focusInEvent(QFocusEvent*) override { setSelected(true); }
    void focusOutEvent(QFocusEvent*) override { setSelected(false); }

private:
    std::function<void()> act_;
};

}  // namespace

struct StartPage::Entry {
    Scene scene;
    PresetCard* card;
    QLabel* picture;
    Comparison result;
    std::optional<UnsavedScene> unsaved;  ///< else a preset
};

StartPage::StartPage(const Theme& theme, Notices& notices, QWidget* parent)
    : QWidget(parent), theme_(&theme), timer_(new QTimer(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    inside_ = new QWidget;
    inside_->setProperty("ground", "window");
    auto* column = new QVBoxLayout(inside_);
    column->setContentsMargins(24, 20, 24, 20);
    column->setSpacing(14);
    auto* head = new QHBoxLayout;
    auto* words = new QVBoxLayout;
    words->setSpacing(3);
    words->addWidget(makeLabel(tr("Choose a comparison"), "heading"));
    words->addWidget(makeLabel(
        tr("Pick a function space and a quadrature rule: the stationarity of the discrete action is the "
           "integrator. Each card is a finished comparison; change anything in it."),
        "caption"));
    head->addLayout(words, 1);
    auto* open = new QPushButton(tr("Open a scene..."));
    connect(open, &QPushButton::clicked, this, &StartPage::openRequested);
    head->addWidget(open);
    column->addLayout(head);
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
    grid_ = new QGridLayout;
    grid_->setSpacing(12);
    column->addLayout(grid_);
    column->addStretch();
    scroll->setWidget(inside_);
    layout->addWidget(scroll);

    timer_->setInterval(25);
    connect(timer_, &QTimer::timeout, this, &StartPage::work);
}

StartPage::~StartPage() { reading_.request_stop(); }

/// Reads the presets in another thread, some of which take a while, and adds their cards as they come: the
/// headline first, then the others by name.
void StartPage::readPresets() {
    hasReadPresets_ = true;
    runInBackground([self = QPointer(this), stop = reading_.get_token()] {
        std::vector<const Preset*> order;
        for (const Preset& p : presets()) order.push_back(&p);
        std::stable_partition(order.begin(), order.end(),
                              [](const Preset* p) { return p->id == "spring-pendulum"; });
        for (const Preset* p : order) {
            if (stop.stop_requested()) return;
            auto read = std::make_shared<ReadScene>(readScene(p->json));
            if (!read->errors.empty()) continue;
            QMetaObject::invokeMethod(
                qApp,
                [self, read, id = QString::fromUtf8(p->id.data(), static_cast<qsizetype>(p->id.size()))] {
                    if (self) self->addPreset(id, std::move(read->scene));
                },
                Qt::QueuedConnection);
        }
    });
}

void StartPage::addPreset(const QString& id, Scene scene) {
    const QString title = QString::fromStdString(scene.title), lesson = QString::fromStdString(scene.lesson);
    const Entry& entry = addCard(std::move(scene), title, lesson, [this, id] { emit presetChosen(id); });
    const int at = grid_->count();
    if (columns_ > 0) grid_->addWidget(entry.card, at / columns_, at % columns_);
    if (isVisible()) timer_->start();
}

StartPage::Entry& StartPage::addCard(Scene scene, const QString& title, const QString& text,
                                     std::function<void()> act) {
    auto entry = std::make_unique<Entry>();
    entry->scene = std::move(scene);
    entry->card = new PresetCard(title, std::move(act), inside_);
    entry->picture = new QLabel(entry->card);
    entry->picture->setFixedHeight(pictureSize.height());
    entry->picture->setAlignment(Qt::AlignCenter);
    entry->card->body()->addWidget(entry->picture);
    auto* label = makeLabel(text, "caption", entry->card);
    label->setWordWrap(true);
    label->setMinimumHeight(34);
    label->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    entry->card->body()->addWidget(label);
    waiting_.push_back(entries_.size());
    return *entries_.emplace_back(std::move(entry));
}

void StartPage::offer(std::vector<UnsavedScene> scenes) {
    std::erase_if(entries_, [](const auto& entry) {
        if (entry->unsaved) entry->card->deleteLater();
        return entry->unsaved.has_value();
    });
    waiting_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (entries_[i]->picture->pixmap().isNull()) waiting_.push_back(i);
    for (UnsavedScene& scene : scenes) {
        ReadScene read = readScene(scene.document);
        const QString when = QLocale().toString(scene.time, "d MMMM, HH:mm"),
                      title = QString::fromStdString(read.scene.title);
        Entry& entry = addCard(std::move(read.scene), scene.name,
                               title.isEmpty() ? when : title + QStringLiteral("  ·  ") + when,
                               [this, scene] { emit restoreRequested(scene); });
        entry.unsaved = scene;
        auto* discard = new QPushButton(tr("Discard"), entry.card);
        discard->setProperty("kind", "flat");
        discard->setAccessibleName(tr("Discard %1").arg(scene.name));
        connect(discard, &QPushButton::clicked, this, [this, scene] { emit discardRequested(scene); });
        entry.card->header()->addWidget(discard);
        waiting_.pop_back();  // its picture is the first one to be made
        if (read.errors.empty()) waiting_.push_front(entries_.size() - 1);
    }
    unsaved_->setVisible(!scenes.empty());
    columns_ = 0;
    arrange();
    if (isVisible()) timer_->start();
}

void StartPage::setTheme(const Theme& theme) {
    theme_ = &theme;
    waiting_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) waiting_.push_back(i);
    if (isVisible()) timer_->start();
}

void StartPage::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (!hasReadPresets_) readPresets();
    timer_->start();
}

void StartPage::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

void StartPage::arrange() {
    const int columns = std::max(1, (width() - 40) / (pictureSize.width() + 44));
    if (columns == columns_) return;
    columns_ = columns;
    for (QGridLayout* grid : {grid_, unsavedGrid_})
        while (QLayoutItem* item = grid->takeAt(0)) delete item;
    for (const auto& entry : entries_) {
        QGridLayout* grid = entry->unsaved ? unsavedGrid_ : grid_;
        const int at = grid->count();
        grid->addWidget(entry->card, at / columns, at % columns);
    }
    for (int c = 0; c < columns; ++c) {
        unsavedGrid_->setColumnStretch(c, 1);  // one card alone is as wide as the others
        unsavedGrid_->setColumnMinimumWidth(c, 1);
    }
}

void StartPage::work() {
    if (!isVisible() || waiting_.empty()) {
        timer_->stop();
        run_.reset();
        return;
    }
    Entry& entry = *entries_[waiting_.front()];
    if (entry.result.schemes.empty()) {
        if (!run_) {
            run_ = std::make_unique<Run>(entry.scene, RunOptions{1});
            run_->start();
        }
        if (!run_->isFinished()) return;
        entry.result = run_->latest();
        run_.reset();
    }
    const std::vector<View> views = plotViews(entry.scene);
    if (!views.empty()) {
        const Figure figure = makeFigure(entry.result, views.front());
        PlotOptions options;
        options.hasHeader = options.hasLegend = false;
        const double ratio = devicePixelRatioF();
        QImage image = renderFigure(figure, pictureSize, *theme_, ratio, options);
        image.setDevicePixelRatio(ratio);
        entry.picture->setPixmap(QPixmap::fromImage(image));
    }
    waiting_.pop_front();
}

}  // namespace extremal
