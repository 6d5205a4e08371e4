// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/windows/figure_sheet.hpp"

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFontDatabase>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/base/save_dialog.hpp"
#include "ui/base/tool_window.hpp"

namespace extremal {
namespace {

constexpr int settleMs = 60, choicesWidth = 350, listHeight = 108, captionHeight = 64;

/// Of the last figure of this session.
PaperStyle& lastStyle() {
    static PaperStyle style;
    return style;
}

template <class T>
void fill(QComboBox& box, std::span<const StyleWord<T>> words) {
    for (const StyleWord<T>& word : words) box.addItem(QString::fromUtf8(word.title));
}
template <class T>
T chosen(const QComboBox& box, std::span<const StyleWord<T>> words) {
    return words[static_cast<std::size_t>(std::max(0, box.currentIndex()))].value;
}
template <class T>
void choose(QComboBox& box, std::span<const StyleWord<T>> words, T value) {
    const auto at = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.value == value; });
    box.setCurrentIndex(at == words.end() ? -1 : static_cast<int>(std::distance(words.begin(), at)));
}

std::vector<std::string> labelsIn(const std::vector<Figure>& figures) {
    std::vector<std::string> labels;
    for (const Figure& figure : figures)
        for (const Series& s : figure.series())
            if (s.style >= 0 && std::find(labels.begin(), labels.end(), s.label) == labels.end())
                labels.push_back(s.label);
    return labels;
}

QListWidgetItem* addItem(QListWidget& list, const QString& text, bool isChecked, int number) {
    auto* item = new QListWidgetItem(text, &list);
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    item->setCheckState(isChecked ? Qt::Checked : Qt::Unchecked);
    item->setData(Qt::UserRole, number);
    return item;
}

bool isChecked(const QListWidget& list, int row) { return list.item(row)->checkState() == Qt::Checked; }

}  // namespace

FigureSheet::FigureSheet(QWidget* parent) : QWidget(parent, Qt::Window) {
    setUpToolWindow(*this, "figureSheet", tr("Figure for a paper"), "command-line#figure", {1240, 800});
    closeOnEscape(*this);
    auto* row = new QHBoxLayout(this);
    row->setSpacing(10);
    row->addWidget(makeChoices());
    row->addWidget(makePreview(), 1);
    timer_.setSingleShot(true);
    timer_.setInterval(settleMs);
    connect(&timer_, &QTimer::timeout, this, &FigureSheet::show);
    setStyle(lastStyle());
}

QWidget* FigureSheet::makeChoices() {
    auto* card = new Card(tr("Figure"), this);
    auto* scroll = new QScrollArea(card);
    scroll->setAccessibleName(tr("Options of the figure"));
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* inside = new QWidget(scroll);
    inside->setProperty("ground", "panel");
    auto* form = new QFormLayout(inside);
    form->setContentsMargins(0, 0, 12, 0);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    addLists(*form);
    addSizes(*form);
    addLooks(*form);
    addCaption(*form);
    scroll->setWidget(inside);
    card->body()->addWidget(scroll, 1);
    card->setFixedWidth(choicesWidth);
    return card;
}

void FigureSheet::addLists(QFormLayout& form) {
    const auto list = [&](const QString& name) {
        auto* made = new QListWidget(this);
        made->setAccessibleName(name);
        made->setFixedHeight(listHeight);
        connect(made, &QListWidget::itemChanged, this, &FigureSheet::later);
        form.addRow(makeLabel(name, "strong", this));
        form.addRow(made);
        return made;
    };
    panels_ = list(tr("Panels, in their order"));
    panels_->setDragDropMode(QAbstractItemView::InternalMove);
    panels_->setToolTip(tr("Drag a row to move it; Space switches it on and off"));
    connect(panels_->model(), &QAbstractItemModel::rowsMoved, this, &FigureSheet::later);
    schemes_ = list(tr("Schemes"));
}

