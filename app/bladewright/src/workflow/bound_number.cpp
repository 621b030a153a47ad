// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/bound_number.h"

#include <QPointer>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace bw::app {

namespace {

std::optional<BoundNumber> boundAt(const Design& design, const std::string& place) {
  const auto bound = design.bindings.find(place);
  return bound == design.bindings.end() ? std::nullopt : std::optional(bound->second);
}

std::string surfacePlace(const Workbench& bench) {
  return "/sources/" + std::to_string(&bench.source() - bench.design().sources.data()) + "/surface";
}

}  // namespace

void bindNumber(Workbench& bench, NumberField* field, const NumberPlace& place) {
  const auto refresh = [&bench, field, place] { field->showExpression(boundAt(bench.design(), place())); };
  const auto value = [&bench, place](const std::string& text) -> Result<double> {
    if (place().empty())
      return fail(ErrorCode::badInput,
                  "no expression can be typed here, because the block lies in a grid, which tells its place "
                  "and size");
    return valueOver(bench, text);
  };
  const auto bind = [&bench, place, field = QPointer<NumberField>(field)](
                        const std::optional<BoundNumber>& bound, const std::function<void()>& tell) {
    bench.editBound(place(), bound, tell);
    // The design may not have taken it.
    if (field) field->showExpression(boundAt(bench.design(), place()));
  };
  field->setExpressions({value, bind});
  QObject::connect(&bench, &Workbench::changed, field, [refresh](const Change& change) {
    if (change.any(Aspect::design | Aspect::selection)) refresh();
  });
  refresh();
}

double asBound(const Workbench& bench, const NumberPlace& place, double value, double within) {
  const std::optional<BoundNumber> bound = boundAt(bench.design(), place());
  return bound && std::abs(value - bound->value) <= within ? bound->value : value;
}

Result<double> valueOver(const Workbench& bench, const std::string& text) {
  std::vector<NamedNumber> numbers;
  for (const Variable& variable : bench.design().variables)
    numbers.push_back({variable.name, variable.value});
  return evaluateExpression(text, numbers);
}

NumberPlace placeInCut(const Workbench& bench, const std::string& key) {
  return [&bench, key] { return placeOfCut(bench, bench.cut().id, key)(); };
}

NumberPlace placeOfCut(const Workbench& bench, const std::string& id, const std::string& key) {
  return [&bench, id, key]() -> std::string {
    const Design& design = bench.design();
    const auto cut = std::ranges::find(design.cuts, id, &Cut::id);
    return "/cuts/" + std::to_string(cut - design.cuts.begin()) + key;
  };
}

NumberPlace placeInBlock(const Workbench& bench, const std::string& key) {
  return [&bench, key]() -> std::string {
    const Design& design = bench.design();
    if (design.grid) return {};
    const auto block = std::ranges::find(design.stock, bench.block().id, &StockBlock::id);
    return "/stock/" + std::to_string(block - design.stock.begin()) + "/block" + key;
  };
}

NumberPlace placeInSurface(const Workbench& bench, const std::string& key) {
  return [&bench, key] { return surfacePlace(bench) + key; };
}

NumberPlace placeOfPole(const Workbench& bench, int row, int column) {
  return [&bench, row, column] {
    const std::string pole =
        surfacePlace(bench) + "/poles/" + std::to_string(row) + "/" + std::to_string(column);
    // It is an object in the file where more than its height is told.
    const std::optional<DesignedSurface>& surface = bench.source().surface;
    const auto* poles = surface ? std::get_if<PolesSurface>(&surface->shape) : nullptr;
    const bool moved =
        poles && row < poles->rows && column < poles->columns && !poles->at(row, column).moved.isZero(0);
    const auto inside = bench.design().bindings.lower_bound(pole + "/");
    const bool told = inside != bench.design().bindings.end() && inside->first.starts_with(pole + "/");
    return moved || told ? pole + "/height" : pole;
  };
}

}  // namespace bw::app
