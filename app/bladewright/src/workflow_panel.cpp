// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow_panel.h"

#include <QDesktopServices>
#include <QLineEdit>
#include <QRegularExpression>
#include <QRegularExpressionValidator>
#include <QUrl>

#include <algorithm>
#include <cmath>

#include "bw/core/cell.h"
#include "bw/core/file_set.h"
#include "numbers.h"

namespace bw::app {

namespace {

constexpr std::array<const char*, 3> kFormats = {"rapid", "csv", "json"};
constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};
// The station slider is logarithmic: 2 … 1000 stations over its length.
constexpr int kSliderSteps = 400;
constexpr double kSliderMin = 2, kSliderMax = 1000;

int stationsOfSlider(int value) {
  return int(std::lround(kSliderMin * std::pow(kSliderMax / kSliderMin, double(value) / kSliderSteps)));
}

int sliderOfStations(int stations) {
  const double t = std::log(stations / kSliderMin) / std::log(kSliderMax / kSliderMin);
  return int(std::lround(kSliderSteps * std::clamp(t, 0.0, 1.0)));
}

}  // namespace

WorkflowPanel::WorkflowPanel(Workbench& bench, const Theme& theme, QWidget* parent)
    : QScrollArea(parent), bench_(bench), theme_(theme) {
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, kGap, 0, kGap);
  layout->setSpacing(0);
  const std::array<std::pair<const char*, QString>, model::kStepCount> heads = {
      {{"setup", tr("Setup")}, {"input", tr("Input")}, {"process", tr("Process")}, {"output", tr("Output")}}};
  const std::array<QWidget*, model::kStepCount> bodies = {makeSetup(), makeInput(), makeProcess(), makeOutput()};
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    if (i > 0) layout->addWidget(makeLine(page));
    sections_[i] = new StepSection(theme, heads[i].first, heads[i].second, bodies[i], page);
    layout->addWidget(sections_[i]);
  }
  layout->addStretch();
  setWidget(page);
  connect(&bench, &Workbench::stateChanged, this, &WorkflowPanel::refreshStates);
  connect(&bench, &Workbench::progressed, this, &WorkflowPanel::refreshStates);
  connect(&bench, &Workbench::resultChanged, this, &WorkflowPanel::refresh);
  connect(&bench.document(), &model::Document::designChanged, this, &WorkflowPanel::refresh);
  refresh();
  refreshStates();
}

QWidget* WorkflowPanel::makeSetup() {
  auto* column = new FormColumn;
  auto* details = new FormColumn;
  bladeFields_ = new BladeFields(bench_, column, details, this);
  FormColumn* bladeFold = column->addFold(tr("Section and material"), theme_);
  bladeFold->addWide(details);
  tolerance_ = new NumberField({0.001, 1000, 3, 0.1, "mm"});
  column->add(tr("Tolerance"), tolerance_, tr("Largest deviation of the cut surface that is accepted"));
  connect(tolerance_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change tolerance"), [value](Job& job) { job.tolerance = value; });
  });
  clearance_ = new NumberField({0, 10000, 1, 5, "mm"});
  column->add(tr("Clearance"), clearance_, tr("Between a grip of the blade and the block"));
  connect(clearance_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change clearance"), [value](Job& job) { job.clearance = value; });
  });
  FormColumn* block = column->addFold(tr("Block"), theme_);
  blockFields_ = new BlockFields(bench_, block, this);
  return column;
}

