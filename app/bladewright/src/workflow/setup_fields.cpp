// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/setup_fields.h"

#include <QHBoxLayout>
#include <QPushButton>

#include <algorithm>
#include <tuple>

#include "bw/core/base/units.h"
#include "bw/core/design/cut_list.h"
#include "bw/core/text/number_text.h"
#include "workbench/block_layout.h"
#include "workflow/cut_length.h"

namespace bw::app {

namespace {

constexpr char kOwn[] = "custom";

/// Whether two blades are the same but for length and name.
bool sameTool(const Blade& a, const Blade& b) {
  const auto numbers = [](const Blade& blade) {
    return std::tuple(blade.section, blade.width, blade.thickness, blade.outerDiameter, blade.innerDiameter,
                      blade.youngModulus, blade.yieldStress, blade.temperature, blade.thermalExpansion,
                      blade.safety, blade.density);
  };
  return numbers(a) == numbers(b);
}

void makeOwn(Blade& blade) {
  blade.name = kOwn;
  blade.title.clear();
  blade.sources.clear();
}

constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};

}  // namespace

BladeFields::BladeFields(Workbench& bench, FormColumn* column, FormColumn* details, const Theme& theme,
                         QObject* parent)
    : QObject(parent), bench_(bench) {
  if (Result<std::vector<Blade>> presets = bladePresets()) presets_ = std::move(*presets);
  preset_ = column->addBelow(tr("Blade"), tr("The tool: its section and material"));
  for (const Blade& blade : presets_)
    preset_->addItem(QString::fromStdString(blade.title.empty() ? blade.name : blade.title));
  preset_->addItem(tr("Custom"));
  connect(preset_, &QComboBox::activated, this, [this](int index) {
    if (std::size_t(index) >= presets_.size()) {
      bench_.editDesign(tr("Customise blade"), [](Design& design) { makeOwn(design.blade); });
      return;
    }
    Blade blade = presets_[std::size_t(index)];
    blade.length = bench_.design().blade.length;
    blade.autoLength = bench_.design().blade.autoLength;
    bench_.editDesign(tr("Choose blade"), [&](Design& design) { design.blade = blade; });
  });

  const auto edit = [this](const QString& text, const std::function<void(Blade&)>& change) {
    editBlade(text, change);
  };
  const std::span<const BladeNumber> numbers = bladeNumbers();
  const auto addNumber = [&](FormColumn* to, const BladeNumber& number) {
    NumberField* field = numbers_.add(to, number, this, edit);
    if (number.scale == 1)
      bindNumber(bench_, field, [place = std::string("/blade/") + number.key] { return place; });
    return field;
  };
  length_ = addNumber(column, numbers.front());
  band_ = column->addWide(new LengthBand(theme));
  connect(band_, &LengthBand::chosen, this, [this](double length) {
    // The lengths told are those of the cut selected, which may have a blade of its own.
    bench_.editDesign(tr("Change blade length"), [this, length](Design& design) {
      if (Cut& own = *std::ranges::find(design.cuts, bench_.cut().id, &Cut::id); own.length) {
        own.length = length;
      } else {
        design.blade.length = length;
        design.blade.autoLength = false;
      }
    });
  });
  lengths_ = column->addWide(makeAnswer());
  autoLength_ =
      column->addCheck(tr("Best length"), tr("Takes the length with which the blade rests most firmly"));
  autoLength_->setObjectName("bestLength");
  connect(autoLength_, &QCheckBox::clicked, this, [this](bool on) {
    const auto result = bench_.sweep();
    const double now = result ? result->sweep.request.blade.length : bench_.design().blade.length;
    bench_.editDesign(on ? tr("Take the best length") : tr("Keep the length"), [on, now](Design& design) {
      design.blade.autoLength = on;
      design.blade.length = now;
    });
  });
  auto* line = new QWidget;
  auto* layout = makeBox<QHBoxLayout>(line);
  layout->addStretch();
  auto* measure = makeButton(tr("Measure…"), tr("Find the length of the mounted blade from how far it sags"),
                             this, &BladeFields::measureRequested);
  measure->setAccessibleName(tr("Measure the blade length"));
  layout->addWidget(measure);
  column->addWide(line);
  minRadius_ = column->addValue(tr("Smallest radius"), tr("The tightest bend that leaves the blade elastic"));
  for (const BladeNumber& number : numbers.subspan(1)) addNumber(details, number);
  weight_ = column->addCheck(tr("Blade hangs in its weight"),
                             tr("The surface is that of the blade as its own weight bends it"));
  connect(weight_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.editDesign(on ? tr("Give the blade weight") : tr("Take the blade's weight away"),
                      [on](Design& design) { design.process.weight = on; });
  });
  up_ = new DirectionLines(
      bench_, column,
      {tr("Up"),
       tr("Against which weight pulls: automatic, to the top of each block as it lies; else a way in the "
          "frame of the file"),
       tr("Up %1")},
      [this] { return bench_.design().process.up; }, [] { return std::string("/process/up"); },
      [] { return Eigen::Vector3d(Eigen::Vector3d::UnitZ()); },
      [this](const DirectionLines::Value& up) {
        bench_.editDesign(tr("Turn up"), [&](Design& design) { design.process.up = up; });
      },
      this);
}

