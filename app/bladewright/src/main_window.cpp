// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "main_window.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QStatusBar>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "numbers.h"

namespace bw::app {

namespace {

constexpr int kLeftWidth = 320, kRightWidth = 280, kBottomHeight = 220;
constexpr int kStaleDelay = 150;  // ms: a quick answer needs no fading
constexpr int kBusyDelay = 250;   // ms until progress is worth showing
constexpr int kPictureScale = 2;

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
  measure_ = new MeasurePage(bench_, theme, stack_);
  stack_->addWidget(measure_);
  setCentralWidget(central);
  makeMenus();
  makeStatusBar();
  palette_ = new CommandPalette(commands_, this);

  connect(start_, &StartPage::openSurfaceRequested, commands_["file.open"], &QAction::trigger);
  connect(start_, &StartPage::openDesignRequested, commands_["file.openDesign"], &QAction::trigger);
  connect(start_, &StartPage::openRequested, this, &MainWindow::openFile);
  connect(start_, &StartPage::exampleRequested, this, &MainWindow::openExample);

  connect(start_, &StartPage::measureRequested, commands_["blade.measure"], &QAction::trigger);
  connect(measure_, &MeasurePage::left, this, &MainWindow::leaveMeasurePage);

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

void MainWindow::showMeasurePage() {
  if (onMeasurePage()) return;
  banner_->hide();
  measure_->enter();
  stack_->setCurrentWidget(measure_);
  measure_->table().setFocus();
  refreshTitle();
  refreshState();
}

void MainWindow::leaveMeasurePage() {
  if (!bench_.document().empty()) return showWorkspace();
  stack_->setCurrentWidget(start_);
  refreshTitle();
  refreshState();
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
  if (bench_.document().empty()) {
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

void MainWindow::refreshState() {
  const bool busy = bench_.runner().busy();
  view_->setAwaiting(busy);
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

  const bool open = stack_->currentWidget() == columns_;
  const bool ready = open && bench_.current() && !bench_.exporting();
  for (const char* id : {"file.export", "file.programs"}) commands_[id]->setEnabled(ready);
  for (const char* id : {"file.save", "file.saveAs", "file.close", "edit.compute"}) commands_[id]->setEnabled(!bench_.document().empty());
  commands_["blade.measure"]->setEnabled(!onMeasurePage());
  for (const char* id : {"file.picture", "view.fit", "view.fitSelection", "view.parallel",
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
  const bool picture = stack_->currentWidget() == columns_;
  const pipeline::SweepResult* result = picture ? bench_.sweep() : nullptr;
  if (!result) {
    summary_->setText(onStartPage() ? QString() : tr("Unit mm"));
    return;
  }
  const SweepSummary& s = result->analysis.summary;
  double slowest = bench_.shown()->design.job.cuttingSpeed;
  const double fastest = slowest;
  if (const Field* speed = result->analysis.cut.field("speed"); speed && !speed->values.empty())
    slowest = *std::min_element(speed->values.begin(), speed->values.end());
  const QString low = QString::fromStdString(shortText(slowest, 3)), high = speedText(fastest);
  const QString speeds = high.startsWith(low + " ") ? high : tr("%1 to %2").arg(low, high);
  const QString radius = radiusText(s.minRadius);
  const QString bend = radius.endsWith("mm") ? tr("radius ≥ %1").arg(radius) : tr("straight blade");
  summary_->setText(tr("Unit mm   ·   deviation ≤ %1   ·   %2 within tolerance   ·   %3   ·   %4")
                        .arg(lengthText(s.deviationMax), percentText(s.withinTolerance), speeds, bend));
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
