// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "blocks/block_panel.h"

#include <QScrollBar>

#include <algorithm>

namespace bw::app {

namespace {

constexpr int kBeside = 700;        // px: in a narrower panel the parts stand below each other
constexpr int kDetailsWidth = 408;  // px, at least, of what stands beside the plan
constexpr int kNumbersWidth = 264;  // px
constexpr int kLeastHeight = 60;    // px, of the same
constexpr int kStandingIcon = 16;

}  // namespace

BlockPanel::BlockPanel(Workbench& bench, const Theme& theme, QWidget* parent)
    : QScrollArea(parent), bench_(bench), theme_(theme) {
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  auto* page = new QWidget;
  page->setObjectName("page");
  parts_ = makeBox<QHBoxLayout>(page, {kGroupGap, kGap, kGroupGap, kGap}, kGroupGap);

  auto* seen = new QWidget(page);
  auto* column = makeBox<QVBoxLayout>(seen, {}, 4);
  plan_ = new BlockPlan(bench, theme, seen);
  layer_ = new ChoiceField(seen);
  layer_->setAccessibleName(tr("Layer"));
  layer_->setToolTip(
      tr("The layer of blocks that the plan shows, counted from the ground (Page Up, Page Down)"));
  connect(layer_, &QComboBox::activated, plan_, &BlockPlan::setLayer);
  connect(plan_, &BlockPlan::layersChanged, this, &BlockPanel::refreshLayers);
  column->addWidget(layer_, 0, Qt::AlignLeft);
  column->addWidget(plan_, 1);
  parts_->addWidget(seen, 1);

  auto* details = new QWidget;
  details->setObjectName("page");
  auto* below = makeBox<QVBoxLayout>(details, {}, kGap);
  auto* head = makeBox<QHBoxLayout>(nullptr, {}, kGap);
  title_ = new QLabel(details);
  QFont bold = Theme::bodyFont();
  bold.setWeight(QFont::DemiBold);
  title_->setFont(bold);
  icon_ = new QLabel(details);
  state_ = new QLabel(details);
  state_->setAccessibleName(tr("State of the block"));
  for (QLabel* label : {title_, icon_, state_}) head->addWidget(label);
  head->addStretch();
  below->addLayout(head);
  cuts_ = new BlockCuts(bench, details);
  below->addWidget(cuts_);
  auto* form = new FormColumn(details);
  form->setFixedWidth(kNumbersWidth);
  numbers_ = new GridFields(bench, form, this);
  below->addWidget(form);
  below->addStretch();
  details_ = new QScrollArea(page);
  details_->setWidgetResizable(true);
  details_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  details_->setFrameShape(QFrame::NoFrame);
  details_->setFocusPolicy(Qt::NoFocus);
  details_->setWidget(details);
  details->installEventFilter(this);
  parts_->addWidget(details_);
  setWidget(page);

  connect(&bench, &Workbench::changed, this, &BlockPanel::follow);
  connect(&theme, &Theme::changed, this, &BlockPanel::refreshState);
  refreshLayers();
  refreshState();
}

void BlockPanel::follow(const Change& change) {
  const bool design = change.any(Aspect::design | Aspect::block), chosen = change.any(Aspect::selection);
  if (design) numbers_->refresh();
  // Heights tell the order of cuts.
  if (design || chosen || change.any(Aspect::result)) cuts_->refresh();
  // What nobody sees waits.
  if (!isVisible() || !(design || chosen || change.any(Aspect::state | Aspect::result | Aspect::sketch)))
    return;
  plan_->refresh();
  refreshState();
}

void BlockPanel::showEvent(QShowEvent* event) {
  QScrollArea::showEvent(event);
  plan_->refresh();
  refreshState();
}

void BlockPanel::refreshLayers() {
  if (layer_->count() != plan_->layers()) {
    layer_->clear();
    for (int i = 1; i <= plan_->layers(); ++i)
      layer_->addItem(tr("Layer %1 of %2").arg(i).arg(plan_->layers()));
  }
  layer_->show(plan_->layer());
  layer_->setVisible(plan_->layers() > 1);
}

void BlockPanel::refreshState() {
  const std::string& block = bench_.selection().block;
  const BlockStanding standing = standingOf(bench_, block);
  title_->setText(QString::fromStdString(block));
  const QColor colour = theme_.colours().*standing.colour;
  icon_->setPixmap(Theme::pixmap(standing.icon, colour, kStandingIcon, devicePixelRatioF()));
  state_->setText(plan_->wordOf(block));
  for (QLabel* label : {icon_, state_}) label->setToolTip(standing.tip);
}

void BlockPanel::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  // Once the areas have taken their sizes.
  QMetaObject::invokeMethod(this, &BlockPanel::arrange, Qt::QueuedConnection);
}

bool BlockPanel::eventFilter(QObject* watched, QEvent* event) {
  if (watched == details_->widget() && event->type() == QEvent::LayoutRequest)
    QMetaObject::invokeMethod(this, &BlockPanel::arrange, Qt::QueuedConnection);
  return QScrollArea::eventFilter(watched, event);
}

void BlockPanel::arrange() {
  const bool beside = viewport()->width() >= kBeside;
  parts_->setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  parts_->setContentsMargins(beside ? kGroupGap : kGap, kGap, beside ? kGroupGap : kGap, kGap);
  // Below the plan they are scrolled with it, beside it alone.
  QWidget& details = *details_->widget();
  const int bar = details_->verticalScrollBar()->sizeHint().width();
  const int room = viewport()->width() - plan_->minimumSizeHint().width() - 3 * kGroupGap - bar;
  cuts_->setNarrow(!beside || cuts_->wideWidth() > room);
  details_->setMinimumWidth(beside ? std::max(kDetailsWidth, details.minimumSizeHint().width() + bar) : 0);
  details_->setMinimumHeight(beside ? kLeastHeight : details.minimumSizeHint().height());
}

}  // namespace bw::app
