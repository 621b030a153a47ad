// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/surface_fields.h"

#include <QApplication>
#include <QGridLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimer>
#include <QToolButton>

#include <algorithm>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/design/blade_bindings.h"
#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/resample.h"
#include "bw/core/shape/surface_blades.h"
#include "bw/core/text/number_text.h"
#include "controls/layout.h"
#include "controls/numbers.h"
#include "workflow/section_edits.h"

namespace bw::app {

namespace {

constexpr std::size_t kMostFields = 120;  // more numbers are for the file
constexpr int kGridFieldWidth = 62;
constexpr int kLineSpacing = 6;  // as between the lines of a form
constexpr int kMostColumns = 4;  // of poles beside each other; more scroll

std::string at(const std::string& list, std::size_t i) { return list + "/" + std::to_string(i); }

/// What the keyboard and the eye had in lines that are made anew: a line that goes would leave the keyboard
/// to whatever comes next, and that would come into sight.
class KeptPlace {
 public:
  /// `lines` are those of `layout`, which go.
  KeptPlace(QWidget& lines, const QLayout& layout) {
    for (QWidget* at = lines.parentWidget(); at && !area_; at = at->parentWidget())
      area_ = qobject_cast<QScrollArea*>(at);
    if (area_) scrolled_ = area_->verticalScrollBar()->value();
    QWidget* held = QApplication::focusWidget();
    bool goes = false;
    for (int i = 0; held && i < layout.count() && !goes; ++i)
      if (const QWidget* line = layout.itemAt(i)->widget()) goes = line->isAncestorOf(held);
    if (!goes) return;
    // A button gives it back, a field keeps it.
    if (!qobject_cast<QAbstractButton*>(held)) name_ = held->accessibleName();
    if (!name_.isEmpty() || !returnKeyboard(lines)) held->clearFocus();
  }
  void restore(const QWidget& made) const {
    for (QWidget* line : made.findChildren<QWidget*>())
      if (!name_.isEmpty() && line->accessibleName() == name_) line->setFocus();
    if (!area_) return;
    // Lines that went leave their room to those that came once these are laid out.
    QTimer::singleShot(0, area_, [area = area_, to = scrolled_] {
      if (QWidget* content = area->widget(); content && content->layout()) content->layout()->activate();
      area->verticalScrollBar()->setValue(to);
    });
  }

 private:
  QScrollArea* area_ = nullptr;
  int scrolled_ = 0;
  QString name_;
};

/// Why a section or a key blade, which `what` names, cannot lie at y; nothing if it can.
template <class Curve>
QString whyNotAt(const std::vector<Curve>& curves, std::size_t i, double y, const QString& what) {
  const auto mm = [](double length) { return QString::fromStdString(shortText(length, 6)); };
  if (i > 0 && y <= curves[i - 1].y)
    return SurfaceFields::tr("It must lie beyond %1 %2, at more than %3 mm")
        .arg(what)
        .arg(i)
        .arg(mm(curves[i - 1].y));
  if (i + 1 < curves.size() && y >= curves[i + 1].y)
    return SurfaceFields::tr("It must lie before %1 %2, at less than %3 mm")
        .arg(what)
        .arg(i + 2)
        .arg(mm(curves[i + 1].y));
  return {};
}

/// What lines are needed: its kind and its counts.
std::string structureOf(const DesignedSurface& surface) {
  std::string text = kShapeKinds[surface.shape.index()];
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape))
    text += " " + std::to_string(poles->columns) + " " + std::to_string(poles->rows);
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape))
    for (const SectionCurve& section : loft->sections)
      text += " " + std::to_string(int(section.kind)) + ":" + std::to_string(section.points.size());
  if (const auto* blades = std::get_if<BladesSurface>(&surface.shape))
    text += " " + std::to_string(blades->blades.size());
  return text;
}