void FigureSheet::addSizes(QFormLayout& form) {
    const auto number = [&](const QString& name, double low, double high, double step, const QString& unit) {
        auto* box = new QDoubleSpinBox(this);
        box->setRange(low, high);
        box->setSingleStep(step);
        box->setDecimals(step < 0.1 ? 2 : 1);
        if (!unit.isEmpty()) box->setSuffix(' ' + unit);
        connect(box, &QDoubleSpinBox::valueChanged, this, &FigureSheet::later);
        form.addRow(name, box);
        return box;
    };
    widths_ = new ComboBox(this);
    fill(*widths_, widthWords());
    widths_->setAccessibleName(tr("Place of the figure"));
    connect(widths_, &QComboBox::activated, this,
            [this](int i) { width_->setValue(widthWords()[static_cast<std::size_t>(i)].value); });
    form.addRow(tr("&For"), widths_);
    width_ = number(tr("&Width"), 30, 1000, 1, tr("mm"));
    connect(width_, &QDoubleSpinBox::valueChanged, this,
            [this](double value) { choose(*widths_, widthWords(), value); });
    ratio_ = number(tr("&Height of a panel"), 0.2, 3, 0.05, tr("of its width"));
    letters_ = number(tr("&Letters"), 4, 48, 0.5, tr("pt"));
    lines_ = number(tr("L&ines"), 0.1, 10, 0.05, tr("pt"));
    const auto count = [&](const QString& name, int low, int high) {
        auto* box = new QSpinBox(this);
        box->setRange(low, high);
        connect(box, &QSpinBox::valueChanged, this, &FigureSheet::later);
        form.addRow(name, box);
        return box;
    };
    columns_ = count(tr("&Panels in a row"), 0, 12);
    columns_->setSpecialValueText(tr("as have room"));
    dots_ = count(tr("&Resolution of PNG"), 72, 1200);
    dots_->setSuffix(' ' + tr("dpi"));
}

void FigureSheet::addLooks(QFormLayout& form) {
    const auto box = [&](const QString& name) {
        auto* made = new ComboBox(this);
        connect(made, &QComboBox::currentIndexChanged, this, &FigureSheet::later);
        form.addRow(name, made);
        return made;
    };
    font_ = box(tr("F&ont"));
    font_->setEditable(true);
    font_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    font_->addItem(QString());
    font_->addItems(QFontDatabase::families());
    font_->lineEdit()->setPlaceholderText(tr("Inter; or that of the document"));
    connect(font_, &QComboBox::editTextChanged, this, &FigureSheet::later);
    legend_ = box(tr("L&egend"));
    fill(*legend_, legendWords());
    colours_ = box(tr("&Colours"));
    fill(*colours_, colourWords());
    portraits_ = box(tr("Por&traits"));
    fill(*portraits_, portraitWords());
    portraits_->setToolTip(tr("Curves in a plane hide each other where schemes share a panel"));
    const auto check = [&](const QString& name) {
        auto* made = new QCheckBox(name, this);
        connect(made, &QCheckBox::toggled, this, &FigureSheet::later);
        form.addRow(made);
        return made;
    };
    hasTitles_ = check(tr("Titles above the panels"));
    isEqual_ = check(tr("Equal scales in portraits"));
    isWindow_ = check(tr("Only the window of time of the plots"));
}

void FigureSheet::addCaption(QFormLayout& form) {
    form.addRow(makeLabel(tr("Caption"), "strong", this));
    caption_ = new QPlainTextEdit(this);
    caption_->setAccessibleName(tr("Caption"));
    caption_->setFixedHeight(captionHeight);
    caption_->setTabChangesFocus(true);
    connect(caption_, &QPlainTextEdit::textChanged, this, &FigureSheet::later);
    form.addRow(caption_);
    isCaptionDrawn_ = new QCheckBox(tr("In the picture as well"), this);
    connect(isCaptionDrawn_, &QCheckBox::toggled, this, &FigureSheet::later);
    form.addRow(isCaptionDrawn_);
}

