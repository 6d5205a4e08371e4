/// The start page: a gallery of the presets, each with a picture rendered by the program itself and its
/// lesson.
#pragma once

#include <QWidget>

#include <deque>
#include <memory>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/scene.hpp"

class QGridLayout;
class QPushButton;
class QTimer;

namespace extremal {

struct Theme;

class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(const Theme& theme, QWidget* parent = nullptr);
    ~StartPage() override;
    void setTheme(const Theme& theme);

signals:
    void presetChosen(const QString& name);
    void openRequested();

protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    struct Entry;
    void arrange();
    void work();  ///< renders the next picture, a little at a time

    const Theme* theme_;
    QWidget* inside_;
    QGridLayout* grid_;
    std::vector<std::unique_ptr<Entry>> entries_;
    std::deque<std::size_t> waiting_;
    std::unique_ptr<Run> run_;
    QTimer* timer_;
    int columns_ = 0;
};

}  // namespace extremal
