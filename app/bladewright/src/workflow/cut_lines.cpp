// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/cut_lines.h"

#include <algorithm>

#include "workflow/bound_number.h"
#include "workflow/cut_length.h"
#include "workflow/cut_words.h"

namespace bw::app {

CutLines::CutLines(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench), stations_(new StationLines(bench, column, false, this)) {
  direction_ = makeCutDirection(bench, column, this);
  up_ = addChoice(column, tr("On top"), tr("The face of the block that lies on top while it is cut"),
                  faceWords(), tr("Lay block"), [](Cut& cut, int index) { cut.pose.up = BlockFace(index); });
  turn_ = addChoice(column, tr("Turned by"),
                    tr("Then turned about the vertical, counter-clockwise seen from above"), turnWords(),
                    tr("Turn block"), [](Cut& cut, int index) { cut.pose.quarters = index; });
  order_ = addChoice(
      column, tr("Order"), tr("When it is made among the cuts of its block: the lowest first, unless told"),
      {}, tr("Change order"),
      [](Cut& cut, int index) { cut.order = index == 0 ? std::nullopt : std::optional(index); });
  keep_ = addChoice(column, tr("Keeps what is"),
                    tr("The foam that stays, seen from the surface as the block lies"), keptWords(),
                    tr("Keep other side"), [](Cut& cut, int index) { cut.keep = KeptSide(index); });
  addOffset(column);
  length_ = column->add(tr("Own length"), makeCutLength(bench, [this] { return bench_.cut().id; }),
                        tr("Of the blade of this cut alone, from grip to grip; empty: that of the design"));
}

ChoiceField* CutLines::addChoice(FormColumn* column, const QString& title, const QString& tip,
                                 const QStringList& items, const QString& step,
                                 const std::function<void(Cut&, int)>& change) {
  auto* field = column->add(title, new ChoiceField, tip);
  field->addItems(items);
  connect(field, &QComboBox::activated, this,
          [this, step, change](int index) { bench_.editCut(step, [&](Cut& cut) { change(cut, index); }); });
  return field;
}

void CutLines::addOffset(FormColumn* column) {
  offset_ = column->add(tr("Offset"), new NumberField({0, Cut::kMostOffset, 2, 1, "mm"}),
                        tr("How far the foam stands back from the surface, along its normals. Only for a cut "
                           "alone in its block"));
  connect(offset_, &NumberField::edited, this, [this](double offset) {
    bench_.editCut(tr("Change offset"), [offset](Cut& cut) { cut.offset = offset; });
  });
  bindNumber(bench_, offset_, placeInCut(bench_, "/offset"));
}

void CutLines::refresh() {
  const Cut& cut = bench_.cut();
  const auto beside = int(std::ranges::count(bench_.design().cuts, cut.block, &Cut::block));
  stations_->refresh();
  direction_->refresh();
  up_->show(int(cut.pose.up));
  turn_->show(cut.pose.quarters);
  showOrder(*order_, bench_, cut);
  keep_->show(int(cut.keep));
  // Of a single cut there is no order; several take no offset, but what one has all the same can be taken
  // away.
  setLineVisible(order_, beside > 1);
  setLineVisible(offset_, beside == 1 || cut.offset != 0);
  offset_->show(cut.offset);
  showCutLength(*length_, cut);
}

}  // namespace bw::app
