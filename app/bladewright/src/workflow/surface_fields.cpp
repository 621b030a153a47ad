// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/surface_fields.h"

#include <QGridLayout>
#include <QScrollArea>
#include <QScrollBar>

#include <algorithm>

#include "bw/core/shape/resample.h"
#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

constexpr double kFarthest = 1e7;         // mm
constexpr std::size_t kMostFields = 120;  // more numbers are for the file
constexpr int kGridFieldWidth = 62;
constexpr int kMostColumns = 4;  // of poles beside each other; more scroll

std::string at(const std::string& list, std::size_t i) { return list + "/" + std::to_string(i); }

/// What lines are needed: its kind and its counts.
std::string structureOf(const DesignedSurface& surface) {
  std::string text = kShapeKinds[surface.shape.index()];
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape))
    text += " " + std::to_string(poles->columns) + " " + std::to_string(poles->rows);
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape))
    for (const SectionCurve& section : loft->sections)
      text += " " + std::to_string(int(section.kind)) + ":" + std::to_string(section.points.size());
  return text;
}

/// A surface of another kind that looks like the one before: heights are taken from it, a formula begins as
/// an arch of its middle and its sides.
SurfaceShape shapeOfKind(int kind, const SplineSurface& before) {
  const auto point = [&](double u, double v) {
    const auto between = [](const std::vector<double>& knots, double share) {
      return knots.front() + share * (knots.back() - knots.front());
    };
    return before.value(between(before.knotsU, u), between(before.knotsV, v));
  };
  const Eigen::Vector3d from = point(0, 0), to = point(1, 1), middle = point(0.5, 0.5), side = point(0, 0.5);
  const Rectangle over{from.head<2>(), to.head<2>()};
  if (kind == 0) {
    PolesSurface surface;
    surface.over = over;
    for (int r = 0; r < surface.rows; ++r)
      for (int c = 0; c < surface.columns; ++c)
        surface.at(r, c).height = point(c / double(surface.columns - 1), r / double(surface.rows - 1)).z();
    return surface;
  }
  if (kind == 1) {
    const double half = 0.5 * (to.x() - from.x()), center = 0.5 * (from.x() + to.x());
    return FormulaSurface{over,
                          shortText(middle.z(), 4) + " - " +
                              shortText(std::max(0.0, middle.z() - side.z()), 4) + "*((x - " +
                              shortText(center, 6) + ")/" + shortText(half, 6) + ")^2",
                          {}};
  }
  SectionsSurface surface;
  for (const double v : {0.0, 0.5, 1.0}) {
    SectionCurve section{point(0, v).y(), SectionCurve::Kind::spline, {}};
    for (const double u : {0.0, 1.0 / 3, 2.0 / 3, 1.0}) {
      const Eigen::Vector3d p = point(u, v);
      section.points.emplace_back(p.x(), p.z());
    }
    surface.sections.push_back(std::move(section));
  }
  return surface;
}

}  // namespace

FormulaField::FormulaField(QWidget* parent) : TypedField(parent) {}

void FormulaField::show(const std::string& formula, std::vector<std::string> names) {
  const bool changed = formula != formula_;
  formula_ = formula;
  names_ = std::move(names);
  showValue(changed);
}

QString FormulaField::take(const QString& text) {
  const std::string formula = text.trimmed().toStdString();
  if (const Result<Expression> read = Expression::parse(formula, names_); !read) {
    QString why = QString::fromStdString(read.error().message);
    why[0] = why[0].toUpper();
    return why;
  }
  if (formula == formula_) return {};
  formula_ = formula;
  emit edited(formula);
  return {};
}

void FormulaField::focusOutEvent(QFocusEvent* event) {
  TypedField::focusOutEvent(event);
  if (!typing()) setCursorPosition(0);  // its beginning says most
}

SurfaceFields::SurfaceFields(Workbench& bench, QWidget* parent)
    : QWidget(parent), bench_(bench), layout_(makeBox<QVBoxLayout>(this, {}, 0)) {
  hide();
}

void SurfaceFields::refresh() {
  const Design& design = bench_.design();
  setVisible(bench_.source().surface.has_value());
  if (!bench_.source().surface) {
    empty(*layout_);
    built_.clear();
    numbers_.clear();
    return;
  }
  DesignedSurface surface = *bench_.source().surface;
  if (const std::string structure = structureOf(surface); structure != built_) {
    rebuild(surface);
    built_ = structure;
  }
  kinds_->show(int(surface.shape.index()));
  for (const Number& number : numbers_) {
    number.field->show(number.get(surface));
    auto bound = design.bindings.find(pointer() + number.place);
    if (bound == design.bindings.end()) bound = design.bindings.find(pointer() + number.place + "/height");
    number.field->setToolTip(bound == design.bindings.end()
                                 ? number.tip
                                 : number.tip + "\n" +
                                       tr("= %1; a number typed here takes its place")
                                           .arg(QString::fromStdString(bound->second.text)));
  }
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) {
    columns_->show(poles->columns);
    rows_->show(poles->rows);
  }
  if (const auto* graph = std::get_if<FormulaSurface>(&surface.shape)) {
    std::vector<std::string> names = {"x", "y"};
    for (const Variable& variable : design.variables) names.push_back(variable.name);
    formula_->show(graph->formula, std::move(names));
    formula_->setToolTip(QString::fromStdString(graph->formula));
  }
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) lofts_->show(int(loft->loft));
}

