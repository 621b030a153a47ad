// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDialogButtonBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QStatusBar>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "bw/pipeline/scene_content.h"
#include "numbers.h"


namespace bw::app {

namespace {

constexpr int kLeftWidth = 320, kRightWidth = 280, kBottomHeight = 220;
constexpr int kStaleDelay = 150;  // ms: a quick answer needs no fading
constexpr int kBusyDelay = 250;   // ms until progress is worth showing
constexpr int kPictureScale = 2;

QString cadFilter() { return MainWindow::tr("CAD surfaces (*.step *.stp *.iges *.igs *.brep *.brp);;All files (*)"); }
QString designFilter() { return MainWindow::tr("Bladewright designs (*.bladewright)"); }

}  // namespace

MainWindow::MainWindow(model::Settings& settings, Theme& theme, const std::filesystem::path& recoveryFolder)
    : settings_(settings),
      theme_(theme),
      recoveryFolder_(recoveryFolder),
      bench_(settings, recoveryFolder),
      commands_(theme, this) {
  setWindowIcon(QIcon(":/icons/bladewright.svg"));
  setAcceptDrops(true);
  setMinimumSize(960, 600);
  setDefaultQuestions();
  makeCommands();

  auto* central = new QWidget(this);
  auto* layout = new QVBoxLayout(central);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  stack_ = new QStackedWidget(central);
  layout->addWidget(stack_, 1);
  banner_ = new Banner(theme, central);
  start_ = new StartPage(bench_, theme, stack_);
  stack_->addWidget(start_);
  makeWorkspace();
  setCentralWidget(central);
  makeMenus();
  makeStatusBar();
  palette_ = new CommandPalette(commands_, this);

  connect(start_, &StartPage::openSurfaceRequested, commands_["file.open"], &QAction::trigger);
  connect(start_, &StartPage::openDesignRequested, commands_["file.openDesign"], &QAction::trigger);
  connect(start_, &StartPage::openRequested, this, &MainWindow::openFile);
  connect(start_, &StartPage::exampleRequested, this, &MainWindow::openExample);

  start_->installEventFilter(this);
  view_->installEventFilter(this);
  connect(banner_, &Banner::told, this, &MainWindow::placeBanner);
  connect(&bench_, &Workbench::noticed, banner_, &Banner::tell);
  connect(&bench_, &Workbench::noticesOutdated, banner_, &Banner::outdate);
  connect(&bench_, &Workbench::resultChanged, this, &MainWindow::refreshContent);
  connect(&bench_, &Workbench::stateChanged, this, &MainWindow::refreshState);
  connect(&bench_, &Workbench::progressed, this, &MainWindow::refreshState);
  connect(&bench_, &Workbench::selectionChanged, this, &MainWindow::refreshStyle);
  connect(&bench_, &Workbench::playTimeChanged, this, &MainWindow::refreshStyle);
  connect(&bench_, &Workbench::frameRequested, this, [this](const Bounds& bounds) { view_->fitBounds(bounds); });
  connect(&bench_.document(), &model::Document::titleChanged, this, &MainWindow::refreshTitle);
  connect(&bench_.document(), &model::Document::designChanged, this, [this] {
    editClock_.start();
    refreshTitle();
  });
  connect(&bench_.document(), &model::Document::replaced, this, [this] {
    fitNext_ = true;
    staleShown_ = false;
  });
  connect(&bench_.settings(), &model::Settings::recentFilesChanged, this, &MainWindow::refreshRecent);
  connect(&theme, &Theme::changed, this, [this] {
    scene::Style style = mapBar_->style();
    style.dark = theme_.dark();
    mapBar_->setStyle(style);
    refreshStyle();
  });

  staleTimer_.setSingleShot(true);
  staleTimer_.setInterval(kStaleDelay);
  connect(&staleTimer_, &QTimer::timeout, this, [this] {
    staleShown_ = bench_.stale();
    refreshStyle();
  });
  busyTimer_.setSingleShot(true);
  busyTimer_.setInterval(kBusyDelay);
  connect(&busyTimer_, &QTimer::timeout, this, &MainWindow::refreshState);

  resize(1440, 900);
  restoreLayout();
  scene::Style style;
  style.field = "deviation";
  style.dark = theme.dark();
  style.tolerance = bench_.job().tolerance;
  mapBar_->setStyle(style);
  setNavigation(settings.mouse());
  refreshTitle();
  refreshRecent();
  refreshStyle();
  refreshState();
}

// The history outlives the commands that show its names.
MainWindow::~MainWindow() { bench_.document().undoStack().disconnect(); }

void MainWindow::makeCommands() {
  const auto add = [this](const char* id, const QString& text, const char* icon, const QString& tip,
                          const QList<QKeySequence>& keys, std::function<void(bool)> run, bool checkable = false) {
    return commands_.add({id, text, icon, tip, keys, checkable}, std::move(run));
  };
  add("file.open", tr("&Open CAD surface…"), "open", tr("A STEP, IGES or BREP file"), {QKeySequence::Open}, [this](bool) {
    if (const QString file = questions_.openSurface(); !file.isEmpty()) openFile(file);
  });
  add("file.openDesign", tr("Open &design…"), "folder", tr("A .bladewright file"), {QKeySequence("Ctrl+Shift+O")}, [this](bool) {
    if (const QString file = questions_.openDesign(); !file.isEmpty()) openFile(file);
  });
  add("file.save", tr("&Save"), "save", tr("Save the design"), {QKeySequence::Save}, [this](bool) { save(); });
  add("file.saveAs", tr("Save &as…"), "", tr("Save the design under another name"), {QKeySequence("Ctrl+Shift+S")}, [this](bool) { saveAs(); });
  add("file.export", tr("&Export everything…"), "export", tr("Report, CAD surface, mesh, stations and programs into a folder"),
      {QKeySequence("Ctrl+E")}, [this](bool) { exportEverything(); });
  add("file.programs", tr("Export &programs…"), "program", tr("The robot programs alone"), {}, [this](bool) { exportPrograms(); });
  add("file.picture", tr("Export p&icture…"), "picture", tr("The view as PNG at any size"), {QKeySequence("Ctrl+Shift+E")},
      [this](bool) { exportPicture(); });
  add("file.close", tr("&Close"), "close", tr("Back to the start page"), {QKeySequence("Ctrl+W")}, [this](bool) {
    if (mayLeave()) showStartPage();
  });
  add("file.quit", tr("&Quit"), "", {}, {QKeySequence("Ctrl+Q")}, [this](bool) { close(); });

  add("edit.undo", tr("&Undo"), "undo", {}, {QKeySequence::Undo}, [this](bool) { bench_.document().undoStack().undo(); });
  add("edit.redo", tr("&Redo"), "redo", {}, {QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")},
      [this](bool) { bench_.document().undoStack().redo(); });
  QUndoStack& undo = bench_.document().undoStack();
  const auto undoText = [this](const char* id, const QString& word, const QString& text) {
    commands_[id]->setText(text.isEmpty() ? word : word + " " + text);
  };
  connect(&undo, &QUndoStack::undoTextChanged, this, [=, this](const QString& text) { undoText("edit.undo", tr("&Undo"), text.toLower()); });
  connect(&undo, &QUndoStack::redoTextChanged, this, [=, this](const QString& text) { undoText("edit.redo", tr("&Redo"), text.toLower()); });
  connect(&undo, &QUndoStack::canUndoChanged, commands_["edit.undo"], &QAction::setEnabled);
  connect(&undo, &QUndoStack::canRedoChanged, commands_["edit.redo"], &QAction::setEnabled);
  commands_["edit.undo"]->setEnabled(false);
  commands_["edit.redo"]->setEnabled(false);
  add("edit.palette", tr("Find a &command…"), "search", tr("Every command by its name"), {QKeySequence("Ctrl+K")},
      [this](bool) { palette_->open(); });
  add("edit.compute", tr("Compute &again"), "process", tr("Read the file again and compute everything"), {QKeySequence("F5")}, [this](bool) {
    if (!bench_.document().empty()) bench_.runner().evaluate(bench_.document().design());
  });
  add("edit.cancel", tr("&Stop computing"), "", tr("Stop the running job"), {QKeySequence("Esc")}, [this](bool) {
    if (bench_.runner().busy()) bench_.runner().cancel();
  });
  for (const auto& [id, name, mouse] :
       {std::tuple("mouse.rhino", tr("Mouse like &Rhino"), model::MouseChoice::rhino),
        std::tuple("mouse.blender", tr("Mouse like &Blender"), model::MouseChoice::blender),
        std::tuple("mouse.solidworks", tr("Mouse like &SolidWorks"), model::MouseChoice::solidworks)})
    add(id, name, "", tr("Which buttons turn, move and scale the view"), {}, [this, mouse = mouse](bool) { setNavigation(mouse); }, true);

  static const std::array<std::tuple<const char*, const char*, const char*, scene::View>, 7> kViews = {
      {{"view.iso", QT_TR_NOOP("&Isometric"), "view-iso", scene::View::iso},
       {"view.top", QT_TR_NOOP("&Top"), "view-top", scene::View::top},
       {"view.bottom", QT_TR_NOOP("B&ottom"), "", scene::View::bottom},
       {"view.front", QT_TR_NOOP("&Front"), "", scene::View::front},
       {"view.back", QT_TR_NOOP("&Back"), "", scene::View::back},
       {"view.left", QT_TR_NOOP("&Left"), "", scene::View::left},
       {"view.right", QT_TR_NOOP("&Right"), "", scene::View::right}}};
  int key = 1;
  for (const auto& [id, text, icon, view] : kViews) {
    QString plain = tr(text);
    plain.remove('&');
    add(id, tr(text), icon, tr("%1 view").arg(plain), {QKeySequence(QString::number(key++))}, [this, view = view](bool) { view_->setView(view); });
  }
  add("view.fit", tr("&Fit all"), "fit", tr("Fit everything into the picture"), {QKeySequence("F")}, [this](bool) { view_->fitAll(); });
  add("view.fitSelection", tr("Fit &selection"), "", tr("Fit the selected thing into the picture"), {QKeySequence("Shift+F")},
      [this](bool) { fitSelection(); });
  add("view.parallel", tr("&Parallel view"), "parallel", tr("Parallel instead of perspective"), {QKeySequence("P")},
      [this](bool on) { view_->setParallel(on); }, true);
  const auto toggle = [&](const char* id, const QString& text, const char* icon, const QString& tip, const QList<QKeySequence>& keys,
                          bool scene::Style::*member) {
    add(id, text, icon, tip, keys, [this, member](bool on) {
      scene::Style style = mapBar_->style();
      style.*member = on;
      mapBar_->setStyle(style);
      refreshStyle();
    }, true);
  };
  toggle("view.shadows", tr("S&oft shadows"), "eye", tr("Shade the surface where it is less open to the light"), {}, &scene::Style::softShadows);
  add("view.section", tr("Se&ction through the scene"), "section", tr("Cut the scene open at the selected station or the moving blade"),
      {QKeySequence("X")}, [this](bool on) {
        sectioned_ = on;
        // The half that the eye is on goes away.
        if (const auto plane = sectionPlane(); plane && (view_->camera().position - plane->point).dot(plane->normal) < 0) sectionSide_ = -sectionSide_;
        refreshStyle();
        refreshState();
      }, true);
  add("view.sectionFlip", tr("Other half of the s&ection"), "", tr("Take the other half away"), {QKeySequence("Shift+X")}, [this](bool) {
    sectionSide_ = -sectionSide_;
    refreshStyle();
  });
  toggle("view.isolines", tr("Is&olines"), "isolines", tr("Lines of equal value at the ticks of the legend"), {QKeySequence("I")}, &scene::Style::isolines);
  toggle("show.target", tr("Target surface"), "target", tr("Show the target surface"), {QKeySequence("Alt+T")}, &scene::Style::showTarget);
  toggle("show.cut", tr("Cut surface"), "cut", tr("Show the cut surface"), {QKeySequence("Alt+C")}, &scene::Style::showCut);
  toggle("show.stations", tr("Stations"), "station", tr("Show the stations"), {QKeySequence("Alt+S")}, &scene::Style::showStations);
  toggle("show.blades", tr("Whole blades"), "blade", tr("Show the whole blade at every station"), {QKeySequence("Alt+B")}, &scene::Style::showBlades);
  toggle("show.block", tr("Block"), "block", tr("Show the foam block"), {QKeySequence("Alt+K")}, &scene::Style::showBlock);
  toggle("show.grid", tr("Ground grid"), "grid", tr("Show the ground grid"), {QKeySequence("Alt+G")}, &scene::Style::showGrid);
  static const std::array<std::tuple<const char*, const char*, const char*>, 6> kMaps = {
      {{"deviation", QT_TR_NOOP("Map: &deviation"), "deviation"},
       {"angle", QT_TR_NOOP("Map: cutting &angle"), "angle"},
       {"speed", QT_TR_NOOP("Map: blade &speed"), "speed"},
       {"relative_speed", QT_TR_NOOP("Map: &relative speed"), "relative-speed"},
       {"curvature", QT_TR_NOOP("Map: &bending against the limit"), "curvature"},
       {"none", QT_TR_NOOP("&No map"), "surface"}}};
  key = 1;
  for (const auto& [name, text, icon] : kMaps)
    add((std::string("map.") + name).c_str(), tr(text), icon, tr("What the colours of the cut surface show"),
        {QKeySequence("Alt+" + QString::number(key++))}, [this, name = std::string(name)](bool) { mapBar_->chooseField(name); });
  add("panel.workflow", tr("&Workflow"), "setup", tr("Show the panel at the left"), {QKeySequence("Ctrl+1")},
      [this](bool on) { workflow_->setVisible(on); }, true);
  add("panel.bottom", tr("&Section, motion, messages"), "station", tr("Show the panel below"), {QKeySequence("Ctrl+2")},
      [this](bool on) { tabs_->setVisible(on); }, true);
  add("panel.inspector", tr("&Inspector"), "measure", tr("Show the panel at the right"), {QKeySequence("Ctrl+3")},
      [this](bool on) { inspector_->setVisible(on); }, true);
  for (const char* id : {"panel.workflow", "panel.bottom", "panel.inspector"}) commands_[id]->setChecked(true);
  for (const auto& [id, text, choice] : {std::tuple("theme.system", tr("Theme of the s&ystem"), model::ThemeChoice::system),
                                         std::tuple("theme.light", tr("&Light theme"), model::ThemeChoice::light),
                                         std::tuple("theme.dark", tr("&Dark theme"), model::ThemeChoice::dark)})
    add(id, text, "", tr("Colours of the window"), {}, [this, choice = choice](bool) { applyTheme(choice); }, true);

  add("station.next", tr("&Next station"), "step-forward", tr("Select the next station"), {QKeySequence(".")}, [this](bool) {
    bench_.selectStation(bench_.selection().station + 1);
    tabs_->setCurrentWidget(section_);
  });
  add("station.previous", tr("Station &before"), "step-back", tr("Select the station before"), {QKeySequence(",")}, [this](bool) {
    bench_.selectStation(std::max(0, bench_.selection().station - 1));
    tabs_->setCurrentWidget(section_);
  });
  add("station.none", tr("Select n&othing"), "", tr("Back to the numbers of the whole result"), {QKeySequence("Ctrl+D")},
      [this](bool) { bench_.select({}); });
  add("motion.play", tr("&Play or pause"), "play", tr("Move the blade through the block"), {QKeySequence("Space")}, [this](bool) {
    tabs_->setCurrentWidget(motion_);
    motion_->togglePlay();
  });
  add("motion.start", tr("To the &start"), "to-start", tr("Blade to the start of the motion"), {QKeySequence("Home")},
      [this](bool) { motion_->goTo(0); });
  add("motion.end", tr("To the &end"), "to-end", tr("Blade to the end of the motion"), {QKeySequence("End")},
      [this](bool) { motion_->goTo(bench_.playEnd()); });
  add("tab.section", tr("Show se&ction"), "station", tr("The selected station in its plane"), {QKeySequence("Ctrl+4")},
      [this](bool) { tabs_->setCurrentWidget(section_); });
  add("tab.motion", tr("Show &motion"), "speed", tr("The timeline"), {QKeySequence("Ctrl+5")}, [this](bool) { tabs_->setCurrentWidget(motion_); });
  add("tab.messages", tr("Show m&essages"), "info", tr("All findings"), {QKeySequence("Ctrl+6")}, [this](bool) { tabs_->setCurrentWidget(messages_); });
  add("help.about", tr("&About Bladewright"), "", {}, {}, [this](bool) {
    QMessageBox box(QMessageBox::NoIcon, tr("About Bladewright"),
                    tr("<b>Bladewright %1</b><br>Design of surfaces that a hot, flexible blade cuts from foam.<br>MIT licence.")
                        .arg(QApplication::applicationVersion()),
                    QMessageBox::Ok, this);
    box.setIconPixmap(QIcon(":/icons/bladewright.svg").pixmap(64, 64));
    box.exec();
  });
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, std::initializer_list<const char*> ids) {
    for (const char* id : ids) {
      if (*id)
        menu->addAction(commands_[id]);
      else
        menu->addSeparator();
    }
    menu->setToolTipsVisible(true);
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  fill(file, {"file.open", "file.openDesign"});
  recentMenu_ = file->addMenu(tr("Open &recent"));
  fill(file, {"", "file.save", "file.saveAs", "", "file.export", "file.programs", "file.picture", "", "file.close", "file.quit"});
  fill(menuBar()->addMenu(tr("&Edit")), {"edit.undo", "edit.redo", "", "edit.compute", "edit.cancel", "", "edit.palette"});
  QMenu* view = menuBar()->addMenu(tr("&View"));
  fill(view, {"view.iso", "view.top", "view.bottom", "view.front", "view.back", "view.left", "view.right", "", "view.fit", "view.fitSelection",
              "view.parallel", "", "view.section", "view.sectionFlip", "view.shadows", ""});
  fill(view->addMenu(tr("&Map")), {"map.deviation", "map.angle", "map.speed", "map.relative_speed", "map.curvature", "map.none", "", "view.isolines"});
  fill(view->addMenu(tr("S&how")), {"show.target", "show.cut", "show.stations", "show.blades", "show.block", "show.grid"});
  fill(view->addMenu(tr("Pa&nels")), {"panel.workflow", "panel.bottom", "panel.inspector", "", "tab.section", "tab.motion", "tab.messages"});
  view->addSeparator();
  fill(view->addMenu(tr("Th&eme")), {"theme.system", "theme.light", "theme.dark"});
  fill(view->addMenu(tr("M&ouse")), {"mouse.rhino", "mouse.blender", "mouse.solidworks"});
  fill(menuBar()->addMenu(tr("&Motion")), {"motion.play", "motion.start", "motion.end", "", "station.previous", "station.next", "station.none"});
  fill(menuBar()->addMenu(tr("&Help")), {"edit.palette", "help.about"});
}

void MainWindow::makeWorkspace() {
  columns_ = new QSplitter(Qt::Horizontal, stack_);
  columns_->setHandleWidth(1);
  columns_->setChildrenCollapsible(false);
  workflow_ = new WorkflowPanel(bench_, theme_, columns_);
  workflow_->setMinimumWidth(280);
  columns_->addWidget(workflow_);

  middle_ = new QSplitter(Qt::Vertical, columns_);
  middle_->setHandleWidth(1);
  middle_->setChildrenCollapsible(false);
  auto* picture = new QWidget(middle_);
  auto* layout = new QVBoxLayout(picture);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  mapBar_ = new MapBar(theme_, commands_, picture);
  layout->addWidget(mapBar_);
  layout->addWidget(makeLine(picture));
  view_ = new view::SceneView(picture);
  view_->setAccessibleName(tr("3D view"));
  layout->addWidget(view_, 1);
  middle_->addWidget(picture);
  tabs_ = new QTabWidget(middle_);
  tabs_->setDocumentMode(true);
  section_ = new SectionView(bench_, theme_, tabs_);
  motion_ = new MotionView(bench_, theme_, tabs_);
  messages_ = new MessageList(bench_, theme_, tabs_);
  tabs_->addTab(section_, tr("Section"));
  tabs_->addTab(motion_, tr("Motion"));
  tabs_->addTab(messages_, tr("Messages"));
  auto* corner = new QFrame(tabs_);
  corner->setObjectName("panel");
  auto* cornerContent = new QWidget(corner);
  auto* cornerOuter = new QHBoxLayout(corner);
  cornerOuter->setContentsMargins(0, 0, 0, 0);
  cornerOuter->addWidget(cornerContent);
  auto* cornerLayout = new QHBoxLayout(cornerContent);
  cornerLayout->setContentsMargins(0, 2, 12, 2);
  cornerLayout->setSpacing(kGap);
  auto* label = new QLabel(tr("Deviation drawn"), corner);
  label->setObjectName("secondary");
  auto* factor = new ChoiceField(corner);
  factor->addItems({tr("1×"), tr("5×"), tr("20×")});
  factor->setMinimumContentsLength(3);
  factor->setToolTip(tr("How many times larger than it is the distance between blade and target is drawn"));
  factor->setAccessibleName(tr("Deviation drawn"));
  label->setBuddy(factor);
  cornerLayout->addWidget(label);
  cornerLayout->addWidget(factor);
  tabs_->setCornerWidget(corner);
  connect(factor, &QComboBox::activated, this, [this](int index) { section_->setExaggeration(index == 0 ? 1 : index == 1 ? 5 : 20); });
  // The corner itself stays, or its place would change colour.
  QSizePolicy keeping = cornerContent->sizePolicy();
  keeping.setRetainSizeWhenHidden(true);
  cornerContent->setSizePolicy(keeping);
  connect(tabs_, &QTabWidget::currentChanged, cornerContent, [this, cornerContent] { cornerContent->setVisible(tabs_->currentWidget() == section_); });
  middle_->addWidget(tabs_);
  middle_->setStretchFactor(0, 1);
  columns_->addWidget(middle_);

  inspector_ = new Inspector(bench_, theme_, columns_);
  inspector_->setMinimumWidth(250);
  columns_->addWidget(inspector_);
  columns_->setStretchFactor(1, 1);
  stack_->addWidget(columns_);

  connect(workflow_, &WorkflowPanel::openRequested, commands_["file.open"], &QAction::trigger);
  connect(workflow_, &WorkflowPanel::exportRequested, this, &MainWindow::exportEverything);
  connect(workflow_, &WorkflowPanel::programsRequested, this, &MainWindow::exportPrograms);
  connect(workflow_, &WorkflowPanel::pictureRequested, this, &MainWindow::exportPicture);
  connect(mapBar_, &MapBar::styleEdited, this, &MainWindow::refreshStyle);
  connect(view_, &view::SceneView::picked, this, &MainWindow::onPicked);
  connect(view_, &view::SceneView::hovered, this, &MainWindow::onHovered);
  connect(view_, &view::SceneView::legendActivated, mapBar_, &MapBar::editRange);
  connect(view_, &QOpenGLWidget::frameSwapped, this, [this] {
    if (!awaitingFrame_) return;
    awaitingFrame_ = false;
    pictureDelay_ = double(editClock_.nsecsElapsed()) * 1e-9;
    emit pictureStands();
  });
  connect(view_, &view::SceneView::rendered, this, [this] {
    if (const QString problem = view_->problem(); !problem.isEmpty()) bench_.tell({Severity::error, problem, {}, {}});
  });
  connect(messages_, &MessageList::counted, this, [this](int errors, int warnings) {
    const int loud = errors + warnings;
    tabs_->setTabText(tabs_->indexOf(messages_), loud ? tr("Messages (%1)").arg(loud) : tr("Messages"));
  });
}

void MainWindow::makeStatusBar() {
  QStatusBar* bar = statusBar();
  bar->setSizeGripEnabled(false);
  const auto label = [&](const QString& name) {
    auto* l = new QLabel(bar);
    l->setObjectName("secondary");
    l->setFont(Theme::secondaryFont());
    l->setAccessibleName(name);
    return l;
  };
  cursor_ = label(tr("Coordinates under the cursor"));
  cursor_->setMinimumWidth(190);
  cursor_->setContentsMargins(kGap, 0, 0, 0);
  probe_ = label(tr("Value under the cursor"));
  probe_->setMinimumWidth(130);
  jobName_ = label(tr("Running job"));
  summary_ = label(tr("Summary of the result"));
  progress_ = new QProgressBar(bar);
  progress_->setTextVisible(false);
  progress_->setRange(0, 1000);
  progress_->setFixedWidth(96);
  progress_->setAccessibleName(tr("Progress"));
  cancel_ = new QToolButton(bar);
  cancel_->setText(tr("Stop"));
  cancel_->setToolTip(tr("Stop the running job (Esc)"));
  cancel_->setFont(Theme::secondaryFont());
  connect(cancel_, &QToolButton::clicked, commands_["edit.cancel"], &QAction::trigger);
  bar->addWidget(cursor_);
  bar->addWidget(probe_);
  bar->addPermanentWidget(jobName_);
  bar->addPermanentWidget(progress_);
  bar->addPermanentWidget(cancel_);
  bar->addPermanentWidget(summary_);
  summary_->setContentsMargins(kGap, 0, kGap, 0);
  bar->setMinimumHeight(28);
}

void MainWindow::setDefaultQuestions() {
  const auto remember = [this](const QString& use, const QString& file) {
    if (!file.isEmpty()) settings_.setFolder(use, QFileInfo(file).isDir() ? file : QFileInfo(file).absolutePath());
    return file;
  };
  questions_.openSurface = [=, this] {
    return remember("open", QFileDialog::getOpenFileName(this, tr("Open CAD surface"), settings_.folder("open"), cadFilter()));
  };
  questions_.openDesign = [=, this] {
    return remember("design", QFileDialog::getOpenFileName(this, tr("Open design"), settings_.folder("design"), designFilter()));
  };
  questions_.saveDesign = [=, this](const QString& suggestion) {
    QString file = QFileDialog::getSaveFileName(this, tr("Save design"), settings_.folder("design") + "/" + suggestion, designFilter());
    if (!file.isEmpty() && QFileInfo(file).suffix().isEmpty()) file += ".bladewright";
    return remember("design", file);
  };
  questions_.savePicture = [=, this](const QString& suggestion) {
    QString file = QFileDialog::getSaveFileName(this, tr("Export picture"), settings_.folder("export") + "/" + suggestion, tr("PNG (*.png)"));
    if (!file.isEmpty() && QFileInfo(file).suffix().isEmpty()) file += ".png";
    return remember("export", file);
  };
  questions_.exportFolder = [=, this] {
    return remember("export", QFileDialog::getExistingDirectory(this, tr("Folder for the files"), settings_.folder("export")));
  };
  questions_.pictureSize = [this](const QSize& suggestion) {
    QDialog dialog(this);
    dialog.setWindowTitle(tr("Export picture"));
    auto* layout = new QVBoxLayout(&dialog);
    auto* column = new FormColumn(&dialog);
    auto* width = new NumberField({16, 16384, 0, 100, "px"});
    auto* height = new NumberField({16, 16384, 0, 100, "px"});
    width->show(suggestion.width());
    height->show(suggestion.height());
    column->add(tr("Width"), width);
    column->add(tr("Height"), height);
    layout->addWidget(column);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, &dialog);
    auto* go = buttons->addButton(tr("Choose file…"), QDialogButtonBox::AcceptRole);
    go->setObjectName("primary");
    layout->addSpacing(kGap);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    return dialog.exec() == QDialog::Accepted ? QSize(int(width->value()), int(height->value())) : QSize();
  };
  questions_.unsaved = [this](const QString& title) {
    QMessageBox box(QMessageBox::NoIcon, tr("Unsaved changes"), tr("“%1” has changes that are not saved.").arg(title),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setDefaultButton(QMessageBox::Save);
    switch (box.exec()) {
      case QMessageBox::Save:
        return Questions::Unsaved::save;
      case QMessageBox::Discard:
        return Questions::Unsaved::discard;
      default:
        return Questions::Unsaved::cancel;
    }
  };
}

bool MainWindow::mayLeave() {
  if (bench_.document().empty() || !bench_.document().modified()) return true;
  switch (questions_.unsaved(bench_.document().title())) {
    case Questions::Unsaved::save:
      return save();
    case Questions::Unsaved::discard:
      return true;
    case Questions::Unsaved::cancel:
      return false;
  }
  return false;
}

void MainWindow::openFile(const QString& file) {
  if (!mayLeave()) return;
  banner_->hide();
  if (bench_.openFile(file.toStdString())) showWorkspace();
}

void MainWindow::openExample(const QString& name) {
  if (!mayLeave()) return;
  banner_->hide();
  if (bench_.openExample(name.toStdString())) showWorkspace();
}

bool MainWindow::save() {
  if (bench_.document().empty()) return false;
  if (bench_.document().file().empty()) return saveAs();
  return bench_.saveTo(bench_.document().file());
}

bool MainWindow::saveAs() {
  if (bench_.document().empty()) return false;
  const QString file = questions_.saveDesign(bench_.document().title() + ".bladewright");
  return !file.isEmpty() && bench_.saveTo(file.toStdString());
}

void MainWindow::exportEverything() {
  if (!bench_.current()) return;
  if (const QString folder = questions_.exportFolder(); !folder.isEmpty()) bench_.exportAll(folder.toStdString());
}

void MainWindow::exportPrograms() {
  if (!bench_.current()) return;
  if (const QString folder = questions_.exportFolder(); !folder.isEmpty()) bench_.exportPrograms(folder.toStdString());
}

void MainWindow::exportPicture() {
  if (onStartPage()) return;
  const QSize size = questions_.pictureSize(view_->size() * kPictureScale);
  if (size.isEmpty()) return;
  const QString file = questions_.savePicture(bench_.document().title() + ".png");
  if (file.isEmpty()) return;
  const double ratio = std::max(1.0, double(size.width()) / std::max(1, view_->width()));
  const QImage image = view_->picture(size, ratio);
  // Written beside its place first: a full disk leaves no half picture.
  const QString part = file + ".part";
  if (image.isNull() || !image.save(part, "PNG") || (QFile::exists(file) && !QFile::remove(file)) || !QFile::rename(part, file)) {
    QFile::remove(part);
    bench_.tell({Severity::error, tr("The picture could not be written to %1; choose another folder.").arg(file), {}, {}});
    return;
  }
  bench_.tell({Severity::info, tr("Picture written to %1").arg(file), {}, {}});
}

void MainWindow::showStartPage() {
  bench_.document().start(Design());
  shown_.reset();
  stack_->setCurrentWidget(start_);
  refreshTitle();
  refreshState();
}

void MainWindow::showWorkspace() {
  stack_->setCurrentWidget(columns_);
  view_->setFocus();
  refreshTitle();
  refreshState();
  placeBanner();
}

void MainWindow::placeBanner() {
  if (onStartPage()) {
    banner_->place({kGroupGap, kGroupGap}, banner_->parentWidget()->width() - 2 * kGroupGap);
    return;
  }
  const QPoint corner = view_->mapTo(banner_->parentWidget(), QPoint(kGap, kGap));
  const QRectF legend = view_->legendRect();
  const double right = legend.isEmpty() ? view_->width() : legend.left();
  banner_->place(corner, std::max(320, int(right) - 2 * kGap));
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Show) QTimer::singleShot(0, this, &MainWindow::placeBanner);
  return QMainWindow::eventFilter(watched, event);
}

void MainWindow::recover() {
  std::optional<model::Recovered> found = model::takeRecovered(recoveryFolder_);
  if (!found) return;
  bench_.document().recover(std::move(found->design), found->file);
  showWorkspace();
  bench_.tell({Severity::info, tr("Unsaved work on “%1” was recovered.").arg(bench_.document().title()), tr("Discard it"), [this] { showStartPage(); }});
}

void MainWindow::refreshTitle() {
  if (onStartPage() || bench_.document().empty()) {
    setWindowModified(false);
    setWindowTitle(tr("Bladewright"));
    return;
  }
  setWindowTitle(tr("%1[*] – Bladewright").arg(bench_.document().title()));
  setWindowModified(bench_.document().modified());
}

void MainWindow::refreshRecent() {
  recentMenu_->clear();
  const auto files = settings_.recentFiles();
  for (const std::filesystem::path& file : files) {
    const QString path = QString::fromStdString(file.string());
    QAction* action = recentMenu_->addAction(QString(path).replace("&", "&&"));
    connect(action, &QAction::triggered, this, [this, path] { openFile(path); });
  }
  if (!files.empty()) {
    recentMenu_->addSeparator();
    connect(recentMenu_->addAction(tr("Clear the list")), &QAction::triggered, &settings_, &model::Settings::clearRecentFiles);
  }
  recentMenu_->setEnabled(!files.empty());
}

void MainWindow::refreshContent() {
  const auto evaluation = bench_.shown();
  if (evaluation != shown_ || !evaluation) {
    shown_ = evaluation;
    view_->setContent(evaluation ? pipeline::sceneContent(*evaluation) : scene::Content());
    if (evaluation && fitNext_) {
      fitNext_ = false;
      view_->setView(scene::View::iso, false);
    }
  }
  staleTimer_.stop();
  staleShown_ = false;
  refreshStyle();
  refreshSummary();
  if (evaluation && bench_.current()) {
    awaitingFrame_ = true;
    view_->update();
  }
}

std::optional<scene::SectionPlane> MainWindow::sectionPlane() const {
  const pipeline::SweepResult* result = bench_.sweep();
  if (!sectioned_ || !result || result->sweep.stations.empty()) return std::nullopt;
  const auto& stations = result->sweep.stations;
  // The moving blade leads while it plays, the selected station otherwise, the middle if there is neither.
  const bool follow = bench_.moving() && (motion_->playing() || bench_.selection().station < 0);
  const double at = follow ? bench_.stationAt(bench_.playTime())
                           : bench_.selection().station >= 0 ? bench_.selection().station : 0.5 * double(stations.size() - 1);
  const auto before = std::size_t(std::clamp(std::floor(at), 0.0, double(stations.size() - 1)));
  const std::size_t after = std::min(before + 1, stations.size() - 1);
  const double share = std::clamp(at - double(before), 0.0, 1.0);
  const Frame &a = stations[before].frame, &b = stations[after].frame;
  return scene::SectionPlane{(1 - share) * a.origin + share * b.origin, sectionSide_ * ((1 - share) * a.normal + share * b.normal).normalized()};
}

void MainWindow::refreshStyle() {
  scene::Style style = mapBar_->style();
  style.dark = theme_.dark();
  style.tolerance = bench_.job().tolerance;
  style.stale = staleShown_;
  style.selectedStation = bench_.selection().station;
  style.playhead = bench_.moving() ? bench_.stationAt(bench_.playTime()) : -1;
  style.section = sectionPlane();
  view_->setStyle(style);
  mapBar_->setRangeInUse(view_->legendRange());
  static const std::pair<const char*, bool scene::Style::*> kToggles[] = {
      {"view.isolines", &scene::Style::isolines}, {"view.shadows", &scene::Style::softShadows}, {"show.target", &scene::Style::showTarget}, {"show.cut", &scene::Style::showCut},
      {"show.stations", &scene::Style::showStations}, {"show.blades", &scene::Style::showBlades}, {"show.block", &scene::Style::showBlock},
      {"show.grid", &scene::Style::showGrid}};
  for (const auto& [id, member] : kToggles) commands_[id]->setChecked(style.*member);
  commands_["view.section"]->setChecked(sectioned_);
}

void MainWindow::refreshState() {
  const bool busy = bench_.runner().busy();
  if (bench_.stale()) {
    if (!staleShown_ && !staleTimer_.isActive()) staleTimer_.start();
  } else {
    staleTimer_.stop();
    if (std::exchange(staleShown_, false)) refreshStyle();
  }
  if (busy && !progress_->isVisible() && !busyTimer_.isActive() && sender() != &busyTimer_) busyTimer_.start();
  if (!busy) busyTimer_.stop();
  const bool shown = busy && !busyTimer_.isActive();
  QString word = bench_.runner().step();
  if (!word.isEmpty()) word[0] = word[0].toUpper();
  jobName_->setText(word.isEmpty() ? tr("Computing") : word);
  progress_->setValue(int(1000 * bench_.runner().progress()));
  for (QWidget* widget : {static_cast<QWidget*>(jobName_), static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_)}) widget->setVisible(shown);

