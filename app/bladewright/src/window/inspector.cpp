// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/inspector.h"

#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bw/core/shape/told_stretches.h"
#include "bw/core/text/number_text.h"
#include "bw/words/findings.h"

namespace bw::app {

using pipeline::CutResult;
using pipeline::CutSketch;
using pipeline::StationView;

namespace {

constexpr int kLeastWidth = 250;
constexpr int kSectionPoints = 17;  // of a section, at which its place is looked up

QString ratioText(double ratio) { return QString::fromStdString(fixedText(ratio, 2)); }
QString shortNumber(double value) { return QString::fromStdString(shortText(value, 3)); }
QString bendText(const BladePose& pose) {
  const double curvature = pose.maxCurvature();
  return radiusText(curvature > 0 ? 1 / curvature : 1e12);
}
QString restText(Rest rest) {
  switch (rest) {
    case Rest::certain:
      return QObject::tr("certain");
    case Rest::held:
      return QObject::tr("held");
    case Rest::lost:
      return QObject::tr("lost");
    case Rest::unknown:
      break;
  }
  return QObject::tr("not known");
}

}  // namespace

Inspector::Inspector(Workbench& bench, const Theme& theme, QWidget* parent)
    : SidePanel(kLeastWidth, parent), bench_(bench), theme_(theme) {
  auto* page = new QWidget;
  page->setObjectName("page");
  auto* layout = makeBox<QVBoxLayout>(page, {kGroupGap, kGroupGap, kGroupGap, kGroupGap}, kGroupGap);
  kind_ = new ChoiceField(page);
  kind_->setAccessibleName(tr("What the inspector shows"));
  kind_->setToolTip(tr("What is inspected; a click into the picture selects too"));
  for (const QString& name : {tr("Result"), tr("Surface"), tr("Block"), tr("Blade"), tr("Station")})
    kind_->addItem(name);
  layout->addWidget(kind_);
  empty_ = makeNote(tr("The numbers stand here as soon as a result is there."), page);
  layout->addWidget(empty_);
  pages_ = new QStackedWidget(page);
  layout->addWidget(pages_);
  layout->addStretch();
  makeResult();
  makeSurface();
  makeBlock();
  makeBlade();
  makeStation();
  setWidget(page);

  connect(kind_, &QComboBox::activated, this, [this](int index) {
    const auto kind = Selection::Kind(index);
    if (kind != Selection::Kind::station) {
      bench_.select({kind, -1});
    } else if (const double at = bench_.stationAt(bench_.playTime()); at >= 0) {
      bench_.selectStation(int(std::lround(at)));
    } else {
      kind_->show(int(bench_.selection().kind));
    }
  });
  connect(&bench, &Workbench::changed, this, [this](const Change& change) {
    if (change.any(
            model::kAspectsOfCut | Aspect::thoughts | Aspect::part | Aspect::design | Aspect::selection,
            bench_.selection()))
      refresh();
    else if (change.any(Aspect::sketch, bench_.selection()))
      refreshNumbers(!bench_.sketch());
  });
  refresh();
}

FormColumn* Inspector::addPage() {
  auto* holder = new QWidget;
  auto* layout = makeBox<QVBoxLayout>(holder);
  auto* column = new FormColumn;
  layout->addWidget(column);
  layout->addStretch();
  pages_->addWidget(holder);
  return column;
}

void Inspector::addValue(FormColumn* column, const QString& name, const QString& tip,
                         std::function<QString()> text, std::function<bool()> broken) {
  values_.push_back({column->addValue(name, tip), std::move(text), std::move(broken)});
}

void Inspector::follow(std::function<QString(const pipeline::CutSketch&)> text,
                       std::function<bool(const pipeline::CutSketch&)> broken) {
  values_.back().followed = std::move(text);
  values_.back().followedBroken = std::move(broken);
}

void Inspector::followStation(std::function<QString(const pipeline::CutSketch&, std::size_t)> text,
                              std::function<bool(const pipeline::CutSketch&, std::size_t)> broken) {
  const auto place = [this](const pipeline::CutSketch& sketch) -> std::optional<std::size_t> {
    const int index = bench_.selection().station;
    if (index < 0 || std::size_t(index) >= sketch.sweep->poses.size()) return std::nullopt;
    return std::size_t(index);
  };
  std::function<bool(const pipeline::CutSketch&)> breaks;
  if (broken)
    breaks = [place, broken = std::move(broken)](const pipeline::CutSketch& sketch) {
      const std::optional<std::size_t> at = place(sketch);
      return at && broken(sketch, *at);
    };
  follow(
      [place, text = std::move(text)](const pipeline::CutSketch& sketch) {
        const std::optional<std::size_t> at = place(sketch);
        return at ? text(sketch, *at) : QString();
      },
      std::move(breaks));
}

void Inspector::addOfResult(FormColumn* column, const QString& name, const QString& tip,
                            std::function<QString(const pipeline::CutResult&)> text,
                            bool SweepLimits::*broken) {
  addValue(
      column, name, tip,
      [this, text = std::move(text)] {
        const auto result = bench_.sweep();
        return result ? text(*result) : QString();
      },
      [this, broken] {
        const auto result = bench_.sweep();
        return broken && result && brokenLimits(*result, bench_.shown()->design).*broken;
      });
}

const SimulatedSurface* Inspector::programCut() const {
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  return cut ? cut->programCut() : nullptr;
}

const pipeline::BlockEvaluation* Inspector::block() const {
  const auto shown = bench_.shown();
  if (!shown) return nullptr;
  const auto found =
      std::ranges::find(shown->blocks, bench_.selection().block, &pipeline::BlockEvaluation::id);
  return found == shown->blocks.end() ? nullptr : &*found;
}

std::optional<pipeline::StationView> Inspector::station() const {
  const auto result = bench_.sweep();
  const int index = bench_.selection().station;
  if (!result || index < 0 || std::size_t(index) >= result->size()) return std::nullopt;
  return result->station(std::size_t(index));
}

QString Inspector::toldHere() const {
  const auto shown = bench_.shown();
  const std::optional<StationView> at = station();
  if (!shown || !at) return {};
  const Design& design = shown->design;
  const auto cut = std::ranges::find(design.cuts, bench_.selection().cut, &Cut::id);
  if (cut == design.cuts.end()) return {};
  const Source& source = design.sourceOf(*cut);
  const auto place = std::size_t(&source - design.sources.data());
  if (!source.surface || place >= shown->told.size() || !shown->told[place].value) return {};
  // The section crosses these y of the frame that the key blades are told in: one, where it lies across them.
  const Eigen::Vector3d along = rotationFromAngles(source.surface->rotation).col(1);
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const Eigen::Vector2d& point : at->fit.target.sample(kSectionPoints)) {
    const double y = (at->pose.frame.toWorld(point) - source.surface->origin).dot(along);
    from = std::min(from, y);
    to = std::max(to, y);
  }
  // Planes that turn are those of the key blades, and their levels these y.
  if (const PlaneFamily planes = bench_.sweep()->sweep.planes; planes.turns())
    from = to = planes.entry + at->pose.travel;
  const std::vector<ToldStretch>& stretches = *shown->told[place].value;
  const Findings& findings = shown->told[place].findings;
  QStringList told;
  for (std::size_t i = 0; i < stretches.size() && i < findings.size(); ++i)
    if (to >= stretches[i].from - kStretchEnd && from <= stretches[i].to + kStretchEnd)
      told << QString::fromStdString(words::sentence(findings[i], words::Reader::window));
  for (QString& sentence : told)
    if (!sentence.isEmpty()) sentence = sentence.left(1).toUpper() + sentence.mid(1) + QLatin1Char('.');
  return told.join(QLatin1Char('\n'));
}

