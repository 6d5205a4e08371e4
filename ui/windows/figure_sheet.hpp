// SPDX-License-Identifier: GPL-3.0-or-later
/// The sheet on which a figure for a paper is made: every choice of its style, and beside them the figure as
/// it will be printed, which follows each of them, as it is or as others see it. What is saved is what
/// `extremal figure` makes, with its data and its caption beside it; the call is shown.
#pragma once

#include <QTimer>
#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

#include "engine/figure/figure.hpp"
#include "ui/pictures/colour_sight.hpp"
#include "ui/pictures/paper_figure.hpp"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QPlainTextEdit;
class QSpinBox;

namespace extremal {

/// What there is to be shown.
struct SheetContent {
    std::vector<Figure> figures;  ///< plots, as they are zoomed
    std::string title;            ///< of the scene
    QString scene;                ///< as the command line names it
    std::optional<std::pair<double, double>> times =
        {};                   ///< the window of time of the plots, if there is one
    std::size_t current = 0;  ///< the plot that had the focus
};

class FigureSheet : public QWidget {
    Q_OBJECT
public:
    explicit FigureSheet(QWidget* parent = nullptr);
    /// With these plots, in the style of the last figure; all of them are panels at first.
    void open(SheetContent content);
    PaperStyle style() const;
    /// Puts a style into the fields.
    void setStyle(const PaperStyle& style);
    void setSight(Sight sight);
    /// The figure as it would be saved.
    PaperFigure paper() const;
    /// The call of the command line that makes it.
    QString command() const;
    /// Saves it; a banner in the window says where, or what went wrong.
    void save(const QString& file);
    const QImage& preview() const { return preview_; }

signals:
    /// `problem`: empty where it was saved.
    void saved(const QString& file, const QString& problem);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    QWidget* makeChoices();
    QWidget* makePreview();
    void addLists(QFormLayout& form);
    void addSizes(QFormLayout& form);
    void addLooks(QFormLayout& form);
    void addCaption(QFormLayout& form);
    void fillLists();
    void later();
    void show();
    void saveDialog();
    std::vector<std::string> chosenViews() const;

    SheetContent content_;
    QImage preview_;
    QTimer timer_;
    QListWidget *panels_, *schemes_;
    QComboBox *widths_, *font_, *legend_, *colours_, *portraits_, *sight_;
    QDoubleSpinBox *width_, *ratio_, *letters_, *lines_;
    QSpinBox *columns_, *dots_;
    QCheckBox *hasTitles_, *isEqual_, *isWindow_, *isCaptionDrawn_;
    QPlainTextEdit* caption_;
    QLabel *picture_, *size_;
    QLineEdit* command_;
    bool isFilling_ = false;
};

}  // namespace extremal