/// The points of a section of another kind that looks like the one before.
Result<std::vector<Eigen::Vector2d>> pointsOfKind(SectionCurve::Kind kind, const SectionCurve& before) {
  const bool from = before.kind == SectionCurve::Kind::bezier, to = kind == SectionCurve::Kind::bezier;
  if (from == to) return before.points;
  if (to) {
    const Result<std::vector<CubicPoles>> chain = bezierChain(before.points);
    if (!chain) return tl::unexpected<Error>(chain.error());
    std::vector<Eigen::Vector2d> poles = {before.points.front()};
    for (const CubicPoles& cubic : *chain) poles.insert(poles.end(), cubic.begin() + 1, cubic.end());
    return poles;
  }
  std::vector<Eigen::Vector2d> points;
  if (before.points.size() > 4) {
    for (std::size_t i = 0; i < before.points.size(); i += 3) points.push_back(before.points[i]);
    return points;
  }
  const Result<PlanarCurve> curve = PlanarCurve::bezier(before.points);
  if (!curve) return tl::unexpected<Error>(curve.error());
  return curve->sample(int(before.points.size()));
}

/// A surface of another kind that looks like the one before: heights are taken from it, a formula begins as
/// an arch of its middle and its sides.
Result<SurfaceShape> shapeOfKind(int kind, const SplineSurface& before) {
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

QString missedAimText(std::size_t count, double deviation, double aim) {
  if (deviation <= aim) return {};
  return count < std::size_t(BladesSurface::kMost)
             ? QObject::tr("; %1 was aimed at, but nothing nearer was found").arg(lengthText(aim))
             : QObject::tr("; %1 was aimed at, but no more of them are taken").arg(lengthText(aim));
}

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

SurfaceFields::SurfaceFields(Workbench& bench, Shows shows, QWidget* parent)
    : QWidget(parent), bench_(bench), shows_(shows) {
  auto* all = makeBox<QVBoxLayout>(this, {}, shows == Shows::whole ? kLineSpacing : 0);
  if (shows == Shows::whole) {
    // Made once: whoever chooses by keyboard stays here while the lines below become others.
    auto* head = new FormColumn(this);
    kinds_ = head->add(tr("Surface"), new ChoiceField,
                       tr("How the surface is told; another kind begins near the one before"));
    kinds_->addItems({tr("Poles"), tr("Formula"), tr("Sections"), tr("Key blades")});
    connect(kinds_, &QComboBox::activated, this, &SurfaceFields::changeKind);
    all->addWidget(head);
  }
  layout_ = new QVBoxLayout;
  layout_->setContentsMargins({});
  layout_->setSpacing(0);
  all->addLayout(layout_);
  hide();
}

void SurfaceFields::refresh() {
  const Design& design = bench_.design();
  setVisible(bench_.source().surface.has_value());
  if (!bench_.source().surface) {
    empty(*layout_);
    built_.clear();
    numbers_.clear();
    ends_.clear();
    tangents_.clear();
    return;
  }
  DesignedSurface surface = *bench_.source().surface;
  std::string structure = structureOf(surface);
  if (curve_) structure += " of " + std::to_string(*curve_);
  for (const auto& [curve, name] : bench_.source().curveNames)
    structure += "\n" + std::to_string(curve) + " " + name;
  if (structure != built_) {
    rebuild(surface);
    built_ = structure;
  }
  if (kinds_) kinds_->show(int(surface.shape.index()));
  for (const Number& number : numbers_) number.field->show(number.get(surface) / number.scale);
  showEnds(surface);
  showTangents(surface);
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape); poles && columns_) {
    columns_->show(poles->columns);
    rows_->show(poles->rows);
  }
  if (const auto* graph = std::get_if<FormulaSurface>(&surface.shape); graph && formula_) {
    std::vector<std::string> names = {"x", "y"};
    for (const Variable& variable : design.variables) names.push_back(variable.name);
    formula_->show(graph->formula, std::move(names));
    formula_->setToolTip(QString::fromStdString(graph->formula));
  }
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) {
    if (lofts_) lofts_->show(int(loft->loft));
    for (const auto& [section, kind] : sectionKinds_) kind->show(int(loft->sections[section].kind));
  }
}