void Inspector::makeResult() {
  FormColumn* column = addPage();
  const auto add = [&](const QString& name, const QString& tip, QString (*format)(double),
                       double SweepSummary::*member, bool SweepLimits::*broken = nullptr) {
    addOfResult(
        column, name, tip, [=](const CutResult& result) { return format(result.analysis.summary.*member); },
        broken);
  };
  // In a form of its own: its fields are wider than the numbers below, whose names are longer.
  auto* cut = column->addWide(new FormColumn);
  cut->addHeading(tr("Cut"));
  cutLines_ = new CutLines(bench_, cut, this);
  column->addHeading(tr("Deviation"));
  add(tr("Surface shown"), tr("The largest of the surface shown from the target, also between stations"),
      lengthText, &SweepSummary::deviationMax, &SweepLimits::deviation);
  follow([](const CutSketch& sketch) { return lengthText(sketch.look->deviationMax); },
         [this](const CutSketch& sketch) {
           return sketch.look->deviationMax > bench_.design().process.tolerance;
         });
  addOfResult(
      column, tr("On the blade's way"),
      tr("Of the blade from the target, as the robots move it, also between stations"),
      [](const CutResult& result) { return lengthText(result.between.deviationMax); }, &SweepLimits::between);
  addValue(
      column, tr("Program cuts within"),
      tr("How far what the whole program cuts, its corners and its ways in and out included, lies from the "
         "cut surface shown: what blade simulate tells of it. Known once the hand has rested"),
      [this] {
        const SimulatedSurface* own = programCut();
        return own ? lengthText(own->toDesignMax) : QString();
      },
      [this] {
        const SimulatedSurface* own = programCut();
        return own && own->toDesignMax > bench_.shown()->design.process.motionTolerance;
      });
  add(tr("Mean"), {}, lengthText, &SweepSummary::deviationMean);
  add(tr("Root mean square"), {}, lengthText, &SweepSummary::deviationRms);
  add(tr("Within tolerance"), tr("Part of the cut surface that lies within the tolerance"), percentText,
      &SweepSummary::withinTolerance, &SweepLimits::deviation);
  addOfResult(
      column, tr("Surface covered"), tr("Part of the surface in the block that has cut surface over it"),
      [](const CutResult& result) { return percentText(result.coverage.share()); }, &SweepLimits::coverage);
  addOfResult(column, tr("Farthest beyond the cut"),
              tr("How far the surface in the block reaches beyond the border of the cut surface, or lies off "
                 "it where a part is not cut"),
              [](const CutResult& result) { return lengthText(result.coverage.distance); });
  column->addHeading(tr("Blade"));
  add(tr("Smallest radius"), tr("Over the whole blade at all stations"), radiusText, &SweepSummary::minRadius,
      &SweepLimits::radius);
  follow([](const CutSketch& sketch) { return radiusText(sketch.look->minRadius); },
         [](const CutSketch& sketch) {
           const double radius = sketch.look->minRadius;
           return radius > 0 && radius < sketch.sweep->request.blade.minRadius();
         });
  addValue(column, tr("Limit of the blade"), tr("The tightest bend that leaves the blade elastic"),
           [this] { return radiusText(bench_.design().blade.minRadius()); });
  values_.back().ofDesign = true;
  add(tr("Steepest cut"), tr("Largest angle between the blade's motion and its plane's normal"), angleText,
      &SweepSummary::angleMax, &SweepLimits::angle);
  follow([](const CutSketch& sketch) { return angleText(sketch.look->angleMax); });
  add(tr("Mean angle"), {}, angleText, &SweepSummary::angleMean);
  column->addHeading(tr("Motion"));
  addOfResult(column, tr("Fastest point"), {},
              [this](const CutResult&) { return speedText(bench_.shown()->design.process.cuttingSpeed); });
  add(tr("Slowest / fastest"), tr("Along the blade, at its most uneven station"), ratioText,
      &SweepSummary::speedRatioMin, &SweepLimits::speed);
  follow([](const CutSketch& sketch) { return ratioText(sketch.look->speedRatioMin); });
  addOfResult(column, tr("Cutting time"),
              tr("Minutes and seconds, leads included; entry and exit come to it"),
              [](const CutResult& result) { return timeText(result.motion.cuttingTime()); });
  column->addHeading(tr("Fit"));
  add(tr("Largest distance"), tr("Hausdorff distance between a section and its elastica"), lengthText,
      &SweepSummary::hausdorffMax);
  add(tr("Largest residual R4"), tr("Root mean square distance over the length"), shortNumber,
      &SweepSummary::R4Max);
}

