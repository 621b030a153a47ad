// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QScreen>

#include <algorithm>

#include "bw/core/base/units.h"
#include "bw/core/shape/surface_blades.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/moulds.h"
#include "controls/layout.h"
#include "controls/numbers.h"
#include "window/start_page.h"
#include "workflow/surface_fields.h"

namespace bw::app {

namespace {

constexpr QSize kUsualSize(1440, 900);
constexpr QSize kFrame(16, 40);  // room for what the desktop puts around a window
constexpr int kLeftWidth = 320, kRightWidth = 300, kBottomHeight = 220, kTreeHeight = 180;
constexpr double kPanelThickness = 30;  // mm, that is proposed
constexpr int kLabelledTabs = 480;      // narrower tabs leave the label beside them out
constexpr int kStaleDelay = 150;        // ms: a quick answer needs no fading
constexpr int kBusyDelay = 250;         // ms until progress is worth showing

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
  auto* layout = makeBox<QVBoxLayout>(central, {}, 0);
  stack_ = new QStackedWidget(central);
  layout->addWidget(stack_, 1);
  banner_ = new Banner(theme, central);
  start_ = new StartPage(bench_, theme, stack_);
  stack_->addWidget(start_);
  recovery_ = new RecoveryList(theme, recoveryFolder, start_);
  start_->putAbove(recovery_);
  makeWorkspace();
  measure_ = new MeasurePage(bench_, theme, stack_);
  stack_->addWidget(measure_);
  setCentralWidget(central);
  makeMenus();
  makeStatusBar();
  palette_ = new CommandPalette(commands_, this);
  guide_ = new GuideWindow(commands_, this);

  connect(start_, &StartPage::openSurfaceRequested, commands_["file.open"], &QAction::trigger);
  connect(start_, &StartPage::openDesignRequested, commands_["file.openDesign"], &QAction::trigger);
  connect(start_, &StartPage::newBlockRequested, commands_["file.newBlock"], &QAction::trigger);
  connect(start_, &StartPage::newWallRequested, commands_["file.newWall"], &QAction::trigger);
  connect(start_, &StartPage::openRequested, this, &MainWindow::openFile);
  connect(start_, &StartPage::exampleRequested, this, &MainWindow::openExample);

  connect(recovery_, &RecoveryList::openRequested, this, &MainWindow::goOnWith);
  connect(recovery_, &RecoveryList::discardRequested, this, &MainWindow::discardUnsaved);
  bench_.document().setPictureMaker([this] { return thumbnail(); });
  bench_.setEarlierQuestion([this](const auto& folder, const auto& files, const auto& other) {
    return questions_.earlierExport(folder, files, other);
  });
  bench_.setLeaveQuestion([this] { return mayLeave(); });
  connect(&bench_, &Workbench::readingEnded, this, [this](bool opened) {
    if (opened) showWorkspace();
  });
  connect(start_, &StartPage::measureRequested, commands_["blade.measure"], &QAction::trigger);
  connect(measure_, &MeasurePage::left, this, &MainWindow::leaveMeasurePage);

