// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/beside_view.h"

#include <QPainter>
#include <QTimer>

#include <algorithm>

#include "bw/core/text/printable.h"
#include "bw/pipeline/scene_content.h"
#include "controls/theme.h"

namespace bw::app {

namespace {

using scene::Kind;

constexpr int kLegendWidth = 236;   ///< of the widest legend, with air; too narrow for an orientation cube
constexpr int kLeastPicture = 240;  ///< that the legend leaves each of the two

/// A name that is shortened to the width there is.
class Head : public QLabel {
 public:
  using QLabel::QLabel;

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    const QRect room = contentsRect();
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(text(), Qt::ElideRight, room.width()));
  }
};

QLabel* makeHead(QWidget* parent) {
  auto* label = new Head(parent);
  label->setFont(Theme::secondaryFont());
  label->setObjectName("panel");
  label->setContentsMargins(kGap, 3, kGap, 3);
  // However long a name is, it takes no width from the pictures.
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  label->hide();
  return label;
}

/// The target alone, in its block.
scene::Content targetOf(const scene::Content& content) {
  scene::Content target = content;
  for (const Kind kind : {Kind::cut, Kind::station, Kind::blade, Kind::part, Kind::crease, Kind::face,
                          Kind::travel, Kind::told})
    target.remove(kind);
  return target;
}

/// What the legend is of.
scene::Content cutsOf(const scene::Content& content) {
  scene::Content cuts;
  for (const scene::Item& item : content.items)
    if (item.kind() == Kind::cut || item.kind() == Kind::crease) cuts.items.push_back(item);
  return cuts;
}

}  // namespace

BesideView::BesideView(const Comparison& comparison, view::SceneView& present, QWidget* parent)
    : QWidget(parent), comparison_(comparison), present_(present), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(0);
  then_ = makeHead(this);
  now_ = makeHead(this);
  line_ = new QFrame(this);
  line_->setObjectName("vline");
  line_->hide();
  grid_->addWidget(then_, 0, 0);
  grid_->addWidget(now_, 0, 2, 1, 2);
  grid_->addWidget(line_, 0, 1, 2, 1);
  grid_->addWidget(&present, 1, 2);
  grid_->setRowStretch(1, 1);
  grid_->setColumnStretch(2, 1);
  connect(&present, &view::SceneView::cameraChanged, this, &BesideView::follow);
}

void BesideView::makeOther() {
  other_ = new view::SceneView(this);
  other_->setAccessibleName(tr("3D view of what is compared"));
  other_->setNavigation(navigation_);
  grid_->addWidget(other_, 1, 0);
  connect(other_, &view::SceneView::cameraChanged, this, [this] {
    if (following_) return;
    following_ = true;
    present_.setCamera(other_->camera());
    following_ = false;
  });
  connect(other_, &view::SceneView::hovered, this, &BesideView::hovered);
  legend_ = new view::SceneView(this);
  legend_->setAccessibleName(tr("Legend of both pictures"));
  legend_->setFocusPolicy(Qt::NoFocus);
  legend_->setFixedWidth(kLegendWidth);
  legend_->hide();
  grid_->addWidget(legend_, 1, 3);
  connect(legend_, &view::SceneView::legendActivated, this, &BesideView::legendActivated);
}

void BesideView::placeLegend() {
  if (!legend_) return;
  const bool has = compared() && style_.legend && present_.legendRange();
  const bool room = width() >= 2 * kLeastPicture + kLegendWidth;
  legend_->setVisible(has && room);
  if (!has || !room) return;
  scene::Style legend = present_.sceneStyle();
  legend.legend = true;
  legend.showGrid = legend.isolines = false;
  // What is seen gives the numbers, though nothing of it is drawn here.
  legend[Kind::cut].opacity = 0;
  legend.selected = {};
  legend.playhead = -1;
  legend.movingBlade.clear();
  legend.section.reset();
  legend.marker.reset();
  legend.handles = {};
  legend.chooseFaces = false;
  legend_->setStyle(legend);
}

void BesideView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  placeLegend();
}

QImage BesideView::picture(const QSize& pixels, double pixelRatio) {
  const scene::Style shown = present_.sceneStyle();
  if (shown.legend == style_.legend) return present_.picture(pixels, pixelRatio);
  scene::Style whole = shown;
  whole.legend = style_.legend;
  present_.setStyle(whole);
  QImage image = present_.picture(pixels, pixelRatio);
  present_.setStyle(shown);
  return image;
}

