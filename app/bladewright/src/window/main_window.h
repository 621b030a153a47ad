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

#include "bw/view/scene_view.h"
#include "controls/theme.h"
#include "measure/measure_page.h"
#include "plots/motion_view.h"
#include "plots/section_view.h"
#include "window/commands.h"
#include "window/inspector.h"
#include "window/map_bar.h"
#include "window/messages.h"
#include "window/start_page.h"
#include "workbench/workbench.h"
#include "workflow/workflow_panel.h"

namespace bw::app {

/// Questions to the user that stop the window; replaced in tests. An empty path means that the user gave up.
struct Questions {
  enum class Unsaved { save, discard, cancel };
  std::function<QString()> openSurface, openDesign;
  std::function<QString(const QString&suggestion)> saveDesign, savePicture;
  std::function<QString()> exportFolder;
  std::function<QSize(const QSize& suggestion)> pictureSize;
  std::function<Unsaved(const QString& title)> unsaved;
};

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
  MessageList& messageList() { return *messages_; }
  WorkflowPanel& workflow() { return *workflow_; }
  Banner& banner() { return *banner_; }
  MeasurePage& measurePage() { return *measure_; }
  StartPage& startPage() { return *start_; }
  QTabWidget& tabs() { return *tabs_; }
  Commands& commands() { return commands_; }
  Questions& questions() { return questions_; }
  /// Whether the scene is cut open at the station or the moving blade.
  bool sectioned() const { return sectioned_; }
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
  void showStartPage();
  /// The page that finds the length of the mounted blade.
  void showMeasurePage();
  /// Offers unsaved work that a crash left behind.
  void recover();

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
  void makeMenus();
  void makeWorkspace();
  void makeStatusBar();
  void setDefaultQuestions();
  bool mayLeave();
  void showWorkspace();
  void leaveMeasurePage();
  void refreshTitle();
  void refreshContent();
  void refreshStyle();
  void refreshState();
  void refreshSummary();
  void placeBanner();
  std::optional<scene::SectionPlane> sectionPlane() const;
  void refreshRecent();
  void onPicked(const scene::Pick& pick);
  void onHovered(const scene::Pick& pick);
  void fitSelection();
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
  Commands commands_;
  Questions questions_;

  Banner* banner_;
  QStackedWidget* stack_;
  StartPage* start_;
  MeasurePage* measure_;
  QSplitter *columns_, *middle_;
  WorkflowPanel* workflow_;
  Inspector* inspector_;
  MapBar* mapBar_;
  view::SceneView* view_;
  QTabWidget* tabs_;
  SectionView* section_;
  MotionView* motion_;
  MessageList* messages_;
  QMenu* recentMenu_;
  CommandPalette* palette_;

  QLabel *cursor_, *probe_, *summary_, *jobName_;
  QProgressBar* progress_;
  QToolButton* cancel_;
  QTimer staleTimer_, busyTimer_;

  std::shared_ptr<const pipeline::Evaluation> shown_;
  bool fitNext_ = true;                   ///< no result of this design was in the picture yet
  std::optional<scene::Camera> opening_;  ///< of the design's first picture
  bool sectioned_ = false;
  double sectionSide_ = 1;  ///< of the station's normal: which half is taken away
  bool staleShown_ = false;
  QElapsedTimer editClock_;
  bool awaitingFrame_ = false;
  double pictureDelay_ = 0;
};

}  // namespace bw::app
