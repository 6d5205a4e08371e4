/// The Compare page: the stage, speed against accuracy, and the linked plots of the scene's views, each in a
/// card.
#pragma once

#include <QWidget>

#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

class QGridLayout;
class QMenu;

namespace extremal {

class Card;
class Playback;
class PlotGroup;
class PlotWidget;
class RunControl;
class StageWidget;
struct Theme;
class Workspace;

class CompareView : public QWidget {
    Q_OBJECT
public:
    CompareView(Workspace& workspace, RunControl& run, Playback& playback, const Theme& theme,
                QWidget* parent = nullptr);
    void setTheme(const Theme& theme);
    void fitAll();
    /// The plot that was last clicked, else the first one; null if there is none.
    PlotWidget* currentPlot() const;
    StageWidget* stage() const { return stage_; }
    std::vector<PlotWidget*> plots() const;

signals:
    void saveFailed(const QString& reason);
    void caseLoaded(const QString& text);  ///< of a map, into the scene

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    struct Slot {
        View view;
        Card* card;
        PlotWidget* plot;
    };
    void rebuild();  ///< another set of views
    void addSceneActions(QMenu& menu, std::size_t slot);
    void arrange();  ///< the same cards, another width
    void refresh();  ///< new results
    void alignMargins();
    void loadCase(const View& view, double value, double step);

    Workspace& workspace_;
    RunControl& run_;
    Playback& playback_;
    const Theme* theme_;
    PlotGroup* group_;
    QWidget* inside_;
    QGridLayout* grid_;
    Card* stageCard_;
    StageWidget* stage_;
    std::vector<Slot> slots_;
    std::vector<View> shownViews_;
    Settings systemModel_;
    System system_;
    int columns_ = 0;
    bool hasStage_ = true;  ///< the model of the results has something to draw there
};

}  // namespace extremal