void Inspector::makeSurface() {
  FormColumn* column = addPage();
  const auto target = [this]() -> const geometry::Target* {
    const pipeline::CutEvaluation* cut = bench_.shownCut();
    return cut ? cut->target.value.get() : nullptr;
  };
  surfaceFields_ = column->addWide(new SurfaceFields(bench_, SurfaceFields::Shows::curve));
  column->addHeading(tr("Target surface"));
  addValue(column, tr("Faces"), {},
           [target] { return target() ? QString::number(target()->faces().size()) : QString(); });
  addValue(column, tr("Area"), {}, [target] {
    return target() ? QString::fromStdString(shortText(target()->area() * 1e-6, 4)) + " m²" : QString();
  });
  const std::array<const char*, 3> axes = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i)
    addValue(column, tr("Extent %1").arg(axes[std::size_t(i)]), {},
             [target, i] { return target() ? lengthText(target()->bounds().size()[i]) : QString(); });
  column->addHeading(tr("Place"));
  for (int i = 0; i < 3; ++i)
    addValue(column, tr("Smallest %1").arg(axes[std::size_t(i)]), tr("In the frame of the file"),
             [target, i] { return target() ? lengthText(target()->bounds().min[i]) : QString(); });
}

void Inspector::makeBlock() {
  FormColumn* column = addPage();
  column->addHeading(tr("Foam block"));
  blockFields_ = new BlockFields(bench_, column, this);
  addValue(column, tr("Volume"), {}, [this] {
    const pipeline::CutEvaluation* cut = bench_.shownCut();
    return cut && cut->setup ? shortNumber(cut->block().size.prod() * 1e-9) + " m³" : QString();
  });
  column->addGap();
  gridColumn_ = column->addWide(new FormColumn);
  gridFields_ = new GridFields(bench_, gridColumn_, this);
  FormColumn* left = column->addWide(new FormColumn);
  left->addHeading(tr("After its cuts"));
  togetherColumn_ = column->addWide(new FormColumn);
  const auto solid = [this]() -> const geometry::Part* {
    const pipeline::BlockEvaluation* shown = block();
    const pipeline::BlockPart* part = shown ? shown->part.value.get() : nullptr;
    return part && part->solid ? &*part->solid : nullptr;
  };
  const auto volume = [](double mm3) { return shortNumber(mm3 * 1e-9) + " m³"; };
  addValue(left, tr("Foam left"), tr("What is left of the block, once the hand has rested"),
           [solid, volume] { return solid() ? volume(solid()->volume()) : QString(); });
  addValue(left, tr("Foam removed"), tr("What the cuts take of the block"), [solid, volume] {
    return solid() ? volume(solid()->blockVolume() - solid()->volume()) : QString();
  });
  const auto worst = [this]() -> const Crease* {
    const pipeline::BlockEvaluation* shown = block();
    if (!shown || !shown->together.value || shown->together.value->creases.empty()) return nullptr;
    return &*std::ranges::max_element(shown->together.value->creases, {}, &Crease::offMax);
  };
  addValue(
      togetherColumn_, tr("Crease off by"),
      tr("The farthest that an edge in which two cuts meet lies from that of the surfaces designed"),
      [worst] { return worst() ? lengthText(worst()->offMax) : QString(); },
      [this, worst] { return worst() && worst()->offMax > bench_.shown()->design.process.tolerance; });
  addValue(togetherColumn_, tr("On the mean"), tr("That edge, along its length"),
           [worst] { return worst() ? lengthText(worst()->offMean) : QString(); });
}

