// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QObject>

#include <array>
#include <functional>
#include <optional>

#include "controls/fields.h"
#include "controls/number_field.h"
#include "workbench/workbench.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// Lines of a form for a direction in the file's frame: an axis or three numbers, or nothing where that
/// stands for "automatic".
class DirectionLines : public QObject {
  Q_OBJECT

 public:
  using Value = std::optional<Eigen::Vector3d>;
  struct Words {
    QString title, tip;
    QString number;  ///< of one of the three, "Direction %1"
    bool automatic = true;
  };

  /// `value` is what the design holds, `place` where its numbers stand in the file; `found` is what three
  /// numbers begin with where it holds nothing; `edit` puts in another.
  DirectionLines(Workbench& bench, FormColumn* column, const Words& words, std::function<Value()> value,
                 NumberPlace place, std::function<Eigen::Vector3d()> found,
                 std::function<void(const Value&)> edit, QObject* parent);
  void refresh();
  void setVisible(bool visible);

 private:
  int chosen() const;
  /// Whether a number of it stands for an expression.
  bool bound(const Eigen::Vector3d& value) const;

  Workbench& bench_;
  NumberPlace place_;
  int axes_;  ///< item of the first axis
  bool visible_ = true;
  std::function<Value()> value_;
  ChoiceField* choice_;
  std::array<NumberField*, 3> numbers_;
  bool vector_ = false;  ///< shown as numbers even where it is an axis
};

/// Those of the travel of the cut selected.
DirectionLines* makeCutDirection(Workbench& bench, FormColumn* column, QObject* parent);

}  // namespace bw::app