QWidget* FigureSheet::makePreview() {
    auto* card = new Card(tr("As printed"), this);
    size_ = makeLabel({}, "caption", card);
    sight_ = new ComboBox(card);
    sight_->addItems({tr("as it is"), tr("in grey"), tr("without red cones"), tr("without green cones"),
                      tr("without blue cones")});
    sight_->setAccessibleName(tr("How the preview is seen"));
    connect(sight_, &QComboBox::currentIndexChanged, this, &FigureSheet::later);
    card->header()->addWidget(size_);
    card->header()->addWidget(sight_);
    picture_ = new QLabel(card);
    picture_->setAlignment(Qt::AlignCenter);
    picture_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
    picture_->setAccessibleName(tr("Preview of the figure"));
    card->body()->addWidget(picture_, 1);
    command_ = new QLineEdit(card);
    command_->setReadOnly(true);
    command_->setAccessibleName(tr("The same on the command line"));
    command_->setToolTip(tr("The same on the command line"));
    card->body()->addWidget(command_);
    auto* row = new QHBoxLayout;
    const auto button = [&](const QString& text, auto act) {
        auto* made = new QPushButton(text, card);
        connect(made, &QPushButton::clicked, this, act);
        row->addWidget(made);
        return made;
    };
    button(tr("&Save..."), [this] { saveDialog(); })->setProperty("kind", "primary");
    button(tr("Copy the picture"),
           [this] { QApplication::clipboard()->setImage(paperImage(paper(), style().dotsPerInch)); });
    button(tr("Copy the caption"), [this] { QApplication::clipboard()->setText(captionOf(paper())); });
    button(tr("Copy the command"), [this] { QApplication::clipboard()->setText(command()); });
    row->addStretch(1);
    card->body()->addLayout(row);
    return card;
}

void FigureSheet::open(SheetContent content) {
    content_ = std::move(content);
    fillLists();
    isWindow_->setEnabled(content_.times.has_value());
    isWindow_->setChecked(content_.times.has_value());
    bringToFront(*this);
    panels_->setFocus();
    show();
}

void FigureSheet::fillLists() {
    isFilling_ = true;
    panels_->clear();
    schemes_->clear();
    for (std::size_t i = 0; i < content_.figures.size(); ++i) {
        const Figure& figure = content_.figures[i];
        const bool isShown = !isEmpty(figure) && figure.view != "work-precision";
        addItem(*panels_, QString::fromStdString(figure.title), isShown, static_cast<int>(i));
    }
    for (const std::string& label : labelsIn(content_.figures))
        addItem(*schemes_, QString::fromStdString(label), true, 0);
    if (panels_->count() > 0) panels_->setCurrentRow(static_cast<int>(content_.current));
    isFilling_ = false;
}

PaperStyle FigureSheet::style() const {
    PaperStyle style;
    style.width = width_->value();
    style.ratio = ratio_->value();
    style.letters = letters_->value();
    style.lines = lines_->value();
    style.columns = columns_->value();
    style.dotsPerInch = dots_->value();
    style.font = font_->currentText().trimmed();
    style.legend = chosen(*legend_, legendWords());
    style.colours = chosen(*colours_, colourWords());
    style.portraits = chosen(*portraits_, portraitWords());
    style.hasTitles = hasTitles_->isChecked();
    style.isEqual = isEqual_->isChecked();
    style.isCaptionDrawn = isCaptionDrawn_->isChecked();
    style.caption = caption_->toPlainText().simplified();
    if (isWindow_->isChecked()) style.times = content_.times;
    bool hasAll = true;
    for (int i = 0; i < schemes_->count(); ++i) {
        if (isChecked(*schemes_, i))
            style.schemes.push_back(schemes_->item(i)->text().toStdString());
        else
            hasAll = false;
    }
    if (hasAll) style.schemes.clear();
    return style;
}

void FigureSheet::setStyle(const PaperStyle& style) {
    isFilling_ = true;
    width_->setValue(style.width);
    choose(*widths_, widthWords(), style.width);
    ratio_->setValue(style.ratio);
    letters_->setValue(style.letters);
    lines_->setValue(style.lines);
    columns_->setValue(style.columns);
    dots_->setValue(style.dotsPerInch);
    font_->setCurrentText(style.font);
    choose(*legend_, legendWords(), style.legend);
    choose(*colours_, colourWords(), style.colours);
    choose(*portraits_, portraitWords(), style.portraits);
    hasTitles_->setChecked(style.hasTitles);
    isEqual_->setChecked(style.isEqual);
    isCaptionDrawn_->setChecked(style.isCaptionDrawn);
    caption_->setPlainText(style.caption);
    isFilling_ = false;
    later();
}

