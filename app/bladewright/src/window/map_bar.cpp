// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/map_bar.h"

#include <QAbstractItemView>
#include <QHBoxLayout>
#include <QStandardItemModel>
#include <QWidgetAction>

#include <algorithm>

#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"
#include "controls/layout.h"

namespace bw::app {

namespace {

constexpr int kComparisonWidth = 158, kAloneWidth = 86;  // with a second picture, and without
constexpr int kRangeWidth = 104;                         // of an end of the legend, with its unit

/// A number with the digits that the legend has.
double asRead(double value) {
  constexpr int kDigits = 4;
  return parseNumber(shortText(value, kDigits)).value_or(value);
}

}  // namespace

const std::vector<std::string>& MapBar::fieldNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const MapInfo& map : cutMaps()) all.push_back(map.name);
    all.push_back("none");
    return all;
  }();
  return names;
}

MapBar::MapBar(const Theme& theme, const Commands& commands, QWidget* parent)
    : QFrame(parent), theme_(theme) {
  setObjectName("panel");
  auto* rows = new FlowLayout(this);
  rows->setContentsMargins(6, 5, 6, 5);
  rows->setSpacing(kGap);
  QHBoxLayout* layout = nullptr;
  const auto addGroup = [&] {
    auto* group = new QWidget(this);
    layout = makeBox<QHBoxLayout>(group, {}, 4);
    rows->addWidget(group);
    return group;
  };
  addGroup();
  field_ = new ChoiceField(this);
  for (const MapInfo& map : cutMaps()) field_->addItem(QString::fromUtf8(map.title));
  field_->addItem(tr("No map"));
  field_->setToolTip(tr("What the colours of the cut surface show"));
  field_->setAccessibleName(tr("Map"));
  field_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  layout->addWidget(field_);
  const auto tool = [&](const QString& tip) {
    auto* b = new QToolButton(this);
    b->setToolTip(tip);
    b->setAccessibleName(tip);
    b->setFocusPolicy(Qt::StrongFocus);
    layout->addWidget(b);
    return b;
  };
  for (const char* id : {"view.isolines", "view.section"}) tool({})->setDefaultAction(commands[id]);
  layers_ = tool(tr("What is shown, and how solid"));
  layers_->setPopupMode(QToolButton::InstantPopup);
  layersMenu_ = new QMenu(layers_);
  auto* content = new QWidgetAction(layersMenu_);
  content->setDefaultWidget(makeLayers());
  layersMenu_->addAction(content);
  layers_->setMenu(layersMenu_);
  rangeGroup_ = addGroup();
  // Whichever map is chosen, the bar has as many rows, and the picture below it stays where it is.
  QSizePolicy policy = rangeGroup_->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  rangeGroup_->setSizePolicy(policy);
  const NumberRange range{-1e6, 1e6, 3, 0.1, {}};
  const auto number = [&](const QString& name) {
    auto* n = new NumberField(range, this);
    n->setFixedWidth(kRangeWidth);
    n->setAccessibleName(name);
    n->setToolTip(name);
    layout->addWidget(n);
    return n;
  };
  min_ = number(tr("Lower end of the legend"));
  layout->addWidget(new QLabel(QStringLiteral("–"), this));
  max_ = number(tr("Upper end of the legend"));
  automatic_ = tool(tr("Range follows the data"));
  automatic_->setText(tr("Auto"));
  automatic_->setCheckable(true);
  automatic_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  automatic_->setIconSize({14, 14});
  addGroup();
  comparison_ = new ChoiceField(this);
  comparison_->setToolTip(
      tr("What stands in a second picture beside this one: the target, the state before the last "
         "change, or a version"));
  comparison_->setAccessibleName(tr("Compare"));
  layout->addWidget(comparison_);
  connect(comparison_, &QComboBox::activated, this, &MapBar::comparisonChosen);
  addGroup();
  tool({})->setDefaultAction(commands["view.iso"]);
  auto* more = tool(tr("Standard views"));
  more->setIcon(theme.icon("chevron-down"));
  more->setIconSize({14, 14});
  more->setPopupMode(QToolButton::InstantPopup);
  auto* views = new QMenu(more);
  for (const char* id :
       {"view.iso", "view.top", "view.bottom", "view.front", "view.back", "view.left", "view.right"})
    views->addAction(commands[id]);
  more->setMenu(views);
  for (const char* id : {"view.fit", "view.parallel"}) tool({})->setDefaultAction(commands[id]);

  connect(field_, &QComboBox::activated, this,
          [this](int index) { chooseField(fieldNames()[std::size_t(index)]); });
  min_->setCheck([this](double value) {
    return value < max_->value() ? QString() : tr("The lower end must be below the upper");
  });
  max_->setCheck([this](double value) {
    return value > min_->value() ? QString() : tr("The upper end must be above the lower");
  });
  const auto applyRange = [this](bool automatic) {
    style_.rangeMin = automatic ? std::nullopt : std::optional(min_->value());
    style_.rangeMax = automatic ? std::nullopt : std::optional(max_->value());
    refresh();
    emit styleEdited(style_);
  };
  for (const NumberField* field : {min_, max_})
    connect(field, &NumberField::edited, this, [applyRange] { applyRange(false); });
  connect(automatic_, &QToolButton::clicked, this, applyRange);
  const auto icons = [this, more] {
    layers_->setIcon(theme_.icon("layers"));
    automatic_->setIcon(theme_.tick());
    more->setIcon(theme_.icon("chevron-down"));
  };
  connect(&theme, &Theme::changed, this, icons);
  icons();
  refresh();
}

