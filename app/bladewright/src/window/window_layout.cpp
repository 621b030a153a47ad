// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The widgets of the workspace, and how they talk to each other.
#include <QStatusBar>

#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr int kFactorWidth = 66;

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
  layout->addWidget(view_, 1);
  faces_ = new FaceChooser(bench_, theme_, view_);
  middle_->addWidget(picture);
  tabs_ = new QTabWidget(middle_);
  tabs_->setDocumentMode(true);
  section_ = new SectionView(bench_, theme_, tabs_);
  motion_ = new MotionView(bench_, theme_, tabs_);
  messages_ = new MessagePanel(bench_, theme_, tabs_);
  tabs_->addTab(section_, tr("Section"));
  tabs_->addTab(motion_, tr("Motion"));
  tabs_->addTab(messages_, tr("Messages"));
  auto* corner = new QFrame(tabs_);
  corner->setObjectName("panel");
  auto* cornerContent = new QWidget(corner);
  auto* cornerOuter = makeBox<QHBoxLayout>(corner);
  cornerOuter->addWidget(cornerContent);
  auto* cornerLayout = makeBox<QHBoxLayout>(cornerContent, {0, 2, 12, 2}, kGap);
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
  // The corner itself stays, or its place would change colour.
  QSizePolicy keeping = cornerContent->sizePolicy();
  keeping.setRetainSizeWhenHidden(true);
  cornerContent->setSizePolicy(keeping);
  connect(tabs_, &QTabWidget::currentChanged, cornerContent,
          [this, cornerContent] { cornerContent->setVisible(tabs_->currentWidget() == section_); });
  middle_->addWidget(tabs_);
  middle_->setStretchFactor(0, 1);
  columns_->addWidget(middle_);

  inspector_ = new Inspector(bench_, theme_, columns_);
  columns_->addWidget(inspector_);
  columns_->setStretchFactor(1, 1);
  stack_->addWidget(columns_);
  setKeyboardHome(*columns_, *view_);

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
  connect(faces_, &FaceChooser::choosingChanged, this, [this](bool choosing) {
    commands_["input.chooseFaces"]->setChecked(choosing);
    refreshState();
    view_->fitWork();
  });
  connect(view_, &view::SceneView::legendActivated, mapBar_, &MapBar::editRange);
  connect(view_, &QOpenGLWidget::frameSwapped, this, [this] {
    if (!awaitingFrame_) return;
    awaitingFrame_ = false;
    pictureDelay_ = double(editClock_.nsecsElapsed()) * 1e-9;
    emit pictureStands();
  });
  connect(&messages_->list(), &MessageList::counted, this, [this](int errors, int warnings) {
    const int loud = errors + warnings;
    tabs_->setTabText(tabs_->indexOf(messages_), loud ? tr("Messages (%1)").arg(loud) : tr("Messages"));
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

}  // namespace bw::app