QWidget* WorkflowPanel::makeInput() {
  auto* column = new FormColumn;
  fileName_ = new QLabel;
  fileName_->setTextFormat(Qt::PlainText);
  fileName_->setWordWrap(true);
  column->addWide(fileName_);
  fileFacts_ = makeNote();
  column->addWide(fileFacts_);
  auto* open = new QPushButton(tr("Open CAD file…"));
  open->setToolTip(tr("STEP, IGES or BREP; a file can also be dropped into the window"));
  column->addWide(open);
  connect(open, &QPushButton::clicked, this, &WorkflowPanel::openRequested);
  faces_ = new ChoiceField;
  faces_->addItems({tr("Largest"), tr("All"), tr("By number")});
  column->add(tr("Faces"), faces_, tr("Which faces of the file are cut"));
  faceList_ = new QLineEdit;
  faceList_->setAlignment(Qt::AlignRight);
  faceList_->setValidator(new QRegularExpressionValidator(QRegularExpression("\\d+(\\s*,\\s*\\d+)*"), faceList_));
  faceListLabel_ = column->add(tr("Face numbers"), faceList_, tr("Counted from 0, with commas: 0, 3, 5"));
  const auto applyFaces = [this] {
    FaceChoice choice;
    choice.kind = FaceChoice::Kind(faces_->currentIndex());
    if (choice.kind == FaceChoice::Kind::indices) {
      for (const QString& part : faceList_->text().split(',', Qt::SkipEmptyParts))
        choice.indices.push_back(part.trimmed().toInt());
      if (choice.indices.empty()) choice.indices = {0};
    }
    bench_.editJob(tr("Choose faces"), [&](Job& job) { job.face = choice; });
  };
  connect(faces_, &QComboBox::activated, this, applyFaces);
  connect(faceList_, &QLineEdit::editingFinished, this, [this, applyFaces] {
    if (faceList_->isModified()) applyFaces();
    faceList_->setModified(false);
  });
  embed_ = new QCheckBox(tr("Keep the geometry in the design file"));
  embed_->setToolTip(tr("On: the saved design holds a copy of the CAD file. Off: it points to the file."));
  column->addWide(embed_);
  connect(embed_, &QCheckBox::clicked, this, [this](bool on) {
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
  });
  return column;
}

QWidget* WorkflowPanel::makeProcess() {
  auto* column = new FormColumn;
  stationMode_ = new ChoiceField;
  stationMode_->addItems({tr("By number"), tr("By spacing")});
  column->add(tr("Stations"), stationMode_, tr("Where the blade is fitted to the surface"));
  connect(stationMode_, &QComboBox::activated, this, [this](int index) {
    double spacing = 10;
    if (const pipeline::SweepResult* result = bench_.sweep(); result && result->sweep.stations.size() > 1)
      spacing = std::max(0.1, std::round(10 * (result->sweep.stations[1].travel - result->sweep.stations[0].travel)) / 10);
    bench_.editJob(tr("Change stations"), [=](Job& job) {
      if (index == 0)
        job.spacing.reset();
      else
        job.spacing = spacing;
    });
  });
  stations_ = new NumberField({2, double(Job::kMaxStations), 0, 1, {}});
  stationsLabel_ = column->add(tr("Number"), stations_, tr("Number of stations along the cut"));
  connect(stations_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change stations"), [value](Job& job) { job.stations = int(value); });
  });
  stationSlider_ = new HandSlider;
  stationSlider_->setRange(0, kSliderSteps);
  stationSlider_->setAccessibleName(tr("Number of stations"));
  stationSlider_->setToolTip(tr("Number of stations"));
  column->addWide(stationSlider_);
  connect(stationSlider_, &HandSlider::grabbed, this, [this] { dragId_ = bench_.newMergeId(); });
  connect(stationSlider_, &HandSlider::moved, this, [this](int value) {
    const int count = stationsOfSlider(value);
    const bool dragging = stationSlider_->held();
    bench_.editJob(tr("Change stations"), [count](Job& job) { job.stations = count; }, dragging ? dragId_ : -1, dragging);
  });
  spacing_ = new NumberField({0.01, 10000, 2, 1, "mm"});
  spacingLabel_ = column->add(tr("Spacing"), spacing_, tr("Distance between stations"));
  connect(spacing_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change spacing"), [value](Job& job) { job.spacing = value; });
  });
  direction_ = new ChoiceField;
  direction_->addItems({tr("Automatic"), "X", "Y", "Z", tr("Vector")});
  column->add(tr("Direction"), direction_, tr("The way the blade travels; automatic: along the longer side"));
  connect(direction_, &QComboBox::activated, this, [this](int index) {
    Eigen::Vector3d now = Eigen::Vector3d::UnitY();
    if (const auto shown = bench_.shown(); shown && shown->setup.value) now = shown->setup.value->direction;
    if (bench_.job().direction) now = *bench_.job().direction;
    if (index == 4) now = (now + Eigen::Vector3d(1e-3, 1e-3, 0)).normalized();
    bench_.editJob(tr("Change direction"), [=](Job& job) {
      if (index == 0)
        job.direction.reset();
      else
        job.direction = index < 4 ? Eigen::Vector3d(Eigen::Vector3d::Unit(index - 1)) : now;
    });
  });
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    directionFields_[axis] = new NumberField({-1, 1, 4, 0.05, {}});
    directionLabels_[axis] = column->add(tr("Direction %1").arg(kAxes[axis]), directionFields_[axis]);
    connect(directionFields_[axis], &NumberField::edited, this, [this, i](double value) {
      Eigen::Vector3d direction = bench_.job().direction.value_or(Eigen::Vector3d::UnitY());
      direction[i] = value;
      if (direction.norm() < 1e-6) {
        refresh();
        return;
      }
      bench_.editJob(tr("Change direction"), [&](Job& job) { job.direction = direction.normalized(); });
    });
  }
  speed_ = new NumberField({0.01, 1000, 2, 1, "mm/s"});
  column->add(tr("Cutting speed"), speed_, tr("Of the fastest point of the blade"));
  connect(speed_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change cutting speed"), [value](Job& job) { job.cuttingSpeed = value; });
  });
  FormColumn* fold = column->addFold(tr("Fit and lead"), theme_);
  fitLength_ = new ChoiceField;
  fitLength_->addItems({tr("Free"), tr("As the section")});
  fold->add(tr("Length"), fitLength_, tr("Length of the blade's part that cuts the surface"));
  connect(fitLength_, &QComboBox::activated, this, [this](int index) {
    bench_.editJob(tr("Change fit length"), [index](Job& job) {
      job.fitLength = index == 0 ? FitOptions::Length::free : FitOptions::Length::exact;
    });
  });
  endpoints_ = new QCheckBox(tr("Keep end points"));
  endpoints_->setToolTip(tr("The ends of every section are met exactly"));
  fold->addWide(endpoints_);
  connect(endpoints_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.editJob(on ? tr("Keep end points") : tr("Free end points"), [on](Job& job) { job.fitEndpoints = on; });
  });
  tangents_ = new QCheckBox(tr("Keep end tangents"));
  tangents_->setToolTip(tr("The blade leaves the surface in the direction of every section's ends"));
  fold->addWide(tangents_);
  connect(tangents_, &QCheckBox::clicked, this, [this](bool on) {
    bench_.editJob(on ? tr("Keep end tangents") : tr("Free end tangents"), [on](Job& job) { job.fitTangents = on; });
  });
  periods_ = new NumberField({0.1, 10, 2, 0.1, {}});
  fold->add(tr("Most waves"), periods_, tr("Periods of the elastica that the blade may span; more than one is hard to hold"));
  connect(periods_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change most waves"), [value](Job& job) { job.maxPeriods = value; });
  });
  lead_ = new NumberField({0, 10000, 2, 5, "mm"});
  fold->add(tr("Lead"), lead_, tr("Straight travel before and after the block"));
  connect(lead_, &NumberField::edited, this, [this](double value) {
    bench_.editJob(tr("Change lead"), [value](Job& job) { job.lead = value; });
  });
  return column;
}

