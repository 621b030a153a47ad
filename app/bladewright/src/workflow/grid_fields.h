// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QObject>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/block_grid.h"
#include "bw/core/text/expression.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "controls/told_list_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Expressions that lengths stand for, by their place below that of the list: "/0", "/2", or "" where one
/// stands for all of them.
using LengthExpressions = std::map<std::string, BoundNumber>;

/// A line of lengths in mm, one for all or one each: "600", "600; 500; 600". A comma followed by a space
/// parts them too. Each may be an expression: "=width", "=width; 500; =width/2"; of those that are, both
/// are shown, and the expressions alone while they are typed into.
class LengthsField : public ToldListField {
  Q_OBJECT

 public:
  /// Each lies between `min` and `max`, mm.
  LengthsField(double min, double max, QWidget* parent = nullptr);

  /// Shows the lengths without telling them as an edit. A field that is being typed into keeps its text.
  void show(const std::vector<double>& lengths, const LengthExpressions& expressions);
  using QWidget::show;
  /// What an expression, without its =, comes to, or why it comes to nothing.
  void setExpressions(std::function<Result<double>(const std::string&)> value) { value_ = std::move(value); }
  /// What is typed into: "=width; 500; =width/2"; empty where no expression stands.
  QString expression() const override;

 signals:
  /// As many as were shown.
  void edited(const std::vector<double>& lengths, const LengthExpressions& expressions);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  /// One of the lengths that were typed; why it is none, or nothing.
  QString read(const QString& text, std::size_t place, double* length) const;
  QString readExpression(const QString& text, double* length) const;

  double min_, max_;
  std::vector<double> lengths_;
  LengthExpressions expressions_;  ///< those that the lengths stand for now
  std::function<Result<double>(const std::string&)> value_;
};

/// How many blocks lie side by side, how large they are and how far apart, and where the grid of them stands;
/// edits go to the design, whose cuts follow.
class GridFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  GridFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 private:
  void addCount(std::size_t way, const QString& name, const QString& tip, FormColumn* column);
  void changeCount(std::size_t way, int count, const std::optional<BoundNumber>& bound);
  /// A number of where the grid stands, which the file tells at `place`, in units of `unit`.
  NumberField* addPlace(const QString& name, const QString& tip, const QString& step,
                        const NumberRange& range, Eigen::Vector3d BlockGrid::*member, int axis, double unit,
                        const std::string& place, FormColumn* column);
  /// Changes the grid; `expressions` stand for what is told at `place` in the file, and below it.
  void change(const QString& text, const std::string& place, const LengthExpressions& expressions,
              const std::function<void(BlockGrid&)>& change);
  /// What an expression of a number of the grid comes to, and whether it can stand there.
  Result<double> value(const std::string& text) const;

  Workbench& bench_;
  std::array<NumberField*, 3> counts_;
  std::array<LengthsField*, 3> sizes_, gaps_;
  std::array<NumberField*, 3> corner_;
  NumberField* turn_;
  QLabel* listed_;
};

}  // namespace bw::app