void Inspector::makeBlade() {
  FormColumn* column = addPage();
  auto* details = new FormColumn;
  column->addHeading(tr("Blade"));
  bladeFields_ = new BladeFields(bench_, column, details, theme_, this);
  column->addHeading(tr("Section and material"));
  column->addWide(details);
  addValue(column, tr("Rigidity"), tr("Flexural rigidity E·I"),
           [this] { return shortNumber(bench_.design().blade.flexuralRigidity()) + " N·mm²"; });
  values_.back().ofDesign = true;
  column->addHeading(tr("Use"));
  addOfResult(
      column, tr("Tightest bend"), tr("Smallest radius of the blade in this cut"),
      [](const CutResult& result) { return radiusText(result.analysis.summary.minRadius); },
      &SweepLimits::radius);
  addOfResult(
      column, tr("Largest stress"), tr("Bending stress at the tightest bend, and the stress allowed"),
      [](const CutResult& result) {
        const double radius = result.analysis.summary.minRadius;
        const Blade& blade = result.sweep.request.blade;
        return radius > 0 ? tr("%1 of %2 N/mm²")
                                .arg(std::lround(blade.stress(1 / radius)))
                                .arg(std::lround(blade.yieldStress / blade.safety))
                          : QString();
      },
      &SweepLimits::radius);
}