  const bool open = !onStartPage();
  const bool ready = open && bench_.current() && !bench_.exporting();
  for (const char* id : {"file.export", "file.programs"}) commands_[id]->setEnabled(ready);
  for (const char* id : {"file.save", "file.saveAs", "file.picture", "file.close", "edit.compute", "view.fit", "view.fitSelection", "view.parallel",
                         "view.isolines", "view.shadows", "view.section", "view.iso", "view.top", "view.bottom", "view.front", "view.back", "view.left", "view.right",
                         "panel.workflow", "panel.bottom", "panel.inspector", "tab.section", "tab.motion", "tab.messages"})
    commands_[id]->setEnabled(open);
  for (const char* id : {"motion.play", "motion.start", "motion.end", "station.next", "station.previous", "station.none"})
    commands_[id]->setEnabled(open && bench_.sweep());
  commands_["view.sectionFlip"]->setEnabled(open && sectioned_);
  commands_["edit.cancel"]->setEnabled(busy);
  refreshSummary();
}

void MainWindow::refreshSummary() {
  const pipeline::SweepResult* result = onStartPage() ? nullptr : bench_.sweep();
  if (!result) {
    summary_->setText(onStartPage() ? QString() : tr("Unit mm"));
    return;
  }
  const SweepSummary& s = result->analysis.summary;
  double slowest = bench_.shown()->design.job.cuttingSpeed;
  const double fastest = slowest;
  if (const Field* speed = result->analysis.cut.field("speed"); speed && !speed->values.empty())
    slowest = *std::min_element(speed->values.begin(), speed->values.end());
  summary_->setText(tr("Unit mm   ·   deviation ≤ %1   ·   %2 within tolerance   ·   %3 to %4   ·   radius ≥ %5")
                        .arg(lengthText(s.deviationMax), percentText(s.withinTolerance), QString::fromStdString(shortText(slowest, 3)),
                             speedText(fastest), radiusText(s.minRadius)));
}