void SurfaceFields::rebuild(const DesignedSurface& surface) {
  const KeptPlace place(*this, *layout_);
  empty(*layout_);
  numbers_.clear();
  ends_.clear();
  tangents_.clear();
  sectionKinds_.clear();
  lofts_ = nullptr;
  columns_ = rows_ = nullptr;
  formula_ = nullptr;
  auto* column = new FormColumn(this);
  layout_->addWidget(column);
  if (shows_ == Shows::curve) return addCurve(column, surface);
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) addPoles(column, *poles);
  if (std::holds_alternative<FormulaSurface>(surface.shape)) addFormula(column);
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) addSections(column, *loft);
  if (const auto* blades = std::get_if<BladesSurface>(&surface.shape)) addBlades(column, *blades);
  place.restore(*column);
  // The keyboard goes from the kind through these lines, which came last.
  QWidget* before = kinds_;
  for (QWidget* line : column->findChildren<QWidget*>()) {
    if (line->window() != window() || !(line->focusPolicy() & Qt::TabFocus)) continue;
    setTabOrder(before, line);
    before = line;
  }
}

NumberField* SurfaceFields::field(const Get& get, const NumberPlace& place, const QString& name,
                                  const Unit& unit) {
  auto* field = new NumberField({-unit.most, unit.most, unit.decimals, unit.step, unit.suffix});
  field->setAccessibleName(name);
  field->setToolTip(name);
  connect(field, &NumberField::edited, this, [this, get, name, scale = unit.scale](double value) {
    edit(tr("Change %1").arg(name), [&](DesignedSurface& surface) { get(surface) = value * scale; });
  });
  // What no surface may have is refused where it is typed.
  field->setCheck([this, get, scale = unit.scale](double value) {
    const Result<Design> changed = changedBy([&](DesignedSurface& surface) { get(surface) = value * scale; });
    return changed ? QString() : bench_.asSentence(QString::fromStdString(changed.error().message));
  });
  bindNumber(bench_, field, place);
  numbers_.push_back({field, get, unit.scale});
  return field;
}

NumberField* SurfaceFields::endField(std::size_t blade, std::size_t end, const NumberPlace& place,
                                     const QString& name) {
  const Unit unit;
  auto* field = new NumberField({-unit.most, unit.most, unit.decimals, unit.step, unit.suffix});
  field->setAccessibleName(name);
  field->setToolTip(name);
  connect(field, &NumberField::edited, this, [this, blade, end, name](double height) {
    EndHeights heights;
    heights[end] = height;
    const auto& blades = std::get<BladesSurface>(bench_.source().surface->shape).blades;
    const Result<KeyBlade> turned = withEndHeights(blades[blade], heights);
    if (!turned) {
      bench_.tell(Topic::declined, turned.error());
      return refresh();
    }
    edit(tr("Change %1").arg(name),
         [&](DesignedSurface& surface) { std::get<BladesSurface>(surface.shape).blades[blade] = *turned; });
  });
  bindNumber(bench_, field, place);
  ends_.push_back({field, blade, end, place});
  return field;
}

void SurfaceFields::showEnds(const DesignedSurface& surface) {
  const auto* sweep = std::get_if<BladesSurface>(&surface.shape);
  for (const End& end : ends_)
    if (const auto ends = bladeEnds(sweep->blades[end.blade]))
      end.field->show(asBound(bench_, end.place, (*ends)[end.end].y(), kEndMiss));
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
          name,
          field([=](DesignedSurface& s) -> double& { return (last ? over(s).max : over(s).min)(axis); },
                placeInSurface(bench_, std::string("/") + char('x' + axis) + (last ? "/1" : "/0")), name));
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
      NumberField* pole = field(
          [r, c](DesignedSurface& s) -> double& { return std::get<PolesSurface>(s.shape).at(r, c).height; },
          placeOfPole(bench_, r, c), tr("pole %1 of %2").arg(c + 1).arg(curveTitle(bench_, std::size_t(r))));
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
  for (std::size_t i = 0; i < surface.sections.size(); ++i) addSectionFields(column, i, surface);
}