QWidget* WorkflowPanel::makeOutput() {
  auto* column = new FormColumn;
  const std::array<std::pair<QString, QString>, 3> formats = {
      {{tr("ABB RAPID"), tr("MultiMove program for two robots")},
       {tr("CSV"), tr("One row an instant: position and rotation of both blade ends")},
       {tr("JSON"), tr("The same with full precision, for scripts")}}};
  for (std::size_t i = 0; i < formats.size(); ++i) {
    programs_[i] = new QCheckBox(formats[i].first);
    programs_[i]->setToolTip(formats[i].second);
    column->addWide(programs_[i]);
    connect(programs_[i], &QCheckBox::clicked, this, [this, i](bool on) {
      bench_.editJob(tr("Choose programs"), [=](Job& job) {
        std::vector<std::string> chosen;
        for (std::size_t k = 0; k < kFormats.size(); ++k) {
          const bool had = std::find(job.programs.begin(), job.programs.end(), kFormats[k]) != job.programs.end();
          if (k == i ? on : had) chosen.push_back(kFormats[k]);
        }
        job.programs = chosen;
      });
    });
  }
  cell_ = new ChoiceField;
  if (Result<std::vector<std::string>> names = cellNames()) cells_ = std::move(*names);
  for (const std::string& name : cells_) {
    const Result<Cell> cell = loadCell(name);
    cell_->addItem(QString::fromStdString(cell && !cell->title.empty() ? cell->title : name));
  }
  column->addLong(tr("Robot cell"), cell_, tr("Robots, tools and the place of the block"));
  connect(cell_, &QComboBox::activated, this, [this](int index) {
    bench_.editJob(tr("Choose robot cell"), [&](Job& job) { job.cell = cells_[std::size_t(index)]; });
  });
  column->addGap(2);
  export_ = new QPushButton(tr("Export everything…"));
  export_->setObjectName("primary");
  export_->setToolTip(tr("Report, CAD surface, mesh, stations and programs into a folder (Ctrl+E)"));
  column->addWide(export_);
  connect(export_, &QPushButton::clicked, this, &WorkflowPanel::exportRequested);
  exportPrograms_ = new QPushButton(tr("Export programs…"));
  exportPrograms_->setToolTip(tr("The robot programs alone"));
  column->addWide(exportPrograms_);
  connect(exportPrograms_, &QPushButton::clicked, this, &WorkflowPanel::programsRequested);
  auto* picture = new QPushButton(tr("Export picture…"));
  picture->setToolTip(tr("The view as PNG (Ctrl+Shift+E)"));
  column->addWide(picture);
  connect(picture, &QPushButton::clicked, this, &WorkflowPanel::pictureRequested);
  exported_ = makeNote();
  exported_->setTextInteractionFlags(Qt::TextBrowserInteraction);
  exported_->setOpenExternalLinks(false);
  connect(exported_, &QLabel::linkActivated, this,
          [](const QString& link) { QDesktopServices::openUrl(QUrl(link)); });
  column->addWide(exported_);
  return column;
}