void SurfaceFields::rebuild(const DesignedSurface& surface) {
  empty(*layout_);
  numbers_.clear();
  auto* column = new FormColumn(this);
  layout_->addWidget(column);
  kinds_ = column->add(tr("Surface"), new ChoiceField,
                       tr("How the surface is told; another kind begins near the one before"));
  kinds_->addItems({tr("Poles"), tr("Formula"), tr("Sections")});
  connect(kinds_, &QComboBox::activated, this, &SurfaceFields::changeKind);
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) addPoles(column, *poles);
  if (std::holds_alternative<FormulaSurface>(surface.shape)) addFormula(column);
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) addSections(column, *loft);
}

NumberField* SurfaceFields::field(const Get& get, const std::string& place, const QString& name) {
  auto* field = new NumberField({-kFarthest, kFarthest, 2, 5, "mm"});
  field->setAccessibleName(name);
  connect(field, &NumberField::edited, this, [this, get, name](double value) {
    edit(tr("Change %1").arg(name), [&](DesignedSurface& surface) { get(surface) = value; });
  });
  numbers_.push_back({field, get, place, name});
  return field;
}

void SurfaceFields::addRectangle(FormColumn* column) {
  const auto over = [](DesignedSurface& surface) -> Rectangle& {
    if (auto* poles = std::get_if<PolesSurface>(&surface.shape)) return poles->over;
    return std::get<FormulaSurface>(surface.shape).over;
  };
  for (const int axis : {0, 1})
    for (const bool last : {false, true}) {
      const QString name = (last ? tr("%1 to") : tr("%1 from")).arg(QLatin1Char(char('x' + axis)));
      column->add(
          name, field([=](DesignedSurface& s) -> double& { return (last ? over(s).max : over(s).min)(axis); },
                      std::string("/") + char('x' + axis) + "/" + (last ? "1" : "0"), name));
    }
}

void SurfaceFields::addPoles(FormColumn* column, const PolesSurface& surface) {
  const auto addCount = [&](const QString& name, int degree, bool across) {
    auto* count = column->add(name, new NumberField({degree + 1.0, PolesSurface::kMost, 0, 1, {}}),
                              tr("The surface stays as near to itself as that many poles let it"));
    connect(count, &NumberField::edited, this, [this, across](double value) {
      const auto& poles = std::get<PolesSurface>(bench_.source().surface->shape);
      changeCounts(across ? int(value) : poles.columns, across ? poles.rows : int(value));
    });
    return count;
  };
  columns_ = addCount(tr("Poles across"), surface.degreeX, true);
  rows_ = addCount(tr("Poles along"), surface.degreeY, false);
  column->addHeading(tr("Heights of the poles"));
  if (surface.poles.size() > kMostFields) {
    column->addWide(
        makeNote(tr("%1 × %2 poles are too many for fields; their numbers are in the design file.")
                     .arg(surface.columns)
                     .arg(surface.rows)));
    return addRectangle(column);
  }
  column->addWide(makeNote(tr("mm, as seen from above")));
  auto* area = new QWidget;
  auto* grid = new QGridLayout(area);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  // As seen from above: the travel goes up. The keyboard goes through them in this order too.
  for (int r = surface.rows - 1; r >= 0; --r)
    for (int c = 0; c < surface.columns; ++c) {
      const std::string place = at(at("/poles", std::size_t(r)), std::size_t(c));
      NumberField* pole = field(
          [r, c](DesignedSurface& s) -> double& { return std::get<PolesSurface>(s.shape).at(r, c).height; },
          place, tr("pole %1 of row %2").arg(c + 1).arg(r + 1));
      pole->setSuffix(" ");  // the unit stands above, and is understood
      pole->setFixedWidth(kGridFieldWidth);
      grid->addWidget(pole, surface.rows - 1 - r, c);
    }
  if (surface.columns <= kMostColumns) {
    column->addWide(area);
  } else {
    auto* scroll = column->addWide(new QScrollArea);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(area);
    scroll->setFixedHeight(area->sizeHint().height() + scroll->horizontalScrollBar()->sizeHint().height());
  }
  column->addGap();
  addRectangle(column);
}