void SurfaceFields::addSectionFields(FormColumn* column, std::size_t i, const SectionsSurface& surface) {
  const SectionCurve& section = surface.sections[i];
  const bool bezier = section.kind == SectionCurve::Kind::bezier;
  const QString title = curveTitle(bench_, i);
  column->addHeading((bezier ? tr("%1, poles x, z") : tr("%1, points x, z")).arg(curveHeading(bench_, i)));
  auto* kind = column->add(
      tr("Curve"), new ChoiceField,
      tr("Bézier: cubics that meet with one tangent. Spline: one curvature. Ducks: the elastic spline that "
         "slides through its points. Another kind begins near the one before"));
  kind->addItems({tr("Bézier"), tr("Spline"), tr("Ducks")});
  kind->setAccessibleName(tr("Curve of %1").arg(title));
  connect(kind, &QComboBox::activated, this,
          [this, i](int chosen) { changeSectionKind(i, SectionCurve::Kind(chosen)); });
  sectionKinds_.emplace_back(i, kind);
  const auto of = [i](DesignedSurface& s) -> SectionCurve& {
    return std::get<SectionsSurface>(s.shape).sections[i];
  };
  const std::string place = at("/sections", i);
  const QString name = tr("y of %1").arg(title);
  NumberField* along = field([of](DesignedSurface& s) -> double& { return of(s).y; },
                             placeInSurface(bench_, place + "/y"), name);
  along->setCheck([this, i](double y) {
    return whyNotAt(std::get<SectionsSurface>(bench_.source().surface->shape).sections, i, y, tr("section"));
  });
  column->add(tr("At y"), along);
  auto* area = new QWidget;
  auto* grid = new QGridLayout(area);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  for (std::size_t p = 0; p < section.points.size(); ++p)
    for (const int axis : {0, 1}) {
      NumberField* number =
          field([of, p, axis](DesignedSurface& s) -> double& { return of(s).points[p](axis); },
                placeInSurface(bench_,
                               at(at(place + "/" + kSectionKinds[int(section.kind)], p), std::size_t(axis))),
                tr("%1 of point %2 of %3").arg(axis == 0 ? "x" : "z").arg(p + 1).arg(title));
      grid->addWidget(number, int(p), axis);
    }
  // Numbers alone stand where one curve is told.
  for (std::size_t p = 0; p < section.points.size() && shows_ == Shows::whole; ++p) {
    auto* gone = new QToolButton;
    gone->setText(QChar(0xd7));
    gone->setAccessibleName(tr("Remove point %1 of %2").arg(p + 1).arg(title));
    gone->setToolTip(bezier ? tr("Takes the pole away, of a chain the joint next to it with its legs")
                            : tr("Takes the point away"));
    gone->setEnabled(section.points.size() > 2);
    connect(gone, &QToolButton::clicked, this, [this, i, p] { removePoint(bench_, i, p); });
    grid->addWidget(gone, int(p), 2);
  }
  column->addWide(area);
  if (shows_ == Shows::whole) addSectionButtons(column, i, surface.sections.size());
}

void SurfaceFields::addSectionButtons(FormColumn* column, std::size_t section, std::size_t count) {
  auto* buttons = new QWidget;
  auto* row = new FlowLayout(buttons);
  row->setContentsMargins({});
  row->setSpacing(4);
  const auto add = [&](const QString& text, const QString& name, const QString& tip, auto run) {
    QPushButton* button = makeButton(text, tip, this, run);
    button->setAccessibleName(name.arg(curveTitle(bench_, section)));
    row->addWidget(button);
    return button;
  };
  add(tr("Add point"), tr("Add a point to %1"),
      tr("A point more before the last one; the handles in the picture add them anywhere"), [this, section] {
        const auto& loft = std::get<SectionsSurface>(bench_.source().surface->shape);
        addPoint(bench_, section, loft.sections[section].points.size() - 2);
      });
  add(tr("Add section"), tr("Add a section after %1"),
      tr("A section more halfway to the next one, as the surface is there; beyond the last one it goes on"),
      [this, section] { addSection(bench_, section); });
  QPushButton* less = add(tr("Remove"), tr("Remove %1"),
                          count > 2 ? tr("Takes the section away") : tr("A loft keeps two sections"),
                          [this, section] { removeSection(bench_, section); });
  less->setEnabled(count > 2);
  column->addWide(buttons);
}

