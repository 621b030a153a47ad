// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "bw/core/blade/blade_numbers.h"
#include "bw/core/design/process_numbers.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "workbench/workbench.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// Lines of a form for numbers of a design, made from their table.
template <class Setting, class Owner>
class NumberLines {
 public:
  /// `text` names the step of undo.
  using Edit = std::function<void(const QString& text, const std::function<void(Owner&)>& change)>;

  NumberField* add(FormColumn* column, const Setting& setting, QObject* context, const Edit& edit) {
    auto* field =
        column->add(QObject::tr(setting.title),
                    new NumberField({setting.scale * setting.typedMin, setting.scale * setting.max,
                                     setting.decimals, setting.step, QString::fromUtf8(setting.unit)}),
                    QObject::tr(setting.help));
    QObject::connect(field, &NumberField::edited, context, [&setting, edit](double value) {
      edit(QObject::tr(setting.change),
           [&setting, value](Owner& owner) { owner.*setting.member = value / setting.scale; });
    });
    lines_.push_back({&setting, field, field->toolTip()});
    return field;
  }

  /// `shown`: the lines that are; `note`: what the tip of a field says besides.
  void refresh(const Owner& owner, const std::function<bool(const Setting&)>& shown = {},
               const std::function<QString(const Setting&)>& note = {}) {
    for (const Line& line : lines_) {
      line.field->show(line.setting->scale * owner.*line.setting->member);
      if (shown) setLineVisible(line.field, shown(*line.setting));
      if (!note) continue;
      const QString more = note(*line.setting);
      line.field->setToolTip(more.isEmpty() ? line.tip : line.tip + "\n" + more);
    }
  }

 private:
  struct Line {
    const Setting* setting;
    NumberField* field;
    QString tip;
  };
  std::vector<Line> lines_;
};

using ProcessLines = NumberLines<ProcessNumber, Process>;
using BladeLines = NumberLines<BladeNumber, Blade>;

inline NumberField* addProcessLine(ProcessLines& lines, FormColumn* column, const ProcessNumber& number,
                                   QObject* context, Workbench& bench) {
  NumberField* field = lines.add(
      column, number, context, [&bench](const QString& text, const std::function<void(Process&)>& change) {
        bench.editDesign(text, [&change](Design& design) { change(design.process); });
      });
  const std::string object = number.object ? std::string(number.object) + "/" : std::string();
  bindNumber(bench, field, [place = "/process/" + object + number.key] { return place; });
  return field;
}

}  // namespace bw::app
