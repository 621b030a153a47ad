// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/section_edits.h"

#include <QCoreApplication>

#include <utility>

#include "bw/core/design/section_list.h"
#include "bw/core/design/surface_curves.h"
#include "bw/core/text/printable.h"

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
    bench.tell(Topic::declined, changed.error());
    return false;
  }
  bench.editDesign(text, [&](Design& design) { design = std::move(*changed); });
  return true;
}

}  // namespace

QString curveTitle(const Workbench& bench, std::size_t curve) {
  return QString::fromStdString(printable(bw::curveTitle(bench.source(), int(curve))));
}

QString curveHeading(const Workbench& bench, std::size_t curve) {
  QString title = curveTitle(bench, curve);
  const bool named = bench.source().curveNames.contains(int(curve));
  if (!named && !title.isEmpty()) title[0] = title[0].toUpper();
  return title;
}

std::optional<std::size_t> addPoint(Workbench& bench, std::size_t section, std::size_t after) {
  std::size_t added = 0;
  Result<Design> changed = withPointAfter(bench.design(), sourceOf(bench), section, after, &added);
  if (!take(bench, words("Add point to %1").arg(curveTitle(bench, section)), std::move(changed))) return {};
  return added;
}

bool removePoint(Workbench& bench, std::size_t section, std::size_t point) {
  return take(bench, words("Remove point %1 of %2").arg(point + 1).arg(curveTitle(bench, section)),
              withoutPoint(bench.design(), sourceOf(bench), section, point));
}

bool addSection(Workbench& bench, std::size_t after) {
  return take(bench, words("Add section"), withSectionAfter(bench.design(), sourceOf(bench), after));
}

bool removeSection(Workbench& bench, std::size_t section) {
  return take(bench, words("Remove %1").arg(curveTitle(bench, section)),
              withoutSection(bench.design(), sourceOf(bench), section));
}

bool addBlade(Workbench& bench, std::size_t after) {
  return take(bench, words("Add key blade"), withBladeAfter(bench.design(), sourceOf(bench), after));
}

bool removeBlade(Workbench& bench, std::size_t blade) {
  return take(bench, words("Remove %1").arg(curveTitle(bench, blade)),
              withoutBlade(bench.design(), sourceOf(bench), blade));
}

bool repeatEntry(Workbench& bench, std::size_t entry) {
  return take(bench, words("Duplicate %1").arg(curveTitle(bench, entry)),
              withEntryRepeated(bench.design(), sourceOf(bench), entry));
}

bool copyShape(Workbench& bench, std::size_t from, const std::vector<std::size_t>& to) {
  return take(bench, words("Copy shape of %1").arg(curveTitle(bench, from)),
              withShapeCopied(bench.design(), sourceOf(bench), from, to));
}

}  // namespace bw::app
