// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/direction_lines.h"

#include <QCoreApplication>

#include "controls/told_list_field.h"

namespace bw::app {

namespace {

constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};
constexpr double kNoDirection = 1e-6;  // shorter vectors lead nowhere

}  // namespace

DirectionLines::DirectionLines(Workbench& bench, FormColumn* column, const Words& words,
                               std::function<Value()> value, NumberPlace place,
                               std::function<Eigen::Vector3d()> found, std::function<void(const Value&)> edit,
                               QObject* parent)
    : QObject(parent),
      bench_(bench),
      place_(std::move(place)),
      axes_(words.automatic ? 1 : 0),
      value_(std::move(value)) {
  choice_ = column->add(words.title, new ChoiceField, words.tip);
  if (words.automatic) choice_->addItem(tr("Automatic"));
  choice_->addItems({"X", "Y", "Z", tr("Vector")});
  connect(choice_, &QComboBox::activated, this, [this, found, edit](int index) {
    vector_ = index == axes_ + 3;
    const auto take = [&] {
      if (index < axes_)
        edit({});
      else
        edit(vector_ ? value_().value_or(found()) : Eigen::Vector3d(Eigen::Vector3d::Unit(index - axes_)));
    };
    // An axis, or the best way, stands for no expressions, even where they come to the same.
    if (const std::string own = place_(); !vector_ && !own.empty())
      bench_.editBound(own + "/", {}, take);
    else
      take();
    refresh();  // the same direction may be an axis and a vector
  });
  for (int i = 0; i < 3; ++i) {
    NumberField*& field = numbers_[std::size_t(i)];
    field = column->add(words.number.arg(kAxes[std::size_t(i)]), new NumberField({-1000, 1000, 4, 0.05, {}}),
                        tr("Only the ratio of the three numbers counts"));
    const auto with = [this, found, i](double number) {
      Eigen::Vector3d direction = value_().value_or(found());
      direction[i] = number;
      return direction;
    };
    field->setCheck([with](double number) {
      return with(number).norm() < kNoDirection ? tr("0, 0, 0 is no direction") : QString();
    });
    connect(field, &NumberField::edited, this, [with, edit](double number) { edit(with(number)); });
    bindNumber(bench_, field, [this, i] {
      const std::string own = place_();
      return own.empty() ? own : own + "/" + std::to_string(i);
    });
  }
}

int DirectionLines::chosen() const {
  const Value value = value_();
  if (!value) return 0;
  for (int i = 0; i < 3 && !vector_ && !bound(*value); ++i)
    if ((*value - Eigen::Vector3d::Unit(i)).norm() < 1e-12) return axes_ + i;
  return axes_ + 3;
}

bool DirectionLines::bound(const Eigen::Vector3d& value) const {
  const std::string own = place_();
  for (int i = 0; i < 3 && !own.empty(); ++i) {
    const auto told = bench_.design().bindings.find(own + "/" + std::to_string(i));
    if (told != bench_.design().bindings.end() && standsFor(value[i], told->second)) return true;
  }
  return false;
}

void DirectionLines::refresh() {
  const Value value = value_();
  const int item = chosen();
  choice_->show(item);
  setLineVisible(choice_, visible_);
  for (int i = 0; i < 3; ++i) {
    NumberField* field = numbers_[std::size_t(i)];
    setLineVisible(field, visible_ && item == axes_ + 3);
    if (value) field->show((*value)[i]);
  }
}

void DirectionLines::setVisible(bool visible) {
  visible_ = visible;
  refresh();
}

DirectionLines* makeCutDirection(Workbench& bench, FormColumn* column, QObject* parent) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("DirectionLines", text); };
  return new DirectionLines(
      bench, column,
      {tr("Direction"),
       tr("The way the blade travels; automatic: the best of some that are tried, "
          "or the way of key blades that turn, whose planes turn with them"),
       tr("Direction %1")},
      [&bench] { return bench.cut().direction; }, placeInCut(bench, "/direction"),
      [&bench] {
        const auto* cut = bench.shownCut();
        return cut && cut->setup ? cut->setup->planes.direction() : Eigen::Vector3d(Eigen::Vector3d::UnitY());
      },
      [&bench, tr](const DirectionLines::Value& direction) {
        bench.editCut(tr("Change direction"), [&](Cut& cut) { cut.direction = direction; });
      },
      parent);
}

}  // namespace bw::app
