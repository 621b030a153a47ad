// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "versions/version_panel.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QSignalBlocker>

#include <algorithm>
#include <utility>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/text/printable.h"
#include "versions/compared_numbers.h"

namespace bw::app {

namespace {

constexpr int kLeastWidth = 250;
constexpr int kSettle = 100;                     // ms: a hand that moves something is not kept waiting
constexpr int kFewestLines = 3, kMostLines = 8;  // of the list, before it scrolls
constexpr std::size_t kMostDifferences = 40;     // told one by one

QString shown(const std::string& text) { return QString::fromStdString(printable(text)); }

/// The same with places where it may be broken into lines, however long its words are.
QString breakable(QString text) {
  constexpr int kMost = 24;
  int run = 0;
  for (qsizetype i = 0; i < text.size(); ++i) {
    run = text[i].isSpace() ? 0 : run + 1;
    if (run < kMost) continue;
    text.insert(++i, QChar(0x200b));
    run = 0;
  }
  return text;
}

QString sentence(const Error& error) {
  QString text = QString::fromStdString(printable(error.message));
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

}  // namespace

VersionName::VersionName(Workbench& bench, QWidget* parent) : TypedField(parent), bench_(bench) {
  setPlaceholderText(tr("Name of this version"));
  setAccessibleName(tr("Name of this version"));
  setToolTip(tr("Keeps the design as it is now under a name: to come back to, and to compare with"));
}

QString VersionName::take(const QString& text) {
  const QString name = text.trimmed();
  if (!name.isEmpty()) {
    Result<Design> named = withVersion(bench_.design(), name.toStdString());
    if (!named) return sentence(named.error());
    bench_.editDesign(tr("Name version"), [&named](Design& design) { design = std::move(*named); });
  }
  return {};
}

QString VersionName::limitsText() const { return tr("A name that no other version has"); }

VersionList::VersionList(Workbench& bench, QWidget* parent) : QTreeWidget(parent), bench_(bench) {
  setAccessibleName(tr("Versions"));
  setColumnCount(2);
  setHeaderHidden(true);
  setRootIsDecorated(false);
  setFrameShape(QFrame::NoFrame);
  setUniformRowHeights(true);
  setEditTriggers(NoEditTriggers);
  setExpandsOnDoubleClick(false);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(name, QHeaderView::Stretch);
  header()->setSectionResizeMode(differs, QHeaderView::ResizeToContents);
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item, int column) {
    if (column == name) editItem(item, name);
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    const auto index = std::size_t(indexOfTopLevelItem(item));
    if (busy_ || column != name || index >= built_.size()) return;
    // Once the editor is done with the line: another name builds all of them anew.
    QMetaObject::invokeMethod(
        this, [this, version = built_[index].name, next = item->text(name)] { rename(version, next); },
        Qt::QueuedConnection);
  });
  connect(this, &QTreeWidget::currentItemChanged, this, [this] {
    if (busy_) return;
    emit picked();
    emit chosenChanged();
  });
  refresh();
}

std::string VersionList::chosen() const {
  const auto index = std::size_t(currentItem() ? indexOfTopLevelItem(currentItem()) : topLevelItemCount());
  return index < built_.size() ? built_[index].name : std::string();
}

void VersionList::choose(const std::string& version) {
  const auto found = std::ranges::find(built_, version, &NamedVersion::name);
  if (found != built_.end()) setCurrentItem(topLevelItem(int(found - built_.begin())));
}

void VersionList::refresh() {
  const std::vector<NamedVersion>& versions = bench_.design().versions;
  if (built_ == versions) return;
  const bool was = std::exchange(busy_, true);
  const bool grown = versions.size() > built_.size();
  const std::string before = chosen();
  built_ = versions;
  clear();
  for (const NamedVersion& version : versions) {
    auto* item = new QTreeWidgetItem(this);
    item->setText(name, shown(version.name));
    item->setToolTip(name, tr("%1 (F2 gives it another name)").arg(shown(version.name)));
    item->setTextAlignment(differs, Qt::AlignRight | Qt::AlignVCenter);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable);
  }
  choose(grown && !versions.empty() ? versions.back().name : before);
  if (!currentItem() && topLevelItemCount() > 0) setCurrentItem(topLevelItem(topLevelItemCount() - 1));
  updateGeometry();
  busy_ = was;
  countDifferences();
  emit chosenChanged();
}

void VersionList::countDifferences() {
  const bool was = std::exchange(busy_, true);
  const std::vector<NamedVersion>& versions = bench_.design().versions;
  for (std::size_t i = 0; i < versions.size(); ++i) {
    const std::size_t count = differences(*versions[i].design, bench_.design()).size();
    topLevelItem(int(i))->setText(differs, count == 0   ? tr("as now")
                                           : count == 1 ? tr("1 difference")
                                                        : tr("%1 differences").arg(count));
  }
  busy_ = was;
}

QSize VersionList::sizeHint() const {
  const int lines = std::clamp(topLevelItemCount(), kFewestLines, kMostLines);
  const int line = topLevelItemCount() > 0 ? sizeHintForRow(0) : fontMetrics().height() + 4;
  return {QTreeWidget::sizeHint().width(), lines * line + 2 * frameWidth() + 4};
}

