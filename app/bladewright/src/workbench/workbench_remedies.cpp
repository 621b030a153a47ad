// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// What the remedies of findings and errors change in the design.

#include "workbench/workbench.h"

namespace bw::app {

namespace {

void takePreset(Job& job, const std::string& name) {
  Result<Blade> blade = bladePreset(name);
  if (!blade) return;
  blade->length = job.blade.length;
  job.blade = std::move(*blade);
}

/// An overload for each remedy; those that only a person can do change nothing.
struct Change {
  Job& job;

  void operator()(const OtherLength& remedy) const { job.blade.length = remedy.length; }
  void operator()(const BendingBlade& remedy) const {
    if (remedy.presetBends()) takePreset(job, remedy.preset);
  }
  void operator()(const FlatBlade& remedy) const {
    if (!remedy.preset.empty()) takePreset(job, remedy.preset);
  }
  void operator()(const LargerSurface&) const {}
  void operator()(const OtherBlock&) const {}
  void operator()(const CutInParts&) const {}
  void operator()(const MoreStations& remedy) const {
    job.stations = remedy.count;
    job.spacing.reset();
  }
  void operator()(const TurnDirection&) const { job.direction.reset(); }
  void operator()(const WiderTolerance& remedy) const { job.tolerance = remedy.tolerance; }
};

}  // namespace

bool Workbench::canApply(const Remedy& remedy) const {
  Job changed = job();
  std::visit(Change{changed}, remedy);
  return !(changed == job());
}

void Workbench::apply(const Remedy& remedy) {
  editJob(QString::fromStdString(words::action(remedy)), [&](Job& job) { std::visit(Change{job}, remedy); });
}

}  // namespace bw::app
