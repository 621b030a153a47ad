// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QStackedWidget>

#include <functional>
#include <vector>

#include "controls/fields.h"
#include "controls/layout.h"
#include "controls/numbers.h"
#include "workbench/workbench.h"
#include "workflow/cut_lines.h"
#include "workflow/grid_fields.h"
#include "workflow/setup_fields.h"
#include "workflow/surface_fields.h"

namespace bw::app {

/// The right panel: the numbers of what is selected, editable where the design tells them, read where they
/// are found.
class Inspector : public SidePanel {
  Q_OBJECT

 public:
  Inspector(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  const BladeFields* bladeFields() const { return bladeFields_; }
  /// The curve of the surface at work whose numbers the surface has, counted from 0; nothing: of none.
  void showCurve(const std::optional<int>& curve);
  /// Results that are out of date are pale.
  void setStale(bool stale);
  /// The first number of the design whose text is refused, on its page; null if there is none.
  TypedField* showRefused();

 private:
  /// A read-only line: its label and how its text follows from the result.
  struct Value {
    ValueLabel* label;
    std::function<QString()> text;
    std::function<bool()> broken;  ///< whether the number breaks its limit; null: it has none
    bool ofDesign = false;         ///< of the present design, never of an earlier one
    /// What a sketch tells of it, and whether that breaks the limit; null: nothing.
    std::function<QString(const pipeline::CutSketch&)> followed = {};
    std::function<bool(const pipeline::CutSketch&)> followedBroken = {};
  };
  /// Has the line added last follow a hand, by what the sketch tells of the cut selected.
  void follow(std::function<QString(const pipeline::CutSketch&)> text,
              std::function<bool(const pipeline::CutSketch&)> broken = {});
  /// The same by what it tells of the station selected.
  void followStation(std::function<QString(const pipeline::CutSketch&, std::size_t)> text,
                     std::function<bool(const pipeline::CutSketch&, std::size_t)> broken = {});
  FormColumn* addPage();
  void addValue(FormColumn* column, const QString& name, const QString& tip, std::function<QString()> text,
                std::function<bool()> broken = {});
  /// The same of the cut selected; red where it breaks the limit `broken`.
  void addOfResult(FormColumn* column, const QString& name, const QString& tip,
                   std::function<QString(const pipeline::CutResult&)> text,
                   bool SweepLimits::*broken = nullptr);
  void makeResult();
  void makeSurface();
  void makeBlock();
  void makeBlade();
  void makeStation();
  void refresh();
  /// `all`: those, too, that follow no hand.
  void refreshNumbers(bool all);
  /// What the program of the cut selected cuts; null if that is not known.
  const SimulatedSurface* programCut() const;
  /// The block selected, of the result on the screen; null if there is none.
  const pipeline::BlockEvaluation* block() const;
  std::optional<pipeline::StationView> station() const;
  /// What no blade can be of all that the key blades tell where the station selected lies, a sentence each.
  QString toldHere() const;
  void refreshStanding(bool all);

  Workbench& bench_;
  const Theme& theme_;
  ChoiceField* kind_;
  QStackedWidget* pages_;
  QLabel* empty_;
  std::vector<Value> values_;
  CutLines* cutLines_ = nullptr;
  SurfaceFields* surfaceFields_ = nullptr;
  BlockFields* blockFields_ = nullptr;
  FormColumn* gridColumn_ = nullptr;
  FormColumn* togetherColumn_ = nullptr;  ///< of a block of several cuts
  GridFields* gridFields_ = nullptr;
  BladeFields* bladeFields_ = nullptr;
  NumberField* stationNumber_ = nullptr;
  ValueLabel* told_ = nullptr;
  bool stale_ = false;
};

}  // namespace bw::app
