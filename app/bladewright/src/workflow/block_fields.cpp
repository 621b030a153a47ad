// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/block_fields.h"

#include "bw/core/base/units.h"

namespace bw::app {

namespace {

constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};

}  // namespace

BlockFields::BlockFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  automatic_ = column->addCheck(
      tr("Block around the surface"),
      tr("On: the block follows the surface. Off: place it by its corner, size and rotation."));
  connect(automatic_, &QCheckBox::clicked, this, [this](bool on) {
    const BlockPlacement now = placement();
    bench_.editBlock(on ? tr("Fit block to surface") : tr("Place block"), [on, now](StockBlock& block) {
      block.placement = on ? std::nullopt : std::optional(now);
    });
  });
  const auto add = [&](const QString& name, const QString& tip, const QString& change,
                       const NumberRange& range, Eigen::Vector3d BlockPlacement::*member, double unit) {
    for (int i = 0; i < 3; ++i) {
      auto* field = column->add(name.arg(kAxes[std::size_t(i)]), new NumberField(range), tip);
      connect(field, &NumberField::edited, this, [=, this](double value) {
        BlockPlacement next = placement();
        (next.*member)[i] = value * unit;
        bench_.editBlock(change, [&](StockBlock& block) { block.placement = next; });
      });
      numbers_.push_back({field, member, i, unit});
    }
  };
  add(tr("Corner %1"), tr("The corner of the block in the frame of the file"), tr("Move block"),
      {-1e6, 1e6, 3, 10, "mm"}, &BlockPlacement::origin, 1);
  add(tr("Size %1"), tr("Edge length of the block"), tr("Resize block"), {1, 1e5, 3, 10, "mm"},
      &BlockPlacement::size, 1);
  add(tr("Rotation %1"), tr("Turned about X, then the new Y, then the new Z"), tr("Rotate block"),
      {-360, 360, 3, 5, QString(QChar(0xb0))}, &BlockPlacement::rotation, kDegree);
}

BlockPlacement BlockFields::placement() const {
  if (bench_.block().placement) return *bench_.block().placement;
  if (const auto* cut = bench_.shownCut(); cut && cut->setup) return placementOf(cut->setup->block);
  return {};
}

void BlockFields::refresh() {
  const bool automatic = !bench_.block().placement;
  automatic_->setChecked(automatic);
  const BlockPlacement now = placement();
  for (const auto& [field, member, axis, unit] : numbers_) {
    field->show((now.*member)[axis] / unit);
    field->setEnabled(!automatic);
  }
}

}  // namespace bw::app
