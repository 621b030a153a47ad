// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "blocks/block_cuts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "workflow/bound_number.h"
#include "workflow/cut_length.h"
#include "workflow/cut_words.h"

namespace bw::app {

namespace {

constexpr int kWidth = 84, kTurnWidth = 66, kLengthWidth = 116;  // px, the last with an expression
constexpr double kOffsetStep = 1;                                // mm

}  // namespace

BlockCuts::BlockCuts(Workbench& bench, QWidget* parent)
    : QWidget(parent), bench_(bench), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(kGap);
  grid_->setVerticalSpacing(4);
  const std::pair<QString, QString> heads[] = {
      {tr("Cut"), tr("The cut whose surface, direction and stations are shown and edited")},
      {tr("Order"), tr("When it is made among the cuts of its block: the lowest first, unless told")},
      {tr("On top"), tr("The face of the block that lies on top while it is cut")},
      {tr("Turned by"), tr("Then turned about the vertical, counter-clockwise seen from above")},
      {tr("Keeps what is"), tr("The foam that stays, seen from the surface as the block lies")},
      {tr("Offset"),
       tr("How far the foam stands back from the surface, along its normals: for a layer on it, "
          "or half of a panel between two moulds. Only for a cut alone in its block")},
      {tr("Blade"), tr("The length of the blade for this cut alone; empty: that of the blade of all")}};
  for (const auto& [title, tip] : heads) {
    auto* label = new QLabel(title);
    label->setObjectName("secondary");
    label->setFont(Theme::secondaryFont());
    label->setToolTip(tip);
    heads_.push_back(label);
  }
  refresh();
}

void BlockCuts::edit(const std::string& cut, const QString& step, const std::function<void(Cut&)>& change) {
  bench_.select({Selection::Kind::result, -1, bench_.selection().block, cut});
  bench_.editCut(step, change);
}

ChoiceField* BlockCuts::addChoice(const char* name, const QString& title, const QStringList& items,
                                  const std::string& cut, const QString& step,
                                  const std::function<void(Cut&, int)>& change) {
  auto* field = new ChoiceField;
  field->addItems(items);
  field->setObjectName(name);
  field->setAccessibleName(tr("%1, %2").arg(title, QString::fromStdString(cut)));
  connect(field, &QComboBox::activated, this,
          [this, cut, step, change](int index) { edit(cut, step, [&](Cut& own) { change(own, index); }); });
  return field;
}

NumberField* BlockCuts::addOffset(const std::string& cut) {
  auto* field = new NumberField({0, Cut::kMostOffset, 2, kOffsetStep, "mm"});
  field->setBlank(tr("none"));
  field->setObjectName("offset");
  field->setAccessibleName(tr("Offset, %1").arg(QString::fromStdString(cut)));
  field->setToolTip(heads_[5]->toolTip());
  field->setFixedWidth(kWidth);
  connect(field, &NumberField::edited, this, [this, cut](double offset) {
    edit(cut, tr("Change offset"), [offset](Cut& own) { own.offset = offset; });
  });
  bindNumber(bench_, field, placeOfCut(bench_, cut, "/offset"));
  return field;
}

NumberField* BlockCuts::addLength(const std::string& cut) {
  NumberField* field = makeCutLength(bench_, [cut] { return cut; });
  field->setObjectName("ownLength");
  field->setAccessibleName(tr("Blade, %1").arg(QString::fromStdString(cut)));
  field->setToolTip(heads_[6]->toolTip());
  field->setFixedWidth(kLengthWidth);
  return field;
}

