// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/face_chooser.h"

#include <QEvent>
#include <QHBoxLayout>

#include <algorithm>

#include "bw/core/text/printable.h"
#include "controls/fields.h"
#include "controls/numbers.h"

namespace bw::app {

namespace {

/// The kind of a surface in words of the trade.
QString kindText(const std::string& type) {
  static const std::pair<const char*, const char*> kWords[] = {
      {"plane", QT_TR_NOOP("plane")},        {"cylinder", QT_TR_NOOP("cylinder")},
      {"cone", QT_TR_NOOP("cone")},          {"sphere", QT_TR_NOOP("sphere")},
      {"torus", QT_TR_NOOP("torus")},        {"revolution", QT_TR_NOOP("revolved")},
      {"extrusion", QT_TR_NOOP("extruded")}, {"offset", QT_TR_NOOP("offset surface")},
      {"bspline", QT_TR_NOOP("free-form")},  {"bezier", QT_TR_NOOP("free-form")}};
  for (const auto& [word, text] : kWords)
    if (type == word) return FaceChooser::tr(text);
  return FaceChooser::tr("surface");
}

}  // namespace

FaceChooser::FaceChooser(Workbench& bench, const Theme& theme, QWidget* picture)
    : QFrame(picture->parentWidget()),
      bench_(bench),
      theme_(theme),
      picture_(picture),
      text_(new QLabel(this)),
      hint_(new QLabel(picture->parentWidget())),
      done_(new QPushButton(tr("Done"), this)) {
  setObjectName("floating");
  setAccessibleName(tr("Choosing faces"));
  auto* layout = makeBox<QHBoxLayout>(this, {kGroupGap, 6, kGap, 6}, kGroupGap);
  layout->addWidget(text_, 1);
  layout->addWidget(done_);
  text_->setWordWrap(true);
  picture->installEventFilter(this);
  done_->setToolTip(tr("Back to the result (Esc)"));
  hint_->setObjectName("floating");
  hint_->setContentsMargins(kGap, 4, kGap, 4);
  hint_->setAttribute(Qt::WA_TransparentForMouseEvents);
  hint_->setTextFormat(Qt::PlainText);
  connect(done_, &QPushButton::clicked, this, [this] { setChoosing(false); });
  connect(&bench.document(), &model::Document::replaced, this, [this] { setChoosing(false); });
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (change.any(Aspect::design | Aspect::source | Aspect::target, bench_.selection())) refresh();
  });
  connect(&theme, &Theme::changed, this, &FaceChooser::refresh);
  hide();
  hint_->hide();
}

bool FaceChooser::possible() const {
  const auto& newest = bench_.runner().evaluation();
  return newest && newest->faceMesh.value;
}

void FaceChooser::setChoosing(bool on) {
  on = on && possible();
  if (on == choosing_) return;
  choosing_ = on;
  hovered_ = -1;
  hint_->hide();
  refresh();
  emit changed();
  emit choosingChanged(on);
}

std::vector<int> FaceChooser::chosen() const {
  const FaceChoice& choice = bench_.cut().face;
  if (choice.kind == FaceChoice::Kind::indices) return choice.indices;
  const geometry::Target* target = bench_.newestTarget();
  return target ? target->faces() : std::vector<int>();
}

void FaceChooser::applyTo(scene::Style& style) const {
  style.chooseFaces = choosing_;
  style.chosenFaces = chosen();
  style.hoveredFace = hovered_;
}

QString FaceChooser::wordsFor(int face) const {
  const geometry::CadInfo* file = bench_.fileInfo();
  if (!file || face < 0 || std::size_t(face) >= file->faceList.size()) return {};
  const geometry::FaceInfo& info = file->faceList[std::size_t(face)];
  const QString name =
      info.name.empty() ? QString() : QStringLiteral("\n") + QString::fromStdString(printable(info.name));
  return tr("Face %1").arg(face) + ", " + kindText(info.type) + name + "\n" + sizeText(info.bounds.size());
}

void FaceChooser::hover(int face, const QPointF& place) {
  if (!choosing_) return;
  const QString words = wordsFor(face);
  hint_->setVisible(!words.isEmpty());
  if (!words.isEmpty()) {
    if (face != hovered_) {
      hint_->setText(words);
      hint_->adjustSize();
    }
    // Beside the mouse, inside the picture.
    const QRect all = picture_->geometry();
    QPoint corner = all.topLeft() + place.toPoint() + QPoint(18, 14);
    if (corner.x() + hint_->width() > all.right()) corner.rx() -= hint_->width() + 30;
    if (corner.y() + hint_->height() > all.bottom()) corner.ry() -= hint_->height() + 22;
    hint_->move(corner);
    hint_->raise();
  }
  if (face == hovered_) return;
  hovered_ = face;
  emit changed();
}

void FaceChooser::click(int face, Qt::KeyboardModifiers keys) {
  if (!choosing_ || face < 0) return;
  std::vector<int> faces{face};
  if (keys.testFlag(Qt::ControlModifier)) {
    faces = chosen();
    const auto found = std::find(faces.begin(), faces.end(), face);
    if (found == faces.end()) {
      faces.push_back(face);
    } else if (faces.size() > 1) {
      faces.erase(found);
    }
    std::sort(faces.begin(), faces.end());
  }
  if (bench_.cut().face.kind == FaceChoice::Kind::indices && bench_.cut().face.indices == faces) return;
  FaceChoice choice;
  choice.kind = FaceChoice::Kind::indices;
  choice.indices = faces;
  bench_.editCut(tr("Choose faces"), [&](Cut& cut) { cut.face = choice; });
}

void FaceChooser::refresh() {
  if (choosing_ && !possible()) return setChoosing(false);
  setVisible(choosing_);
  if (!choosing_) return;
  const std::size_t count = chosen().size();
  text_->setText(tr("Click a face to cut it; Ctrl+click adds it or takes it away.") + " " +
                 (count == 1 ? tr("1 face is chosen.") : tr("%1 faces are chosen.").arg(count)));
  place();
  emit changed();
}

void FaceChooser::place() {
  constexpr int kWidest = 620;
  const QRect all = picture_->geometry();
  const int wide = std::min(kWidest, all.width() - 2 * kGap);
  resize(wide, layout()->hasHeightForWidth() ? layout()->heightForWidth(wide) : sizeHint().height());
  move(all.left() + (all.width() - width()) / 2, all.bottom() - height() - kGroupGap);
  raise();
}

bool FaceChooser::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && choosing_) place();
  return QFrame::eventFilter(watched, event);
}

}  // namespace bw::app