  new LaidOutFirst(this);
  start_->installEventFilter(this);
  view_->installEventFilter(this);
  connect(banner_, &Banner::told, this, &MainWindow::placeBanner);
  connect(&bench_, &Workbench::noticed, banner_, &Banner::tell);
  connect(&bench_, &Workbench::noticesOutdated, banner_, &Banner::outdate);
  connect(&bench_, &Workbench::locateRequested, this, &MainWindow::locateSurface);
  connect(qApp, &QGuiApplication::applicationStateChanged, this, [this](Qt::ApplicationState state) {
    if (state == Qt::ApplicationActive) bench_.lookAtSource();
  });
  connect(&bench_, &Workbench::changed, this, &MainWindow::follow);
  connect(&bench_, &Workbench::spotShown, this, &MainWindow::showSpot);
  connect(&bench_.document(), &model::Document::titleChanged, this, &MainWindow::refreshTitle);
  connect(&bench_.document(), &model::Document::replaced, this, [this] {
    for (TypedField* field : columns_->findChildren<TypedField*>()) field->restore();
    fitNext_ = true;
    opening_.reset();
    thumbnail_ = {};
    pictured_.reset();
    staleShown_ = false;
    ordered_ = nullptr;
    handles_->choose({});
    // Another design may have no creases to be coloured.
    scene::Style style = mapBar_->style();
    if (const MapInfo* map = cutMap(style[scene::Kind::cut].map); map && !map->ofCut) {
      style[scene::Kind::cut].map = "deviation";
      mapBar_->setStyle(style);
    }
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

  resize(kUsualSize.boundedTo(screen()->availableSize() - kFrame));
  restoreLayout();
  scene::Style style;
  style[scene::Kind::cut].map = "deviation";
  style.dark = theme.dark();
  style.tolerance = bench_.design().process.tolerance;
  mapBar_->setStyle(style);
  setNavigation(settings.mouse());
  tickTheme();
  refreshTitle();
  refreshRecent();
  refreshStyle();
  refreshState();
}

MainWindow::~MainWindow() {
  // A field that is being typed into tells its number when it is hidden: now, while there is a design.
  hide();
  // The history outlives the commands that show its names.
  bench_.document().undoStack().disconnect();
}

void MainWindow::showStartPage() {
  bench_.document().start(Design());
  recovery_->refresh();
  stack_->setCurrentWidget(start_);
  refreshTitle();
  refreshState();
}

void MainWindow::showWorkspace() {
  stack_->setCurrentWidget(columns_);
  view_->setFocus();
  refreshTitle();
  refreshState();
  banner_->resume();
  placeBanner();
}

void MainWindow::takeKeyBlades(pipeline::Told told) {
  const std::shared_ptr<const pipeline::Evaluation> shown = bench_.shown();
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  if (!cut || !bench_.current()) return;
  const double tolerance = kKeyBladeShare * bench_.design().process.tolerance;
  const Result<pipeline::CutKeyBlades> keys = pipeline::keyBladesOf(*cut, told, tolerance, {});
  if (!keys) return bench_.tell(Topic::declined, keys.error());
  Result<Design> changed = pipeline::withSurface(*shown, cut->id, keys->surface);
  if (!changed) return bench_.tell(Topic::declined, changed.error());
  const std::size_t count = std::get<BladesSurface>(keys->surface.shape).blades.size();
  bench_.editDesign(told == pipeline::Told::cut ? tr("Adopt what is cut") : tr("Surface as key blades"),
                    [&changed](Design& design) { design = std::move(*changed); });
  QString words =
      tr("%1 key blades, within %2 of what they were made from").arg(count).arg(lengthText(keys->deviation));
  constexpr double kSeen = 0.005;  // degrees
  if (const double off = toDegrees(keys->turnedOff); off >= kSeen)
    words += tr("; planes up to %1° off those before").arg(QString::fromStdString(shortText(off, 2)));
  words += missedAimText(count, keys->deviation, tolerance);
  bench_.tell(Topic::made, keys->deviation > tolerance ? Severity::warning : Severity::info, words);
}

void MainWindow::makeMoulds() {
  const std::shared_ptr<const pipeline::Evaluation> shown = bench_.shown();
  if (!shown || !bench_.current()) return;
  const auto told = [this](Result<Design> moulds) {
    if (!moulds) bench_.tell(Topic::declined, moulds.error());
    return moulds;
  };
  // What keeps the blocks from it is told before anything is asked.
  if (!told(pipeline::withUpperMoulds(*shown, kPanelThickness))) return;
  const std::optional<double> thickness = questions_.panelThickness(kPanelThickness);
  if (!thickness) return;
  const Result<Design> moulds = told(pipeline::withUpperMoulds(*shown, *thickness));
  if (!moulds) return;
  const auto counted = [](std::size_t count, const QString& one, const QString& many) {
    return QString::number(count) + " " + (count == 1 ? one : many);
  };
  const std::size_t blocks = bench_.design().stock.size();
  const int lost = pipeline::gridExpressions(bench_.design());
  bench_.editDesign(tr("Two moulds for a panel"), [&moulds](Design& design) { design = *moulds; });
  if (bench_.design() != *moulds) return;  // something of it is locked, which is told
  QString words = tr("%1 for %2: the foam of both stands back from the surface by %3")
                      .arg(counted(moulds->stock.size() - blocks, tr("upper mould"), tr("upper moulds")),
                           counted(blocks, tr("block"), tr("blocks")), lengthText(*thickness / 2));
  if (lost > 0)
    words += tr(". The blocks lie in no grid any more: %1 of it that expressions told now stand as computed")
                 .arg(counted(std::size_t(lost), tr("number"), tr("numbers")));
  bench_.tell(Topic::made, lost > 0 ? Severity::warning : Severity::info, words);
}

void MainWindow::showMeasurePage() {
  if (onMeasurePage()) return;
  banner_->pause();
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
  banner_->resume();
}

void MainWindow::placeBanner() {
  if (onStartPage()) {
    // At the lower edge: the title is above, and every button.
    banner_->place({kGroupGap, 0}, banner_->parentWidget()->width() - 2 * kGroupGap);
    banner_->move(kGroupGap, banner_->parentWidget()->height() - banner_->height() - kGroupGap);
    return;
  }
  const QPoint corner = view_->mapTo(banner_->parentWidget(), QPoint(kGap, kGap));
  const QRectF legend = view_->legendRect();
  const double right = legend.isEmpty() ? view_->width() : legend.left();
  banner_->place(corner, std::max(320, int(right) - 2 * kGap));
}

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Show)
    QTimer::singleShot(0, this, &MainWindow::placeBanner);
  if (watched == tabs_ && event->type() == QEvent::Resize)
    drawnLabel_->setVisible(tabs_->width() >= kLabelledTabs);
  return QMainWindow::eventFilter(watched, event);
}

void MainWindow::applyTheme(model::ThemeChoice choice) {
  settings_.setTheme(choice);
  theme_.apply(choice);
  refreshState();
  tickTheme();
}

void MainWindow::tickTheme() {
  for (const auto& [id, choice] : {std::pair("theme.system", model::ThemeChoice::system),
                                   std::pair("theme.light", model::ThemeChoice::light),
                                   std::pair("theme.dark", model::ThemeChoice::dark)})
    commands_[id]->setChecked(choice == settings_.theme());
}

void MainWindow::setNavigation(model::MouseChoice mouse) {
  settings_.setMouse(mouse);
  const view::Navigation navigation = mouse == model::MouseChoice::blender      ? view::Navigation::blender
                                      : mouse == model::MouseChoice::solidworks ? view::Navigation::solidworks
                                                                                : view::Navigation::rhino;
  view_->setNavigation(navigation);
  beside_->setNavigation(navigation);
  for (const auto& [id, m] : {std::pair("mouse.rhino", model::MouseChoice::rhino),
                              std::pair("mouse.blender", model::MouseChoice::blender),
                              std::pair("mouse.solidworks", model::MouseChoice::solidworks)})
    commands_[id]->setChecked(m == mouse);
}

void MainWindow::restoreLayout() {
  if (const QByteArray state = settings_.layout("window"); !state.isEmpty()) restoreGeometry(state);
  if (!columns_->restoreState(settings_.layout("columns")))
    columns_->setSizes({kLeftWidth, width() - kLeftWidth - kRightWidth, kRightWidth});
  if (!middle_->restoreState(settings_.layout("middle"))) middle_->setSizes({600, kBottomHeight});
  if (!right_->restoreState(settings_.layout("right"))) right_->setSizes({kTreeHeight, 600});
}

void MainWindow::storeLayout() {
  settings_.setLayout("window", saveGeometry());
  settings_.setLayout("columns", columns_->saveState());
  settings_.setLayout("middle", middle_->saveState());
  settings_.setLayout("right", right_->saveState());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!mayLeave()) {
    event->ignore();
    return;
  }
  storeLayout();
  bench_.document().discardCopy();  // saved, or given up: the person was asked
  event->accept();
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
  if (!commands_.pressKey(event)) QMainWindow::keyPressEvent(event);
}

}  // namespace bw::app
