// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/cut_length.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bw/core/blade/blade_numbers.h"
#include "workflow/bound_number.h"

namespace bw::app {

namespace {

/// The least length of a blade, mm.
double least() { return bladeNumbers().front().min; }

/// What an empty field holds: less than any blade has, by nothing that could be typed.
double none() { return std::nextafter(least(), 0); }

}  // namespace

NumberField* makeCutLength(Workbench& bench, const std::function<std::string()>& cut) {
  auto* field = new NumberField({none(), bladeNumbers().front().max, 2, 10, "mm"});
  field->setBlank(QObject::tr("as all"));
  QObject::connect(field, &NumberField::edited, field, [&bench, cut](double length) {
    // Of this cut alone, also where those of a grid are alike.
    bench.editDesign(QObject::tr("Change length for the cut"), [&](Design& design) {
      const auto own = std::ranges::find(design.cuts, cut(), &Cut::id);
      if (own != design.cuts.end()) own->length = length >= least() ? std::optional(length) : std::nullopt;
    });
  });
  bindNumber(bench, field, [&bench, cut] { return placeOfCut(bench, cut(), "/blade_length")(); });
  return field;
}

void showCutLength(NumberField& field, const Cut& cut) { field.show(cut.length.value_or(none())); }

}  // namespace bw::app