void SurfaceFields::addBlades(FormColumn* column, const BladesSurface& surface) {
  constexpr std::size_t kMost = 15;
  const std::size_t count = surface.blades.size();
  if (count > kMost) {
    column->addWide(makeNote(
        tr("%1 key blades are too many for fields; their numbers are in the design file.").arg(count)));
    return;
  }
  column->addWide(
      makeNote(tr("Between the key blades all numbers run smoothly, so that every blade of the "
                  "surface is an elastica.")));
  for (std::size_t i = 0; i < count; ++i) addBladeFields(column, i, count);
}

void SurfaceFields::addBladeFields(FormColumn* column, std::size_t i, std::size_t count) {
  const QString title = curveTitle(bench_, i);
  column->addHeading(curveHeading(bench_, i));
  const auto of = [i](DesignedSurface& s) -> KeyBlade& { return std::get<BladesSurface>(s.shape).blades[i]; };
  const std::string place = at("/blades", i);
  const auto add = [&](const QString& label, const Get& get, const std::string& key, const Unit& unit,
                       const QString& tip) {
    const QString name = tr("%1 of %2").arg(label, title);
    return column->add(label, field(get, placeInSurface(bench_, place + key), name, unit), tip);
  };
  const Unit mm, bare{3, 0.1, {}, 1};
  NumberField* along = add(
      tr("At y"), [of](DesignedSurface& s) -> double& { return of(s).y; }, "/y", mm,
      tr("Its place along the travel"));
  along->setCheck([this, i](double y) {
    return whyNotAt(std::get<BladesSurface>(bench_.source().surface->shape).blades, i, y, tr("key blade"));
  });
  add(
      tr("Middle x"), [of](DesignedSurface& s) -> double& { return of(s).middle.x(); }, "/middle/0", mm,
      tr("Where the middle of the blade lies"));
  add(
      tr("Middle z"), [of](DesignedSurface& s) -> double& { return of(s).middle.y(); }, "/middle/1", mm,
      tr("How high the middle of the blade lies"));
  add(
      tr("Lean"), [of](DesignedSurface& s) -> double& { return of(s).angle; }, "/angle_deg",
      {2, 1, QStringLiteral("°"), kDegree}, tr("Angle of the tangent at the middle"));
  add(
      tr("Turn"), [of](DesignedSurface& s) -> double& { return of(s).turn; }, "/turn_deg",
      {2, 1, QStringLiteral("°"), kDegree},
      tr("Of the blade's plane about the upright line through its middle, seen from above against the clock; "
         "0 lies across the travel. Planes must not meet in the block"));
  for (const std::size_t end : {0u, 1u}) {
    const QString label = end == 0 ? tr("−x end z") : tr("+x end z");
    column->add(
        label,
        endField(i, end, placeInSurface(bench_, place + "/end_heights/" + std::to_string(end)),
                 tr("%1 of %2").arg(label, title)),
        tr("How high this end of the blade lies; the blade is turned about its other end, as it is. An "
           "expression here frees those of middle and lean"));
  }
  add(
      tr("Length"), [of](DesignedSurface& s) -> double& { return of(s).length; }, "/length_mm", mm,
      tr("From end to end of the curve; the blade goes on beyond"));
  add(
      tr("Bend"), [of](DesignedSurface& s) -> double& { return of(s).bend; }, "/bend", bare,
      tr("Curvature at the middle times the length: the turning of an arc of that curvature, rad; below 0 "
         "for an arch"));
  add(
      tr("Force along"), [of](DesignedSurface& s) -> double& { return of(s).force.x(); }, "/force/0", bare,
      tr("Force along the tangent at the middle, times length squared over stiffness"));
  add(
      tr("Force across"), [of](DesignedSurface& s) -> double& { return of(s).force.y(); }, "/force/1", bare,
      tr("Force across the blade at the middle, times length squared over stiffness: it makes the blade "
         "bend more to one side"));
  if (shows_ == Shows::curve) return;
  auto* buttons = new QWidget;
  auto* row = makeBox<QHBoxLayout>(buttons, {}, 4);
  auto* more = new QPushButton(tr("Add one after"));
  more->setAccessibleName(tr("Add a key blade after %1").arg(title));
  more->setToolTip(tr("The blade halfway to the next one, as it is"));
  more->setEnabled(i + 1 < count);
  connect(more, &QPushButton::clicked, this, [this, i] { addBlade(bench_, i); });
  auto* less = new QPushButton(tr("Remove"));
  less->setAccessibleName(tr("Remove %1").arg(title));
  less->setToolTip(count > 2 ? tr("The blades beside it run into each other then")
                             : tr("A surface has two key blades at least"));
  less->setEnabled(count > 2);
  connect(less, &QPushButton::clicked, this, [this, i] { removeBlade(bench_, i); });
  row->addWidget(more);
  row->addWidget(less);
  row->addStretch();
  column->addWide(buttons);
}