void FigureSheet::setSight(Sight sight) { sight_->setCurrentIndex(static_cast<int>(sight)); }

std::vector<std::string> FigureSheet::chosenViews() const {
    std::vector<std::string> views;
    for (int i = 0; i < panels_->count(); ++i) {
        const auto& figure =
            content_.figures[static_cast<std::size_t>(panels_->item(i)->data(Qt::UserRole).toInt())];
        if (isChecked(*panels_, i) && (views.empty() || views.back() != figure.view))
            views.push_back(figure.view);
    }
    return views;
}

PaperFigure FigureSheet::paper() const {
    PaperFigure paper{style(), {}, content_.title};
    std::vector<Figure> figures;
    for (int i = 0; i < panels_->count(); ++i)
        if (isChecked(*panels_, i))
            figures.push_back(
                content_.figures[static_cast<std::size_t>(panels_->item(i)->data(Qt::UserRole).toInt())]);
    const bool hasScheme = schemes_->count() == 0 || [&] {
        for (int i = 0; i < schemes_->count(); ++i)
            if (isChecked(*schemes_, i)) return true;
        return false;
    }();
    if (hasScheme) paper.panels = panelsOf(figures, paper.style);
    return paper;
}

QString FigureSheet::command() const {
    return paperCommand(style(), content_.scene, chosenViews(), QStringLiteral("figure.pdf"));
}

void FigureSheet::later() {
    if (!isFilling_ && isVisible()) timer_.start();
}

void FigureSheet::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    later();
}

void FigureSheet::show() {
    timer_.stop();
    const PaperFigure figure = paper();
    command_->setText(command());
    command_->setCursorPosition(0);
    caption_->setPlaceholderText(captionOf(figure));
    if (const auto problem = problemOf(figure.style)) {
        size_->setText(QString::fromStdString(problem->what));
        return;
    }
    if (figure.panels.empty()) {
        picture_->setText(tr("No panel or no scheme is switched on."));
        return size_->clear();
    }
    lastStyle() = figure.style;
    lastStyle().schemes.clear();
    lastStyle().times.reset();
    lastStyle().caption.clear();
    const QSizeF size = paperSize(figure);
    const QSizeF room = picture_->size() - QSize(8, 8);
    const double fitting =
        std::clamp(std::min(room.width() / size.width(), room.height() / size.height()), 0.1, 4.0);
    const double ratio = devicePixelRatioF();
    preview_ = seenBy(static_cast<Sight>(sight_->currentIndex()), paperImage(figure, 96 * fitting * ratio));
    preview_.setDevicePixelRatio(ratio);
    picture_->setPixmap(QPixmap::fromImage(preview_));
    size_->setText(tr("%1 x %2 mm, shown at %3 %")
                       .arg(size.width() * 25.4 / 96, 0, 'f', 0)
                       .arg(size.height() * 25.4 / 96, 0, 'f', 0)
                       .arg(100 * fitting, 0, 'f', 0));
    picture_->setAccessibleDescription(captionOf(figure));
}

void FigureSheet::saveDialog() {
    const QString path = askForSave(this, tr("Save the figure"), QStringLiteral("figure.pdf"),
                                    tr("PDF (*.pdf);;SVG (*.svg);;Picture (*.png)"));
    if (!path.isEmpty()) save(path);
}

void FigureSheet::save(const QString& file) {
    QString problem;
    try {
        // The dialog has asked about the picture itself, but not about what is beside it.
        const PaperFigure figure = paper();
        const std::vector<QString> files = paperFiles(file);
        requireReplaceable(files[1].toStdString(), {}, paperCsv(figure));
        requireReplaceable(files[2].toStdString(), {});
        problem = figure.panels.empty() ? tr("no panel or no scheme is switched on")
                                        : savePaper(file, figure, {.isForced = true});
    } catch (const std::exception& error) {
        problem = QString::fromUtf8(error.what());
    }
    emit saved(file, problem);
}

}  // namespace extremal
