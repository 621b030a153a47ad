// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Every field of the real window that is typed into, each in a state of the window in which it is seen.
#pragma once

#include <QPointer>
#include <QScrollArea>
#include <QSet>

#include "bw/core/design/grid_change.h"
#include "window_fixture.h"

namespace bw::app {

class EveryFieldTest : public WindowTest {
 protected:
  /// Calls `visit` for every field, on a design that is the same for each, and requires that none was missed.
  void visitFields(const std::function<void(TypedField&)>& visit) {
    openPanel(4);
    for (QToolButton* fold : window().findChildren<QToolButton*>())
      if (fold->isCheckable() && fold->isVisible() && !fold->isChecked() &&
          QStringList{"Section and material", "Block", "Fit and lead"}.contains(fold->text()))
        fold->click();
    const auto edit = [&](const std::function<void(Design&)>& change) {
      bench().editDesign("Prepare", change);
    };
    const auto inspect = [&](Selection::Kind kind) { bench().select({kind, 0}); };
    // Stations by number, vectors, a block by numbers, faces by number, a tube; then what excludes these.
    edit([](Design& design) {
      design.cut().direction = Eigen::Vector3d(0.1, 1, 0);
      design.process.up = Eigen::Vector3d(0.1, 0, 1);
      design.block().placement = BlockPlacement{{-10, -10, -200}, {700, 700, 600}, {0.1, 0.2, 0.3}};
      design.cut().face = {FaceChoice::Kind::indices, {0}};
    });
    visitVisible(visit);
    for (Selection::Kind kind : {Selection::Kind::block, Selection::Kind::blade, Selection::Kind::station}) {
      bench().document().undoStack().setIndex(1);
      inspect(kind);
      visitVisible(visit);
    }
    edit([](Design& design) {
      design.cut().sections.spacing = 25;
      design.blade = bladePreset("nicr-flat-5x1").value_or(design.blade);
      design.blade.length = 900;
    });
    base_ = 2;
    inspect(Selection::Kind::blade);
    visitVisible(visit);
    edit([](Design& design) {
      const double length = design.blade.length;
      design.blade = bladePreset("steel-tube-3-2.5").value_or(design.blade);
      design.blade.length = length;
      design.cut().length = length;
      design.cut().face.kind = FaceChoice::Kind::nearest;
    });
    base_ = 3;
    inspect(Selection::Kind::blade);
    visitVisible(visit);
    window().commands()["tab.blocks"]->trigger();
    visitVisible(visit);
    edit([](Design& design) {
      const BlockGrid before = *gridOf(design, *design.block().placement);
      BlockGrid grid = before;
      for (std::size_t way = 0; way < 3; ++way) grid = withCount(grid, way, 2, true);
      design = withGrid(design, before, grid, design.block().id).value();
    });
    base_ = 4;
    window().commands()["tab.blocks"]->trigger();
    visitVisible(visit);
    window().commands()["tab.versions"]->trigger();
    visitVisible(visit);
    window().showMeasurePage();
    visitVisible(visit);
    for (TypedField* field : window().findChildren<TypedField*>())
      EXPECT_TRUE(visited_.contains(field) || names_.contains(nameOf(*field)))
          << "never seen: " << field->accessibleName().toStdString();
  }

  /// Back to the design before a field was tried.
  void undoAll() { bench().document().undoStack().setIndex(base_); }

  /// Types with key events, whatever the letters.
  static void type(QWidget& field, const QString& text) {
    for (QChar c : text)
      QTest::sendKeyEvent(QTest::Click, &field,
                          c.unicode() < 0x80 ? QTest::asciiToKey(char(c.unicode())) : Qt::Key_unknown,
                          QString(c), Qt::NoModifier);
  }

  /// Gives the keyboard to a field and types over what it holds.
  static void typeOver(TypedField& field, const QString& text) {
    field.setFocus();
    field.selectAll();
    if (text.isEmpty())
      QTest::keyClick(&field, Qt::Key_Delete);
    else
      type(field, text);
  }

  int base_ = 1;

 private:
  /// "Offset" of "Offset, cut-1": that of any line of the table.
  static QString nameOf(const TypedField& field) { return field.accessibleName().section(", ", 0, 0); }

  void visitVisible(const std::function<void(TypedField&)>& visit) {
    // Lines of a table are made anew when a visit changes what they are of: those are known by their names.
    bool isFirst = true;
    for (bool more = true; more; isFirst = false) {
      more = false;
      QList<QPointer<TypedField>> fields;
      for (TypedField* field : window().findChildren<TypedField*>()) fields << field;
      for (const QPointer<TypedField>& field : fields) {
        if (!field || !field->isVisible() || !field->isEnabled() || visited_.contains(field)) continue;
        const QString name = nameOf(*field);
        if (!isFirst && names_.contains(name)) continue;
        visited_ << field;
        names_ << name;
        more = true;
        for (QWidget* at = field->parentWidget(); at; at = at->parentWidget())
          if (auto* area = qobject_cast<QScrollArea*>(at)) area->ensureWidgetVisible(field);
        SCOPED_TRACE(name.toStdString());
        visit(*field);
        undoAll();
      }
    }
  }

  QSet<TypedField*> visited_;
  QSet<QString> names_;
};

}  // namespace bw::app
