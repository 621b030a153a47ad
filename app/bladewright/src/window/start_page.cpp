// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/start_page.h"

#include <QEvent>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <QToolButton>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"
#include "controls/fields.h"

namespace bw::app {

namespace {

constexpr QSize kPictureSize(120, 75);

QString nameOf(const model::RecoveryCopy& copy) {
  if (!copy.problem.isEmpty()) return RecoveryList::tr("A copy that cannot be read");
  if (!copy.file.empty()) return QString::fromStdString(copy.file.stem().string());
  return copy.name;
}

constexpr int kCardWidth = 208, kPictureHeight = 132, kCardHeight = kPictureHeight + 48;
constexpr int kCardGap = 16;
constexpr int kPageWidth = 4 * kCardWidth + 3 * kCardGap;
constexpr int kPageMargin = 40;
constexpr int kRecentShown = 6;
constexpr int kOverlap = 4;  // px by which neighbours of a row may overlap

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

ExampleCard::ExampleCard(const Theme& theme, const QString& name, const QString& title, QWidget* parent)
    : QAbstractButton(parent),
      theme_(theme),
      picture_(":/icons/examples/" + name + ".png"),
      darkPicture_(":/icons/examples/" + name + "-dark.png") {
  setObjectName("example." + name);
  setText(title);
  setAccessibleName(tr("Example: %1").arg(title));
  setToolTip(tr("Open the example “%1”").arg(title));
  setCursor(Qt::PointingHandCursor);
  setFocusPolicy(Qt::StrongFocus);
  setFixedSize(sizeHint());
}

QSize ExampleCard::sizeHint() const { return {kCardWidth, kCardHeight}; }

bool ExampleCard::event(QEvent* event) {
  if (event->type() == QEvent::Enter || event->type() == QEvent::Leave) update();
  return QAbstractButton::event(event);
}

void ExampleCard::paintEvent(QPaintEvent*) {
  const Colours& c = theme_.colours();
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  QPainterPath path;
  path.addRoundedRect(frame, 6, 6);
  painter.fillPath(path, c.panel);
  painter.save();
  painter.setClipPath(path);
  const QRectF area(0, 0, width(), kPictureHeight);
  painter.fillRect(area, c.dark ? QColor("#2A2D32") : QColor("#F3F4F4"));
  if (const QPixmap& picture = c.dark ? darkPicture_ : picture_; !picture.isNull()) {
    const double scale = std::max(area.width() / picture.width(), area.height() / picture.height());
    const QSizeF size = QSizeF(picture.size()) * scale;
    painter.drawPixmap(QRectF(area.center() - QPointF(size.width(), size.height()) / 2, size), picture,
                       picture.rect());
  } else {
    painter.drawPixmap(QPointF(area.center() - QPointF(20, 20)), theme_.pixmap("surface", c.disabled, 40));
  }
  painter.restore();
  const bool lit = underMouse() || hasFocus() || isDown();
  painter.setPen(QPen(lit ? c.selection : c.line, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(path);
  painter.setPen(c.text);
  painter.setFont(Theme::bodyFont());
  const QRect text(12, kPictureHeight + 4, width() - 24, kCardHeight - kPictureHeight - 8);
  painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, this->text());
}

StartPage::StartPage(Workbench& bench, const Theme& theme, QWidget* parent)
    : QScrollArea(parent), bench_(bench), theme_(theme) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* outer = new QWidget;
  outer->setObjectName("start");
  auto* center = makeBox<QHBoxLayout>(outer, {kPageMargin, kPageMargin, kPageMargin, kPageMargin});
  page_ = new QWidget(outer);
  page_->setMaximumWidth(kPageWidth);
  center->addStretch();
  center->addWidget(page_, 100);
  center->addStretch();
  auto* layout = makeBox<QVBoxLayout>(page_, {}, kGap);

  auto* title = new QLabel(tr("Bladewright"), page_);
  QFont big = Theme::bodyFont();
  big.setPointSize(22);
  big.setWeight(QFont::DemiBold);
  title->setFont(big);
  layout->addWidget(title);
  auto* claim = new QLabel(
      tr("Surfaces that a hot blade can cut from foam, and the robot programs that cut them."), page_);
  claim->setObjectName("secondary");
  claim->setWordWrap(true);
  layout->addWidget(claim);
  layout->addSpacing(kGroupGap);
  auto* buttons = makeBox<QHBoxLayout>(nullptr, {}, kGap);
  const auto add = [&](const QString& text, const QString& tip, void (StartPage::*signal)()) {
    auto* button = makeButton(text, tip, this, signal);
    buttons->addWidget(button);
    button->installEventFilter(this);
    return button;
  };
  surface_ = add(tr("Open CAD surface…"), tr("A STEP, IGES or BREP file becomes a blade sweep"),
                 &StartPage::openSurfaceRequested);
  surface_->setObjectName("primary");
  add(tr("Open design…"), tr("A .bladewright file saved before"), &StartPage::openDesignRequested);
  add(tr("New single block"), tr("A surface of 4 × 6 poles in a block of 600 × 800 × 500 mm"),
      &StartPage::newBlockRequested);
  add(tr("New wall"), tr("A surface through sections over three blocks of 600 × 800 × 500 mm side by side"),
      &StartPage::newWallRequested);
  add(tr("Measure a blade…"), tr("The length of a mounted blade from how far it sags"),
      &StartPage::measureRequested);
  buttons->addSpacing(kGap);
  auto* drop = makeNote(tr("or drop a file here"), page_);
  drop->setWordWrap(false);
  buttons->addWidget(drop);
  buttons->addStretch();
  layout->addLayout(buttons);
  layout->addSpacing(kStepGap);

  above_ = new QVBoxLayout;
  layout->addLayout(above_);
  recentTitle_ = makeTitle(tr("Recent"), page_);
  layout->addWidget(recentTitle_);
  recent_ = new QVBoxLayout;
  recent_->setSpacing(0);
  layout->addLayout(recent_);

  layout->addWidget(makeTitle(tr("Examples"), page_));
  shelf_ = new QWidget(page_);
  layout->addWidget(shelf_);
  std::vector<geometry::Example> examples = geometry::exampleList();
  // What is begun anew has its buttons above.
  std::ranges::copy_if(
      pipeline::designedExamples(), std::back_inserter(examples), [](const geometry::Example& example) {
        return example.name != pipeline::kSingleBlock && example.name != pipeline::kBlockWall;
      });
  for (const geometry::Example& example : examples) {
    const QString name = QString::fromStdString(example.name);
    auto* card = new ExampleCard(theme, name,
                                 QString::fromStdString(example.title)
                                     .replace(" mm", QString(QChar(0xa0)) + "mm")
                                     .replace(" × ", QString(QChar(0xa0)) + "×" + QChar(0xa0)),
                                 shelf_);
    connect(card, &QAbstractButton::clicked, this, [this, name] { emit exampleRequested(name); });
    card->installEventFilter(this);
    cards_.push_back(card);
  }
  layout->addStretch();
  setWidget(outer);
  viewport()->setAutoFillBackground(false);
  outer->setAutoFillBackground(false);
  connect(&bench.settings(), &model::Settings::recentFilesChanged, this, &StartPage::refreshRecent);
  connect(&theme, &Theme::changed, this, &StartPage::refreshRecent);
  refreshRecent();
  arrange();
}

void StartPage::putAbove(RecoveryList* list) {
  above_->addWidget(list);
  const auto addTargets = [this, list] {
    for (QAbstractButton* button : list->findChildren<QAbstractButton*>()) button->installEventFilter(this);
  };
  addTargets();
  connect(list, &RecoveryList::refreshed, this, addTargets);
}

void StartPage::refreshRecent() {
  empty(*recent_);
  const auto files = bench_.settings().recentFiles();
  recentTitle_->setVisible(!files.empty());
  for (std::size_t i = 0; i < files.size() && i < kRecentShown; ++i) {
    const QString path = QString::fromStdString(files[i].string());
    auto* button = new QToolButton(page_);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setIcon(theme_.icon(path.endsWith(".bladewright") ? "sweep" : "surface"));
    const QFileInfo info(path);
    button->setText(QStringLiteral(" %1   –   %2")
                        .arg(info.fileName(),
                             QFontMetrics(Theme::bodyFont()).elidedText(info.path(), Qt::ElideMiddle, 480)));
    button->setToolTip(path);
    connect(button, &QToolButton::clicked, this, [this, path] { emit openRequested(path); });
    button->installEventFilter(this);
    recent_->addWidget(button, 0, Qt::AlignLeft);
  }
  if (!files.empty()) recent_->addSpacing(kGroupGap);
}

void StartPage::arrange() {
  const int width = std::min(kPageWidth, viewport()->width() - 2 * kPageMargin);
  const int columns = std::clamp((width + kCardGap) / (kCardWidth + kCardGap), 1, 4);
  if (columns == columns_) return;
  columns_ = columns;
  const int rows = (int(cards_.size()) + columns - 1) / columns;
  shelf_->setFixedHeight(rows * kCardHeight + (rows - 1) * kCardGap);
  for (std::size_t i = 0; i < cards_.size(); ++i)
    cards_[i]->move(int(i) % columns * (kCardWidth + kCardGap), int(i) / columns * (kCardHeight + kCardGap));
}

bool StartPage::eventFilter(QObject* watched, QEvent* event) {
  auto* button = qobject_cast<QAbstractButton*>(watched);
  if (!button || event->type() != QEvent::KeyPress) return QScrollArea::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
  const QPoint way((key == Qt::Key_Right) - (key == Qt::Key_Left),
                   (key == Qt::Key_Down) - (key == Qt::Key_Up));
  if (!enter && way.isNull()) return QScrollArea::eventFilter(watched, event);
  enter ? button->click() : moveKeyboard(*button, way);
  return true;
}

void StartPage::moveKeyboard(const QAbstractButton& from, const QPoint& direction) {
  const auto place = [this](const QAbstractButton& button) {
    return QRect(button.mapTo(widget(), QPoint()), button.size());
  };
  const QRect here = place(from);
  QAbstractButton* nearest = nullptr;
  int least = 0;
  for (QAbstractButton* button : page_->findChildren<QAbstractButton*>()) {
    if (button == &from || !button->isVisible() || !button->isEnabled()) continue;
    const QRect there = place(*button);
    const QPoint way = there.center() - here.center();
    // How far along the direction from edge to edge, and how far beside it.
    const bool across = direction.x() != 0;
    const int along = QPoint::dotProduct(way, direction) -
                      (across ? here.width() + there.width() : here.height() + there.height()) / 2;
    const int beside = across ? std::max({0, there.top() - here.bottom(), here.top() - there.bottom()})
                              : std::max({0, there.left() - here.right(), here.left() - there.right()});
    if (along < -kOverlap || (across && beside > 0)) continue;
    const int distance = 2 * (along + beside) + std::abs(across ? way.y() : way.x()) / 8;
    if (nearest && distance >= least) continue;
    nearest = button;
    least = distance;
  }
  if (!nearest) return;
  nearest->setFocus(Qt::TabFocusReason);
  ensureWidgetVisible(nearest);
}

void StartPage::showEvent(QShowEvent* event) {
  QScrollArea::showEvent(event);
  if (!isAncestorOf(window()->focusWidget())) surface_->setFocus();
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  arrange();
}

}  // namespace bw::app
