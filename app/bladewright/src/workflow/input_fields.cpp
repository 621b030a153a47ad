// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/input_fields.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QStandardItemModel>

#include <algorithm>
#include <initializer_list>

#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "controls/numbers.h"

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
  setLineVisible(kinds_, true);
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

void FaceFields::hide() {
  for (QWidget* field :
       std::initializer_list<QWidget*>{kinds_, numbers_, names_, sides_, point_[0], point_[1], point_[2]})
    setLineVisible(field, false);
  inPicture_->hide();
}

InputFields::InputFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  fileName_ = column->addWide(new QLabel);
  fileName_->setTextFormat(Qt::PlainText);
  fileName_->setWordWrap(true);
  fileFacts_ = column->addWide(makeNote());
  layer_ = column->addLong(
      tr("Layer"), tr("Which curves of the drawing the surface is made of: all, or those of one layer"));
  connect(layer_, &QComboBox::activated, this, [this](int index) {
    const Drawing* drawing = bench_.drawing();
    if (drawing && index <= int(drawing->layers.size()))
      bench_.takeLayer(index == 0 ? std::nullopt
                                  : Drawing::Layer(drawing->layers[std::size_t(index) - 1].name));
    showLayers();
  });
  setLineVisible(layer_, false);
  surface_ = column->addWide(new SurfaceFields(bench));
  column->addWide(
      makeButton(tr("Open CAD file…"),
                 tr("STEP (also packed), IGES or BREP, or the curves of a drawing (DXF); a file can also be "
                    "dropped into the window"),
                 this, &InputFields::openRequested));
  auto* row = new QWidget;
  auto* buttons = makeBox<QHBoxLayout>(row, {}, kGap);
  replace_ = makeButton(tr("Replace…"), tr("Another CAD file under the same settings"), this,
                        &InputFields::replaceRequested);
  reload_ = makeButton(tr("Reload"), tr("Read the CAD file again; settings and undo stay"), this,
                       &InputFields::reloadRequested);
  locate_ =
      makeButton(tr("Locate…"), tr("Say where the CAD file is now"), this, &InputFields::locateRequested);
  for (QPushButton* button : {replace_, reload_, locate_}) buttons->addWidget(button);
  column->addWide(row);
  follow_ = column->addCheck(
      tr("Read again when it changes"),
      tr("On: when the file changes on disk it is read again as soon as it is whole. Off: a line tells that "
         "it changed, and Reload reads it."));
  follow_->setObjectName("followFile");
  connect(follow_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.setFollowsFile(on);
    refreshState();
  });
  unit_ = column->addLong(
      tr("Read as"),
      tr("The unit that the numbers of the file are taken in, and the size that the surface then has"));
  unit_->addItem(tr("As stated"));
  for (const LengthUnit unit : kLengthUnits) unit_->addItem(QString::fromLatin1(lengthUnitName(unit)));
  connect(unit_, &QComboBox::activated, this, &InputFields::applyUnit);
  faces_ = new FaceFields(bench, column, this);
  embed_ =
      column->addCheck(tr("Keep the geometry in the design"),
                       tr("On: the saved design holds a copy of the CAD file. Off: it points to the file."));
  connect(embed_, &QCheckBox::clicked, this, &InputFields::embed);
}

void InputFields::applyUnit(int index) {
  bench_.editDesign(tr("Read the file in another unit"), [index](Design& design) {
    design.source().unit = index == 0 ? std::nullopt : std::optional(kLengthUnits[std::size_t(index) - 1]);
  });
}

void InputFields::showUnits(const geometry::CadInfo* info, const Eigen::Vector3d& size) {
  const auto& unit = bench_.design().source().unit;
  const int now =
      unit ? 1 + int(std::find(kLengthUnits.begin(), kLengthUnits.end(), *unit) - kLengthUnits.begin()) : 0;
  // Sizes follow from the one that was read; without it the words stand alone.
  const auto sized = [&](const QString& words, double mm) {
    return info && mm > 0 && info->readAsLength > 0 && size.norm() > 0
               ? tr("%1: %2").arg(words, sizeText(size * (mm / info->readAsLength)))
               : words;
  };
  // The closed field names the unit; the size of the one that is read stands above with the file.
  const auto label = [&](int index, const QString& words, double mm) {
    unit_->setItemText(index, sized(words, mm));
    unit_->setShortText(index, words);
  };
  label(0, info ? tr("As stated, %1").arg(QString::fromStdString(info->unit)) : tr("As stated"),
        info ? info->unitLength : 0);
  for (std::size_t i = 0; i < kLengthUnits.size(); ++i)
    label(int(i) + 1, QString::fromLatin1(lengthUnitName(kLengthUnits[i])), millimetres(kLengthUnits[i]));
  unit_->show(now);
}