void VersionList::edit(const QString& step, const Result<Design>& changed) {
  if (!changed) return bench_.tell(Topic::declined, changed.error());
  bench_.editDesign(step, [&changed](Design& design) { design = *changed; });
}

void VersionList::rename(const std::string& version, const QString& next) {
  const std::string words = next.trimmed().toStdString();
  const bool same = words == printable(version);
  const Result<Design> renamed =
      same ? Result<Design>(bench_.design()) : withVersionRenamed(bench_.design(), version, words);
  edit(tr("Rename version"), renamed);
  built_.clear();  // what was refused is called as before
  refresh();
  choose(renamed && !same ? words : version);
}

void VersionList::editName() {
  if (currentItem()) editItem(currentItem(), name);
}

void VersionList::goBack() {
  if (const std::string version = chosen(); !version.empty())
    edit(tr("Go back to %1").arg(shown(version)), atVersion(bench_.design(), version));
}

void VersionList::removeChosen() {
  if (const std::string version = chosen(); !version.empty())
    edit(tr("Remove version"), withoutVersion(bench_.design(), version));
}

void VersionList::keyPressEvent(QKeyEvent* event) {
  if (currentItem() && event->modifiers() == Qt::NoModifier && state() != EditingState) {
    if (event->key() == Qt::Key_F2) return editName();
    if (event->key() == Qt::Key_Delete) return removeChosen();
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return goBack();
    if (event->key() == Qt::Key_Escape && returnKeyboard(*this)) return;
  }
  QTreeWidget::keyPressEvent(event);
}

VersionPanel::VersionPanel(Workbench& bench, Comparison& comparison, const Theme& theme, QWidget* parent)
    : SidePanel(kLeastWidth, parent), bench_(bench), comparison_(comparison) {
  auto* page = new QWidget;
  page->setObjectName("page");
  // Narrow at the sides: two numbers with their marks have room beside the picture of the smallest window.
  auto* layout = makeBox<QVBoxLayout>(page, {kGap, kGroupGap, kGap, kGroupGap}, kGap);
  name_ = new VersionName(bench, page);
  layout->addWidget(name_);
  layout->addWidget(makeButton(tr("Name this version"), name_->toolTip(), this, [this] {
    if (name_->text().trimmed().isEmpty()) name_->setFocus();
    name_->finish();
  }));
  none_ =
      makeNote(tr("No version has a name yet. What is named here is kept in the file of the design."), page);
  layout->addWidget(none_);
  list_ = new VersionList(bench, page);
  layout->addWidget(list_);
  auto* buttons = new QWidget(page);
  auto* grid = new QGridLayout(buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(kGap);
  back_ = makeButton(tr("Go back"), tr("Makes the design what it was in this version; undo takes it back"),
                     list_, &VersionList::goBack);
  compare_ = makeButton(tr("Compare"), tr("Shows this version beside the present result"), this, [this] {
    comparison_.choose(compare_->isChecked() ? Beside{Beside::What::version, list_->chosen()} : Beside{});
    refresh();
  });
  compare_->setCheckable(true);
  rename_ =
      makeButton(tr("Rename"), tr("Gives this version another name (F2)"), list_, &VersionList::editName);
  remove_ = makeButton(tr("Remove"), tr("Takes this version away (Del); undo brings it back"), list_,
                       &VersionList::removeChosen);
  grid->addWidget(back_, 0, 0);
  grid->addWidget(compare_, 0, 1);
  grid->addWidget(rename_, 1, 0);
  grid->addWidget(remove_, 1, 1);
  layout->addWidget(buttons);

  title_ = makeTitle({}, page);
  title_->setWordWrap(true);
  layout->addWidget(title_);
  state_ = makeNote({}, page);
  layout->addWidget(state_);
  table_ = new QWidget(page);
  auto* table = new QGridLayout(table_);
  table->setContentsMargins(0, 0, 0, 0);
  table->setHorizontalSpacing(kGap);
  table->setVerticalSpacing(4);
  table->setColumnStretch(0, 1);
  for (const auto& [column, text] : {std::pair(1, tr("Then")), std::pair(2, tr("Now"))}) {
    auto* head = new QLabel(text, table_);
    head->setObjectName("secondary");
    head->setFont(Theme::secondaryFont());
    table->addWidget(head, 0, column, Qt::AlignRight);
  }
  for (const ComparedNumber& number : comparedNumbers(nullptr)) {
    const Line line{new QLabel(number.name, table_), new ValueLabel(table_), new ValueLabel(table_)};
    const int row = table->rowCount();
    int column = 0;
    for (QLabel* label : {line.name, static_cast<QLabel*>(line.then), static_cast<QLabel*>(line.now)}) {
      label->setToolTip(number.tip);
      label->setFont(Theme::secondaryFont());
      table->addWidget(label, row, column, column == 0 ? Qt::AlignLeft : Qt::AlignRight);
      ++column;
    }
    line.then->setAccessibleName(tr("%1, then").arg(number.name));
    line.now->setAccessibleName(tr("%1, now").arg(number.name));
    numbers_.push_back(line);
  }
  layout->addWidget(table_);
  differences_ = new QWidget(page);
  differenceLines_ = makeBox<QVBoxLayout>(differences_, {}, 4);
  layout->addWidget(differences_);
  layout->addStretch();
  setWidget(page);
  page->installEventFilter(this);

  connect(list_, &VersionList::picked, this, [this] {
    // Who compares with a version and chooses another wants to see that.
    if (comparison_.beside().what == Beside::What::version)
      comparison_.choose({Beside::What::version, list_->chosen()});
    refresh();
  });
  connect(&comparison, &Comparison::chosen, this, &VersionPanel::refresh);
  connect(&comparison, &Comparison::computed, this, &VersionPanel::refreshNumbers);
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (change.any(Aspect::design)) list_->refresh();
    if (change.any(Aspect::design) && isVisible() && !settle_.isActive()) settle_.start();
    if (change.any(Aspect::result | Aspect::sketch | Aspect::state) && isVisible()) refreshNumbers();
  });
  connect(&theme, &Theme::changed, this, &VersionPanel::refreshNumbers);
  settle_.setSingleShot(true);
  settle_.setInterval(kSettle);
  connect(&settle_, &QTimer::timeout, this, [this] {
    if (bench_.sketch()) return settle_.start();  // the hand goes on
    refresh();
  });
  refresh();
}

