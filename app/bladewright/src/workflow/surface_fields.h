// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "controls/fields.h"
#include "controls/number_field.h"
#include "controls/typed_field.h"
#include "workbench/workbench.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// How the sentence goes on that tells how near so many key blades come, where they miss the aim; else empty.
QString missedAimText(std::size_t count, double deviation, double aim);

/// A line that holds a formula of x, y and the variables; what cannot be read stays as typed, with the
/// character.
class FormulaField : public TypedField {
  Q_OBJECT

 public:
  explicit FormulaField(QWidget* parent = nullptr);
  void show(const std::string& formula, std::vector<std::string> names);
  using QWidget::show;

 signals:
  void edited(const std::string& formula);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override { return QString::fromStdString(formula_); }

 private:
  std::string formula_;
  std::vector<std::string> names_;
};

/// The numbers of a designed surface: its kind, the heights of its poles, its formula, its sections, or its
/// key blades; or of one of its curves (`bw/core/design/surface_curves.h`) with the place of its frame
/// (curve_fields.cpp). Hidden where the source is a file. Edits go to the design.
class SurfaceFields : public QWidget {
  Q_OBJECT

 public:
  enum class Shows { whole, curve };
  explicit SurfaceFields(Workbench& bench, Shows shows = Shows::whole, QWidget* parent = nullptr);
  void refresh();
  /// The curve whose numbers the next refresh shows, counted from 0; nothing: what belongs to none.
  void setCurve(const std::optional<int>& curve) { curve_ = curve; }

 private:
  using Get = std::function<double&(DesignedSurface&)>;

  /// Lines for a surface of this kind and these counts.
  void rebuild(const DesignedSurface& surface);
  void addPoles(FormColumn* column, const PolesSurface& surface);
  void addFormula(FormColumn* column);
  void addSections(FormColumn* column, const SectionsSurface& surface);
  void addSectionFields(FormColumn* column, std::size_t i, const SectionsSurface& surface);
  void addSectionButtons(FormColumn* column, std::size_t section, std::size_t count);
  void addBlades(FormColumn* column, const BladesSurface& surface);
  void addBladeFields(FormColumn* column, std::size_t i, std::size_t count);
  /// The lines of one curve, or of none.
  void addCurve(FormColumn* column, const DesignedSurface& surface);
  void addRow(FormColumn* column, int row, const PolesSurface& surface);
  void addTangents(FormColumn* column, std::size_t section, const SectionCurve& curve);
  void addFrame(FormColumn* column);
  void addRectangle(FormColumn* column);
  /// How a number is shown and typed: `scale` of it is one of the unit, in which the file has it, too.
  struct Unit {
    int decimals = 2;
    double step = 5;
    QString suffix = QStringLiteral("mm");
    double scale = 1;
    double most = 1e7;  ///< of it, either way
  };
  /// A field for a number of the surface, in the file at this place.
  NumberField* field(const Get& get, const NumberPlace& place, const QString& name, const Unit& unit);
  NumberField* field(const Get& get, const NumberPlace& place, const QString& name) {
    return field(get, place, name, Unit());
  }
  /// The JSON pointer of the surface shown.
  std::string pointer() const;
  /// The design with such a surface; an error where that is none.
  Result<Design> changedBy(const std::function<void(DesignedSurface&)>& change) const;
  void edit(const QString& text, const std::function<void(DesignedSurface&)>& change);
  /// Takes a changed design, resolved, or tells why not.
  void take(const QString& text, const Design& changed);
  void changeKind(int kind);
  void changeCounts(int columns, int rows);
  void changeSectionKind(std::size_t section, SectionCurve::Kind kind);
  /// One more blade halfway to the next (or before the last), or one less.
  /// Another surface in the place of this one, whose expressions are gone.
  void replace(const QString& text, SurfaceShape shape);

  struct Number {
    NumberField* field;
    Get get;
    double scale = 1;
  };
  /// The height of an end of a key blade, 0 left, 1 right: it follows from the other numbers, and turns the
  /// blade about its other end where it is typed.
  struct End {
    NumberField* field;
    std::size_t blade, end;
    NumberPlace place;
  };
  NumberField* endField(std::size_t blade, std::size_t end, const NumberPlace& place, const QString& name);
  void showEnds(const DesignedSurface& surface);
  /// The direction of the tangent at a joint or an end of a chain of cubics: it follows from the poles, and
  /// turns the legs beside it where it is typed.
  struct Tangent {
    NumberField* field;
    std::size_t section, joint;
    NumberPlace place;
  };
  void showTangents(const DesignedSurface& surface);
  Workbench& bench_;
  Shows shows_;
  std::optional<int> curve_;
  QVBoxLayout* layout_ = nullptr;  ///< of the lines
  std::string built_;              ///< what the lines are for
  ChoiceField* kinds_ = nullptr;   ///< stays; those below are made for each kind
  ChoiceField* lofts_ = nullptr;
  std::vector<std::pair<std::size_t, ChoiceField*>> sectionKinds_;  ///< by their section
  NumberField *columns_ = nullptr, *rows_ = nullptr;
  FormulaField* formula_ = nullptr;
  std::vector<Number> numbers_;
  std::vector<End> ends_;
  std::vector<Tangent> tangents_;
};

}  // namespace bw::app
