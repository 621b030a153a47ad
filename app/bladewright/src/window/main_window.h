// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QMainWindow>
#include <QProgressBar>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTimer>

#include <functional>
#include <optional>

#include "blocks/block_panel.h"
#include "bw/pipeline/key_blades.h"
#include "bw/view/scene_view.h"
#include "controls/theme.h"
#include "measure/measure_page.h"
#include "plots/motion_view.h"
#include "plots/section_view.h"
#include "versions/comparison.h"
#include "versions/version_panel.h"
#include "window/beside_view.h"
#include "window/block_handles.h"
#include "window/commands.h"
#include "window/face_chooser.h"
#include "window/handle_keys.h"
#include "window/inspector.h"
#include "window/map_bar.h"
#include "window/notices.h"
#include "window/object_tree.h"
#include "window/start_page.h"
#include "window/summary_line.h"
#include "window/surface_handles.h"
#include "workbench/workbench.h"
#include "workflow/workflow_panel.h"

namespace bw::app {

/// Questions to the user that stop the window; replaced in tests. An empty path means that the user gave up.
struct Questions {
  enum class Unsaved { save, discard, cancel };
  enum class Changed { replace, otherName, cancel };
  std::function<QString()> openSurface, openDesign;
  std::function<QString(const QString&suggestion)> saveDesign, savePicture;
  std::function<QString()> exportFolder;
  std::function<void(const QString& folder)> showFolder;  ///< no question: shows what was exported
  std::function<QSize(const QSize& suggestion)> pictureSize;
  /// mm, of a panel between two moulds; empty: the user gave up.
  std::function<std::optional<double>(double suggestion)> panelThickness;
  std::function<Unsaved(const QString& title)> unsaved;
  /// Somebody else wrote the file that is about to be saved to.
  std::function<Changed(const QString& file)> changedOnDisk;
  /// A file of that name is there, and no dialog has asked about it yet.
  std::function<bool(const QString& file)> replaceFile;
  std::function<bool(const QString& name)> discardCopy;
  Workbench::EarlierQuestion earlierExport;
};

class RecoveryList;

/// The window: start page or workspace, with menus, status bar and the line of notices. The window_*.cpp
/// files hold one side of it each: layout, commands, files, questions, scene, state.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// `recoveryFolder` empty: no autosave.
  MainWindow(model::Settings& settings, Theme& theme, const std::filesystem::path& recoveryFolder);
  ~MainWindow() override;

  Workbench& bench() { return bench_; }
  view::SceneView& sceneView() { return *view_; }
  MapBar& mapBar() { return *mapBar_; }
  SectionView& sectionView() { return *section_; }
  MotionView& motionView() { return *motion_; }
  MessageList& messageList() { return messages_->list(); }
  BlockPanel& blockPanel() { return *blocks_; }
  ObjectTree& objectTree() { return *tree_; }
  VersionPanel& versionPanel() { return *versions_; }
  BesideView& besideView() { return *beside_; }
  Comparison& comparison() { return comparison_; }
  WorkflowPanel& workflow() { return *workflow_; }
  Banner& banner() { return *banner_; }
  RecoveryList& recoveryList() { return *recovery_; }
  GuideWindow& guide() { return *guide_; }
  MeasurePage& measurePage() { return *measure_; }
  StartPage& startPage() { return *start_; }
  QTabWidget& tabs() { return *tabs_; }
  /// At the right: objects with the inspector, and versions.
  QTabWidget& sideTabs() { return *sides_; }
  FaceChooser& faceChooser() { return *faces_; }
  SurfaceHandles& surfaceHandles() { return *handles_; }
  HandleKeys& handleKeys() { return *keys_; }
  BlockHandles& blockHandles() { return *blockHandles_; }
  SummaryLine& summaryLine() { return *summary_; }
  Inspector& inspector() { return *inspector_; }
  Commands& commands() { return commands_; }
  Questions& questions() { return questions_; }
  bool onMeasurePage() const { return stack_->currentWidget() == measure_; }
  bool onStartPage() const { return stack_->currentWidget() == start_; }
  /// Seconds between the last change of the design and the picture of its result; 0 before the first.
  double pictureDelay() const { return pictureDelay_; }

  /// Opens a CAD file or a design, after asking about unsaved changes. A failure is told in the window too.
  Result<void> openFile(const QString& file);
  Result<void> openExample(const QString& name);

 public slots:
  bool save();
  bool saveAs();
  void exportEverything();
  void exportPrograms();
  void exportPicture();
  /// The surface of the cut selected by key blades, or that which it cuts, as one undoable step.
  void takeKeyBlades(pipeline::Told told);
  /// Asks for the thickness of a panel and gives each block a second one, as one undoable step.
  void makeMoulds();
  /// Unsaved work of earlier sessions, in a dialog.
  void showUnsaved();
  void showStartPage();
  /// The page that finds the length of the mounted blade.
  void showMeasurePage();
  /// Offers the unsaved work that crashes left behind: on the start page, else in a notice.
  void recover();
  /// Copies unsaved work, what is being typed included, before the program ends; returns when it stands.
  void keepWork();