void Inspector::makeStation() {
  FormColumn* column = addPage();
  auto* row = new QWidget;
  auto* line = makeBox<QHBoxLayout>(row, {}, 4);
  const auto arrow = [&](const char* icon, const QString& tip, int step) {
    auto* button = new QToolButton(row);
    button->setIcon(theme_.icon(icon));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    connect(&theme_, &Theme::changed, button, [this, button, icon] { button->setIcon(theme_.icon(icon)); });
    connect(button, &QToolButton::clicked, this,
            [this, step] { bench_.selectStation(bench_.selection().station + step); });
    return button;
  };
  line->addWidget(arrow("chevron-left", tr("Station before"), -1));
  line->addWidget(arrow("chevron-right", tr("Next station"), 1));
  line->addStretch();
  stationNumber_ = new NumberField({1, double(SectionRequest::kMost), 0, 1, {}});
  stationNumber_->setAccessibleName(tr("Station"));
  stationNumber_->setToolTip(tr("Counted from 1, as in messages; data files count from 0"));
  stationNumber_->setFixedWidth(96);
  connect(stationNumber_, &NumberField::edited, this, [this](double value) {
    const auto result = bench_.sweep();
    if (!result) return;
    const auto& stations = result->sweep.poses;
    const auto found = std::ranges::lower_bound(stations, int(value) - 1, {}, &BladePose::index);
    bench_.selectStation(int(found - stations.begin()));
    refresh();
  });
  stationNumber_->setCheck([this](double value) {
    const auto result = bench_.sweep();
    if (!result) return tr("There are no stations yet");
    const auto& stations = result->sweep.poses;
    const bool there = std::ranges::find(stations, int(value) - 1, &BladePose::index) != stations.end();
    return there ? QString() : tr("Station %1 was left out").arg(int(value));
  });
  line->addWidget(stationNumber_);
  column->addWide(row);
  told_ = column->addWide(new ValueLabel);
  told_->setWordWrap(true);
  told_->setAccessibleName(tr("Told by the key blades here"));
  values_.push_back({told_, [this] { return toldHere(); }, [this] { return !toldHere().isEmpty(); }});
  const auto add = [&](const QString& name, const QString& tip,
                       std::function<QString(const StationView&)> text, bool SweepLimits::*broken = nullptr) {
    addValue(
        column, name, tip,
        [this, text = std::move(text)] { return station() ? text(*station()) : QString(); },
        broken ? std::function<bool()>([this, broken] {
          return station() && brokenLimits(*station(), bench_.shown()->design).*broken;
        })
               : nullptr);
  };
  add(tr("Travel"), tr("Position along the cutting direction"),
      [](const StationView& s) { return lengthText(s.pose.travel); });
  followStation(
      [](const CutSketch& sketch, std::size_t i) { return lengthText(sketch.sweep->poses[i].travel); });
  addValue(column, tr("Time"), tr("From the start of the motion"), [this] {
    return station() ? timeText(bench_.timeOfStation(bench_.selection().station)) : QString();
  });
  column->addHeading(tr("Fit"));
  add(tr("Section length"), {}, [](const StationView& s) { return lengthText(s.fit.target.length()); });
  followStation([](const CutSketch& sketch, std::size_t i) {
    return lengthText(sketch.sweep->fits[i].target.length());
  });
  add(tr("Largest distance"), tr("Hausdorff distance between section and elastica"),
      [](const StationView& s) { return lengthText(s.fit.fit.hausdorff); });
  add(tr("Residual R4"), tr("Root mean square distance over the length"),
      [](const StationView& s) { return shortNumber(s.fit.fit.R4); });
  add(tr("Status"), {}, [](const StationView& s) {
    switch (s.fit.fit.status) {
      case FitStatus::converged:
        return tr("Converged");
      case FitStatus::iterationLimit:
        return tr("Stopped at the limit");
      case FitStatus::constraintsActive:
        return tr("At a bound");
      case FitStatus::infeasible:
        return tr("Not feasible");
    }
    return QString();
  });
  column->addHeading(tr("Blade"));
  add(
      tr("Smallest radius"), tr("Of the whole blade"), [](const StationView& s) { return bendText(s.pose); },
      &SweepLimits::radius);
  followStation([](const CutSketch& sketch, std::size_t i) { return bendText(sketch.sweep->poses[i]); },
                [](const CutSketch& sketch, std::size_t i) {
                  const double curvature = sketch.sweep->poses[i].maxCurvature();
                  return curvature > 1 / sketch.sweep->request.blade.minRadius();
                });
  add(
      tr("Stability margin"), tr("How firmly it rests: 1 for a straight blade, 0 where it is about to snap"),
      [](const StationView& s) { return ratioText(s.check.stabilityMargin); }, &SweepLimits::margin);
  add(tr("Shape"),
      tr("Certain: the only one at rest, or clearly the lowest. Held: another one, into which the program "
         "leads "
         "the blade, and which it keeps. Lost: nothing brings the blade there"),
      [](const StationView& s) { return restText(s.rest); });
  followStation([](const CutSketch& sketch, std::size_t i) { return restText(sketch.look->rest[i]); },
                [](const CutSketch& sketch, std::size_t i) { return sketch.look->rest[i] == Rest::lost; });
  add(tr("Inflections"), tr("Changes of the bending direction along the blade"),
      [](const StationView& s) { return QString::number(bladeInflections(s.pose.blade)); });
  followStation([](const CutSketch& sketch, std::size_t i) {
    return QString::number(bladeInflections(sketch.sweep->poses[i].blade));
  });
  add(tr("Extension"), tr("Length of the blade beyond the surface, on the side where there is less of it"),
      [](const StationView& s) { return lengthText(std::min(s.pose.before, s.pose.after())); });
  followStation([](const CutSketch& sketch, std::size_t i) {
    const BladePose& pose = sketch.sweep->poses[i];
    return lengthText(std::min(pose.before, pose.after()));
  });
  add(
      tr("Clearance"), tr("Between the nearer grip and the block"),
      [](const StationView& s) { return lengthText(s.check.clearance); }, &SweepLimits::clearance);
  add(
      tr("Above the bottom"), tr("The lowest point of the blade over the face that the block lies on"),
      [](const StationView& s) { return lengthText(s.check.aboveBottom); }, &SweepLimits::floor);
  column->addHeading(tr("Motion"));
  add(
      tr("Largest angle"), tr("Between the blade's motion and the plane's normal"),
      [](const StationView& s) { return angleText(s.check.angleMax); }, &SweepLimits::angle);
  add(tr("Mean angle"), {}, [](const StationView& s) { return angleText(s.check.angleMean); });
  add(
      tr("Slowest / fastest"), tr("Along the blade"),
      [](const StationView& s) { return ratioText(s.check.speedRatio); }, &SweepLimits::speed);
  column->addHeading(tr("Grips"));
  const auto addGrip = [&](const QString& name, Eigen::Vector3d (BladePose::*end)() const) {
    auto* heading = makeNote(name);
    column->addWide(heading);
    auto* place = new ValueLabel;
    place->setAlignment(Qt::AlignRight);
    place->setAccessibleName(name);
    column->addWide(place);
    values_.push_back(
        {place, [this, end] { return station() ? pointText((station()->pose.*end)()) + " mm" : QString(); },
         nullptr});
    followStation([end](const CutSketch& sketch, std::size_t i) {
      return pointText((sketch.sweep->poses[i].*end)()) + " mm";
    });
  };
  addGrip(tr("Left, in the frame of the file"), &BladePose::leftPoint);
  addGrip(tr("Right, in the frame of the file"), &BladePose::rightPoint);
}