void SurfaceFields::changeSectionKind(std::size_t section, SectionCurve::Kind kind) {
  SectionsSurface surface = std::get<SectionsSurface>(bench_.source().surface->shape);
  SectionCurve& curve = surface.sections[section];
  if (kind == curve.kind) return;
  Result<std::vector<Eigen::Vector2d>> points = pointsOfKind(kind, curve);
  if (!points) {
    bench_.tell(Topic::declined, points.error());
    return refresh();
  }
  curve.points = std::move(*points);
  curve.kind = kind;
  replace(tr("Change curve of %1").arg(curveTitle(bench_, section)), std::move(surface));
}

std::string SurfaceFields::pointer() const {
  return "/sources/" + std::to_string(&bench_.source() - bench_.design().sources.data()) + "/surface";
}

Result<Design> SurfaceFields::changedBy(const std::function<void(DesignedSurface&)>& change) const {
  Design changed = bench_.design();
  change(*changed.sourceOf(bench_.cut()).surface);
  if (Result<void> ok = holdEnds(changed, bench_.design()); !ok) return tl::unexpected<Error>(ok.error());
  holdTangents(changed, bench_.design());
  return resolved(changed);
}

void SurfaceFields::edit(const QString& text, const std::function<void(DesignedSurface&)>& change) {
  Result<Design> changed = changedBy(change);
  if (changed) return bench_.editDesign(text, [&](Design& design) { design = std::move(*changed); });
  bench_.tell(Topic::declined, changed.error());
  refresh();
}

void SurfaceFields::take(const QString& text, const Design& changed) {
  Result<Design> read = resolved(changed);
  if (read) return bench_.editDesign(text, [&read](Design& design) { design = std::move(*read); });
  bench_.tell(Topic::declined, read.error());
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
    bench_.tell(Topic::declined, before.error());
    refresh();
    return;
  }
  const double near = kKeyBladeShare * bench_.design().process.tolerance;
  QString told;
  Severity severity = Severity::info;
  Result<SurfaceShape> shape = [&]() -> Result<SurfaceShape> {
    if (kind != 3) return shapeOfKind(kind, *before);
    Result<SurfaceBlades> found = fewestBladesOf(*before, near);
    if (!found) return tl::unexpected<Error>(found.error());
    if (found->deviation > near) severity = Severity::warning;
    told = tr("%1 key blades, within %2 of the surface that they were made from (the farthest at y = %3)")
               .arg(found->shape.blades.size())
               .arg(lengthText(found->deviation), QString::fromStdString(shortText(found->worst, 6))) +
           missedAimText(found->shape.blades.size(), found->deviation, near);
    return std::move(found->shape);
  }();
  if (!shape) {
    bench_.tell(Topic::declined, shape.error());
    return refresh();
  }
  replace(tr("Change kind of surface"), *shape);
  // Nothing of one that was refused, which is told.
  if (!told.isEmpty() && bench_.source().surface->shape == *shape) bench_.tell(Topic::made, severity, told);
}

void SurfaceFields::changeCounts(int columns, int rows) {
  const auto& poles = std::get<PolesSurface>(bench_.source().surface->shape);
  Result<PolesSurface> other = resampled(poles, columns, rows);
  if (other) return replace(tr("Change number of poles"), std::move(*other));
  bench_.tell(Topic::declined, other.error());
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
