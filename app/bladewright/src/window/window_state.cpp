// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The widgets of the workspace, how they talk to each other, and what the window tells of the state: its
// title, which commands there are, progress, and the summary of the result.
#include <QStatusBar>
#include <QTabBar>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bw/core/text/number_text.h"
#include "controls/numbers.h"
#include "window/curve_handles.h"
#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr int kFactorWidth = 66;
constexpr int kToldFor = 8000;     // ms, in the line at the bottom
constexpr int kMiddleWidth = 358;  // as much as the panels beside it leave of the smallest window
constexpr double kLeastUp = 0.2;   // cosine between the way of handles and the plane's, to be pulled there

/// Tabs that are no wider than what they hold: there is no frame around it.
class SideTabs : public QTabWidget {
 public:
  using QTabWidget::QTabWidget;
  QSize minimumSizeHint() const override {
    int width = tabBar()->minimumSizeHint().width();
    for (int i = 0; i < count(); ++i) width = std::max(width, widget(i)->minimumSizeHint().width());
    return {width, QTabWidget::minimumSizeHint().height()};
  }
};

/// Which of the first `count` handles, moved along `way`, lie within `reach` of a plane, as they lie in it.
SectionGrips gripsIn(const scene::Handles& handles, int count, const Eigen::Vector3d& way, const Frame& plane,
                     double reach) {
  SectionGrips in;
  if (std::abs(way.dot(plane.y)) < kLeastUp) return in;
  const auto lies = [&](const Eigen::Vector3d& p) { return std::abs(plane.toLocal(p).z()) <= reach; };
  const auto placed = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d { return plane.toLocal(p).head<2>(); };
  for (int i = 0; i < std::min(count, int(handles.points.size())); ++i)
    if (const Eigen::Vector3d& p = handles.points[std::size_t(i)]; lies(p))
      in.grips.push_back(
          {i, placed(p), std::ranges::find(handles.chosen, i) != handles.chosen.end(), i == handles.lit});
  for (const scene::HandleWay& each : handles.ways)
    if (lies(each.from))
      in.ways.push_back({placed(each.from), placed(each.to), each.endsAtFrom, each.endsAtTo});
  if (const scene::Polyline& corners = handles.region.corners; std::ranges::all_of(corners, lies)) {
    std::ranges::transform(corners, std::back_inserter(in.region), placed);
    in.regionEnds = handles.region.ends;
  }
  in.text = QString::fromStdString(handles.text);
  in.stopped = handles.stopped;
  return in;
}

}  // namespace

