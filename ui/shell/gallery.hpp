// SPDX-License-Identifier: GPL-3.0-or-later
/// The presets as the start page shows them: in sections, with what can be searched. The sections are data
/// (resources/gallery.json); a preset that none of them names is in the last one.
#pragma once

#include <QString>

#include <functional>
#include <vector>

#include "ui/base/card.hpp"

class QLabel;

namespace extremal {

struct GalleryItem {
    QString id, title, lesson;
    QString words;  ///< what a search looks at
    int steps = 0;  ///< of its lesson; 0: it has none
};

struct GallerySection {
    QString title, about;
    std::vector<GalleryItem> items;
};

/// Reads titles and lessons alone: some milliseconds.
std::vector<GallerySection> readGallery();

/// All words of the search, in any order and wherever they stand.
bool matches(const GalleryItem& item, const QString& search);

/// A card with a picture and some lines that is one big button.
class GalleryCard : public Card {
    Q_OBJECT
public:
    GalleryCard(const QString& title, const QString& text, QWidget* parent = nullptr);
    void setPicture(const QImage& image);
    bool hasPicture() const { return hasPicture_; }
    /// A button for the lesson of so many steps.
    void offerLesson(int steps);

signals:
    void chosen();
    void lessonChosen();

protected:
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    QLabel* picture_;
    bool hasPicture_ = false;
};

}  // namespace extremal
