// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/export_blocks.h"

#include <QStyleOptionButton>
#include <QStylePainter>

#include <algorithm>

#include "controls/fields.h"
#include "controls/numbers.h"

namespace bw::app {

namespace {

constexpr std::size_t kLines = 30;  // more blocks are written all the same
constexpr int kIcon = 16;

QString counted(int count, const QString& one, const QString& many) {
  return QStringLiteral("%1 %2").arg(count).arg(count == 1 ? one : many);
}

/// How many stations rest in each way.
struct Rests {
  int certain = 0, held = 0, others = 0;
};

Rests restsOf(const pipeline::BlockEvaluation& block) {
  Rests rests;
  for (const pipeline::CutEvaluation& cut : block.cuts)
    for (const Rest station : cut.rest.value->stations)
      ++(station == Rest::certain ? rests.certain : station == Rest::held ? rests.held : rests.others);
  return rests;
}

/// What a sketch of a cut shows to be wrong at a station, the worst of it first; empty where nothing is.
QString wrongIn(const pipeline::CutSketch& cut, const Design& design) {
  const auto tr = [](const char* text) { return ExportBlocks::tr(text); };
  const RowSketch& look = *cut.look;
  const double radius = cut.sweep->request.blade.minRadius();
  const auto lost = std::ranges::count(look.rest, Rest::lost);
  if (std::ranges::any_of(look.crosses, [](char crosses) { return crosses != 0; })) return tr("crossed");
  if (look.minRadius > 0 && look.minRadius < radius) return tr("too tight");
  if (lost > 0) return tr("%1 lost").arg(lost);
  if (look.nearBlock) return tr("grip at %1").arg(lengthText(look.clearance));
  if (look.nearBottom) return tr("too low");
  if (look.deviationMax > design.process.tolerance) return tr("off by %1").arg(lengthText(look.deviationMax));
  return {};
}

/// True if a sketch has the blades of a result.
bool isAsBefore(const pipeline::CutSketch& cut, const pipeline::CutEvaluation& before) {
  const Sweep& was = *before.sweep.value;
  return std::ranges::equal(cut.sweep->poses, was.poses, [](const BladePose& a, const BladePose& b) {
    return a.leftPoint() == b.leftPoint() && a.rightPoint() == b.rightPoint();
  });
}

/// How a block that a hand changes stands; empty where the hand does not reach it.
std::optional<BlockStanding> pulledStanding(const Workbench& bench, const pipeline::BlockEvaluation& block) {
  const auto tr = [](const char* text) { return ExportBlocks::tr(text); };
  const pipeline::Sketch* sketch = bench.sketch();
  if (!sketch) return {};
  bool moved = false;
  QString wrong;
  for (const pipeline::CutEvaluation& cut : block.cuts) {
    const pipeline::CutSketch* drawn = sketch->find(cut.id);
    if (!drawn || !cut.result() || isAsBefore(*drawn, cut)) continue;
    moved = true;
    if (wrong.isEmpty()) wrong = wrongIn(*drawn, sketch->design);
  }
  if (!moved) return {};
  if (!wrong.isEmpty())
    return BlockStanding{"error", &Colours::error, wrong, tr("At a station, as the hand has it now"), {}};
  return BlockStanding{
      "stale",
      &Colours::secondary,
      tr("being changed"),
      tr("Nothing is known to be wrong at its stations; all is looked at once the hand rests"),
      {}};
}

BlockStanding standingOf(const Workbench& bench, const std::string& id, const Findings& findings) {
  BlockStanding standing;
  const auto tr = [](const char* text) { return ExportBlocks::tr(text); };
  const auto shown = bench.shown();
  if (!shown) {
    standing.word = tr("not computed");
    return standing;
  }
  const auto found = std::ranges::find(shown->blocks, id, &pipeline::BlockEvaluation::id);
  if (found == shown->blocks.end()) {
    const bool wrong = std::ranges::any_of(findings, [&id](const Finding& finding) {
      return finding.severity == Severity::error && finding.where.block == id;
    });
    standing.word = bench.stale() ? tr("not computed") : tr("not cut");
    if (bench.stale()) return standing;
    standing.tip = wrong ? tr("The messages tell why nothing can be cut of it")
                         : tr("The surface does not meet this block");
    if (wrong) {
      standing.icon = "error";
      standing.colour = &Colours::error;
    }
    return standing;
  }
  if (std::optional<BlockStanding> pulled = pulledStanding(bench, *found)) return *pulled;
  double time = 0;
  int stations = 0;
  bool whole = true;
  for (const pipeline::CutEvaluation& cut : found->cuts) {
    whole = whole && cut.result();
    if (!cut.result()) continue;
    time += cut.motion.value->cuttingTime();
    stations += int(cut.result()->size());
  }
  if (whole) standing.time = timeText(time);
  if (bench.stale() && bench.failed())
    return {"error", &Colours::error, tr("no result"), tr("The messages tell why"), {}};
  if (bench.stale()) {
    standing.icon = "stale";
    standing.word = tr("out of date");
    return standing;
  }
  if (!whole) return {"error", &Colours::error, tr("no result"), tr("The messages tell why"), {}};
  int errors = 0, warnings = 0;
  for (const Finding& finding : findings) {
    if (!finding.where.block.empty() && finding.where.block != id) continue;
    errors += finding.severity == Severity::error;
    warnings += finding.severity == Severity::warning;
  }
  const Rests rests = restsOf(*found);
  standing.tip = QObject::tr("%1 in %2: %3 certain, %4 held")
                     .arg(counted(stations, tr("station"), tr("stations")),
                          counted(int(found->cuts.size()), tr("cut"), tr("cuts")))
                     .arg(rests.certain)
                     .arg(rests.held);
  if (rests.others > 0) standing.tip += tr(", %1 lost or not known").arg(rests.others);
  if (errors > 0) {
    standing.icon = "error";
    standing.colour = &Colours::error;
    standing.word = counted(errors, tr("error"), tr("errors"));
    standing.tip +=
        "\n" + tr("A robot program is not written where something is wrong; the messages tell what");
  } else if (warnings > 0) {
    standing.icon = "warning";
    standing.colour = &Colours::warning;
    standing.word = counted(warnings, tr("warning"), tr("warnings"));
  } else {
    standing.icon = "done";
    standing.colour = &Colours::success;
    standing.word = rests.held > 0 ? tr("held") : tr("certain");
  }
  return standing;
}

/// A check box whose name is shortened to the width there is.
class NameBox : public QCheckBox {
 public:
  using QCheckBox::QCheckBox;
  QSize minimumSizeHint() const override {
    return {std::min(kLeastName, QCheckBox::sizeHint().width()), QCheckBox::minimumSizeHint().height()};
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QStyleOptionButton option;
    initStyleOption(&option);
    const int room = style()->subElementRect(QStyle::SE_CheckBoxContents, &option, this).width();
    option.text = fontMetrics().elidedText(option.text, Qt::ElideMiddle, room);
    QStylePainter(this).drawControl(QStyle::CE_CheckBox, option);
  }

