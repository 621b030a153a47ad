// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "workflow/cut_words.h"

#include <QCoreApplication>

#include <algorithm>

#include "controls/fields.h"
#include "workbench/workbench.h"

namespace bw::app {

namespace {

QString cutWord(const char* word) { return QCoreApplication::translate("CutWords", word); }

/// Counted from 1; none where nothing tells it yet, or the cut is dropped.
std::optional<int> placeOf(const Workbench& bench, const Cut& cut) {
  const auto shown = bench.shown();
  if (!shown) return std::nullopt;
  const auto block = std::ranges::find(shown->blocks, cut.block, &pipeline::BlockEvaluation::id);
  if (block == shown->blocks.end()) return std::nullopt;
  const auto own = std::ranges::find(block->cuts, cut.id, &pipeline::CutEvaluation::id);
  if (own == block->cuts.end()) return std::nullopt;
  return int(own - block->cuts.begin()) + 1;
}

}  // namespace

QStringList faceWords() {
  return {cutWord("Top"),   cutWord("Bottom"), cutWord("Left"),
          cutWord("Right"), cutWord("Front"),  cutWord("Back")};
}

QStringList turnWords() { return {cutWord("0°"), cutWord("90°"), cutWord("180°"), cutWord("270°")}; }

QStringList keptWords() {
  return {cutWord("Below"), cutWord("Above"),    cutWord("Left"),
          cutWord("Right"), cutWord("In front"), cutWord("Behind")};
}

void showOrder(ChoiceField& field, const Workbench& bench, const Cut& cut) {
  const auto beside = int(std::ranges::count(bench.design().cuts, cut.block, &Cut::block));
  const int places = std::max(beside, cut.order.value_or(0));
  if (field.count() != places + 1) {
    field.clear();
    field.addItem(cutWord("Lowest first"));
    for (int i = 1; i <= places; ++i) field.addItem(QString::number(i));
  }
  const std::optional<int> place = placeOf(bench, cut);
  field.setShortText(0, place ? cutWord("%1 (auto)").arg(*place) : cutWord("auto"));
  field.show(cut.order.value_or(0));
}

}  // namespace bw::app