TypedField* Inspector::showRefused() {
  for (const auto kind :
       {Selection::Kind::result, Selection::Kind::surface, Selection::Kind::block, Selection::Kind::blade})
    if (TypedField* field = refusedField(*pages_->widget(int(kind)))) {
      bench_.select({kind, -1});
      return field;
    }
  return nullptr;
}

void Inspector::showCurve(const std::optional<int>& curve) {
  surfaceFields_->setCurve(curve);
  if (bench_.selection().kind == Selection::Kind::surface) surfaceFields_->refresh();
}

void Inspector::setStale(bool stale) {
  if (stale == std::exchange(stale_, stale)) return;
  refreshStanding(true);
}

void Inspector::refreshStanding(bool all) {
  const CutSketch* sketch = bench_.sketchedCut();
  for (const Value& value : values_)
    if (!all && !value.followed)
      continue;
    else if (sketch && value.followed)
      value.label->setStanding(value.followedBroken && value.followedBroken(*sketch), false);
    else
      value.label->setStanding(value.broken && value.broken(), stale_ && !value.ofDesign);
}

void Inspector::refreshNumbers(bool all) {
  const pipeline::CutSketch* sketch = bench_.sketchedCut();
  for (const Value& value : values_) {
    if (!all && !value.followed) continue;
    const QString text = sketch && value.followed ? value.followed(*sketch) : value.text();
    value.label->setText(text.isEmpty() ? QStringLiteral("–") : text);
  }
  refreshStanding(all);
}

void Inspector::refresh() {
  const Selection& selection = bench_.selection();
  kind_->show(int(selection.kind));
  pages_->setCurrentIndex(int(selection.kind));
  // What the design tells stands there before any result does.
  const bool there = selection.kind != Selection::Kind::station || bench_.sweep();
  empty_->setVisible(!there);
  pages_->setVisible(there);
  refreshNumbers(true);
  told_->setVisible(!toldHere().isEmpty());
  cutLines_->refresh();
  // Of a page that nobody sees the fields wait.
  if (selection.kind == Selection::Kind::surface) surfaceFields_->refresh();
  gridColumn_->setVisible(bench_.design().grid && bench_.design().grid->count() > 1);
  togetherColumn_->setVisible(block() && block()->cuts.size() > 1);
  gridFields_->refresh();
  blockFields_->refresh();
  bladeFields_->refresh();
  if (const auto result = bench_.sweep()) {
    const int last = result->sweep.poses.empty() ? 1 : result->sweep.poses.back().index + 1;
    stationNumber_->setMaximum(last);
    stationNumber_->setSuffix(tr("of %1").arg(last));
  }
  if (const auto selected = station()) stationNumber_->show(selected->pose.index + 1);
}

}  // namespace bw::app
