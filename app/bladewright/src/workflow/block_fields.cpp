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
  automatic_ = new QCheckBox(tr("Block around the surface"));
  automatic_->setToolTip(
      tr("On: the block follows the surface. Off: place it by its corner, size and rotation."));
  column->addWide(automatic_);
  connect(automatic_, &QCheckBox::clicked, this, [this](bool on) {
    const BlockPlacement now = placement();
    bench_.editBlock(on ? tr("Fit block to surface") : tr("Place block"), [on, now](StockBlock& block) {
      block.placement = on ? std::nullopt : std::optional(now);
    });
  });
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    origin_[axis] = new NumberField({-1e6, 1e6, 3, 10, "mm"});
    column->add(tr("Corner %1").arg(kAxes[axis]), origin_[axis],
                tr("The corner of the block in the frame of the file"));
    connect(origin_[axis], &NumberField::edited, this, [this, i](double value) {
      editPlacement(tr("Move block"), [=](BlockPlacement& p) { p.origin[i] = value; });
    });
  }
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    size_[axis] = new NumberField({1, 1e5, 3, 10, "mm"});
    column->add(tr("Size %1").arg(kAxes[axis]), size_[axis], tr("Edge length of the block"));
    connect(size_[axis], &NumberField::edited, this, [this, i](double value) {
      editPlacement(tr("Resize block"), [=](BlockPlacement& p) { p.size[i] = value; });
    });
  }
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    rotation_[axis] = new NumberField({-360, 360, 3, 5, QString(QChar(0xb0))});
    column->add(tr("Rotation %1").arg(kAxes[axis]), rotation_[axis],
                tr("Turned about X, then the new Y, then the new Z"));
    connect(rotation_[axis], &NumberField::edited, this, [this, i](double value) {
      editPlacement(tr("Rotate block"), [=](BlockPlacement& p) { p.rotation[i] = fromDegrees(value); });
    });
  }
}

BlockPlacement BlockFields::placement() const {
  if (bench_.block().placement) return *bench_.block().placement;
  if (const auto* cut = bench_.shownCut(); cut && cut->setup) return placementOf(cut->setup->block);
  return {};
}

void BlockFields::editPlacement(const QString& text, const std::function<void(BlockPlacement&)>& change) {
  BlockPlacement next = placement();
  change(next);
  bench_.editBlock(text, [&](StockBlock& block) { block.placement = next; });
}

void BlockFields::refresh() {
  const bool automatic = !bench_.block().placement;
  automatic_->setChecked(automatic);
  const BlockPlacement now = placement();
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    origin_[axis]->show(now.origin[i]);
    size_[axis]->show(now.size[i]);
    rotation_[axis]->show(toDegrees(now.rotation[i]));
    for (NumberField* field : {origin_[axis], size_[axis], rotation_[axis]}) field->setEnabled(!automatic);
  }
}

}  // namespace bw::app