void MainWindow::makeWorkspace() {
  columns_ = new QSplitter(Qt::Horizontal, stack_);
  columns_->setHandleWidth(1);
  columns_->setChildrenCollapsible(false);
  workflow_ = new WorkflowPanel(bench_, theme_, columns_);
  columns_->addWidget(workflow_);

  middle_ = new QSplitter(Qt::Vertical, columns_);
  middle_->setHandleWidth(1);
  middle_->setChildrenCollapsible(false);
  auto* picture = new QWidget(middle_);
  auto* layout = makeBox<QVBoxLayout>(picture, {}, 0);
  mapBar_ = new MapBar(theme_, commands_, picture);
  layout->addWidget(mapBar_);
  layout->addWidget(makeLine(picture));
  view_ = new view::SceneView(picture);
  view_->setAccessibleName(tr("3D view"));
  beside_ = new BesideView(comparison_, *view_, picture);
  layout->addWidget(beside_, 1);
  faces_ = new FaceChooser(bench_, theme_, view_);
  handles_ = new SurfaceHandles(bench_, view_);
  keys_ = new HandleKeys(bench_, view_, *handles_);
  blockHandles_ = new BlockHandles(bench_, view_, *handles_);
  middle_->addWidget(picture);
  middle_->setMinimumWidth(kMiddleWidth);
  tabs_ = new QTabWidget(middle_);
  tabs_->setDocumentMode(true);
  section_ = new SectionView(bench_, theme_, tabs_);
  motion_ = new MotionView(bench_, theme_, tabs_);
  messages_ = new MessagePanel(bench_, theme_, tabs_);
  tabs_->addTab(section_, tr("Section"));
  tabs_->addTab(motion_, tr("Motion"));
  tabs_->addTab(messages_, tr("Messages"));
  blocks_ = new BlockPanel(bench_, theme_, tabs_);
  tabs_->addTab(blocks_, tr("Blocks"));
  auto* corner = new QFrame(tabs_);
  corner->setObjectName("panel");
  auto* cornerContent = new QWidget(corner);
  auto* cornerOuter = makeBox<QHBoxLayout>(corner);
  cornerOuter->addWidget(cornerContent);
  auto* cornerLayout = makeBox<QHBoxLayout>(cornerContent, {0, 2, 4, 2}, kGap);
  auto* label = new QLabel(tr("Deviation drawn"), corner);
  label->setObjectName("secondary");
  auto* factor = new ChoiceField(corner);
  factor->addItems({tr("1×"), tr("5×"), tr("20×")});
  factor->setFixedWidth(kFactorWidth);
  factor->setToolTip(tr("How many times larger than it is the distance between blade and target is drawn"));
  factor->setAccessibleName(tr("Deviation drawn"));
  label->setBuddy(factor);
  cornerLayout->addWidget(label);
  cornerLayout->addWidget(factor);
  drawnLabel_ = label;
  tabs_->setCornerWidget(corner);
  tabs_->installEventFilter(this);
  connect(factor, &QComboBox::activated, this, [this](int index) {
    section_->setExaggeration(index == 0 ? 1 : index == 1 ? 5 : 20);
  });
  // The corner itself stays, or its place would change colour; its width is the tabs' where it is empty.
  connect(tabs_, &QTabWidget::currentChanged, cornerContent,
          [this, cornerContent] { cornerContent->setVisible(tabs_->currentWidget() == section_); });
  middle_->addWidget(tabs_);
  middle_->setStretchFactor(0, 1);
  columns_->addWidget(middle_);

  sides_ = new SideTabs(columns_);
  sides_->setDocumentMode(true);
  right_ = new QSplitter(Qt::Vertical, sides_);
  right_->setHandleWidth(1);
  right_->setChildrenCollapsible(false);
  tree_ = new ObjectTree(bench_, theme_, right_);
  right_->addWidget(tree_);
  inspector_ = new Inspector(bench_, theme_, right_);
  right_->addWidget(inspector_);
  right_->setStretchFactor(1, 1);
  sides_->addTab(right_, tr("Objects"));
  versions_ = new VersionPanel(bench_, comparison_, theme_, sides_);
  sides_->addTab(versions_, tr("Versions"));
  columns_->addWidget(sides_);
  followComparison();
  connect(&bench_, &Workbench::objectsChanged, this, &MainWindow::refreshStyle);
  columns_->setStretchFactor(1, 1);
  stack_->addWidget(columns_);
  setKeyboardHome(*columns_, *view_);

  connect(workflow_, &WorkflowPanel::blocksRequested, commands_["tab.blocks"], &QAction::trigger);
  InputFields* input = workflow_->inputFields();
  connect(input, &InputFields::openRequested, commands_["file.open"], &QAction::trigger);
  connect(input, &InputFields::replaceRequested, commands_["file.replace"], &QAction::trigger);
  connect(input, &InputFields::reloadRequested, commands_["file.reload"], &QAction::trigger);
  connect(input, &InputFields::locateRequested, this, &MainWindow::locateSurface);
  connect(&input->faces(), &FaceFields::chooseInPictureRequested, faces_, [this](bool on) {
    faces_->setChoosing(on);
    refreshState();
  });
  const OutputFields* output = workflow_->outputFields();
  connect(output, &OutputFields::folderRequested, this, [this] {
    if (const QString folder = questions_.exportFolder(); !folder.isEmpty())
      bench_.setExportTo(folder.toStdString());
  });
  connect(output, &OutputFields::exportRequested, this, &MainWindow::exportEverything);
  connect(output, &OutputFields::programsRequested, this, &MainWindow::exportPrograms);
  connect(output, &OutputFields::pictureRequested, this, &MainWindow::exportPicture);
  for (const BladeFields* fields : {workflow_->bladeFields(), inspector_->bladeFields()})
    connect(fields, &BladeFields::measureRequested, commands_["blade.measure"], &QAction::trigger);
  connect(&bench_, &Workbench::exported, this,
          [this](const QString& folder) { questions_.showFolder(folder); });
  connect(mapBar_, &MapBar::styleEdited, this, &MainWindow::refreshStyle);
  connect(view_, &view::SceneView::picked, this, &MainWindow::onPicked);
  connect(view_, &view::SceneView::hovered, this, &MainWindow::onHovered);
  // By the picture, not by the camera: a view that glides becomes parallel at the end of its way.
  connect(view_, &QOpenGLWidget::frameSwapped, this,
          [this] { commands_["view.parallel"]->setChecked(view_->parallel()); });
  connect(view_, &view::SceneView::faceClicked, faces_, &FaceChooser::click);
  connect(faces_, &FaceChooser::changed, this, &MainWindow::refreshStyle);
  connect(handles_, &SurfaceHandles::changed, this, &MainWindow::refreshStyle);
  connect(handles_, &SurfaceHandles::chosenChanged, this, &MainWindow::refreshHandleCommands);
  // A curve that is chosen in the tree has its handles chosen, and the other way round.
  const auto showCurve = [this] {
    const std::optional<DesignedSurface>& surface = bench_.source().surface;
    const std::optional<int> curve = surface ? curveOf(*surface, handles_->chosen()) : std::nullopt;
    // Numbers of a result are watched while something is pulled, those of a block are not.
    if (curve && bench_.selection().kind == Selection::Kind::block)
      bench_.select({Selection::Kind::surface, -1});
    tree_->showCurve(curve);
    inspector_->showCurve(curve);
  };
  connect(handles_, &SurfaceHandles::chosenChanged, tree_, showCurve);
  connect(tree_, &ObjectTree::curveChosen, handles_, [this, showCurve](const std::optional<int>& curve) {
    const std::optional<DesignedSurface>& surface = bench_.source().surface;
    handles_->choose(surface && curve ? handlesOf(*surface, *curve) : std::vector<int>());
    showCurve();  // of those that were chosen already, too
  });
  connect(blockHandles_, &BlockHandles::changed, this, &MainWindow::refreshStyle);
  const auto tell = [this](const QString& why) { statusBar()->showMessage(why, kToldFor); };
  connect(handles_, &SurfaceHandles::told, this, tell);
  connect(blockHandles_, &BlockHandles::told, this, tell);
  connect(keys_, &HandleKeys::menuRequested, this, [this](const QPoint& place) {
    refreshHandleCommands();
    handleMenu_->popup(place);
  });
  // The section shows what of the picture's handles lies in its plane.
  section_->setGrips([this](const Frame& plane, double reach) {
    SectionGrips grips =
        gripsIn(view_->sceneStyle().handles, handles_->count(), handles_->way(), plane, reach);
    for (const Snap& snap : handles_->snapped()) {
      const Eigen::Vector3d at = plane.toLocal(handles_->placeOf(handles_->pulled()));
      if (std::abs(at.z()) <= reach)
        grips.meetings.push_back(
            {at.head<2>(), plane.toLocal(snap.line[0]).head<2>(), plane.toLocal(snap.line[1]).head<2>()});
    }
    return grips;
  });
  connect(section_, &SectionView::gripPressed, handles_, &SurfaceHandles::grab);
  connect(
      section_, &SectionView::gripMoved, handles_,
      qOverload<const Frame&, const Eigen::Vector2d&, double, Qt::KeyboardModifiers>(&SurfaceHandles::drag));
  connect(section_, &SectionView::gripReleased, handles_, &SurfaceHandles::drop);
  connect(handles_, &SurfaceHandles::changed, section_, qOverload<>(&QWidget::update));
  connect(faces_, &FaceChooser::choosingChanged, this, [this](bool choosing) {
    commands_["input.chooseFaces"]->setChecked(choosing);
    refreshState();
    view_->fitWork();
  });
  connect(view_, &view::SceneView::legendActivated, mapBar_, &MapBar::editRange);
  connect(beside_, &BesideView::legendActivated, mapBar_, &MapBar::editRange);
  connect(view_, &QOpenGLWidget::frameSwapped, this, [this] {
    if (!awaitingFrame_) return;
    awaitingFrame_ = false;
    pictureDelay_ = double(editClock_.nsecsElapsed()) * 1e-9;
    emit pictureStands();
  });
  connect(&messages_->list(), &MessageList::counted, this, [this](int errors, int warnings) {
    constexpr int kMost = 99;  // the bar has no room for more digits on a small screen
    const int loud = std::min(kMost, errors + warnings);
    tabs_->setTabText(tabs_->indexOf(messages_), loud ? tr("Messages %1").arg(loud) : tr("Messages"));
    if (std::exchange(errors_, errors) != errors) refreshSummary();
  });
}