QWidget* MapBar::makeLayers() {
  auto* page = new QWidget;
  auto* grid = new QGridLayout(page);
  grid->setContentsMargins(kGap, kGap, kGap, kGap);
  grid->setHorizontalSpacing(kGroupGap);
  grid->setVerticalSpacing(4);
  int row = 0;
  const auto line = [&](const QString& name, StyleSwitch isOn, scene::Kind solid = scene::Kind::none) {
    auto* box = new QCheckBox(name, page);
    grid->addWidget(box, row, 0);
    shows_.emplace_back(box, isOn);
    connect(box, &QCheckBox::clicked, this, [this, isOn](bool on) {
      isOn(style_) = on;
      emit styleEdited(style_);
    });
    if (solid != scene::Kind::none) {
      auto* slider = new HandSlider(page);
      slider->setRange(5, 100);
      slider->setFixedWidth(120);
      slider->setToolTip(tr("Opacity"));
      slider->setAccessibleName(tr("Opacity of %1").arg(name));
      grid->addWidget(slider, row, 1);
      opacities_.emplace_back(slider, solid);
      slider->putBackByEscape(
          [slider] { return [slider, was = slider->value()] { slider->setValue(was); }; });
      connect(slider, &HandSlider::moved, this, [this, solid](int value) {
        style_[solid].opacity = value / 100.0;
        emit styleEdited(style_);
      });
    }
    ++row;
  };
  using scene::Kind;
  line(tr("Target surface"), shows<Kind::target>, Kind::target);
  line(tr("Other faces of the file"), shows<Kind::face>);
  line(tr("Cut surface"), shows<Kind::cut>, Kind::cut);
  line(tr("Block"), shows<Kind::block>, Kind::block);
  line(tr("Part of several cuts"), shows<Kind::part>);
  line(tr("Part of a single cut"), switchOf<&scene::Style::partsOfOneCut>);
  line(tr("Creases between cuts"), shows<Kind::crease>);
  line(tr("Key blades that none can be"), shows<Kind::told>);
  line(tr("Stations"), shows<Kind::station>);
  line(tr("Whole blades"), shows<Kind::blade>);
  line(tr("Ground grid"), switchOf<&scene::Style::showGrid>);
  line(tr("Legend"), switchOf<&scene::Style::legend>);
  return page;
}

void MapBar::chooseField(const std::string& name) {
  if (style_[scene::Kind::cut].map == name) return;
  style_[scene::Kind::cut].map = name;
  style_.rangeMin.reset();
  style_.rangeMax.reset();
  refresh();
  emit styleEdited(style_);
}

void MapBar::setStyle(const scene::Style& style) {
  style_ = style;
  refresh();
}

void MapBar::setRangeInUse(const std::optional<std::pair<double, double>>& range) {
  mapped_ = range.has_value();
  if (range) {
    for (NumberField* field : {min_, max_})
      field->setStep(std::max(0.001, (range->second - range->first) / 20));
    if (!style_.rangeMin) {
      min_->show(asRead(range->first));
      max_->show(asRead(range->second));
    }
  }
  showRange();
}

void MapBar::setRangeUnit(const QString& unit) {
  for (NumberField* field : {min_, max_})
    if (field->range().unit != unit) field->setUnit(unit);
}

void MapBar::setCreases(bool any) {
  auto* model = qobject_cast<QStandardItemModel*>(field_->model());
  for (std::size_t i = 0; model && i < cutMaps().size(); ++i)
    if (!cutMaps()[i].ofCut) model->item(int(i))->setEnabled(any);
}

void MapBar::showRange() {
  // Without a map there is no range to tell, and one of words has all of them.
  const std::string& map = style_[scene::Kind::cut].map;
  rangeGroup_->setVisible(mapped_ && map != "none" && mapRule(map) != MapRule::words);
}

void MapBar::setComparisons(const QStringList& items, int index, bool before) {
  if (comparisons_ != items) {
    comparisons_ = items;
    comparison_->clear();
    comparison_->addItems(items);
  }
  if (auto* model = qobject_cast<QStandardItemModel*>(comparison_->model()))
    model->item(2)->setEnabled(before);
  comparison_->show(index);
  // Without a second picture all of the bar has room in one row over the usual width of this one.
  comparison_->setFixedWidth(index == 0 ? kAloneWidth : kComparisonWidth);
  comparison_->view()->setMinimumWidth(std::max(kComparisonWidth, comparison_->view()->sizeHintForColumn(0)));
}

void MapBar::editRange() {
  min_->setFocus();
  min_->selectAll();
}

void MapBar::refresh() {
  const auto& names = fieldNames();
  const auto found = std::find(names.begin(), names.end(), style_[scene::Kind::cut].map);
  field_->show(found == names.end() ? int(names.size()) - 1 : int(found - names.begin()));
  showRange();
  automatic_->setChecked(!style_.rangeMin && !style_.rangeMax);
  if (style_.rangeMin) min_->show(*style_.rangeMin);
  if (style_.rangeMax) max_->show(*style_.rangeMax);
  for (const auto& [box, isOn] : shows_) box->setChecked(isOn(style_));
  for (const auto& [slider, kind] : opacities_) slider->show(int(100 * style_[kind].opacity + 0.5));
}

}  // namespace bw::app
