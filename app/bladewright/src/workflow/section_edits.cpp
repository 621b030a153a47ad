// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/section_edits.h"

#include <QCoreApplication>

#include <utility>

#include "bw/core/design/section_list.h"

namespace bw::app {

namespace {

QString words(const char* text) { return QCoreApplication::translate("SectionEdits", text); }

std::size_t sourceOf(const Workbench& bench) {
  return std::size_t(&bench.source() - bench.design().sources.data());
}

bool take(Workbench& bench, const QString& text, Result<Design> changed) {
  if (changed) {
    // What makes no spline is no surface.
    const Result<SplineSurface> spline = splineOf(*changed->sources[sourceOf(bench)].surface);
    if (!spline) changed = tl::unexpected<Error>(spline.error());
  }
  if (!changed) {
    bench.tell(Topic::other, changed.error());
    return false;
  }
  bench.editDesign(text, [&](Design& design) { design = std::move(*changed); });
  return true;
}

}  // namespace

std::optional<std::size_t> addPoint(Workbench& bench, std::size_t section, std::size_t after) {
  std::size_t added = 0;
  Result<Design> changed = withPointAfter(bench.design(), sourceOf(bench), section, after, &added);
  if (!take(bench, words("Add point to section %1").arg(section + 1), std::move(changed))) return {};
  return added;
}

bool removePoint(Workbench& bench, std::size_t section, std::size_t point) {
  return take(bench, words("Remove point %1 of section %2").arg(point + 1).arg(section + 1),
              withoutPoint(bench.design(), sourceOf(bench), section, point));
}

bool addSection(Workbench& bench, std::size_t after) {
  return take(bench, words("Add section"), withSectionAfter(bench.design(), sourceOf(bench), after));
}

bool removeSection(Workbench& bench, std::size_t section) {
  return take(bench, words("Remove section %1").arg(section + 1),
              withoutSection(bench.design(), sourceOf(bench), section));
}

bool addBlade(Workbench& bench, std::size_t after) {
  return take(bench, words("Add key blade"), withBladeAfter(bench.design(), sourceOf(bench), after));
}

bool removeBlade(Workbench& bench, std::size_t blade) {
  return take(bench, words("Remove key blade %1").arg(blade + 1),
              withoutBlade(bench.design(), sourceOf(bench), blade));
}

namespace {

bool isOfBlades(const Workbench& bench) {
  return std::holds_alternative<BladesSurface>(bench.source().surface->shape);
}

}  // namespace

bool repeatEntry(Workbench& bench, std::size_t entry) {
  return take(bench,
              words(isOfBlades(bench) ? "Duplicate key blade %1" : "Duplicate section %1").arg(entry + 1),
              withEntryRepeated(bench.design(), sourceOf(bench), entry));
}

bool copyShape(Workbench& bench, std::size_t from, const std::vector<std::size_t>& to) {
  const bool rows = std::holds_alternative<PolesSurface>(bench.source().surface->shape);
  return take(bench,
              words(isOfBlades(bench) ? "Copy shape of key blade %1"
                    : rows            ? "Copy shape of row %1"
                                      : "Copy shape of section %1")
                  .arg(from + 1),
              withShapeCopied(bench.design(), sourceOf(bench), from, to));
}

}  // namespace bw::app