void BladeFields::editBlade(const QString& text, const std::function<void(Blade&)>& change) {
  bench_.editDesign(text, [&](Design& design) {
    const Blade before = design.blade;
    change(design.blade);
    // The length is the user's in any case; any other number makes it a blade of their own, until it is that
    // of a preset again.
    if (sameTool(design.blade, before)) return;
    makeOwn(design.blade);
    if (const Blade* preset = presetOf(design.blade)) {
      design.blade.name = preset->name;
      design.blade.title = preset->title;
      design.blade.sources = preset->sources;
    }
  });
}

const Blade* BladeFields::presetOf(const Blade& blade) const {
  const auto found = std::find_if(presets_.begin(), presets_.end(),
                                  [&](const Blade& preset) { return sameTool(preset, blade); });
  return found == presets_.end() ? nullptr : &*found;
}

void BladeFields::refresh() {
  const Blade& blade = bench_.design().blade;
  const Blade* preset = blade.name == kOwn ? nullptr : presetOf(blade);
  preset_->show(preset ? int(preset - presets_.data()) : int(presets_.size()));
  const auto source = [&](const BladeNumber& number) {
    const auto found = blade.sources.find(number.key);
    return found == blade.sources.end() ? QString()
                                        : tr("Source: %1").arg(QString::fromStdString(found->second));
  };
  numbers_.refresh(
      blade, [&](const BladeNumber& number) { return number.appliesTo(blade.section); }, source);
  refreshLengths();
  minRadius_->setText(QString::fromStdString(shortText(blade.minRadius(), 3)) + " mm");
  weight_->setChecked(bench_.design().process.weight);
  up_->setVisible(bench_.design().process.weight);
}

void BladeFields::refreshLengths() {
  const Blade& blade = bench_.design().blade;
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  std::shared_ptr<const BladeLengths> known = cut ? cut->lengths.value : nullptr;
  // Where the design of now comes to no result, those of an earlier one are told alone if nothing but the
  // length is another.
  if (known && bench_.stale() && bench_.failed()) {
    Design before = bench_.shown()->design;
    before.blade.length = blade.length;
    before.blade.autoLength = blade.autoLength;
    if (!(before == bench_.design())) known = nullptr;
  }
  const auto result = bench_.sweep();
  const std::optional<double>& own = bench_.cut().length;
  const double length =
      blade.autoLength && result && !own ? result->sweep.request.blade.length : blade.length;
  band_->show(known, own.value_or(length));
  lengths_->setText(lengthsText(known.get()));
  autoLength_->setChecked(blade.autoLength);
  length_->show(length);
  length_->setEnabled(!blade.autoLength);
}

BlockFields::BlockFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  automatic_ = column->addCheck(
      tr("Block around the surface"),
      tr("On: the block follows the surface, and goes on below it as far as the floor asks for. Off: "
         "place it by its corner, size and rotation."));
  connect(automatic_, &QCheckBox::clicked, this, [this](bool on) {
    const BlockPlacement now = placement();
    bench_.editBlock(on ? tr("Fit block to surface") : tr("Place block"), [on, now](StockBlock& block) {
      block.placement = on ? std::nullopt : std::optional(now);
    });
  });
  const auto add = [&](const QString& name, const QString& tip, const QString& change,
                       const NumberRange& range, Eigen::Vector3d BlockPlacement::*member, double unit,
                       const std::string& key) {
    for (int i = 0; i < 3; ++i) {
      auto* field = column->add(name.arg(kAxes[std::size_t(i)]), new NumberField(range), tip);
      connect(field, &NumberField::edited, this, [=, this](double value) {
        BlockPlacement next = placement();
        (next.*member)[i] = value * unit;
        bench_.editBlock(change, [&](StockBlock& block) { block.placement = next; });
      });
      bindNumber(bench_, field, placeInBlock(bench_, key + std::to_string(i)));
      numbers_.push_back({field, member, i, unit});
    }
  };
  add(tr("Corner %1"), tr("The corner of the block in the frame of the file"), tr("Move block"),
      {-1e6, 1e6, 3, 10, "mm"}, &BlockPlacement::origin, 1, "/origin/");
  add(tr("Size %1"), tr("Edge length of the block"), tr("Resize block"), {1, 1e5, 3, 10, "mm"},
      &BlockPlacement::size, 1, "/size/");
  add(tr("Rotation %1"), tr("Turned about X, then the new Y, then the new Z"), tr("Rotate block"),
      {-360, 360, 3, 5, QString(QChar(0xb0))}, &BlockPlacement::rotation, kDegree, "/rotation_deg/");
}

