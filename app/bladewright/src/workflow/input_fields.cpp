// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/input_fields.h"

#include <QPushButton>
#include <QRegularExpression>
#include <QRegularExpressionValidator>

#include "bw/core/file_set.h"
#include "controls/numbers.h"

namespace bw::app {

InputFields::InputFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  fileName_ = new QLabel;
  fileName_->setTextFormat(Qt::PlainText);
  fileName_->setWordWrap(true);
  column->addWide(fileName_);
  fileFacts_ = makeNote();
  column->addWide(fileFacts_);
  auto* open = new QPushButton(tr("Open CAD file…"));
  open->setToolTip(tr("STEP, IGES or BREP; a file can also be dropped into the window"));
  column->addWide(open);
  connect(open, &QPushButton::clicked, this, &InputFields::openRequested);
  faces_ = new ChoiceField;
  faces_->addItems({tr("Largest"), tr("All"), tr("By number")});
  column->add(tr("Faces"), faces_, tr("Which faces of the file are cut"));
  faceList_ = new TextField;
  faceList_->setAlignment(Qt::AlignRight);
  faceList_->setValidator(
      new QRegularExpressionValidator(QRegularExpression("\\d+(\\s*,\\s*\\d+)*"), faceList_));
  faceListLabel_ = column->add(tr("Face numbers"), faceList_, tr("Counted from 0, with commas: 0, 3, 5"));
  connect(faces_, &QComboBox::activated, this, &InputFields::applyFaces);
  connect(faceList_, &TextField::edited, this, &InputFields::applyFaces);
  embed_ = new QCheckBox(tr("Keep the geometry in the design file"));
  embed_->setToolTip(tr("On: the saved design holds a copy of the CAD file. Off: it points to the file."));
  column->addWide(embed_);
  connect(embed_, &QCheckBox::clicked, this, &InputFields::embed);
}

void InputFields::applyFaces() {
  FaceChoice choice;
  choice.kind = FaceChoice::Kind(faces_->currentIndex());
  if (choice.kind == FaceChoice::Kind::indices) {
    for (const QString& part : faceList_->text().split(',', Qt::SkipEmptyParts))
      choice.indices.push_back(part.trimmed().toInt());
    if (choice.indices.empty()) choice.indices = {0};
  }
  bench_.editJob(tr("Choose faces"), [&](Job& job) { job.face = choice; });
}

void InputFields::embed(bool on) {
  Design design = *bench_.document().design();
  if (on) {
    Result<std::string> bytes = readFile(design.source.path);
    if (!bytes) {
      bench_.tell({Severity::error, QString::fromStdString(bytes.error().message), {}, {}});
      refresh();
      return;
    }
    design.source.bytes = std::move(*bytes);
  } else {
    design.source.bytes.clear();
  }
  bench_.document().edit(std::move(design), on ? tr("Embed geometry") : tr("Link geometry"));
}

void InputFields::refresh() {
  const Design& design = *bench_.document().design();
  const Job& job = design.job;
  const std::string file = design.source.path.filename().string();
  fileName_->setText(file.empty() ? tr("No file") : QString::fromStdString(file));
  fileName_->setToolTip(QString::fromStdString(design.source.path.string()));
  QString facts;
  const auto& newest = bench_.runner().evaluation();
  if (newest && newest->model.value) {
    const geometry::CadInfo& info = newest->model.value->info();
    facts = tr("%1, unit %2, %3")
                .arg(QString::fromStdString(info.format), QString::fromStdString(info.unit),
                     info.faces == 1 ? tr("1 face") : tr("%1 faces").arg(info.faces));
    if (newest->target.value) facts += "\n" + sizeText(newest->target.value->bounds().size());
    if (!info.healing.empty())
      facts += "\n" + tr("Repaired: %1").arg(QString::fromStdString(info.healing.front()));
  }
  fileFacts_->setText(facts);
  fileFacts_->setVisible(!facts.isEmpty());
  faces_->show(int(job.face.kind));
  setLineVisible(faceListLabel_, faceList_, job.face.kind == FaceChoice::Kind::indices);
  QStringList list;
  for (int index : job.face.indices) list << QString::number(index);
  faceList_->show(list.join(", "));
  const bool embedded = !design.source.bytes.empty();
  embed_->setChecked(embedded);
  std::error_code ignored;
  embed_->setEnabled(!embedded || std::filesystem::is_regular_file(design.source.path, ignored));
}

}  // namespace bw::app