void VersionPanel::showEvent(QShowEvent* event) {
  SidePanel::showEvent(event);
  refresh();
}

void VersionPanel::beginNaming() {
  name_->setFocus();
  name_->selectAll();
}

const Design* VersionPanel::told(QString& name) const {
  if (comparison_.beside().what == Beside::What::before && comparison_.design()) {
    name = tr("Before the last change");
    return comparison_.design().get();
  }
  const auto& versions = bench_.design().versions;
  const auto found = std::ranges::find(versions, list_->chosen(), &NamedVersion::name);
  if (found == versions.end()) return nullptr;
  name = shown(found->name);
  return found->design.get();
}

void VersionPanel::refresh() {
  const Beside& beside = comparison_.beside();
  list_->refresh();
  list_->countDifferences();
  if (beside.what == Beside::What::version) {
    const QSignalBlocker quiet(list_);
    list_->choose(beside.version);
  }
  const bool any = !bench_.design().versions.empty(), one = !list_->chosen().empty();
  none_->setVisible(!any);
  list_->setVisible(any);
  for (QPushButton* button : {back_, compare_, rename_, remove_}) {
    button->setVisible(any);
    button->setEnabled(one);
  }
  compare_->setChecked(beside.what == Beside::What::version);
  refreshDifferences();
  refreshNumbers();
}

void VersionPanel::refreshNumbers() {
  const Beside::What what = comparison_.beside().what;
  const bool compared = what == Beside::What::version || what == Beside::What::before;
  table_->setVisible(compared);
  state_->setVisible(compared && (comparison_.busy() || comparison_.error()));
  if (!compared) return;
  state_->setText(comparison_.busy()    ? tr("It is being computed.")
                  : comparison_.error() ? sentence(*comparison_.error())
                                        : QString());
  const std::vector<ComparedNumber> then = comparedNumbers(comparison_.evaluation().get()),
                                    now = comparedNumbers(bench_.shown().get());
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const auto show = [](ValueLabel& label, const ComparedNumber& number, bool stale) {
      label.setText(number.text.isEmpty() ? QStringLiteral("–") : number.text);
      label.setStanding(number.broken, stale);
    };
    show(*numbers_[i].then, then[i], comparison_.busy());
    show(*numbers_[i].now, now[i], bench_.stale() || bench_.sketch());
  }
}

void VersionPanel::refreshDifferences() {
  QString name;
  const Design* then = told(name);
  title_->setVisible(then != nullptr);
  differences_->setVisible(then != nullptr);
  QStringList lines;
  if (then) {
    title_->setText(breakable(tr("%1, and now").arg(name)));
    const std::vector<DesignDifference> all = differences(*then, bench_.design());
    for (std::size_t i = 0; i < std::min(all.size(), kMostDifferences); ++i)
      lines << breakable(shown(sentenceOf(all[i])));
    if (all.size() > kMostDifferences) lines << tr("and %1 more").arg(all.size() - kMostDifferences);
    if (all.empty()) lines << tr("Nothing differs.");
  }
  if (std::exchange(shownDifferences_, lines) == lines) return;
  empty(*differenceLines_);
  for (const QString& line : lines) differenceLines_->addWidget(makeNote(line, differences_));
}

QStringList VersionPanel::shownNumbers() const {
  QStringList lines;
  for (const Line& line : numbers_)
    if (table_->isVisible()) lines << line.name->text() + "|" + line.then->text() + "|" + line.now->text();
  return lines;
}

QStringList VersionPanel::shownDifferences() const { return shownDifferences_; }

}  // namespace bw::app
