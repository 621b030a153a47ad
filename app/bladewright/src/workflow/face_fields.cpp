// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/face_fields.h"

#include <QStandardItemModel>

#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

using Kind = FaceChoice::Kind;

constexpr int kUnknownCount = 100000;    // faces of a file that is not read yet
constexpr std::size_t kSidesShown = 40;  // the largest; more are chosen by number

QStringList namesOf(const geometry::CadInfo* info) {
  QStringList names;
  if (!info) return names;
  for (const geometry::FaceInfo& face : info->faceList) {
    const QString name = QString::fromStdString(face.name);
    if (!name.isEmpty()) names << name;
  }
  names.removeDuplicates();
  names.sort(Qt::CaseInsensitive);
  return names;
}

QString areaText(double mm2) {
  const bool large = mm2 >= 1e4;
  return QStringLiteral("%1 %2").arg(QString::fromStdString(shortText(large ? mm2 * 1e-6 : mm2)),
                                     large ? QStringLiteral("m²") : QStringLiteral("mm²"));
}

}  // namespace

FaceFields::FaceFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  kinds_ = column->add(tr("Faces"), new ChoiceField,
                       tr("Which faces of the file are cut. Largest: of those that are neither planes, "
                          "cylinders nor cones, if there are such"));
  kinds_->addItems(
      {tr("Largest"), tr("All"), tr("By number"), tr("By name"), tr("One side"), tr("Near a point")});
  connect(kinds_, &QComboBox::activated, this, &FaceFields::chooseKind);
  inPicture_ = column->addWide(
      makeButton(tr("Choose in the picture"),
                 tr("All faces of the file are shown; a click chooses, Ctrl+click adds or takes away (C)"),
                 this, &FaceFields::chooseInPictureRequested));
  inPicture_->setObjectName("chooseFaces");
  inPicture_->setCheckable(true);
  numbers_ = column->add(tr("Face numbers"), new ListField(tr("face")), tr("Counted from 0: 0, 3, 5-7"));
  connect(numbers_, &ListField::edited, this, &FaceFields::chooseNumbers);
  names_ = column->addLong(tr("Name"), tr("Names that faces, or their solids, have in the file"));
  connect(names_, &QComboBox::activated, this, [this] {
    FaceChoice choice;
    choice.kind = Kind::named;
    for (const QString& name : names_->currentData().toStringList())
      choice.names.push_back(name.toStdString());
    this->choose(choice);
  });
  sides_ = column->addLong(tr("Side"), tr("Faces that join smoothly, the largest side first"));
  connect(sides_, &QComboBox::activated, this, [this](int index) {
    FaceChoice choice;
    choice.kind = Kind::group;
    choice.group = sides_->itemData(index).toInt();
    this->choose(choice);
  });
  static const char* const kAxes[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < point_.size(); ++axis) {
    point_[axis] = column->add(tr("Point %1").arg(kAxes[axis]), new NumberField({-1e7, 1e7, 3, 10, "mm"}),
                               tr("The face nearest to this point of the file's frame is cut"));
    connect(point_[axis], &NumberField::edited, this, [this, i = Eigen::Index(axis)](double value) {
      FaceChoice choice = bench_.cut().face;
      choice.point[i] = value;
      this->choose(choice);
    });
  }
}

void FaceFields::showChoosing(bool choosing, bool possible) {
  inPicture_->setChecked(choosing);
  inPicture_->setVisible(possible);
}

void FaceFields::choose(const FaceChoice& choice) {
  bench_.editCut(tr("Choose faces"), [&](Cut& cut) { cut.face = choice; });
}

void FaceFields::chooseKind(int kind) {
  FaceChoice choice;
  choice.kind = Kind(kind);
  const geometry::Target* target = bench_.newestTarget();
  if (choice.kind == Kind::indices) {
    choice.indices = target ? target->faces() : std::vector<int>{0};
  } else if (choice.kind == Kind::named) {
    const QStringList names = namesOf(bench_.fileInfo());
    if (names.isEmpty()) return refresh();
    choice.names = {names.first().toStdString()};
  } else if (choice.kind == Kind::nearest && target) {
    choice.point = target->bounds().center();
  }
  choose(choice);
}

void FaceFields::chooseNumbers(const std::vector<int>& numbers) {
  FaceChoice choice;
  choice.kind = Kind::indices;
  choice.indices = numbers;
  if (choice.indices.empty()) choice.indices = {0};
  choose(choice);
}

void FaceFields::showNames(const FaceChoice& face, const geometry::CadInfo* info) {
  QStringList chosen;
  for (const std::string& name : face.names) chosen << QString::fromStdString(name);
  const QStringList names = namesOf(info);
  names_->clear();
  for (const QString& name : names) names_->addItem(name, QStringList(name));
  if (chosen.size() > 1 || (!chosen.isEmpty() && !names.contains(chosen.first())))
    names_->addItem(chosen.join(", "), chosen);
  names_->show(names_->findData(chosen));
  auto* items = qobject_cast<QStandardItemModel*>(kinds_->model());
  items->item(int(Kind::named))->setEnabled(!names.isEmpty());
}

void FaceFields::showSides(const FaceChoice& face, const geometry::CadInfo* info) {
  sides_->clear();
  const auto add = [&](const geometry::FaceGroup& group) {
    const int faces = int(group.faces.size());
    const geometry::FaceInfo& first = info->faceList[std::size_t(group.faces.front())];
    const QString name =
        first.name.empty() ? QString() : QStringLiteral(" (%1)").arg(QString::fromStdString(first.name));
    sides_->addItem(tr("%1: %2%3, %4")
                        .arg(group.index + 1)
                        .arg(faces == 1 ? tr("face %1").arg(first.index) : tr("%1 faces").arg(faces), name,
                             areaText(group.area)),
                    group.index);
  };
  if (info) {
    for (const geometry::FaceGroup& group : info->groups) {
      if (std::size_t(group.index) < kSidesShown || group.index == face.group) add(group);
    }
  }
  sides_->show(sides_->findData(face.group));
}

void FaceFields::refresh() {
  const FaceChoice& face = bench_.cut().face;
  const geometry::CadInfo* info = bench_.fileInfo();
  kinds_->show(int(face.kind));
  setLineVisible(numbers_, face.kind == Kind::indices);
  setLineVisible(names_, face.kind == Kind::named);
  setLineVisible(sides_, face.kind == Kind::group);
  numbers_->setCount(info ? info->faces : kUnknownCount);
  numbers_->show(face.indices);
  showNames(face, info);
  showSides(face, info);
  for (std::size_t axis = 0; axis < point_.size(); ++axis) {
    setLineVisible(point_[axis], face.kind == Kind::nearest);
    point_[axis]->show(face.point[Eigen::Index(axis)]);
  }
}

}  // namespace bw::app