void BesideView::follow() {
  if (following_ || !other_ || !compared()) return;
  following_ = true;
  other_->setCamera(present_.camera());
  following_ = false;
}

void BesideView::setNavigation(view::Navigation navigation) {
  navigation_ = navigation;
  if (other_) other_->setNavigation(navigation);
}

void BesideView::refreshNames() {
  const Beside& beside = comparison_.beside();
  QString then, now = tr("Now");
  switch (beside.what) {
    case Beside::What::nothing:
      break;
    case Beside::What::target:
      then = tr("Target");
      now = tr("Cut");
      break;
    case Beside::What::before:
      then = tr("Before the last change");
      break;
    case Beside::What::version:
      then = QString::fromStdString(printable(beside.version));
      break;
  }
  const QString state = comparison_.busy()    ? tr("%1: computing")
                        : comparison_.error() ? tr("%1: without a result")
                                              : QStringLiteral("%1");
  then_->setText(state.arg(then));
  then_->setToolTip(comparison_.error() ? QString::fromStdString(printable(comparison_.error()->message))
                                        : then);
  now_->setText(now);
  for (QWidget* widget : std::initializer_list<QWidget*>{then_, now_, line_}) widget->setVisible(compared());
}

void BesideView::refresh() {
  if (compared() && !other_) makeOther();
  refreshNames();
  grid_->setColumnStretch(0, compared() ? 1 : 0);
  ranged_.reset();
  if (!other_) return;
  following_ = true;
  if (comparison_.beside().what == Beside::What::target)
    other_->setContent(targetOf(present_.content()));
  else if (const auto& evaluation = comparison_.evaluation())
    other_->setContent(pipeline::sceneContent(*evaluation));
  else
    other_->setContent({});
  const bool opened = other_->isHidden() == compared();
  other_->setVisible(compared());
  other_->setCamera(present_.camera());
  following_ = false;
  legend_->setContent(compared() ? cutsOf(present_.content()) : scene::Content());
  placeLegend();
  // Once both have their new widths.
  if (opened) QTimer::singleShot(0, &present_, [this] { present_.fitWork(false); });
}

void BesideView::setContent(const scene::Content& content) {
  present_.setContent(content);
  if (legend_ && compared()) legend_->setContent(cutsOf(content));
  followContent();
}

void BesideView::replace(scene::Content content) {
  if (legend_ && compared()) legend_->replace(cutsOf(content));
  present_.replace(std::move(content));
  followContent();
}

void BesideView::followContent() {
  ranged_.reset();
  if (comparison_.beside().what != Beside::What::target || !other_) return;
  following_ = true;
  other_->setContent(targetOf(present_.content()));
  other_->setCamera(present_.camera());
  following_ = false;
}

std::optional<std::pair<double, double>> BesideView::rangeOfBoth(const scene::Style& style,
                                                                 const scene::Style& other) {
  if (style.rangeMin || style.rangeMax) return std::nullopt;
  const Ranged now = {style[Kind::cut].map, style.tolerance, style.items.size()};
  if (ranged_ == now) return range_;
  ranged_ = now;
  present_.setStyle(style);
  other_->setStyle(other);
  const auto a = present_.legendRange(), b = other_->legendRange();
  range_ = a && b ? std::optional(std::pair(std::min(a->first, b->first), std::max(a->second, b->second)))
                  : std::nullopt;
  return range_;
}

void BesideView::setStyle(const scene::Style& style) {
  style_ = style;
  if (!other_ || !compared()) return present_.setStyle(style);
  const Beside::What what = comparison_.beside().what;
  scene::Style now = style, then = style;
  then.items.clear();
  then[Kind::crease].opacity = 1;  // no hand moves it
  then.legend = false;
  then.selected = {};
  then.playhead = -1;
  then.movingBlade.clear();
  then.marker.reset();
  then.handles = {};
  then.chooseFaces = false;
  then.stale = comparison_.busy();
  if (what == Beside::What::target) {
    then.stale = style.stale;
    then[Kind::target] = {true, 1, "none"};
    now[Kind::target].visible = false;
  } else if (const auto range = rangeOfBoth(now, then)) {
    now.rangeMin = then.rangeMin = range->first;
    now.rangeMax = then.rangeMax = range->second;
  }
  now.legend = false;
  present_.setStyle(now);
  other_->setStyle(then);
  placeLegend();
}

}  // namespace bw::app