void MainWindow::onPicked(const scene::Pick& pick) {
  switch (pick.kind) {
    case scene::Pick::Kind::station:
      bench_.selectStation(pick.station);
      break;
    case scene::Pick::Kind::target:
      bench_.select({Selection::Kind::surface, -1});
      break;
    case scene::Pick::Kind::blade:
      bench_.select({Selection::Kind::blade, -1});
      break;
    case scene::Pick::Kind::block:
      bench_.select({Selection::Kind::block, -1});
      break;
    default:
      bench_.select({});
  }
}

void MainWindow::onHovered(const scene::Pick& pick) {
  if (pick.kind == scene::Pick::Kind::none) {
    cursor_->clear();
    probe_->clear();
    return;
  }
  cursor_->setText(pointText(pick.point) + " mm");
  QString text;
  const Field* field = view_->content().cut.field(view_->sceneStyle().field);
  if (pick.value && field) {
    text = QString::fromStdString(field->title.empty() ? field->name : field->title) + " " + QString::fromStdString(shortText(*pick.value, 3));
    if (!field->unit.empty()) text += (field->unit == "°" ? "" : " ") + QString::fromStdString(field->unit);
  }
  probe_->setText(text);
}

void MainWindow::fitSelection() {
  Bounds bounds;
  const auto shown = bench_.shown();
  if (!shown) return;
  const Selection& selection = bench_.selection();
  if (const pipeline::SweepResult* result = bench_.sweep(); result && selection.station >= 0) {
    const Station& station = result->sweep.stations[std::size_t(selection.station)];
    for (const Eigen::Vector2d& p : station.blade.sample(33)) bounds.add(station.frame.toWorld(p));
  } else if (selection.kind == Selection::Kind::surface && shown->target.value) {
    bounds = shown->target.value->bounds();
  } else if (selection.kind == Selection::Kind::block && shown->setup.value) {
    for (const Eigen::Vector3d& corner : shown->setup.value->block.corners()) bounds.add(corner);
  }
  if (bounds.valid())
    view_->fitBounds(bounds);
  else
    view_->fitAll();
}

