// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/grid_fields.h"

#include <QRegularExpression>

#include <algorithm>

#include "bw/core/design/grid_change.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"
#include "workbench/block_layout.h"

namespace bw::app {

namespace {

constexpr double kSmallest = 1, kLargest = 1e5;  // mm, of a block
constexpr int kDigits = 8;

QString lengthOf(double mm) { return QString::fromStdString(shortText(mm, kDigits)); }

}  // namespace

LengthsField::LengthsField(double min, double max, QWidget* parent)
    : TypedField(parent), min_(min), max_(max) {
  setAlignment(Qt::AlignRight);
  setProperty("limits", limitsText());
}

void LengthsField::show(const std::vector<double>& lengths) {
  const bool changed = lengths != lengths_;
  lengths_ = lengths;
  showValue(changed);
}

QString LengthsField::take(const QString& text) {
  static const QRegularExpression between(QStringLiteral(";|,\\s+"));
  const QStringList parts = text.split(between);
  const std::size_t count = lengths_.size();
  if (parts.size() != 1 && std::size_t(parts.size()) != count)
    return tr("These are %1 lengths; there must be %2, or one for all").arg(parts.size()).arg(count);
  std::vector<double> read;
  for (const QString& part : parts) {
    const Result<double> length = readTypedNumber(part.trimmed().toStdString(), {"mm", min_, max_});
    if (!length) {
      QString why = QString::fromStdString(length.error().message);
      why[0] = why[0].toUpper();
      return why;
    }
    read.push_back(*length);
  }
  read.resize(count, read.front());
  if (read == lengths_) return {};
  lengths_ = read;
  emit edited(read);
  return {};
}

QString LengthsField::valueText() const {
  if (lengths_.empty()) return {};
  const bool same = std::ranges::all_of(lengths_, [&](double length) { return length == lengths_.front(); });
  QStringList parts;
  for (const double length : lengths_) parts << lengthOf(length);
  return same ? parts.front() : parts.join(QStringLiteral("; "));
}

QString LengthsField::limitsText() const {
  return tr("One for all, or one each: 600; 500; 600. %1 to %2 mm").arg(lengthOf(min_), lengthOf(max_));
}

GridFields::GridFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  column->addHeading(tr("Blocks side by side"));
  const std::array<std::pair<QString, QString>, 3> ways = {
      {{tr("Columns"), tr("Blocks side by side along X; a surface over all of them goes on over the others")},
       {tr("Rows"), tr("Blocks one behind the other along Y")},
       {tr("Layers"), tr("Blocks on top of each other along Z")}}};
  for (std::size_t way = 0; way < 3; ++way) {
    const auto& [name, tip] = ways[way];
    counts_[way] = column->add(name, new NumberField({1, BlockGrid::kMost, 0, 1, {}}), tip);
    connect(counts_[way], &NumberField::edited, this,
            [this, way](double count) { changeCount(way, int(count)); });
    const auto addLengths = [&](const QString& label, const QString& about, double least, double most,
                                const QString& step, auto member) {
      auto* field = column->add(label, new LengthsField(least, most), about);
      connect(field, &LengthsField::edited, this,
              [this, way, step, member](const std::vector<double>& lengths) {
                change(step, [&](BlockGrid& grid) { (grid.*member)[way] = lengths; });
              });
      return field;
    };
    sizes_[way] = addLengths(tr("%1, sizes").arg(name), tr("mm, of each of them"), kSmallest, kLargest,
                             tr("Resize blocks"), &BlockGrid::sizes);
    gaps_[way] = addLengths(tr("%1, gaps").arg(name), tr("mm, between neighbours"), 0, BlockGrid::kMostGap,
                            tr("Change gaps"), &BlockGrid::gaps);
  }
  listed_ =
      column->addWide(makeNote(tr("The blocks of this design are a list and lie in no grid; undo, or "
                                  "its file, brings one back.")));
}

void GridFields::changeCount(std::size_t way, int count) {
  // A block that lies around its surface is shared by those that take its place.
  const bool around = !bench_.design().grid && !bench_.block().placement;
  change(tr("Change number of blocks"), [&](BlockGrid& grid) { grid = withCount(grid, way, count, around); });
}

void GridFields::change(const QString& text, const std::function<void(BlockGrid&)>& change) {
  const std::optional<BlockGrid> before = gridOf(bench_);
  if (!before) return refresh();
  BlockGrid next = *before;
  change(next);
  if (next != *before && !layOut(bench_, text, bench_.design(), *before, next)) refresh();
}

void GridFields::refresh() {
  const std::optional<BlockGrid> now = gridOf(bench_);
  const bool listed = bench_.design().stock.size() > 1 && !bench_.design().grid;
  listed_->setVisible(listed);
  for (std::size_t way = 0; way < 3; ++way) {
    setLineVisible(counts_[way], !listed);
    counts_[way]->setEnabled(now.has_value());
    const std::size_t count = now ? now->sizes[way].size() : 1;
    counts_[way]->show(double(count));
    setLineVisible(sizes_[way], !listed && count > 1);
    setLineVisible(gaps_[way], !listed && count > 1);
    if (!now) continue;
    sizes_[way]->show(now->sizes[way]);
    gaps_[way]->show(now->gaps[way]);
  }
}

}  // namespace bw::app