void InputFields::showLayers() {
  const Drawing* drawing =
      &bench_.source() == &bench_.design().source() && bench_.source().surface ? bench_.drawing() : nullptr;
  // While a hand pulls at a surface without one there is nothing to do.
  if (!drawing && layer_->count() == 0) return;
  setLineVisible(layer_, drawing != nullptr);
  layer_->clear();
  if (!drawing) return;
  const auto add = [this](const QString& name, int curves) {
    layer_->addItem(curves == 1 ? tr("%1: 1 curve").arg(name) : tr("%1: %2 curves").arg(name).arg(curves));
  };
  int all = 0;
  for (const pipeline::DrawnLayer& layer : drawing->layers) all += layer.curves;
  add(tr("All layers"), all);
  for (const pipeline::DrawnLayer& layer : drawing->layers)
    add(layer.name.empty() ? tr("(no name)") : QString::fromStdString(printable(layer.name)), layer.curves);
  const std::optional<Drawing::Layer> now = drawing->layerOf(bench_.source().surface);
  if (!now) layer_->addItem(tr("Changed since"));  // by a hand; a layer that is chosen takes its place
  const auto place = std::ranges::find_if(
      drawing->layers, [&](const pipeline::DrawnLayer& layer) { return now && *now && layer.name == **now; });
  layer_->show(!now ? layer_->count() - 1 : !*now ? 0 : 1 + int(place - drawing->layers.begin()));
}

void InputFields::embed(bool on) {
  Design design = *bench_.document().design();
  if (on) {
    Result<std::string> bytes = readFile(bench_.sourceFile());
    if (!bytes) {
      bench_.tell(Topic::declined, bytes.error());
      refresh();
      return;
    }
    design.source().bytes = std::move(*bytes);
  } else {
    design.source().bytes.clear();
    design.source().path = bench_.sourceFile();
  }
  bench_.document().edit(std::move(design), on ? tr("Embed geometry") : tr("Link geometry"));
}

void InputFields::refresh() {
  const Design& design = *bench_.document().design();
  const std::string file = design.source().path.filename().string();
  const auto& surface = bench_.source().surface;
  fileName_->setText(surface        ? tr("Designed surface")
                     : file.empty() ? tr("No file")
                                    : QString::fromStdString(file));
  fileName_->setToolTip(QString::fromStdString(design.source().path.string()));
  QString facts;
  const geometry::CadInfo* info = bench_.fileInfo();
  const geometry::Target* target = info ? bench_.newestTarget() : nullptr;
  const Eigen::Vector3d size = target ? target->bounds().size() : Eigen::Vector3d(0, 0, 0);
  if (info && surface) {
    if (target) facts = sizeText(size);
  } else if (info) {
    facts = tr("%1, unit %2, %3")
                .arg(QString::fromStdString(info->format), QString::fromStdString(info->unit),
                     info->faces == 1 ? tr("1 face") : tr("%1 faces").arg(info->faces));
    if (target) facts += "\n" + sizeText(size);
    for (const std::string& line : info->leftOut)
      facts += "\n" + tr("Left out: %1").arg(QString::fromStdString(line));
    if (!info->healing.empty())
      facts += "\n" + tr("Repaired: %1").arg(QString::fromStdString(info->healing.front()));
  }
  const bool drawn = bench_.fromDrawing() && &bench_.source() == &design.source();
  const QTime& again = bench_.readAgainAt();
  if ((drawn || !surface) && again.isValid())
    facts += (facts.isEmpty() ? QString() : QStringLiteral("\n")) +
             tr("Read again at %1").arg(again.toString(QStringLiteral("HH:mm:ss")));
  fileFacts_->setText(facts);
  fileFacts_->setVisible(!facts.isEmpty());
  showUnits(info, size);
  showLayers();
  surface_->refresh();
  setLineVisible(unit_, !surface);
  surface ? faces_->hide() : faces_->refresh();
  embed_->setVisible(!surface);
  embed_->setChecked(!design.source().bytes.empty());
  refreshState();
}

void InputFields::refreshState() {
  const bool missing = bench_.sourceMissing(), there = bench_.canReload();
  replace_->setEnabled(!bench_.document().empty());
  reload_->setEnabled(there);
  const bool drawn = bench_.fromDrawing() && &bench_.source() == &bench_.design().source();
  const bool linked = !bench_.source().surface || drawn;
  reload_->setVisible(!missing && linked);
  locate_->setVisible(missing);
  // A copy in the design is the person's own.
  follow_->setVisible(linked && (drawn || bench_.design().source().bytes.empty()));
  follow_->setChecked(bench_.followsFile());
  embed_->setEnabled(!embed_->isChecked() || there);
}

}  // namespace bw::app