 signals:
  /// The picture of the newest result stands.
  void pictureStands();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makeCommands();
  void makeHandleCommands();
  void makeVersionCommands();
  void makeMenus();
  void makeWorkspace();
  void makeStatusBar();
  void setDefaultQuestions();
  bool mayLeave();
  /// Asks for a folder and exports to it, or does so when the result that is being computed stands.
  void order(const std::function<void(const std::filesystem::path& folder)>& write);
  void runOrder();
  /// What a report shows of the result, whatever the view shows now.
  std::vector<pipeline::ReportPicture> reportPictures();
  /// Asks for another CAD file under the same settings; the step is named `text`.
  void replaceSurface(const QString& text);
  /// Asks where the CAD file is now.
  void locateSurface() { replaceSurface(tr("Locate surface")); }
  /// Goes on with an autosaved copy, after asking about unsaved changes.
  bool goOnWith(const QString& copy);
  void discardUnsaved(const QString& copy, const QString& name);
  QImage thumbnail();
  /// False while the text of a number of the design is refused: its field is brought into sight and gets the
  /// keyboard, and it is told.
  bool numbersStand();
  void showWorkspace();
  void leaveMeasurePage();
  void refreshTitle();
  scene::Content sceneContent();
  void follow(const Change& change);
  /// A newer evaluation stands, or none does.
  /// Shows what follows the hand.
  void refreshSketch();
  void refreshResult(bool content);
  /// The cut selected among the things of the picture.
  scene::ItemId selectedRow() const;
  void refreshStyle();
  void refreshHandleCommands();
  /// Leaves out of the picture what the tree of objects hides.
  void hideObjects(scene::Style& style) const;
  void refreshState();
  void followComparison();
  void chooseBeside(const Beside& beside);
  /// What can be compared, and what is.
  void refreshComparison();
  void summarise(const pipeline::CutSketch& sketch);
  void refreshSummary();
  void placeBanner();
  std::optional<scene::SectionPlane> sectionPlane() const;
  void refreshRecent();
  void onPicked(const scene::Pick& pick);
  void onHovered(const scene::Pick& pick);
  /// Place and value under the cursor of one of the pictures.
  void tellHovered(const scene::Pick& pick, const view::SceneView& view);
  /// The field that a picture shows as a map, or null.
  static const Field* mappedField(const view::SceneView& view);
  void fitSelection();
  /// Frames the surroundings of a finding and marks its point.
  void showSpot(const Spot& spot);
  void applyTheme(model::ThemeChoice choice);
  /// Ticks the command of the theme chosen in the settings.
  void tickTheme();
  void setNavigation(model::MouseChoice mouse);
  void restoreLayout();
  void storeLayout();

  model::Settings& settings_;
  Theme& theme_;
  std::filesystem::path recoveryFolder_;
  Workbench bench_;
  Comparison comparison_{bench_};
  Commands commands_;
  Questions questions_;
  std::vector<std::pair<const char*, StyleSwitch>> toggles_;  ///< commands that are on or off with the style

  Banner* banner_;
  QStackedWidget* stack_;
  StartPage* start_;
  RecoveryList* recovery_;
  MeasurePage* measure_;
  QSplitter *columns_, *middle_, *right_;
  WorkflowPanel* workflow_;
  ObjectTree* tree_;
  Inspector* inspector_;
  VersionPanel* versions_;
  MapBar* mapBar_;
  view::SceneView* view_;
  BesideView* beside_;
  FaceChooser* faces_;
  SurfaceHandles* handles_;
  HandleKeys* keys_;
  BlockHandles* blockHandles_;
  QTabWidget *tabs_, *sides_;
  QLabel* drawnLabel_;  ///< before the choice beside the tabs, where there is room for it
  SectionView* section_;
  MotionView* motion_;
  MessagePanel* messages_;
  BlockPanel* blocks_;
  QMenu *recentMenu_, *handleMenu_;
  CommandPalette* palette_;
  GuideWindow* guide_;

  QLabel *cursor_, *probe_, *jobName_;
  SummaryLine* summary_;
  QProgressBar* progress_;
  QToolButton* cancel_;
  QTimer staleTimer_, busyTimer_;

  std::shared_ptr<const pipeline::Evaluation> pictured_;  ///< what `thumbnail_` shows
  QImage thumbnail_;
  /// That the view shows; null while it shows none.
  std::shared_ptr<const pipeline::Sketch> shownSketch_;
  bool fitNext_ = true;                   ///< no result of this design was in the picture yet
  std::optional<scene::Camera> opening_;  ///< of the design's first picture
  std::optional<scene::Marker> marker_;   ///< of the finding looked at, until something else is
  bool sectioned_ = false;                ///< the scene is cut open at the station or the moving blade
  double sectionSide_ = 1;                ///< of the station's normal: which half is taken away
  int errors_ = 0;                        ///< among the messages
  bool staleShown_ = false;
  std::function<void()> ordered_;  ///< an export that waits for the result
  QElapsedTimer editClock_;
  bool awaitingFrame_ = false;
  double pictureDelay_ = 0;
};

}  // namespace bw::app