void BlockCuts::rebuild(const std::vector<std::string>& cuts) {
  for (const Line& line : lines_)
    for (QWidget* widget : std::initializer_list<QWidget*>{line.name, line.order, line.up, line.turn,
                                                           line.keep, line.offset, line.length}) {
      grid_->removeWidget(widget);
      widget->hide();
      widget->deleteLater();
    }
  lines_.clear();
  for (const std::string& cut : cuts) {
    Line line{cut, new QToolButton, nullptr, nullptr, nullptr, nullptr, addOffset(cut), addLength(cut)};
    line.name->setText(QString::fromStdString(cut));
    line.name->setCheckable(true);
    line.name->setAccessibleName(tr("Work on %1").arg(line.name->text()));
    line.name->setToolTip(heads_.front()->toolTip());
    connect(line.name, &QToolButton::clicked, this, [this, cut] {
      bench_.select({Selection::Kind::result, -1, bench_.selection().block, cut});
      refresh();  // a press of the one at work leaves it pressed
    });
    line.order = addChoice("order", tr("Order"), {}, cut, tr("Change order"), [](Cut& own, int index) {
      own.order = index == 0 ? std::nullopt : std::optional(index);
    });
    line.up = addChoice("faceUp", tr("On top"), faceWords(), cut, tr("Lay block"),
                        [](Cut& own, int index) { own.pose.up = BlockFace(index); });
    line.turn = addChoice("turn", tr("Turned by"), turnWords(), cut, tr("Turn block"),
                          [](Cut& own, int index) { own.pose.quarters = index; });
    line.keep = addChoice("keep", tr("Keeps what is"), keptWords(), cut, tr("Keep other side"),
                          [](Cut& own, int index) { own.keep = KeptSide(index); });
    for (ChoiceField* field : {line.order, line.up, line.keep}) field->setFixedWidth(kWidth);
    line.turn->setFixedWidth(kTurnWidth);
    lines_.push_back(line);
  }
  arrange();
}

void BlockCuts::arrange() {
  const int first = narrow_ ? 0 : 1;
  grid_->setHorizontalSpacing(narrow_ ? kGap / 2 : kGap);
  if (!narrow_) grid_->addWidget(heads_[0], 0, 0);
  for (int k = 1; k < int(heads_.size()); ++k) grid_->addWidget(heads_[std::size_t(k)], 0, first + k - 1);
  int row = 1;
  for (const Line& line : lines_) {
    grid_->addWidget(line.name, row, 0, 1, narrow_ ? 6 : 1, Qt::AlignLeft);
    if (narrow_) ++row;
    int column = first;
    for (QWidget* field :
         std::initializer_list<QWidget*>{line.order, line.up, line.turn, line.keep, line.offset, line.length})
      grid_->addWidget(field, row, column++, Qt::AlignLeft);
    ++row;
  }
  grid_->setColumnStretch(6, narrow_ ? 1 : 0);
  grid_->setColumnStretch(7, 1);
}

void BlockCuts::setNarrow(bool narrow) {
  if (std::exchange(narrow_, narrow) == narrow) return;
  arrange();
  refresh();
}

int BlockCuts::wideWidth() const {
  int width = 0;
  for (const Line& line : lines_) width = std::max(width, line.name->sizeHint().width());
  const Line& line = lines_.front();
  const std::array<const QWidget*, 6> fields = {line.order, line.up,     line.turn,
                                                line.keep,  line.offset, line.length};
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (!fields[i]->isHidden())
      width += kGap + std::max(fields[i]->minimumWidth(), heads_[i + 1]->sizeHint().width());
  return width;
}

void BlockCuts::refresh() {
  std::vector<const Cut*> cuts;
  std::vector<std::string> ids, built;
  for (const Cut& cut : bench_.design().cuts)
    if (cut.block == bench_.selection().block) {
      cuts.push_back(&cut);
      ids.push_back(cut.id);
    }
  for (const Line& line : lines_) built.push_back(line.cut);
  if (ids != built) rebuild(ids);
  // Of a single cut there is no order.
  const bool several = cuts.size() > 1;
  heads_[0]->setVisible(!narrow_);
  heads_[1]->setVisible(several);
  // Several take none; what one has all the same can be taken away.
  const bool offset = !several || std::ranges::any_of(cuts, [](const Cut* cut) { return cut->offset != 0; });
  heads_[5]->setVisible(offset);
  const bool length = std::ranges::any_of(cuts, [](const Cut* cut) { return cut->length.has_value(); });
  heads_[6]->setVisible(length);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    const Cut& cut = *cuts[i];
    line.name->setChecked(cut.id == bench_.selection().cut);
    showOrder(*line.order, bench_, cut);
    line.up->show(int(cut.pose.up));
    line.turn->show(cut.pose.quarters);
    line.keep->show(int(cut.keep));
    line.order->setVisible(several);
    line.offset->show(cut.offset);
    line.offset->setVisible(offset);
    showCutLength(*line.length, cut);
    line.length->setVisible(length);
  }
}

}  // namespace bw::app
