// SPDX-License-Identifier: GPL-3.0-or-later
/// The Compare page: the stage, speed against accuracy, and the linked plots of the scene's views, each in a
/// card. A plot keeps its zoom and its history for as long as the scene has its view.
#pragma once

#include <QTimer>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"
#include "ui/compare/card_layout.hpp"
#include "ui/compare/figure_job.hpp"
#include "ui/compare/profile_drawing.hpp"
#include "ui/plots/view_state.hpp"

class QAction;
class QMenu;
class QScrollArea;

namespace extremal {

class BackgroundSweep;
class BodyDragging;
class Card;
class CasePreview;
class FieldPoking;
class MechanismSketch;
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
    ~CompareView() override;
    /// Puts another theme on the stage and the plots, one after the other.
    std::vector<std::function<void()>> partsOfTheme(const Theme& theme);
    void fitAll();
    void toggleSideBySide();  ///< of the schemes on the stage
    void togglePotential();   ///< behind the motion on the stage
    void changeTrails();      ///< to longer ones, and back to short ones
    void togglePoking();      ///< whether clicks on the stage poke the field
    /// Brings the card of a view into sight and marks it; that of no view ("") marks none.
    void pointAt(const QString& view);
    /// Where "speed against accuracy" has its lines from.
    void setSweep(const BackgroundSweep& sweep);
    /// The wanted error, a line in that plot which can be dragged.
    void setWanted(double error);
    /// The plot that was last clicked, else the first one; null if there is none.
    PlotWidget* currentPlot() const;
    StageWidget* stage() const { return stage_; }
    bool hasStage() const { return hasStage_; }
    std::vector<PlotWidget*> plots() const;
    void setPageLayout(PageLayout layout);
    /// Makes the row that has the focus, else that of the stage, higher by so many pixels.
    void growRow(int by);
    void forgetSizes();  ///< of rows and cards, given by hand
    /// The second cursor of the plots.
    void setPinned(std::optional<double> t);
    std::optional<double> pinned() const;
    /// The views of the scene with what is seen of them: the parts of plots to which the user has zoomed, and
    /// the sizes of cards.
    std::vector<View> seenViews() const;
    /// The stage and one plot alone: the one that was pointed at last, else the current one.
    void setPresented(bool isPresented);
    /// The plot so many places further has the focus, and is presented.
    void showOtherPlot(int by);
    PageLayout pageLayout() const { return pageLayout_; }
    int columns() const;
    /// One card takes the whole page; the same one again, or restore(), brings the others back.
    void maximize(Card* card);
    /// False if nothing was maximised.
    bool restore();
    /// Whether the plots show the latest results. Figures are made in another thread.
    bool isCurrent() const;
    /// Makes at once what is still missing, for exports.
    void complete();
    /// Figures made so far, each of one plot: what is not needed is not made, which tests count.
    long long figuresMade() const { return figuresMade_; }
    /// Whether the plots show short runs from where a body is dragged.
    bool isPreviewing() const;
    /// Draws the mechanism of the scene by hand, or ends that; `isEmpty`: on an empty sheet.
    void drawMechanism(bool isEmpty);

signals:
    void saveFailed(const QString& reason);
    void caseLoaded(const QString& text);             ///< of a map, into the scene
    void startRefused(const QString& reason);         ///< no motion starts at a place that was chosen
    void orbitAsked(const std::vector<Edit>& start);  ///< a periodic orbit near this start of the scene
    /// What was drawn cannot be in the scene; both empty: it is, or nothing is drawn.
    void sketchRefused(const QString& reason, const QString& remedy);
    void figuresChanged();
    void wantedMoved(double error);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    struct Slot {
        int number;
        View view;
        Card* card;
        PlotWidget* plot;
        std::shared_ptr<const Comparison> shown = {};  ///< what the plot shows the view of
        View shownView = {};
        CardSize size = {};                ///< in the scene
        std::optional<Figure> whole = {};  ///< of a portrait that shows a part of the time
    };
    void makeStage();
    void connectState();
    void rebuild();  ///< another set of views
    void discard(std::unique_ptr<Slot> slot);
    Slot& makeSlot(const View& view);
    void takeSizes();  ///< of the scene, where it has others than before
    void makeMaximizable(Card& card);
    void addSceneActions(QMenu& menu, Slot& slot);
    void addPlaceActions(QMenu& menu, Slot& slot);
    /// The part of the window of time, of a portrait; else the figure itself.
    Figure inTimes(const Figure& whole) const;
    void showTimes(std::optional<PlotRange> range);
    void describeStage();  ///< to screen readers
    CardShape shapeOf(const Slot& slot) const;
    void arrange();
    void refresh();  ///< new results
    FigureJob missing() const;
    void startJob();
    void take(FigureSet made);
    void alignMargins();
    void loadCase(const View& view, double value, double step);
    QString selectedLabel() const;  ///< empty: no scheme is selected
    void connectDrawing();          ///< of initial profiles, on the stage
    void connectPreview();          ///< of cases of maps, on the stage
    void connectBodies();           ///< that are dragged on the stage
    void connectPoking();           ///< of fields, on the stage
    void connectSketch();           ///< of a mechanism that is drawn by hand
    void tellOfHand();              ///< what cannot be dragged, in the tooltip of the stage
    /// What is shown: the results, or a preview of others.
    std::shared_ptr<const Comparison> shownResults() const;
    void connectCases(Slot& slot);     ///< of its map
    void connectStarting(Slot& slot);  ///< of motions, in its plot
    void showWanted();
    void addSweep(const View& view, Figure& figure) const;
    void showStarts();  ///< the handles of the scene's start
    /// The system of the scene; null until there are results with its model.
    const System* systemOfScene() const;

    Workspace& workspace_;
    RunControl& run_;
    Playback& playback_;
    const Theme* theme_;
    PlotGroup* group_;
    QScrollArea* scroll_;
    QWidget* inside_;
    CardLayout* cardLayout_;
    QTimer align_;  ///< the margins, when the events are done
    PageLayout pageLayout_ = PageLayout::automatic;
    std::vector<std::pair<Card*, CardShape>> arranged_;
    Card *stageCard_, *maximized_ = nullptr;
    QAction* draw_ = nullptr;
    std::optional<ProfileDrawing> drawing_;  ///< of the stroke that is being made
    StageWidget* stage_;
    CasePreview* preview_;  ///< of a case of a map, on the stage
    BodyDragging* bodies_;
    FieldPoking* poking_;
    MechanismSketch* sketch_;
    std::shared_ptr<const Comparison> staged_;  ///< what the stage shows
    std::vector<std::unique_ptr<Slot>> slots_;
    std::shared_ptr<const System> system_;  ///< of the results
    int columns_ = 0, nextNumber_ = 0;
    bool isPresented_ = false;
    CardSize stageSize_ = {};         ///< in the scene
    std::optional<PlotRange> times_;  ///< the window of time to which the user has zoomed
    int presentedSlot_ = 0;           ///< the number of the slot whose plot is presented
    bool hasStage_ = true;            ///< the model of the results has something to draw there
    bool isJobRunning_ = false;
    long long figuresMade_ = 0;
    const BackgroundSweep* sweep_ = nullptr;
    double wanted_ = 0;  ///< 0: none
};

}  // namespace extremal
