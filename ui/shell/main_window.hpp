// SPDX-License-Identifier: GPL-3.0-or-later
/// The main window: it only arranges. State lives in Workspace, RunControl and Playback; panels and pages
/// show it.
#pragma once

#include <QMainWindow>
#include <QPointer>
#include <QUrl>

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/scene/scene.hpp"
#include "ui/base/theme.hpp"

class QLabel;
class QSplitter;
class QMenu;
class QStackedWidget;
class QTabBar;
class QScrollArea;

namespace extremal {

class Actions;
class Autosave;
class BackgroundSweep;
class CompareView;
class CellCosts;
class CopiesWindow;
class Discretizer;
struct ExportParts;
class FigureSheet;
class FitWindow;
class HeaderBar;
class HelpWindow;
class InspectorWindow;
class LessonBar;
class LogWindow;
class NeedsCard;
class Notices;
class NotesPage;
class OrbitFinder;
class OwnList;
class OwnWindow;
class PassportWindow;
struct PaletteEntry;
class RecordBar;
class RaceWindow;
class Playback;
class RunControl;
class SchemeList;
class StartPage;
class StudyPage;
class ThemeSwitch;
class TextView;
class Timeline;
class ValuesTable;
class Wanted;
class Workspace;

class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    /// `isRemembered`: layout, theme and unsaved scenes are stored between sessions; not for tests and
    /// screenshots.
    explicit MainWindow(const Theme& theme, bool isRemembered = true);
    ~MainWindow() override;

    /// A path or "preset:NAME". Asks first what becomes of changes that are not saved.
    bool open(const QString& scene, bool isTrusted = false);
    /// Whether scenes play as soon as they have results; at first as stored, without a store they do not.
    void setPlaysWhenOpened(bool plays);
    /// The colours change some turns of the event loop later.
    void setTheme(const Theme& theme);
    /// Everything into a folder: files as `extremal run`, the figures, and the command that makes them again.
    bool exportEverything(const QString& folder);

    Workspace& workspace() { return *workspace_; }
    RunControl& runControl() { return *run_; }
    Playback& playback() { return *playback_; }
    Actions& actions() { return *actions_; }
    CompareView& compareView() { return *compare_; }
    Discretizer& discretizer() { return *discretizer_; }
    Notices& notices() { return *notices_; }
    StudyPage& studies() { return *studies_; }
    NeedsCard& needs() { return *needs_; }
    OrbitFinder& orbits() { return *orbits_; }
    RecordBar& record() { return *record_; }
    CellCosts& cellCosts() { return *cellCosts_; }
    Wanted& wanted() { return *wanted_; }
    ThemeSwitch& themeSwitch() { return *themeSwitch_; }

public slots:
    /// "handbook:multiscale#resonances", of links in messages.
    void openHandbook(const QUrl& url);
    /// "preset:kepler", of links in texts.
    void openPreset(const QUrl& url);

protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    bool focusNextPrevChild(bool next) override;

private:
    void makePages();
    void makeHeader(BackgroundSweep& sweep);
    QWidget* makeWorkPage(BackgroundSweep& sweep);
    void makeSceneColumn();
    QWidget* makeCentre(BackgroundSweep& sweep);
    void makeTabPages(BackgroundSweep& sweep);
    void tellOfPlots();
    void tellOfStudies();
    void tellOfNeeds();
    void makeStartPage();
    void makeStatus();
    void makeActions();
    void connectState();
    void addFileActions();
    void addEditActions();
    void addViewActions();
    void addStageActions(const QString& menu);
    void addLayoutActions(const QString& menu);
    void fillPlots(QMenu& menu);
    void toggleScheme(int index);
    void addRunActions();
    void addStudyActions();
    void addLessonActions();
    void startLesson();
    void playWhenOpened();
    void takeShown();
    void storeSeen();
    void forgetSeen();
    void startFromCursor();
    void shareWidth();
    void toggleWideDiscretizer();
    void togglePresentation();
    void addPresentationActions(const QString& menu);
    void showOtherPlot(int by);
    void startPresentation();
    bool endPresentation();
    void scaleLetters(double scale);
    bool isSceneInSight() const;
    void showStartPage();
    void showWork();
    void goBack();
    void showSight();
    void showPage(int page);
    void focusStage();
    void showScene();
    void showStatus();
    void offerUnsaved();
    bool mayLeaveScene();
    void showLog();
    void showHelp(const QString& page);
    void showValues();
    void openDialog();
    FitWindow& fitWindow();
    void newFromLagrangian();
    void drawMechanism();
    void keepRecent();
    void save(bool asksName);
    void exportDialog();
    std::optional<ExportParts> partsOfExport();
    void startExport(const QString& folder);
    void continueExport(const std::shared_ptr<std::deque<std::function<QString()>>>& steps,
                        const QString& problem, const QString& folder);
    bool tellOfExport(const QString& problem, const QString& file, const QString& folder);
    void exportReport();
    void askForFolder(const QString& title, const QString& kind,
                      const std::function<void(const QString&)>& use);
    void exportFrames();
    void startFrames(const QString& folder, int count);
    void showFigureSheet();
    void copyScene();
    void pasteScene();
    void showPalette();
    void showPlotChoice();
    std::vector<PaletteEntry> paletteEntries();
    std::vector<PaletteEntry> plotEntries();
    void addSchemeEntries(std::vector<PaletteEntry>& entries);
    void addPlaceEntries(std::vector<PaletteEntry>& entries);
    void showOwn();
    OwnList& ownList();
    double rowStep() const;

