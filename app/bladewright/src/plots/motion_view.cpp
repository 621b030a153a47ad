// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "plots/motion_view.h"

#include <QHBoxLayout>

#include <algorithm>
#include <cmath>

#include "controls/flow_layout.h"

namespace bw::app {

namespace {

constexpr int kFrameInterval = 16;  // ms
constexpr std::array<double, 4> kPaces = {1, 4, 10, 30};

}  // namespace

MotionView::MotionView(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme), timeline_(new Timeline(bench, theme, this)) {
  setObjectName("panel");
  setAttribute(Qt::WA_StyledBackground);
  auto* layout = makeBox<QVBoxLayout>(this, {0, 4, 0, 0}, 4);
  auto* controls = new QWidget(this);
  auto* rows = new FlowLayout(controls);
  rows->setContentsMargins(8, 0, 12, 0);
  rows->setSpacing(kGap);
  QHBoxLayout* bar = nullptr;
  const auto addGroup = [&] {
    auto* group = new QWidget(controls);
    bar = makeBox<QHBoxLayout>(group, {}, 2);
    rows->addWidget(group);
  };
  addGroup();
  const auto button = [&](const char* icon, const QString& tip, const std::function<void()>& press) {
    auto* b = new QToolButton(this);
    b->setProperty("iconName", QString(icon));
    b->setToolTip(tip);
    b->setAccessibleName(tip);
    connect(b, &QToolButton::clicked, this, press);
    bar->addWidget(b);
    buttons_ << b;
    return b;
  };
  button("to-start", tr("To the start"), [this] { goTo(0); });
  button("step-back", tr("Station before"), [this] { stepStation(-1); });
  play_ = button("play", tr("Play or pause (Space)"), [this] { togglePlay(); });
  button("step-forward", tr("Next station"), [this] { stepStation(1); });
  button("to-end", tr("To the end"), [this] { goTo(bench_.playEnd()); });
  bar->addSpacing(kGap);
  clock_ = new QLabel(this);
  clock_->setMinimumWidth(130);
  bar->addWidget(clock_);
  addGroup();
  blade_ = new QCheckBox(tr("Show the blade"), this);
  blade_->setToolTip(tr("The moving blade in the picture"));
  connect(blade_, &QCheckBox::clicked, &bench, &Workbench::setMoving);
  bar->addWidget(blade_);
  bar->addSpacing(kGroupGap);
  auto* paceLabel = new QLabel(tr("Pace"), this);
  bar->addWidget(paceLabel);
  bar->addSpacing(4);
  pace_ = new ChoiceField(this);
  pace_->setMinimumWidth(72);
  pace_->setMinimumContentsLength(3);
  for (double pace : kPaces) pace_->addItem(QStringLiteral("%1×").arg(pace));
  pace_->setCurrentIndex(2);
  pace_->setToolTip(tr("Times faster than the cut"));
  pace_->setAccessibleName(tr("Pace"));
  paceLabel->setBuddy(pace_);
  bar->addWidget(pace_);
  layout->addWidget(controls);
  layout->addWidget(timeline_, 1);

  timer_.setInterval(kFrameInterval);
  connect(&timer_, &QTimer::timeout, this, &MotionView::tick);
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (change.any(Aspect::playTime | Aspect::motion, bench_.selection())) refresh();
  });
  connect(&theme, &Theme::changed, this, &MotionView::refresh);
  refresh();
}

void MotionView::togglePlay() {
  if (timer_.isActive()) {
    timer_.stop();
  } else if (bench_.playEnd() > 0) {
    if (bench_.playTime() >= bench_.playEnd()) bench_.setPlayTime(0);
    bench_.setMoving(true);
    elapsed_.start();
    timer_.start();
  }
  refresh();
}

void MotionView::tick() {
  const double seconds =
      double(elapsed_.restart()) / 1000 * kPaces[std::size_t(std::max(0, pace_->currentIndex()))];
  bench_.setPlayTime(bench_.playTime() + seconds);
  if (bench_.playTime() >= bench_.playEnd()) timer_.stop();
  refresh();
}

void MotionView::stepStation(int by) {
  const auto result = bench_.sweep();
  if (!result) return;
  const double at = bench_.stationAt(bench_.playTime());
  const int from = by > 0 ? int(std::floor(at + 1e-6)) : int(std::ceil(at - 1e-6));
  goTo(bench_.timeOfStation(std::clamp(from + by, 0, int(result->sweep.poses.size()) - 1)));
}

void MotionView::goTo(double seconds) {
  bench_.setMoving(true);
  bench_.setPlayTime(seconds);
}

void MotionView::refresh() {
  const bool there = bench_.playEnd() > 0;
  if (!there) timer_.stop();
  for (QToolButton* b : buttons_) {
    const QString icon =
        b == play_ && playing() ? QStringLiteral("pause") : b->property("iconName").toString();
    if (b->property("shownIcon").toString() != icon + (theme_.dark() ? "d" : "l")) {
      b->setProperty("shownIcon", icon + (theme_.dark() ? "d" : "l"));
      b->setIcon(theme_.icon(icon));
    }
    b->setEnabled(there);
  }
  blade_->setChecked(bench_.moving());
  blade_->setEnabled(there);
  pace_->setEnabled(there);
  clock_->setText(there
                      ? QStringLiteral("%1 / %2").arg(timeText(bench_.playTime()), timeText(bench_.playEnd()))
                      : QString());
}

}  // namespace bw::app