void MainWindow::makeStatusBar() {
  QStatusBar* bar = statusBar();
  bar->setSizeGripEnabled(false);
  const auto label = [&](const QString& name) {
    auto* l = new QLabel(bar);
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
  summary_ = new SummaryLine(bar);
  summary_->setAccessibleName(tr("Summary of the result"));
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
  bar->setMinimumHeight(28);
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

void MainWindow::refreshState() {
  if (!bench_.runner().busy()) runOrder();
  const bool busy = bench_.runner().busy();
  view_->setAwaiting(busy);
  if (bench_.stale()) {
    if (!staleShown_ && !staleTimer_.isActive()) staleTimer_.start();
  } else {
    staleTimer_.stop();
    if (std::exchange(staleShown_, false)) refreshStyle();
  }
  if (busy && !progress_->isVisible() && !busyTimer_.isActive() && sender() != &busyTimer_)
    busyTimer_.start();
  if (!busy) busyTimer_.stop();
  const bool shown = busy && !busyTimer_.isActive();
  QString word = bench_.runner().step();
  if (!word.isEmpty()) word[0] = word[0].toUpper();
  jobName_->setText(word.isEmpty() ? tr("Computing") : word);
  // A bar that takes a value draws the whole window at once, with texts that are not laid out yet.
  progress_->setUpdatesEnabled(false);
  progress_->setValue(int(1000 * bench_.runner().progress()));
  progress_->setUpdatesEnabled(true);
  for (QWidget* widget :
       {static_cast<QWidget*>(jobName_), static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_)})
    widget->setVisible(shown);

  const bool open = stack_->currentWidget() == columns_;
  commands_["file.export"]->setEnabled(open && bench_.canExport());
  commands_["file.export"]->setText(bench_.wanted() == pipeline::Wanted() ? tr("&Export everything…")
                                                                          : tr("&Export what is chosen…"));
  commands_["file.programs"]->setEnabled(open && bench_.canExportPrograms());
  for (const char* id : {"file.save", "file.saveAs", "file.close", "edit.compute"})
    commands_[id]->setEnabled(!bench_.document().empty());
  commands_["file.replace"]->setEnabled(!bench_.document().empty());
  commands_["file.reload"]->setEnabled(bench_.canReload());
  commands_["file.locate"]->setEnabled(bench_.sourceMissing());
  commands_["blade.measure"]->setEnabled(!onMeasurePage());
  for (const char* id : {"design.keys", "design.adopt", "design.moulds"})
    commands_[id]->setEnabled(open && bench_.current() && bench_.sweep());
  for (const char* id :
       {"file.picture", "view.fit",        "view.fitSelection", "view.parallel", "view.isolines",
        "view.shadows", "view.section",    "view.iso",          "view.top",      "view.bottom",
        "view.front",   "view.back",       "view.left",         "view.right",    "panel.workflow",
        "panel.bottom", "panel.inspector", "tab.section",       "tab.motion",    "tab.messages",
        "tab.blocks"})
    commands_[id]->setEnabled(open);
  for (const char* id :
       {"motion.play", "motion.start", "motion.end", "station.next", "station.previous", "station.none"})
    commands_[id]->setEnabled(open && bench_.sweep());
  commands_["view.sectionFlip"]->setEnabled(open && sectioned_);
  commands_["edit.cancel"]->setEnabled(busy || faces_->choosing() || view_->holding());
  commands_["view.handles"]->setEnabled(open);
  refreshHandleCommands();
  refreshComparison();
  commands_["input.chooseFaces"]->setEnabled(open && faces_->possible());
  workflow_->inputFields()->faces().showChoosing(faces_->choosing(), faces_->possible());
  refreshSummary();
}

namespace {

/// What the summary is of, where a design has several cuts: "column-2: ". One of a block goes by its block.
QString whoseSummary(const Workbench& bench) {
  const auto shown = bench.shown();
  const pipeline::CutEvaluation* cut = bench.shownCut();
  if (!shown || !cut) return {};
  for (const pipeline::BlockEvaluation& block : shown->blocks) {
    if (std::ranges::find(block.cuts, cut->id, &pipeline::CutEvaluation::id) == block.cuts.end()) continue;
    if (block.cuts.size() > 1) return QString::fromStdString(cut->id) + ": ";
    if (shown->blocks.size() > 1) return QString::fromStdString(block.id) + ": ";
  }
  return {};
}

}  // namespace

void MainWindow::summarise(const pipeline::CutSketch& sketch) {
  const RowSketch& look = *sketch.look;
  const Blade& blade = sketch.sweep->request.blade;
  const auto stations = [&](const auto& holds) { return int(std::ranges::count_if(look.rest, holds)); };
  const int lost = stations([](Rest rest) { return rest == Rest::lost; });
  const int unknown = stations([](Rest rest) { return rest == Rest::unknown; });
  const auto crossing = int(std::ranges::count_if(look.crosses, [](char crosses) { return crosses != 0; }));
  const QString radius = radiusText(look.minRadius);
  std::vector<SummaryLine::Part> parts = {
      {tr("Unit mm")},
      {whoseSummary(bench_) + tr("deviation at stations ≤ %1").arg(lengthText(look.deviationMax)), 4,
       look.deviationMax > bench_.design().process.tolerance},
      {radius.endsWith("mm") ? tr("radius ≥ %1").arg(radius) : tr("straight blade"), 2,
       look.minRadius > 0 && look.minRadius < blade.minRadius()}};
  if (crossing > 0) parts.push_back({tr("%1 crossed").arg(crossing), 3, true});
  if (lost > 0) parts.push_back({tr("%1 lost").arg(lost), 3, true});
  if (unknown > 0) parts.push_back({tr("%1 not known").arg(unknown), 3});
  if (look.nearBottom)
    parts.push_back({tr("%1 above the bottom").arg(lengthText(look.aboveBottom)), 3, true});
  if (look.nearBlock)
    parts.push_back({(look.clearance < 0 ? tr("a grip %1 inside the block") : tr("a grip %1 from the block"))
                         .arg(lengthText(std::abs(look.clearance))),
                     3, true});
  if (lost + unknown + crossing == 0) parts.push_back({tr("all rest"), 3});
  summary_->setParts(parts, false);
}

void MainWindow::refreshSummary() {
  const bool picture = stack_->currentWidget() == columns_;
  const auto result = picture ? bench_.sweep() : std::nullopt;
  // What the numbers hold or break is not all that may be wrong.
  const SummaryLine::Part errors{errors_ == 1 ? tr("1 error") : tr("%1 errors").arg(errors_), 5, true};
  if (!result) {
    std::vector<SummaryLine::Part> parts;
    if (!onStartPage()) parts.push_back({tr("Unit mm")});
    if (picture && errors_ > 0) parts.push_back(errors);
    return summary_->setParts(parts, false);
  }
  if (const pipeline::CutSketch* sketch = bench_.sketchedCut()) return summarise(*sketch);
  const SweepSummary& s = result->analysis.summary;
  double slowest = bench_.shown()->design.process.cuttingSpeed;
  const double fastest = slowest;
  if (const Field* speed = result->analysis.cut.field("speed"))
    for (const double value : speed->values)
      if (value < slowest) slowest = value;
  const QString low = QString::fromStdString(shortText(slowest, 3)), high = speedText(fastest);
  const QString speeds = high.startsWith(low + " ") ? high : tr("%1 to %2").arg(low, high);
  const QString radius = radiusText(s.minRadius);
  const QString bend = radius.endsWith("mm") ? tr("radius ≥ %1").arg(radius) : tr("straight blade");
  const SweepLimits broken = brokenLimits(*result, bench_.shown()->design);
  std::vector<SummaryLine::Part> parts = {
      {tr("Unit mm")},
      {whoseSummary(bench_) +
           tr("deviation ≤ %1").arg(lengthText(std::max(s.deviationMax, result->between.deviationMax))),
       4, broken.deviation || broken.between},
      {(broken.between ? tr("%1 of the surface shown within tolerance") : tr("%1 within tolerance"))
           .arg(percentText(s.withinTolerance)),
       3, broken.deviation || broken.between},
      {tr("%1 covered").arg(percentText(result->coverage.share())), 3, broken.coverage},
      {speeds, 1, broken.speed},
      {bend, 2, broken.radius}};
  if (errors_ > 0) parts.push_back(errors);
  summary_->setParts(parts, staleShown_);
}

}  // namespace bw::app
