// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/vary_dialog.h"

#include <QApplication>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QPointer>
#include <QShortcut>

#include <algorithm>
#include <mutex>
#include <stop_token>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/scene_content.h"

namespace bw::app {

namespace {

constexpr QSize kSize(1000, 620);
constexpr QSize kNewest(240, 160), kPicture(120, 80);  // device-independent pixels
constexpr double kFarthest = 1e9;                      // the range of the variable is checked besides
constexpr double kLeastShown = 5e-4;                   // of what is measured, mm or °
constexpr int kCollect = 100;                          // ms between looks at what is computed
enum Column { kValue, kResult, kDeviation, kRadius, kAngle, kRest, kTime, kFindings, kColumns };

}  // namespace

/// What the thread that computes and the dialog share.
struct VaryDialog::Work {
  std::mutex mutex;
  struct Made {
    pipeline::Variation variation;
    scene::Content content;
  };
  std::vector<Made> made;  // and not yet collected
  std::stop_source stop;   // of this work alone; what the window computes besides goes on
};

VaryDialog::VaryDialog(Workbench& bench, const Theme& theme, QWidget* parent)
    : QDialog(parent), bench_(bench), theme_(theme) {
  setWindowTitle(tr("Vary a variable"));
  resize(kSize);
  auto* layout = new QVBoxLayout(this);
  auto* column = new FormColumn;
  variable_ = column->addLong(tr("Variable"), tr("What is varied; all else of the design stays"));
  for (const Variable& variable : bench_.design().variables)
    variable_->addItem(QString::fromStdString(variable.name));
  from_ = column->add(tr("From"), new NumberField({-kFarthest, kFarthest, 3, 1, {}}), tr("The first value"));
  to_ = column->add(tr("To"), new NumberField({-kFarthest, kFarthest, 3, 1, {}}), tr("The last value"));
  count_ = column->add(tr("Values"),
                       new NumberField({pipeline::VaryRange::kLeast, pipeline::VaryRange::kMost, 0, 1, {}}),
                       tr("How many, both ends among them, evenly spaced"));
  count_->show(pipeline::VaryRange{}.count);
  auto* top = new QWidget;
  auto* beside = makeBox<QHBoxLayout>(top, {}, kGap);
  beside->addWidget(column, 1);
  newest_ = new view::SceneView;
  newest_->setFixedSize(kNewest);
  newest_->setAccessibleName(tr("What was computed last"));
  newest_->setToolTip(tr("What was computed last, with the map of deviation"));
  beside->addWidget(newest_, 0, Qt::AlignTop);
  layout->addWidget(top);
  auto* row = new QWidget;
  auto* buttons = makeBox<QHBoxLayout>(row, {}, kGap);
  start_ =
      makeButton(tr("Compute"), tr("Computes the design with each of the values"), this, &VaryDialog::start);
  start_->setObjectName("primary");
  stop_ = makeButton(tr("Stop"), tr("What was computed stays"), this, &VaryDialog::stop);
  state_ = makeNote();
  buttons->addWidget(start_);
  buttons->addWidget(stop_);
  buttons->addWidget(state_, 1);
  layout->addWidget(row);
  table_ = new QTableWidget(0, kColumns);
  table_->setHorizontalHeaderLabels({tr("Value"), tr("Result"), tr("Deviation"), tr("Smallest radius"),
                                     tr("Angle"), tr("Certain, held, lost"), tr("Cutting time"),
                                     tr("Findings")});
  table_->setAccessibleName(tr("What the design comes to with each value"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setIconSize(kPicture);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  layout->addWidget(table_, 1);
  auto* end = new QDialogButtonBox(QDialogButtonBox::Close);
  take_ = end->addButton(tr("Take this value"), QDialogButtonBox::ActionRole);
  take_->setToolTip(
      tr("Gives the variable the value of the line that is selected, as a step that undo takes back"));
  copy_ = end->addButton(tr("Copy table"), QDialogButtonBox::ActionRole);
  copy_->setToolTip(tr("As text with commas, which spreadsheets take"));
  layout->addWidget(end);
  collector_.setInterval(kCollect);
  connect(&collector_, &QTimer::timeout, this, &VaryDialog::collect);
  connect(variable_, &QComboBox::currentIndexChanged, this, &VaryDialog::showVariable);
  connect(table_, &QTableWidget::itemSelectionChanged, this, &VaryDialog::refresh);
  connect(table_, &QTableWidget::cellDoubleClicked, this, &VaryDialog::takeRow);
  for (const int key : {Qt::Key_Return, Qt::Key_Enter})
    connect(new QShortcut(key, table_, nullptr, nullptr, Qt::WidgetShortcut), &QShortcut::activated, this,
            &VaryDialog::takeRow);
  connect(take_, &QPushButton::clicked, this, &VaryDialog::takeRow);
  connect(copy_, &QPushButton::clicked, this, &VaryDialog::copyTable);
  connect(end, &QDialogButtonBox::rejected, this, &QDialog::reject);
  // Enter takes what is typed or the line chosen; it computes nothing anew.
  for (QPushButton* button : findChildren<QPushButton*>()) button->setAutoDefault(false);
  showVariable();
  refresh();
}

VaryDialog::~VaryDialog() { stop(); }

void VaryDialog::showVariable() {
  const int index = variable_->currentIndex();
  if (index < 0 || index >= int(bench_.design().variables.size())) return;
  const Variable& variable = bench_.design().variables[std::size_t(index)];
  for (NumberField* field : {from_, to_}) {
    field->setUnit(QString::fromStdString(variable.unit));
    field->setStep((variable.max - variable.min) / 100);
    field->setCheck([range = variable](double value) {
      return value >= range.min && value <= range.max
                 ? QString()
                 : tr("It must lie between %1 and %2, as the design says of the variable")
                       .arg(QString::fromStdString(shortText(range.min, 6)),
                            QString::fromStdString(shortText(range.max, 6)));
    });
  }
  from_->show(variable.min);
  to_->show(variable.max);
}

void VaryDialog::start() {
  const std::size_t index = std::size_t(std::max(0, variable_->currentIndex()));
  if (work_ || index >= bench_.design().variables.size()) return;
  finishTyping(*this);
  if (TypedField* refused = refusedField(*this)) return refused->setFocus();
  if (from_->value() == to_->value())
    return state_->setText(tr("Both ends are the same; vary over a range."));
  shown_ = bench_.design().variables[index].name;
  rows_.clear();
  table_->setRowCount(0);
  const QString unit = QString::fromStdString(bench_.design().variables[index].unit);
  table_->horizontalHeaderItem(kValue)->setText(unit.isEmpty()
                                                    ? QString::fromStdString(shown_)
                                                    : tr("%1, %2").arg(QString::fromStdString(shown_), unit));
  const auto work = work_ = std::make_shared<Work>();
  const pipeline::VaryRange range{shown_, from_->value(), to_->value(), int(count_->value())};
  const auto task = [work, range, design = bench_.document().design()](const pipeline::Evaluation&,
                                                                       const RunContext& context) {
    const std::stop_callback all(context.stop, [work] { work->stop.request_stop(); });
    RunContext own = context;
    own.stop = work->stop.get_token();
    return pipeline::vary(
        *design, range, own,
        [&](const pipeline::Variation& variation, const pipeline::Evaluation* result) -> Result<void> {
          scene::Content content = result ? pipeline::sceneContent(*result) : scene::Content();
          if (work->stop.stop_requested()) return stoppedError();
          const std::lock_guard lock(work->mutex);
          work->made.push_back({variation, std::move(content)});
          return {};
        });
  };
  bench_.runner().submit(
      tr("Varying %1").arg(QString::fromStdString(shown_)), task,
      [dialog = QPointer<VaryDialog>(this), work](const Result<void>& done) {
        if (dialog && dialog->work_ == work) dialog->finish(done);
      },
      model::EvaluationRunner::Needs::nothing);
  collector_.start();
  refresh();
}

void VaryDialog::stop() {
  if (work_) work_->stop.request_stop();
}

void VaryDialog::collect() {
  if (!work_) return;
  std::vector<Work::Made> made;
  {
    const std::lock_guard lock(work_->mutex);
    made.swap(work_->made);
  }
  for (const Work::Made& one : made) add(one.variation, one.content);
  refresh();
}

void VaryDialog::finish(const Result<void>& done) {
  collect();
  collector_.stop();
  work_.reset();
  refresh();
  if (!done && done.error().code != ErrorCode::cancelled)
    state_->setText(QString::fromStdString(done.error().message));
}

QPixmap VaryDialog::pictureOf(const scene::Content& content) {
  scene::Style style;
  style.dark = theme_.dark();
  style.legend = style.showGrid = false;
  // One range for all of them, so that they can be compared.
  style.tolerance = bench_.design().process.tolerance;
  style.rangeMax = 2 * style.tolerance;
  style.rangeMin = -*style.rangeMax;
  style[scene::Kind::cut].map = "deviation";
  newest_->setContent(content);
  newest_->setStyle(style);
  newest_->setView(scene::View::iso, false);
  const double ratio = devicePixelRatioF();
  QPixmap picture = QPixmap::fromImage(newest_->picture(kPicture * ratio, ratio, scene::View::iso));
  picture.setDevicePixelRatio(ratio);
  return picture;
}

void VaryDialog::add(const pipeline::Variation& variation, const scene::Content& content) {
  const int row = table_->rowCount();
  table_->insertRow(row);
  const auto put = [&](Column column, const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setToolTip(text);
    table_->setItem(row, column, item);
  };
  const auto number = [](double value) {
    return QString::fromStdString(shortText(std::abs(value) < kLeastShown ? 0 : value));
  };
  put(kValue, QString::fromStdString(shortText(variation.value, 6)));
  rows_.push_back(variation);
  if (!content.items.empty()) table_->item(row, kValue)->setData(Qt::DecorationRole, pictureOf(content));
  if (variation.error) {
    put(kResult, tr("none"));
    put(kFindings, QString::fromStdString(variation.error->message));
    return;
  }
  const SweepSummary& summary = variation.all.summary;
  put(kResult, variation.good ? tr("within all limits") : tr("exceeds a limit"));
  put(kDeviation,
      tr("%1 mm").arg(number(std::max(summary.deviationMax, variation.all.betweenMax.value_or(0)))));
  put(kRadius, summary.minRadius > 0 ? tr("%1 mm").arg(number(summary.minRadius)) : tr("straight"));
  put(kAngle, tr("%1°").arg(number(toDegrees(summary.angleMax))));
  put(kRest, QStringLiteral("%1, %2, %3")
                 .arg(variation.rest[std::size_t(Rest::certain)])
                 .arg(variation.rest[std::size_t(Rest::held)])
                 .arg(variation.rest[std::size_t(Rest::lost)]));
  put(kTime, tr("%1 s").arg(number(variation.all.cuttingTime)));
  put(kFindings, QString::fromStdString(variation.findings));
}

void VaryDialog::copyTable() {
  std::string text = pipeline::varyHead(shown_) + "\n";
  for (const pipeline::Variation& variation : rows_) text += pipeline::varyLine(variation) + "\n";
  QApplication::clipboard()->setText(QString::fromStdString(text));
}

void VaryDialog::takeRow() {
  const int row = table_->currentRow();
  if (row < 0 || row >= int(rows_.size()) || work_) return;
  emit taken(shown_, rows_[std::size_t(row)].value);
}

void VaryDialog::refresh() {
  start_->setEnabled(!work_);
  stop_->setEnabled(work_ != nullptr);
  take_->setEnabled(!work_ && table_->currentRow() >= 0 && !table_->selectedItems().isEmpty());
  copy_->setEnabled(!rows_.empty());
  for (QWidget* field : std::initializer_list<QWidget*>{variable_, from_, to_, count_})
    field->setEnabled(!work_);
  state_->setText(work_ ? tr("%1 of %2").arg(rows_.size()).arg(int(count_->value())) : QString());
}

}  // namespace bw::app