 private:
  static constexpr int kLeastName = 96;
};

Findings findingsOf(const Workbench& bench) {
  const auto shown = bench.shown();
  return shown ? shown->findings() : Findings();
}

}  // namespace

BlockStanding standingOf(const Workbench& bench, const std::string& block) {
  return standingOf(bench, block, findingsOf(bench));
}

std::vector<BlockStanding> standingsOf(const Workbench& bench) {
  const Findings findings = findingsOf(bench);
  std::vector<BlockStanding> all;
  for (const StockBlock& block : bench.design().stock) all.push_back(standingOf(bench, block.id, findings));
  return all;
}

ExportBlocks::ExportBlocks(Workbench& bench, const Theme& theme, QWidget* parent)
    : QWidget(parent), bench_(bench), theme_(theme), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(kGap);
  grid_->setVerticalSpacing(4);
  grid_->setColumnStretch(0, 1);
  connect(&theme, &Theme::changed, this, [this] {
    for (Line& line : lines_) paint(line);
  });
}

void ExportBlocks::rebuild() {
  empty(*grid_);
  lines_.clear();
  for (const std::string& block : built_) {
    if (lines_.size() == kLines) break;
    Line line{block, new NameBox(QString::fromStdString(block)), new QLabel, new QLabel, new QLabel, {}};
    line.wanted->setToolTip(
        tr("Programs, drawing, part and line of the cut list of %1").arg(line.wanted->text()));
    line.wanted->setAccessibleName(tr("Export %1").arg(line.wanted->text()));
    connect(line.wanted, &QCheckBox::clicked, this,
            [this, block](bool on) { bench_.setBlockWanted(block, on); });
    line.time->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    line.time->setObjectName("secondary");
    line.time->setToolTip(tr("Cutting time, leads included; entry and exit come to it"));
    line.word->setAccessibleName(tr("State of %1").arg(line.wanted->text()));
    const int row = int(lines_.size());
    grid_->addWidget(line.wanted, row, 0);
    grid_->addWidget(line.icon, row, 1);
    grid_->addWidget(line.word, row, 2);
    grid_->addWidget(line.time, row, 3);
    lines_.push_back(line);
    paint(lines_.back());
  }
  if (built_.size() > kLines)
    grid_->addWidget(makeNote(tr("%1 more blocks are written, too").arg(built_.size() - kLines)), int(kLines),
                     0, 1, 4);
}

void ExportBlocks::paint(Line& line) {
  const QColor colour = theme_.colours().*line.shown.colour;
  line.icon->setPixmap(Theme::pixmap(line.shown.icon, colour, kIcon, devicePixelRatioF()));
  line.word->setText(line.shown.word);
  line.time->setText(line.shown.time);
  for (QLabel* label : {line.icon, line.word}) label->setToolTip(line.shown.tip);
}

void ExportBlocks::refresh() {
  std::vector<std::string> blocks;
  for (const StockBlock& block : bench_.design().stock) blocks.push_back(block.id);
  if (blocks != built_) {
    built_ = blocks;
    rebuild();
  }
  const pipeline::Wanted wanted = bench_.wanted();
  const bool any = bench_.anyBlockWanted();
  const Findings findings = findingsOf(bench_);
  for (Line& line : lines_) {
    line.wanted->setChecked(any && wanted.hasBlock(line.block));
    line.wanted->setEnabled(built_.size() > 1 || !any);
    BlockStanding now = standingOf(bench_, line.block, findings);
    if (now == line.shown) continue;
    line.shown = std::move(now);
    paint(line);
  }
}

}  // namespace bw::app