void MainWindow::applyTheme(model::ThemeChoice choice) {
  settings_.setTheme(choice);
  theme_.apply(choice);
  refreshState();
  for (const auto& [id, c] : {std::pair("theme.system", model::ThemeChoice::system), std::pair("theme.light", model::ThemeChoice::light),
                              std::pair("theme.dark", model::ThemeChoice::dark)})
    commands_[id]->setChecked(c == choice);
}

void MainWindow::setNavigation(model::MouseChoice mouse) {
  settings_.setMouse(mouse);
  view_->setNavigation(mouse == model::MouseChoice::blender      ? view::Navigation::blender
                       : mouse == model::MouseChoice::solidworks ? view::Navigation::solidworks
                                                                 : view::Navigation::rhino);
  for (const auto& [id, m] : {std::pair("mouse.rhino", model::MouseChoice::rhino), std::pair("mouse.blender", model::MouseChoice::blender),
                              std::pair("mouse.solidworks", model::MouseChoice::solidworks)})
    commands_[id]->setChecked(m == mouse);
  for (const auto& [id, c] : {std::pair("theme.system", model::ThemeChoice::system), std::pair("theme.light", model::ThemeChoice::light),
                              std::pair("theme.dark", model::ThemeChoice::dark)})
    commands_[id]->setChecked(c == settings_.theme());
}

void MainWindow::restoreLayout() {
  if (const QByteArray state = settings_.layout("window"); !state.isEmpty()) restoreGeometry(state);
  if (!columns_->restoreState(settings_.layout("columns"))) columns_->setSizes({kLeftWidth, 1440 - kLeftWidth - kRightWidth, kRightWidth});
  if (!middle_->restoreState(settings_.layout("middle"))) middle_->setSizes({600, kBottomHeight});
}

void MainWindow::storeLayout() {
  settings_.setLayout("window", saveGeometry());
  settings_.setLayout("columns", columns_->saveState());
  settings_.setLayout("middle", middle_->saveState());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!mayLeave()) {
    event->ignore();
    return;
  }
  storeLayout();
  event->accept();
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
  if (!commands_.pressKey(event)) QMainWindow::keyPressEvent(event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  if (!event->mimeData()->hasUrls()) return;
  event->acceptProposedAction();
  const QString file = event->mimeData()->urls().first().toLocalFile();
  // The question about unsaved changes must not hold up the drag.
  QTimer::singleShot(0, this, [this, file] { openFile(file); });
}

}  // namespace bw::app
