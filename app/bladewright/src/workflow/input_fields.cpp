// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/input_fields.h"

#include <QHBoxLayout>
#include <QPushButton>

#include <algorithm>

#include "bw/core/files/file_set.h"
#include "controls/numbers.h"

namespace bw::app {

InputFields::InputFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  fileName_ = column->addWide(new QLabel);
  fileName_->setTextFormat(Qt::PlainText);
  fileName_->setWordWrap(true);
  fileFacts_ = column->addWide(makeNote());
  column->addWide(
      makeButton(tr("Open CAD file…"),
                 tr("STEP (also packed), IGES or BREP; a file can also be dropped into the window"), this,
                 &InputFields::openRequested));
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

void InputFields::embed(bool on) {
  Design design = *bench_.document().design();
  if (on) {
    Result<std::string> bytes = readFile(bench_.sourceFile());
    if (!bytes) {
      bench_.tell(Topic::other, bytes.error());
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
  fileName_->setText(file.empty() ? tr("No file") : QString::fromStdString(file));
  fileName_->setToolTip(QString::fromStdString(design.source().path.string()));
  QString facts;
  const geometry::CadInfo* info = bench_.fileInfo();
  const geometry::Target* target = info ? bench_.newestTarget() : nullptr;
  const Eigen::Vector3d size = target ? target->bounds().size() : Eigen::Vector3d(0, 0, 0);
  if (info) {
    facts = tr("%1, unit %2, %3")
                .arg(QString::fromStdString(info->format), QString::fromStdString(info->unit),
                     info->faces == 1 ? tr("1 face") : tr("%1 faces").arg(info->faces));
    if (target) facts += "\n" + sizeText(size);
    for (const std::string& line : info->leftOut)
      facts += "\n" + tr("Left out: %1").arg(QString::fromStdString(line));
    if (!info->healing.empty())
      facts += "\n" + tr("Repaired: %1").arg(QString::fromStdString(info->healing.front()));
  }
  fileFacts_->setText(facts);
  fileFacts_->setVisible(!facts.isEmpty());
  showUnits(info, size);
  faces_->refresh();
  embed_->setChecked(!design.source().bytes.empty());
  refreshState();
}

void InputFields::refreshState() {
  const bool missing = bench_.sourceMissing(), there = bench_.canReload();
  replace_->setEnabled(!bench_.document().empty());
  reload_->setEnabled(there);
  reload_->setVisible(!missing);
  locate_->setVisible(missing);
  embed_->setEnabled(!embed_->isChecked() || there);
}

}  // namespace bw::app
