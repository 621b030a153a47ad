// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/workflow_panel.h"

#include <QEvent>
#include <QPainter>
#include <QScrollBar>
#include <QTimer>

#include "controls/fields.h"

namespace bw::app {

using Kind = model::StepState::Kind;

namespace {

/// The icon and the colour that stand for a state, in the order of the kinds.
constexpr std::pair<const char*, QColor Colours::*> kSigns[] = {
    {"idle", &Colours::secondary},    {"done", &Colours::success},    {"stale", &Colours::secondary},
    {"running", &Colours::selection}, {"warning", &Colours::warning}, {"error", &Colours::error}};
constexpr int kTitleX = kGap + 14 + 6 + 20 + kGap;  // after the chevron and the icon

constexpr int kLeastWidth = 304;

}  // namespace

StepHead::StepHead(const Theme& theme, const QString& icon, const QString& title, QWidget* parent)
    : QAbstractButton(parent), theme_(theme), icon_(icon) {
  setText(title);
  setAccessibleName(title);
  setCheckable(true);
  setChecked(true);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  connect(&theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void StepHead::setState(const model::StepState& state) {
  state_ = state;
  setAccessibleDescription(state.text);
  setToolTip(state.text.isEmpty() ? QString() : text() + ": " + state.text);
  update();
}

QSize StepHead::sizeHint() const { return {200, QFontMetrics(Theme::titleFont()).height() + 2 * 9}; }

int StepHead::textWidth() const {
  return kTitleX + QFontMetrics(Theme::titleFont()).horizontalAdvance(text()) + kGroupGap +
         QFontMetrics(Theme::secondaryFont()).horizontalAdvance(state_.text) + 6 + 16 + kGroupGap;
}

bool StepHead::event(QEvent* event) {
  if (event->type() == QEvent::Enter || event->type() == QEvent::Leave) update();
  return QAbstractButton::event(event);
}

void StepHead::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  const qreal ratio = devicePixelRatioF();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (underMouse()) {
    QColor hover = c.text;
    hover.setAlphaF(0.05f);
    painter.fillRect(rect(), hover);
  }
  if (hasFocus()) {
    painter.setPen(c.selection);
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
  const int middle = height() / 2;
  int x = kGap;
  painter.drawPixmap(x, middle - 7,
                     theme_.pixmap(isChecked() ? "chevron-down" : "chevron-right", c.secondary, 14, ratio));
  x += 14 + 6;
  painter.drawPixmap(x, middle - 10, theme_.pixmap(icon_, c.text, 20, ratio));
  x = kTitleX;

  const QFont title = Theme::titleFont();
  painter.setFont(title);
  painter.setPen(c.text);
  const int titleWidth = QFontMetrics(title).horizontalAdvance(text());
  painter.drawText(QRect(x, 0, titleWidth + 4, height()), Qt::AlignLeft | Qt::AlignVCenter, text());
  x += titleWidth + kGroupGap;

  const auto [icon, member] = kSigns[std::size_t(state_.kind)];
  const QColor colour = c.*member;
  int right = width() - kGroupGap;
  painter.drawPixmap(right - 16, middle - 8, theme_.pixmap(icon, colour, 16, ratio));
  right -= 16 + 6;
  const QFont small = Theme::secondaryFont();
  painter.setFont(small);
  const bool loud = state_.kind == Kind::warning || state_.kind == Kind::error;
  painter.setPen(loud ? colour : c.secondary);
  const QString words = QFontMetrics(small).elidedText(state_.text, Qt::ElideRight, right - x);
  painter.drawText(QRect(x, 0, right - x, height()), Qt::AlignRight | Qt::AlignVCenter, words);

  if (state_.kind == Kind::running) {
    painter.fillRect(QRectF(0, height() - 2, width(), 2), c.line);
    painter.fillRect(QRectF(0, height() - 2, width() * state_.progress, 2), c.selection);
  }
}

StepSection::StepSection(const Theme& theme, const QString& icon, const QString& title, QWidget* body,
                         QWidget* parent)
    : QWidget(parent), head_(new StepHead(theme, icon, title, this)) {
  auto* layout = makeBox<QVBoxLayout>(this, {}, 0);
  layout->addWidget(head_);
  auto* frame = new QWidget(this);
  auto* inner = makeBox<QVBoxLayout>(frame, {kGroupGap, 2, kGroupGap, kGroupGap});
  inner->addWidget(body);
  layout->addWidget(frame);
  makeFolding(*head_, *frame);
}

WorkflowPanel::WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent)
    : SidePanel(kLeastWidth, parent), bench_(bench), theme_(theme) {
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = makeBox<QVBoxLayout>(page, {0, kGap, 0, kGap}, 0);
  const std::array<std::pair<const char*, QString>, model::kStepCount> heads = {
      {{"setup", tr("Setup")}, {"input", tr("Input")}, {"process", tr("Process")}, {"output", tr("Output")}}};
  const std::array<QWidget*, model::kStepCount> bodies = {makeSetup(), makeInput(), makeProcess(),
                                                          makeOutput()};
  variables_ = new VariableFields(bench_, theme_, page);
  layout->addWidget(variables_);
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (i > 0) layout->addWidget(makeLine(page));
    sections_[i] = new StepSection(theme, heads[i].first, heads[i].second, bodies[i], page);
    layout->addWidget(sections_[i]);
  }
  layout->addStretch();
  setWidget(page);
  connect(&bench, &Workbench::changed, this, &WorkflowPanel::follow);
  // Another design begins at the first step, also where lines of the one before are still on their way.
  connect(&bench.document(), &model::Document::replaced, this, [this] {
    verticalScrollBar()->setValue(0);
    QTimer::singleShot(0, this, [this] { verticalScrollBar()->setValue(0); });
  });
  follow({Aspect::design | Aspect::state});
}

QWidget* WorkflowPanel::makeSetup() {
  auto* column = new FormColumn;
  auto* details = new FormColumn;
  cutFields_ = new CutFields(bench_, column, this);
  bladeFields_ = new BladeFields(bench_, column, details, theme_, this);
  column->addFold(tr("Section and material"), theme_)->addWide(details);
  for (const ProcessNumber& number : processNumbers())
    if (number.part == ProcessPart::setup) addProcessLine(numbers_, column, number, this, bench_);
  FormColumn* block = column->addFold(tr("Block"), theme_);
  blockFields_ = new BlockFields(bench_, block, this);
  auto* line = new QWidget;
  auto* layout = makeBox<QHBoxLayout>(line);
  layout->addStretch();
  auto* blocks =
      makeButton(tr("Blocks and cuts…"),
                 tr("The plan of all blocks: how many, how large and how far apart they are, and how "
                    "each lies for its cuts"),
                 this, &WorkflowPanel::blocksRequested);
  blocks->setObjectName("showBlocks");
  layout->addWidget(blocks);
  block->addWide(line);
  return column;
}

QWidget* WorkflowPanel::makeInput() {
  auto* column = new FormColumn;
  input_ = new InputFields(bench_, column, this);
  return column;
}

QWidget* WorkflowPanel::makeProcess() {
  auto* column = new FormColumn;
  process_ = new ProcessFields(bench_, column, theme_, this);
  return column;
}

QWidget* WorkflowPanel::makeOutput() {
  auto* column = new FormColumn;
  output_ = new OutputFields(bench_, column, theme_, this);
  return column;
}

void WorkflowPanel::follow(const Change& change) {
  const auto any = [&](model::Aspects of) { return change.any(of, bench_.selection()); };
  if (any(Aspect::design | Aspect::block)) blockFields_->refresh();
  if (any(Aspect::design | Aspect::selection)) cutFields_->refresh();
  if (any(Aspect::design | Aspect::source | Aspect::target)) input_->refresh();
  // Another target may be that of another cut, which has numbers of its own.
  if (any(Aspect::design | Aspect::target))
    process_->refresh();
  else if (any(Aspect::result))
    process_->refreshStations();
  if (any(Aspect::design)) {
    variables_->refresh();
    bladeFields_->refresh();
    numbers_.refresh(bench_.design().process);
    output_->refresh();
  } else if (any(Aspect::thoughts | Aspect::poses)) {
    bladeFields_->refreshLengths();
    process_->refreshMargins();
  }
  if (any(Aspect::state | Aspect::progress)) refreshStates();
  if (any(Aspect::state)) {
    input_->refreshState();
    bladeFields_->refreshLengths();
  }
  if (any(Aspect::state | Aspect::sketch)) output_->refreshBlocks();
}

void WorkflowPanel::refreshStates() {
  const model::StepStates states = bench_.stepStates();
  for (std::size_t i = 0; i < sections_.size(); ++i) sections_[i]->head().setState(states[i]);
  output_->refreshState();
}

}  // namespace bw::app
