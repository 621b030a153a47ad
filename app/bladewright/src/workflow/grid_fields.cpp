// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/grid_fields.h"

#include <algorithm>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/grid_change.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"
#include "workbench/block_layout.h"
#include "workflow/bound_number.h"

namespace bw::app {

namespace {

constexpr double kSmallest = 1, kLargest = 1e5;  // mm, of a block
constexpr int kDigits = 8;
constexpr QLatin1Char kEquals('=');
constexpr QLatin1String kBetween("; ");

QString lengthOf(double mm) { return QString::fromStdString(shortText(mm, kDigits)); }

QString upper(const std::string& sentence) {
  QString text = QString::fromStdString(sentence);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

/// The parts of a list. Within brackets nothing parts them: =max(a; b).
QStringList partsOf(const QString& text) {
  QStringList parts(1);
  int brackets = 0;
  for (int i = 0; i < text.size(); ++i) {
    const QChar c = text[i];
    if (c == '(') ++brackets;
    if (c == ')') --brackets;
    const bool comma = c == ',' && i + 1 < text.size() && text[i + 1].isSpace();
    if (brackets <= 0 && (c == ';' || comma))
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (QString& part : parts) part = part.trimmed();
  return parts;
}

bool allSame(const std::vector<double>& lengths) {
  return std::ranges::all_of(lengths, [&](double length) { return length == lengths.front(); });
}

std::string placeOf(std::size_t index) { return "/" + std::to_string(index); }

/// Those of the expressions that came to the lengths that there are.
LengthExpressions standing(const LengthExpressions& told, const std::vector<double>& lengths) {
  LengthExpressions stand;
  if (const auto all = told.find(""); all != told.end())
    if (std::ranges::all_of(lengths, [&](double length) { return standsFor(length, all->second); }))
      return {*all};
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (const auto one = told.find(placeOf(i)); one != told.end() && standsFor(lengths[i], one->second))
      stand.insert(*one);
  return stand;
}

/// Whether the file of the design tells its grid: cuts that no grid makes are told with their blocks.
bool tellsGrid(const Design& design) {
  Design probe = withoutVersions(design);
  const double columns = double(probe.grid->sizes[0].size());
  const std::string place = "/grid/columns";
  probe.bindings = {{place, {shortText(columns, kDigits), columns}}};
  const Result<Design> again = resolved(probe);
  return again && again->bindings.contains(place);
}

/// The expressions at a place of the file, and below it.
LengthExpressions expressionsAt(const Design& design, const std::string& place) {
  LengthExpressions found;
  for (auto bound = design.bindings.lower_bound(place);
       bound != design.bindings.end() && bound->first.starts_with(place); ++bound) {
    const std::string below = bound->first.substr(place.size());
    if (below.empty() || below.front() == '/') found.emplace(below, bound->second);
  }
  return found;
}

std::string sizesPlace(std::size_t way) { return std::string("/grid/sizes/") + kGridWays[way]; }
std::string gapsPlace(std::size_t way) { return std::string("/grid/gaps/") + kGridWays[way]; }
std::string cornerPlace(std::size_t axis) { return "/grid/origin/" + std::to_string(axis); }
constexpr char kTurnPlace[] = "/grid/rotation_deg/2";
std::string countPlace(std::size_t way) { return std::string("/grid/") + kGridWays[way]; }

}  // namespace

LengthsField::LengthsField(double min, double max, QWidget* parent)
    : ToldListField(parent), min_(min), max_(max) {
  setProperty("limits", limitsText());
}

void LengthsField::show(const std::vector<double>& lengths, const LengthExpressions& expressions) {
  const LengthExpressions stand = standing(expressions, lengths);
  const bool changed = lengths != lengths_ || stand != expressions_;
  lengths_ = lengths;
  expressions_ = stand;
  showValue(changed);
  refreshTold();
}

QString LengthsField::expression() const {
  if (expressions_.empty()) return {};
  if (const auto all = expressions_.find(""); all != expressions_.end())
    return kEquals + QString::fromStdString(all->second.text);
  QStringList parts;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const auto one = expressions_.find(placeOf(i));
    parts << (one == expressions_.end() ? lengthOf(lengths_[i])
                                        : kEquals + QString::fromStdString(one->second.text));
  }
  return parts.join(kBetween);
}

QString LengthsField::readExpression(const QString& text, double* length) const {
  if (!value_) return tr("A number, for no expression can stand here");
  const Result<double> value = value_(text.toStdString());
  if (!value) return tr("After its =, %1").arg(QString::fromStdString(value.error().message));
  if (*value < min_ || *value > max_)
    return tr("This comes to %1 mm, which is out of range").arg(lengthOf(*value));
  *length = *value;
  return {};
}

QString LengthsField::read(const QString& text, std::size_t place, double* length) const {
  if (text.startsWith(kEquals)) return readExpression(text.mid(1).trimmed(), length);
  // What the field shows of a length is that length, though it may have more digits.
  if (place < lengths_.size() && text == lengthOf(lengths_[place])) {
    *length = lengths_[place];
    return {};
  }
  const Result<double> number = readTypedNumber(text.toStdString(), {"mm", min_, max_});
  if (!number) return upper(number.error().message);
  *length = *number;
  return {};
}

QString LengthsField::take(const QString& text) {
  const QStringList parts = partsOf(text);
  const std::size_t count = lengths_.size(), typed = std::size_t(parts.size());
  if (typed != 1 && typed != count)
    return tr("These are %1 lengths; there must be %2, or one for all").arg(parts.size()).arg(count);
  std::vector<double> lengths(typed);
  LengthExpressions expressions;
  for (std::size_t i = 0; i < typed; ++i) {
    const QString& part = parts[int(i)];
    if (const QString why = read(part, i, &lengths[i]); !why.isEmpty())
      return typed == 1 ? why : tr("Length %1: %2").arg(i + 1).arg(why);
    if (part.startsWith(kEquals))
      expressions[typed == 1 ? std::string() : placeOf(i)] = {part.mid(1).trimmed().toStdString(),
                                                              lengths[i]};
  }
  lengths.resize(count, lengths.front());
  if (lengths == lengths_ && expressions == expressions_) return {};
  lengths_ = lengths;
  expressions_ = expressions;
  emit edited(lengths, expressions);
  return {};
}

QString LengthsField::valueText() const {
  if (lengths_.empty()) return {};
  if (hasFocus() && !expressions_.empty()) return expression();
  if (allSame(lengths_)) return lengthOf(lengths_.front());
  QStringList parts;
  for (const double length : lengths_) parts << lengthOf(length);
  return parts.join(kBetween);
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
    addCount(way, name, tip, column);
    const auto addLengths = [&](const QString& label, const QString& about, double least, double most,
                                const QString& step, const std::string& place, auto member) {
      auto* field = column->add(label, new LengthsField(least, most), about);
      field->setExpressions([this](const std::string& text) { return value(text); });
      connect(field, &LengthsField::edited, this,
              [this, way, step, place, member](const std::vector<double>& lengths,
                                               const LengthExpressions& expressions) {
                change(step, place, expressions, [&](BlockGrid& grid) { (grid.*member)[way] = lengths; });
              });
      return field;
    };
    sizes_[way] = addLengths(tr("%1, sizes").arg(name), tr("mm, of each of them"), kSmallest, kLargest,
                             tr("Resize blocks"), sizesPlace(way), &BlockGrid::sizes);
    gaps_[way] = addLengths(tr("%1, gaps").arg(name), tr("mm, between neighbours"), 0, BlockGrid::kMostGap,
                            tr("Change gaps"), gapsPlace(way), &BlockGrid::gaps);
  }
  for (int axis = 0; axis < 3; ++axis)
    corner_[std::size_t(axis)] =
        addPlace(tr("Corner %1").arg(QLatin1Char(char('X' + axis))),
                 tr("The corner of the first block, in the frame of the file; surfaces stay where they are"),
                 tr("Move blocks"), {-1e6, 1e6, 3, 10, "mm"}, &BlockGrid::origin, axis, 1,
                 cornerPlace(std::size_t(axis)), column);
  turn_ = addPlace(tr("Rotation Z"), tr("Of all blocks about that corner; surfaces stay where they are"),
                   tr("Rotate blocks"), {-360, 360, 3, 5, QString(QChar(0xb0))}, &BlockGrid::rotation, 2,
                   kDegree, kTurnPlace, column);
  listed_ =
      column->addWide(makeNote(tr("The blocks of this design are a list and lie in no grid; undo, or "
                                  "its file, brings one back.")));
}

void GridFields::addCount(std::size_t way, const QString& name, const QString& tip, FormColumn* column) {
  NumberField* field = column->add(name, new NumberField({1, BlockGrid::kMost, 0, 1, {}}), tip);
  counts_[way] = field;
  connect(field, &NumberField::edited, this,
          [this, way](double count) { changeCount(way, int(count), std::nullopt); });
  const auto counted = [this, way](const std::string& text) -> Result<double> {
    const Result<double> count = value(text);
    const std::optional<BlockGrid> now = gridOf(bench_);
    if (count && *count == 1 && now && withCount(*now, way, 1, false).count() == 1)
      return fail(ErrorCode::badInput,
                  "this comes to 1, and a single block lies in no grid that could keep the expression");
    return count;
  };
  // The step that binds it is that of the grid, also where the count stays.
  const auto bind = [this, way, field](const std::optional<BoundNumber>& bound,
                                       const std::function<void()>&) {
    changeCount(way, int(field->value()), bound);
  };
  field->setExpressions({counted, bind});
}

NumberField* GridFields::addPlace(const QString& name, const QString& tip, const QString& step,
                                  const NumberRange& range, Eigen::Vector3d BlockGrid::*member, int axis,
                                  double unit, const std::string& place, FormColumn* column) {
  auto* field = column->add(name, new NumberField(range), tip);
  connect(field, &NumberField::edited, this, [this, step, member, axis, unit](double value) {
    if (!bench_.design().grid) return;
    bench_.editDesign(step, [&](Design& design) {
      ((*design.grid).*member)[axis] = value * unit;
      design.stock = stockOf(*design.grid);
    });
  });
  field->setExpressions(
      {[this](const std::string& text) { return value(text); },
       [this, place](const std::optional<BoundNumber>& bound, const std::function<void()>& tell) {
         bench_.editBound(place, bound, tell);
         refresh();  // the design may not have taken it
       }});
  return field;
}

Result<double> GridFields::value(const std::string& text) const {
  if (bench_.design().grid && !tellsGrid(bench_.design()))
    return fail(ErrorCode::badInput,
                "no expression can stand here, because the cuts differ from block to block so that the "
                "file of the design tells its blocks one by one");
  return valueOver(bench_, text);
}

void GridFields::changeCount(std::size_t way, int count, const std::optional<BoundNumber>& bound) {
  // A block that lies around its surface is shared by those that take its place.
  const bool around = !bench_.design().grid && !bench_.block().placement;
  LengthExpressions expressions;
  if (bound) expressions[""] = *bound;
  change(tr("Change number of blocks"), countPlace(way), expressions,
         [&](BlockGrid& grid) { grid = withCount(grid, way, count, around); });
}

void GridFields::change(const QString& text, const std::string& place, const LengthExpressions& expressions,
                        const std::function<void(BlockGrid&)>& change) {
  const std::optional<BlockGrid> before = gridOf(bench_);
  if (!before) return refresh();
  BlockGrid next = *before;
  change(next);
  Design from = bench_.design();
  for (const auto& [below, bound] : expressionsAt(from, place)) from.bindings.erase(place + below);
  for (const auto& [below, bound] : expressions) from.bindings[place + below] = bound;
  if (next == *before && from.bindings == bench_.design().bindings) return;
  if (!layOut(bench_, text, from, *before, next)) refresh();
}

void GridFields::refresh() {
  const Design& design = bench_.design();
  const std::optional<BlockGrid> now = gridOf(bench_);
  const bool listed = design.stock.size() > 1 && !design.grid;
  listed_->setVisible(listed);
  const auto boundAt = [&design](const std::string& place) {
    const auto bound = design.grid ? design.bindings.find(place) : design.bindings.end();
    return bound == design.bindings.end() ? std::nullopt : std::optional(bound->second);
  };
  for (NumberField* field : {corner_[0], corner_[1], corner_[2], turn_})
    setLineVisible(field, design.grid.has_value());
  for (std::size_t axis = 0; axis < 3 && design.grid; ++axis) {
    corner_[axis]->show(design.grid->origin[Eigen::Index(axis)]);
    corner_[axis]->showExpression(boundAt(cornerPlace(axis)));
  }
  if (design.grid) {
    turn_->show(design.grid->rotation.z() / kDegree);
    turn_->showExpression(boundAt(kTurnPlace));
  }
  for (std::size_t way = 0; way < 3; ++way) {
    setLineVisible(counts_[way], !listed);
    counts_[way]->setEnabled(now.has_value());
    const std::size_t count = now ? now->sizes[way].size() : 1;
    counts_[way]->show(double(count));
    counts_[way]->showExpression(boundAt(countPlace(way)));
    setLineVisible(sizes_[way], !listed && (count > 1 || design.grid));
    setLineVisible(gaps_[way], !listed && count > 1);
    if (!now) continue;
    sizes_[way]->show(now->sizes[way], expressionsAt(design, sizesPlace(way)));
    gaps_[way]->show(now->gaps[way], expressionsAt(design, gapsPlace(way)));
  }
}

}  // namespace bw::app
