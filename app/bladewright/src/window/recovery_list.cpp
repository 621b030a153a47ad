// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/recovery_list.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>

#include "controls/fields.h"

namespace bw::app {

namespace {

constexpr QSize kPictureSize(120, 75);

QString nameOf(const model::RecoveryCopy& copy) {
  if (!copy.problem.isEmpty()) return RecoveryList::tr("A copy that cannot be read");
  if (!copy.file.empty()) return QString::fromStdString(copy.file.stem().string());
  return copy.name;
}

}  // namespace

RecoveryList::RecoveryList(const Theme& theme, const std::filesystem::path& folder, QWidget* parent)
    : QFrame(parent), theme_(theme), folder_(folder) {
  auto* layout = makeBox<QVBoxLayout>(this, {0, 0, 0, kGroupGap}, kGap);
  layout->addWidget(makeTitle(tr("Unsaved work"), this));
  rows_ = new QVBoxLayout;
  rows_->setSpacing(kGap);
  layout->addLayout(rows_);
  connect(&theme, &Theme::changed, this, &RecoveryList::refresh);
  refresh();
}

void RecoveryList::refresh() {
  copies_ = folder_.empty() ? std::vector<model::RecoveryCopy>() : model::listRecovery(folder_);
  empty(*rows_);
  for (const model::RecoveryCopy& copy : copies_) rows_->addWidget(makeRow(copy));
  setVisible(!copies_.empty());
  emit refreshed();
}

QWidget* RecoveryList::makeRow(const model::RecoveryCopy& copy) {
  const QString path = QString::fromStdString(copy.copy.string()), name = nameOf(copy);
  auto* row = new QWidget(this);
  auto* layout = makeBox<QHBoxLayout>(row, {}, kGroupGap);
  auto* picture = new QLabel(row);
  picture->setFixedSize(kPictureSize);
  picture->setAlignment(Qt::AlignCenter);
  if (copy.picture.isNull()) {
    picture->setPixmap(
        theme_.pixmap(copy.problem.isEmpty() ? "sweep" : "warning", theme_.colours().disabled, 32));
  } else {
    QPixmap scaled = QPixmap::fromImage(copy.picture.scaled(kPictureSize * devicePixelRatio(),
                                                            Qt::KeepAspectRatio, Qt::SmoothTransformation));
    scaled.setDevicePixelRatio(devicePixelRatio());
    picture->setPixmap(scaled);
  }
  layout->addWidget(picture);

  auto* words = makeBox<QVBoxLayout>(nullptr, {}, 2);
  auto* title = new QLabel(name, row);
  title->setTextFormat(Qt::PlainText);
  words->addWidget(title);
  const QString place =
      copy.problem.isEmpty()
          ? copy.file.empty() ? tr("Never saved") : QString::fromStdString(copy.file.string())
          : tr("%1 – it is kept as %2").arg(copy.problem, path);
  auto* where = makeNote(place, row);
  where->setTextInteractionFlags(Qt::TextSelectableByMouse);
  words->addWidget(where);
  words->addWidget(makeNote(tr("%1   ·   %2")
                                .arg(QLocale().toString(copy.time, QLocale::ShortFormat),
                                     QLocale().formattedDataSize(qint64(copy.size))),
                            row));
  layout->addLayout(words, 1);

  auto* open = makeButton(tr("Go on with it"), tr("Opens it; it stays unsaved until you save it"), this,
                          [this, path] { emit openRequested(path); });
  open->setObjectName("primary");
  open->setEnabled(copy.problem.isEmpty());
  open->setAccessibleName(tr("Go on with %1").arg(name));
  auto* discard = makeButton(tr("Discard…"), tr("Removes the copy after a question"), this,
                             [this, path, name] { emit discardRequested(path, name); });
  discard->setAccessibleName(tr("Discard %1").arg(name));
  layout->addWidget(open);
  layout->addWidget(discard);
  return row;
}

}  // namespace bw::app