void SurfaceFields::addFormula(FormColumn* column) {
  column->addWide(makeNote(tr("z in mm, by x, y and the variables")));
  formula_ = column->addWide(new FormulaField);
  formula_->setAccessibleName(tr("Formula"));
  connect(formula_, &FormulaField::edited, this, [this](const std::string& formula) {
    edit(tr("Change formula"),
         [&](DesignedSurface& surface) { std::get<FormulaSurface>(surface.shape).formula = formula; });
  });
  addRectangle(column);
}

void SurfaceFields::addSections(FormColumn* column, const SectionsSurface& surface) {
  lofts_ = column->add(
      tr("Loft"), new ChoiceField,
      tr("How far apart sections lie for the loft: as their distance, its square root (tight), or evenly"));
  lofts_->addItems({tr("By chord"), tr("By its root"), tr("Evenly")});
  connect(lofts_, &QComboBox::activated, this, [this](int index) {
    edit(tr("Change loft"),
         [index](DesignedSurface& s) { std::get<SectionsSurface>(s.shape).loft = LoftSpacing(index); });
  });
  std::size_t count = 0;
  for (const SectionCurve& section : surface.sections) count += 1 + 2 * section.points.size();
  if (count > kMostFields) {
    column->addWide(
        makeNote(tr("%1 numbers are too many for fields; they are in the design file.").arg(count)));
    return;
  }
  for (std::size_t i = 0; i < surface.sections.size(); ++i) {
    const SectionCurve& section = surface.sections[i];
    const bool bezier = section.kind == SectionCurve::Kind::bezier;
    column->addHeading(bezier ? tr("Section %1, poles x, z").arg(i + 1)
                              : tr("Section %1, points x, z").arg(i + 1));
    const auto of = [i](DesignedSurface& s) -> SectionCurve& {
      return std::get<SectionsSurface>(s.shape).sections[i];
    };
    const std::string place = at("/sections", i);
    const QString name = tr("y of section %1").arg(i + 1);
    column->add(tr("At y"),
                field([of](DesignedSurface& s) -> double& { return of(s).y; }, place + "/y", name));
    auto* area = new QWidget;
    auto* grid = new QGridLayout(area);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(4);
    for (std::size_t p = 0; p < section.points.size(); ++p)
      for (const int axis : {0, 1}) {
        NumberField* number =
            field([of, p, axis](DesignedSurface& s) -> double& { return of(s).points[p](axis); },
                  at(at(place + (bezier ? "/bezier" : "/spline"), p), std::size_t(axis)),
                  tr("%1 of point %2 of section %3").arg(axis == 0 ? "x" : "z").arg(p + 1).arg(i + 1));
        grid->addWidget(number, int(p), axis);
      }
    column->addWide(area);
  }
}

std::string SurfaceFields::pointer() const {
  return "/sources/" + std::to_string(&bench_.source() - bench_.design().sources.data()) + "/surface";
}

void SurfaceFields::edit(const QString& text, const std::function<void(DesignedSurface&)>& change) {
  Design changed = bench_.design();
  change(*changed.sourceOf(bench_.cut()).surface);
  take(text, changed);
}

void SurfaceFields::take(const QString& text, const Design& changed) {
  Result<Design> read = resolved(changed);
  if (read) return bench_.editDesign(text, [&read](Design& design) { design = std::move(*read); });
  bench_.tell(Topic::other, read.error());
  refresh();
}

void SurfaceFields::changeKind(int kind) {
  const DesignedSurface& surface = *bench_.source().surface;
  if (kind == int(surface.shape.index())) return;
  DesignedSurface own = surface;
  own.origin.setZero();
  own.rotation.setZero();
  const Result<SplineSurface> before = splineOf(own);
  if (!before) {
    bench_.tell(Topic::other, before.error());
    refresh();
    return;
  }
  replace(tr("Change kind of surface"), shapeOfKind(kind, *before));
}

void SurfaceFields::changeCounts(int columns, int rows) {
  const auto& poles = std::get<PolesSurface>(bench_.source().surface->shape);
  Result<PolesSurface> other = resampled(poles, columns, rows);
  if (other) return replace(tr("Change number of poles"), std::move(*other));
  bench_.tell(Topic::other, other.error());
  refresh();
}

void SurfaceFields::replace(const QString& text, SurfaceShape shape) {
  Design changed = bench_.design();
  changed.sourceOf(bench_.cut()).surface->shape = std::move(shape);
  std::erase_if(changed.bindings,
                [own = pointer() + "/"](const auto& bound) { return bound.first.starts_with(own); });
  take(text, changed);
}

}  // namespace bw::app
