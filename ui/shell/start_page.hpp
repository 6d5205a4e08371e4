/// The start page: a gallery of the presets, each with a picture rendered by the program itself and its
/// lesson; before them the scenes that an earlier session has left unsaved.
#pragma once

#include <QWidget>

#include <deque>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/scene.hpp"
#include "ui/shell/autosave.hpp"

class QGridLayout;
class QPushButton;
class QTimer;

namespace extremal {

struct Theme;

class Notices;

class StartPage : public QWidget {
    Q_OBJECT
public:
    StartPage(const Theme& theme, Notices& notices, QWidget* parent = nullptr);
    ~StartPage() override;
    void setTheme(const Theme& theme);
    /// Replaces the scenes that are offered to go on with.
    void offer(std::vector<UnsavedScene> scenes);

signals:
    void presetChosen(const QString& name);
    void openRequested();
    void restoreRequested(const UnsavedScene& scene);
    void discardRequested(const UnsavedScene& scene);

protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    struct Entry;
    void readPresets();
    void addPreset(const QString& id, Scene scene);
    Entry& addCard(Scene scene, const QString& title, const QString& text, std::function<void()> act);
    void arrange();
    void work();  ///< renders the next picture, a little at a time

    const Theme* theme_;
    QWidget *inside_, *unsaved_;
    QGridLayout *grid_, *unsavedGrid_;
    std::vector<std::unique_ptr<Entry>> entries_;
    std::deque<std::size_t> waiting_;
    std::stop_source reading_;  ///< of the presets
    std::unique_ptr<Run> run_;
    QTimer* timer_;
    int columns_ = 0;
    bool hasReadPresets_ = false;
};

}  // namespace extremal
