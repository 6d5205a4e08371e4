// SPDX-License-Identifier: GPL-3.0-or-later
/// The start page: the scenes that an earlier session has left unsaved, the recent files, and the presets in
/// sections, each with its picture and its lesson; a field searches them.
#pragma once

#include <QWidget>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "engine/run/run.hpp"
#include "engine/scene/scene.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/workspace/autosave.hpp"

class QGridLayout;
class QHBoxLayout;
class QLineEdit;
class QPushButton;
class QTimer;
class QVBoxLayout;

namespace extremal {

class Notices;
struct Theme;

class StartPage : public QWidget {
    Q_OBJECT
public:
    StartPage(const Theme& theme, Notices& notices, QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    /// Replaces the scenes that are offered to go on with.
    void offer(std::vector<UnsavedScene> scenes);
    /// The latest first.
    void setRecent(const QStringList& files);
    /// The title of the scene that the button leads back to; empty: no scene is open, and there is no button.
    void setBack(const QString& title);
    void search(const QString& text);
    /// The presets that are in sight, from the first on.
    QStringList shownPresets() const;

signals:
    void presetChosen(const QString& name);
    void lessonChosen(const QString& name);  ///< the lesson of a preset
    void backRequested();
    void openRequested();
    void newRequested();
    void fileChosen(const QString& path);
    void restoreRequested(const UnsavedScene& scene);
    void discardRequested(const UnsavedScene& scene);

protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    struct Entry {
        GalleryCard* card;
        QString preset;                   ///< empty: an unsaved scene
        GalleryItem item = {};            ///< of a preset
        std::optional<Scene> scene = {};  ///< read for a picture that is not there yet
        std::shared_ptr<const Comparison> result = {};
    };
    struct Section {
        QWidget* box;
        QGridLayout* grid;
        std::vector<std::size_t> entries;
    };
    void makeHead(QVBoxLayout& column);
    void makeSections();
    void arrange();
    void loadPictures();
    void work();  ///< makes the next picture that no file has, a little at a time

    const Theme* theme_;
    QWidget *inside_, *unsaved_, *recent_;
    QHBoxLayout* recentRow_;
    QGridLayout* unsavedGrid_;
    QPushButton* back_;
    QLineEdit* search_;
    QVBoxLayout* gallery_;  ///< sections, only while the page is in sight: hundreds of widgets
    std::vector<std::unique_ptr<Entry>> entries_, unsavedEntries_;
    std::vector<Section> sections_;
    std::deque<Entry*> waiting_;
    std::unique_ptr<Run> run_;
    QTimer* timer_;
    int columns_ = 0;
    bool isReading_ = false, hasLoaded_ = false;
};

}  // namespace extremal
