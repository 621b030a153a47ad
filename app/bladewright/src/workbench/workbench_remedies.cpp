// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// What the remedies of findings and errors change in the design.

#include "workbench/workbench.h"

namespace bw::app {

namespace {

void takePreset(Design& design, const std::string& name) {
  Result<Blade> blade = bladePreset(name);
  if (!blade) return;
  blade->length = design.blade.length;
  design.blade = std::move(*blade);
}

/// An overload for each remedy; those that only a person can do change nothing.
struct Mend {
  Design& design;
  Cut& cut;

  void operator()(const OtherLength& remedy) const { design.blade.length = remedy.length; }
  void operator()(const BendingBlade& remedy) const {
    if (remedy.presetBends()) takePreset(design, remedy.preset);
  }
  void operator()(const FlatBlade& remedy) const {
    if (!remedy.preset.empty()) takePreset(design, remedy.preset);
  }
  void operator()(const LargerSurface&) const {}
  void operator()(const OtherBlock&) const {}
  void operator()(const CutInParts&) const {}
  void operator()(const MoreStations& remedy) const {
    cut.sections.stations = remedy.count;
    cut.sections.spacing.reset();
  }
  void operator()(const TurnDirection&) const { cut.direction.reset(); }
  void operator()(const WiderTolerance& remedy) const { design.process.tolerance = remedy.tolerance; }
};

}  // namespace

bool Workbench::canApply(const Remedy& remedy) const {
  Design changed = design();
  std::visit(Mend{changed, cutOf(changed)}, remedy);
  return changed != design();
}

void Workbench::apply(const Remedy& remedy) {
  editDesign(QString::fromStdString(words::action(remedy)), [&](Design& design) {
    std::visit(Mend{design, cutOf(design)}, remedy);
  });
}

}  // namespace bw::app
