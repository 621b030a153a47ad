// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The fields of one curve of a designed surface, and of the place of its frame.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/design/surface_curves.h"
#include "bw/core/shape/section_tangents.h"
#include "workflow/section_edits.h"
#include "workflow/surface_fields.h"

namespace bw::app {

namespace {

constexpr std::size_t kMostFields = 120;  // more numbers are for the file
constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};

}  // namespace

void SurfaceFields::addCurve(FormColumn* column, const DesignedSurface& surface) {
  const auto* poles = std::get_if<PolesSurface>(&surface.shape);
  const auto* loft = std::get_if<SectionsSurface>(&surface.shape);
  const int count = curveCount(surface);
  if (!curve_ || *curve_ >= count) {
    if (count > 0)
      column->addWide(
          makeNote(tr("Choose one of its curves, in the tree above or by a handle in the picture: "
                      "its numbers then stand here.")));
    if (poles) addRectangle(column);
    if (std::holds_alternative<FormulaSurface>(surface.shape)) addFormula(column);
  } else if (poles) {
    addRow(column, *curve_, *poles);
  } else if (loft) {
    const auto i = std::size_t(*curve_);
    if (const std::size_t numbers = 1 + 2 * loft->sections[i].points.size(); numbers > kMostFields) {
      column->addWide(
          makeNote(tr("%1 numbers are too many for fields; they are in the design file.").arg(numbers)));
    } else {
      addSectionFields(column, i, *loft);
      addTangents(column, i, loft->sections[i]);
    }
  } else {
    addBladeFields(column, std::size_t(*curve_), std::size_t(count));
  }
  addFrame(column);
}

void SurfaceFields::addRow(FormColumn* column, int row, const PolesSurface& surface) {
  const QString title = curveTitle(bench_, std::size_t(row));
  column->addHeading(tr("%1, heights of its poles").arg(curveHeading(bench_, std::size_t(row))));
  for (int c = 0; c < surface.columns; ++c)
    column->add(tr("Pole %1").arg(c + 1),
                field([row, c](DesignedSurface& s)
                          -> double& { return std::get<PolesSurface>(s.shape).at(row, c).height; },
                      placeOfPole(bench_, row, c), tr("pole %1 of %2").arg(c + 1).arg(title)),
                tr("How high it lies"));
}

void SurfaceFields::addTangents(FormColumn* column, std::size_t section, const SectionCurve& curve) {
  for (std::size_t joint = 0; joint < jointCount(curve); ++joint) {
    if (joint == 0) column->addHeading(tr("Tangents"));
    const std::size_t pole = poleOfJoint(joint) + 1;
    const QString name = tr("tangent at pole %1 of %2").arg(pole).arg(curveTitle(bench_, section));
    auto* field = new NumberField({-360, 360, 2, 1, QString(QChar(0xb0))});
    field->setAccessibleName(name);
    column->add(
        tr("At pole %1").arg(pole), field,
        tr("Angle of the curve against x. It follows from the poles: the legs turn about the pole and "
           "keep their lengths. An expression here frees those of the legs"));
    connect(field, &NumberField::edited, this, [this, section, joint, name](double degrees) {
      edit(tr("Change %1").arg(name), [&](DesignedSurface& surface) {
        SectionCurve& own = std::get<SectionsSurface>(surface.shape).sections[section];
        own = withTangent(std::move(own), joint, degrees);
      });
    });
    const NumberPlace place = placeInSurface(
        bench_, "/sections/" + std::to_string(section) + "/tangents_deg/" + std::to_string(joint));
    bindNumber(bench_, field, place);
    tangents_.push_back({field, section, joint, place});
  }
}

void SurfaceFields::showTangents(const DesignedSurface& surface) {
  const auto* loft = std::get_if<SectionsSurface>(&surface.shape);
  const auto& bindings = bench_.design().bindings;
  for (const Tangent& tangent : tangents_) {
    // Of its turns the one that an expression came to.
    const auto bound = bindings.find(tangent.place());
    const std::optional<double> angle = tangentAt(loft->sections[tangent.section], tangent.joint,
                                                  bound == bindings.end() ? 0 : bound->second.value);
    tangent.field->setEnabled(angle.has_value());
    if (angle) tangent.field->show(asBound(bench_, tangent.place, *angle, kTangentMiss));
  }
}

void SurfaceFields::addFrame(FormColumn* column) {
  column->addHeading(tr("Where it lies"));
  for (int i = 0; i < 3; ++i) {
    const QString name = tr("Origin %1").arg(kAxes[std::size_t(i)]);
    column->add(name,
                field([i](DesignedSurface& s) -> double& { return s.origin[i]; },
                      placeInSurface(bench_, "/frame/origin/" + std::to_string(i)), name),
                tr("Of the frame that the surface is told in, in that of the design"));
  }
  for (int i = 0; i < 3; ++i) {
    const QString name = tr("Turned about %1").arg(kAxes[std::size_t(i)]);
    column->add(name,
                field([i](DesignedSurface& s) -> double& { return s.rotation[i]; },
                      placeInSurface(bench_, "/frame/rotation_deg/" + std::to_string(i)), name,
                      {2, 5, QString(QChar(0xb0)), kDegree, 360}),
                tr("Of its frame: about X, then the new Y, then the new Z"));
  }
}

}  // namespace bw::app