BlockPlacement BlockFields::placement() const { return placementOf(bench_).value_or(BlockPlacement()); }

void BlockFields::refresh() {
  const bool automatic = !bench_.block().placement;
  automatic_->setChecked(automatic);
  const BlockPlacement now = placement();
  for (const auto& [field, member, axis, unit] : numbers_) {
    field->show((now.*member)[axis] / unit);
    field->setEnabled(!automatic);
  }
}

CutFields::CutFields(Workbench& bench, FormColumn* column, QObject* parent) : QObject(parent), bench_(bench) {
  cut_ =
      column->addBelow(tr("Cut"), tr("The cut whose surface, direction and stations are shown and edited"));
  cut_->setObjectName("cut");
  connect(cut_, &QComboBox::activated, this, [this](int index) {
    const Cut& cut = bench_.design().cuts[std::size_t(index)];
    bench_.select({Selection::Kind::result, -1, cut.block, cut.id});
  });
  length_ = column->add(tr("Own length"), makeCutLength(bench, [this] { return bench_.cut().id; }),
                        tr("The length of the blade for this cut alone; empty: that of the blade below"));
  auto* line = new QWidget;
  auto* layout = makeBox<QHBoxLayout>(line);
  layout->addStretch();
  add_ = makeButton(tr("Add cut"), tr("Another cut of this block, with a surface of its own"), this,
                    &CutFields::add);
  add_->setObjectName("addCut");
  remove_ = makeButton(tr("Remove cut"),
                       tr("Takes this cut away, in a grid from each of its blocks; a block keeps one"), this,
                       &CutFields::remove);
  remove_->setObjectName("removeCut");
  layout->addWidget(remove_);
  layout->addWidget(add_);
  column->addWide(line);
}

void CutFields::add() {
  const Cut& beside = bench_.cut();
  const BlockPlacement placed = placementOf(bench_).value_or(BlockPlacement());
  Result<AnotherCut> another = withAnotherCut(bench_.design(), beside, placed);
  if (!another) return bench_.tell(Topic::declined, another.error());
  // What lay around the surface stays where it is.
  if (!bench_.block().placement && bench_.shownCut() && bench_.shownCut()->setup)
    std::ranges::find(another->design.stock, beside.block, &StockBlock::id)->placement = placed;
  const Selection next{Selection::Kind::result, -1, beside.block, another->id};
  bench_.editDesign(tr("Add cut"), [&](Design& design) { design = std::move(another->design); });
  bench_.select(next);
}

void CutFields::remove() {
  if (!mayGo(bench_.design(), bench_.cut())) return;
  bench_.editDesign(tr("Remove cut"),
                    [cut = bench_.cut()](Design& design) { design = withoutCut(design, cut); });
}

void CutFields::refreshChoice() {
  const std::vector<Cut>& cuts = bench_.design().cuts;
  QStringList names;
  for (const Cut& cut : cuts) {
    const bool own = bench_.design().stock.size() > 1 && !cut.id.ends_with("-" + cut.block);
    names.push_back(QString::fromStdString(own ? cut.block + ", " + cut.id : cut.id));
  }
  QStringList shown;
  for (int i = 0; i < cut_->count(); ++i) shown.push_back(cut_->itemText(i));
  if (names != shown) {
    cut_->clear();
    cut_->addItems(names);
  }
  const auto own = std::ranges::find(cuts, bench_.cut().id, &Cut::id);
  cut_->show(int(own - cuts.begin()));
  setLineVisible(cut_, cuts.size() > 1);
}

void CutFields::refresh() {
  refreshChoice();
  const Cut& cut = bench_.cut();
  const auto beside = std::ranges::count(bench_.design().cuts, cut.block, &Cut::block);
  showCutLength(*length_, cut);
  // A single cut has the blade to itself.
  setLineVisible(length_, bench_.design().cuts.size() > 1 || cut.length.has_value());
  remove_->setVisible(beside > 1);
  remove_->setEnabled(mayGo(bench_.design(), cut));
  add_->setEnabled(!bench_.document().empty());
}

}  // namespace bw::app