void WorkflowPanel::refresh() {
  const Design& design = *bench_.document().design();
  const Job& job = design.job;
  const auto shown = bench_.shown();
  bladeFields_->refresh();
  blockFields_->refresh();
  tolerance_->show(job.tolerance);
  clearance_->show(job.clearance);

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
    if (!info.healing.empty()) facts += "\n" + tr("Repaired: %1").arg(QString::fromStdString(info.healing.front()));
  }
  fileFacts_->setText(facts);
  fileFacts_->setVisible(!facts.isEmpty());
  faces_->show(int(job.face.kind));
  setLineVisible(faceListLabel_, faceList_, job.face.kind == FaceChoice::Kind::indices);
  if (!faceList_->hasFocus()) {
    QStringList list;
    for (int index : job.face.indices) list << QString::number(index);
    faceList_->setText(list.join(", "));
  }
  const bool embedded = !design.source.bytes.empty();
  embed_->setChecked(embedded);
  std::error_code ignored;
  embed_->setEnabled(!embedded || std::filesystem::is_regular_file(design.source.path, ignored));

  stationMode_->show(job.spacing ? 1 : 0);
  setLineVisible(stationsLabel_, stations_, !job.spacing);
  stationSlider_->setVisible(!job.spacing);
  setLineVisible(spacingLabel_, spacing_, job.spacing.has_value());
  stations_->show(job.stations);
  stationSlider_->show(sliderOfStations(job.stations));
  if (job.spacing) spacing_->show(*job.spacing);
  int directionIndex = 0;
  if (job.direction) {
    directionIndex = 4;
    for (int i = 0; i < 3; ++i)
      if ((*job.direction - Eigen::Vector3d::Unit(i)).norm() < 1e-12) directionIndex = i + 1;
  }
  direction_->show(directionIndex);
  for (int i = 0; i < 3; ++i) {
    const auto axis = std::size_t(i);
    setLineVisible(directionLabels_[axis], directionFields_[axis], directionIndex == 4);
    if (job.direction) directionFields_[axis]->show((*job.direction)[i]);
  }
  speed_->show(job.cuttingSpeed);
  fitLength_->show(job.fitLength == FitOptions::Length::free ? 0 : 1);
  endpoints_->setChecked(job.fitEndpoints);
  tangents_->setChecked(job.fitTangents);
  periods_->show(job.maxPeriods);
  lead_->show(job.lead);

  for (std::size_t i = 0; i < kFormats.size(); ++i)
    programs_[i]->setChecked(std::find(job.programs.begin(), job.programs.end(), kFormats[i]) != job.programs.end());
  const auto cell = std::find(cells_.begin(), cells_.end(), job.cell);
  cell_->show(cell == cells_.end() ? -1 : int(cell - cells_.begin()));
}

void WorkflowPanel::refreshStates() {
  const model::StepStates states = bench_.stepStates();
  for (std::size_t i = 0; i < sections_.size(); ++i) sections_[i]->head().setState(states[i]);
  const bool ready = bench_.current() && !bench_.exporting();
  export_->setEnabled(ready);
  exportPrograms_->setEnabled(ready && !bench_.job().programs.empty());
  const QString folder = QString::fromStdString(bench_.exportFolder().string());
  exported_->setVisible(!folder.isEmpty());
  if (!folder.isEmpty())
    exported_->setText(tr("Last export: <a href=\"%1\">%2</a>").arg(QUrl::fromLocalFile(folder).toString(), folder.toHtmlEscaped()));
}

}  // namespace bw::app