    Theme theme_;
    bool isRemembered_;
    ThemeSwitch* themeSwitch_;
    Notices* notices_;
    Workspace* workspace_;
    RunControl* run_;
    Playback* playback_;
    Wanted* wanted_;
    Autosave* autosave_ = nullptr;
    Actions* actions_;
    CompareView* compare_;
    LessonBar* lesson_;
    RecordBar* record_;
    NotesPage* notesPage_;
    Discretizer* discretizer_;
    CellCosts* cellCosts_;
    SchemeList* schemes_;
    HeaderBar* header_;
    StartPage* startPage_;
    StudyPage* studies_;
    NeedsCard* needs_;
    OrbitFinder* orbits_;
    Timeline* timeline_;
    ValuesTable* values_;
    HelpWindow* help_ = nullptr;
    LogWindow* log_ = nullptr;
    PassportWindow* passport_ = nullptr;
    InspectorWindow* inspector_ = nullptr;
    RaceWindow* race_ = nullptr;
    FigureSheet* figureSheet_ = nullptr;
    FitWindow* fit_ = nullptr;
    CopiesWindow* copies_ = nullptr;
    OwnWindow* own_ = nullptr;
    OwnList* ownList_ = nullptr;
    QStackedWidget* stack_;  ///< start page or work page
    QStackedWidget* pages_;  ///< Compare, Notes, Studies
    QTabBar* tabs_;
    QSplitter* splitter_;
    QWidget* leftPanel_;  ///< the scene, and the discretizer below it
    QScrollArea* left_;   ///< the scene
    bool isDiscretizerWide_ = false;
    /// What the presentation has changed.
    struct Presentation {
        std::vector<QPointer<QWidget>> hidden;
        double fontScale = 1;
        bool wasFullScreen = false;
    };
    std::optional<Presentation> presentation_;
    TextView* notes_;
    QString shownNotes_;                               ///< their source
    QPointer<QWidget> focusBefore_;                    ///< what the start page has taken the focus from
    bool wasPlaying_ = false;                          ///< when the start page hid the scene
    bool playsWhenOpened_ = false, isToPlay_ = false;  ///< an opened scene, as soon as it has results
    std::optional<Shown> shown_;                       ///< by the scene; empty: it has just been opened
    PageLayout ownLayout_ = PageLayout::automatic;     ///< of scenes without one
    QLabel* status_;
};

}  // namespace extremal
