// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/workbench.h"

#include <QGuiApplication>
#include <QStringList>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "bw/core/base/box_distance.h"
#include "bw/core/design/blade_bindings.h"
#include "bw/core/sweep/station_times.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/words/findings.h"

namespace bw::app {

namespace fs = std::filesystem;

namespace {

constexpr double kSamePlace = 1e-6;  // mm by which a block is no nearer than another

}  // namespace

Workbench::Workbench(model::Settings& settings, const fs::path& recoveryFolder, QObject* parent)
    : QObject(parent), settings_(settings), document_(recoveryFolder) {
  leftOut_ = settings.leftOut();
  settleSelection();
  connect(&document_, &model::Document::replaced, this, &Workbench::onReplaced);
  connect(&document_, &model::Document::designChanged, this, &Workbench::onDesignChanged);
  connect(&document_, &model::Document::designChanged, this, &Workbench::followSource);
  // What a command made is told after its step.
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    emit noticesOutdated(Topic::made);
    emit noticesOutdated(Topic::declined);
  });
  connect(&watch_, &model::SourceWatch::changed, this, &Workbench::onSourceChanged);
  connect(&watch_, &model::SourceWatch::gone, this, &Workbench::tellSourceGone);
  connect(&watch_, &model::SourceWatch::back, this, [this] { emit noticesOutdated(Topic::source); });
  // Whether the file can be read again or is to be located follows from what lies on the disk.
  for (const auto signal :
       {&model::SourceWatch::changed, &model::SourceWatch::gone, &model::SourceWatch::back})
    connect(&watch_, signal, this, [this] { tellChanged(Aspect::state); });
  connect(&document_, &model::Document::autosaveFailed, this, [this](const QString& message) {
    tell(Topic::autosave, Severity::warning,
         tr("The automatic copy could not be written: %1. Save the design.").arg(message));
  });
  connect(&document_, &model::Document::autosaveMended, this,
          [this] { emit noticesOutdated(Topic::autosave); });
  connect(&runner_, &model::EvaluationRunner::finished, this, &Workbench::onFinished);
  connect(&runner_, &model::EvaluationRunner::sketched, this, [this] {
    sketchTold_ = true;
    tellChanged(Aspect::sketch | Aspect::state);
  });
  connect(&runner_, &model::EvaluationRunner::busyChanged, this,
          [this] { tellChanged(Aspect::state | Aspect::progress); });
  connect(&runner_, &model::EvaluationRunner::progressed, this, [this] { tellChanged(Aspect::progress); });
  connect(&runner_, &model::EvaluationRunner::cancelled, this, [this] {
    if (!current() && !document_.empty())
      tell({Severity::info,
            runner_.evaluation() ? tr("Stopped. The picture shows the result before the last change.")
                                 : tr("Stopped before there was a result."),
            tr("Compute"), [this] { runner_.evaluate(document_.design()); }, Topic::evaluation});
    tellChanged(Aspect::state);
  });
}

void Workbench::onReplaced() {
  ++opened_;
  // First of all: whoever is told that work ended asks for the cut selected, and the design is the new one.
  selection_ = {};
  Change change = settleSelection();
  runner_.clear();
  playTime_ = 0;
  moving_ = false;
  judgedSize_.reset();
  sourceTold_ = false;
  readSource_.reset();
  readPath_.clear();
  readAgainAt_ = {};
  sourceChanged_ = false;
  ++sourceReadings_;
  messages_.clear();
  exportFindings_.clear();
  exported_.clear();
  exportTo_.clear();
  exportFolder_.clear();
  exportedFiles_.clear();
  exportProblem_.clear();
  blocksLeftOut_.clear();
  reading_.reset();
  drawing_.reset();
  for (const Topic topic : {Topic::evaluation, Topic::source, Topic::unit, Topic::file, Topic::written,
                            Topic::made, Topic::declined})
    emit noticesOutdated(topic);
  change |= resultChange();
  change.whole |= Aspect::messages;
  emit changed(change);
  emit objectsChanged();
}

std::shared_ptr<const pipeline::Evaluation> Workbench::shown() const {
  return runner_.lastComplete() ? runner_.lastComplete() : runner_.evaluation();
}

const pipeline::CutEvaluation* Workbench::shownCut() const {
  const auto evaluation = shown();
  return evaluation ? evaluation->find(selection_.cut) : nullptr;
}

std::optional<pipeline::CutResult> Workbench::sweep() const {
  const pipeline::CutEvaluation* cut = shownCut();
  return cut ? cut->result() : std::nullopt;
}

const pipeline::CutSketch* Workbench::sketchedCut() const {
  return sketch() ? sketch()->find(selection_.cut) : nullptr;
}

const Sweep* Workbench::row() const {
  if (const pipeline::CutSketch* cut = sketchedCut()) return cut->sweep.get();
  const pipeline::CutEvaluation* cut = shownCut();
  return cut && cut->result() ? cut->sweep.value.get() : nullptr;
}

const geometry::CadInfo* Workbench::fileInfo() const {
  const auto& newest = runner_.evaluation();
  return newest && newest->source.value ? &newest->source.value->model.info() : nullptr;
}

const geometry::Target* Workbench::newestTarget() const {
  const auto& newest = runner_.evaluation();
  const pipeline::CutEvaluation* cut = newest ? newest->find(selection_.cut) : nullptr;
  return cut ? cut->target.value.get() : nullptr;
}

bool Workbench::current() const {
  return runner_.evaluation() && runner_.evaluation() == runner_.lastComplete() &&
         runner_.evaluatedDesign() == document_.design();
}

bool Workbench::stale() const { return shown() && !document_.empty() && !current() && !sketch() && sweep(); }

model::StepStates Workbench::stepStates() const {
  model::StepFacts facts;
  facts.design = document_.design();
  facts.evaluated = runner_.evaluatedDesign();
  facts.evaluation = runner_.evaluation();
  facts.cut = selection_.cut;
  facts.error = runner_.error();
  facts.busy = runner_.busy();
  facts.progress = runner_.progress();
  facts.busyStep = runner_.step();
  facts.exported = exported_;
  facts.exportedPart = exportedPart_;
  facts.exporting = exporting_;
  facts.exportProblem = exportProblem_;
  return model::stepStates(facts);
}

void Workbench::select(Selection next) {
  if (next.cut.empty()) {
    next.cut = selection_.cut;
    next.block = selection_.block;
  }
  Change change{Aspect::selection};
  if (next.cut != selection_.cut) change.cuts[next.cut] = model::kAspectsOfCut;
  const Selection before = std::exchange(selection_, next);
  if (next.kind == Selection::Kind::station) {
    const auto result = sweep();
    if (!result || result->sweep.poses.empty()) {
      selection_ = before;
      return;
    }
    selection_.station = std::clamp(next.station, 0, int(result->sweep.poses.size()) - 1);
  } else {
    selection_.station = -1;
  }
  if (selection_ != before) emit changed(change);
}

Cut& Workbench::cutOf(Design& design) const {
  return *std::ranges::find(design.cuts, selection_.cut, &Cut::id);
}

const Cut& Workbench::cut() const { return *std::ranges::find(design().cuts, selection_.cut, &Cut::id); }

const StockBlock& Workbench::block() const {
  return *std::ranges::find(design().stock, selection_.block, &StockBlock::id);
}

double Workbench::playEnd() const {
  const auto result = sweep();
  return result ? result->motion.duration() : 0;
}

void Workbench::setPlayTime(double seconds) {
  const double time = std::clamp(seconds, 0.0, playEnd());
  if (time == playTime_ && moving_) return;
  playTime_ = time;
  moving_ = sweep().has_value();
  tellChanged(Aspect::playTime);
}

void Workbench::setMoving(bool moving) {
  if (moving_ == moving) return;
  moving_ = moving && sweep();
  tellChanged(Aspect::playTime);
}

void Workbench::selectCutAt(const Eigen::Vector3d& place) {
  const auto evaluation = shown();
  const pipeline::CutEvaluation* selected = shownCut();
  if (!selected || !selected->setup) return;
  // Beside several the one that is selected stays.
  double least = boxDistance(selected->block(), place) - kSamePlace;
  Selection next = selection_;
  for (const pipeline::BlockEvaluation& block : evaluation->blocks)
    for (const pipeline::CutEvaluation& other : block.cuts) {
      const auto cut = std::ranges::find(design().cuts, other.id, &Cut::id);
      if (!other.result() || cut == design().cuts.end() || &design().sourceOf(*cut) != &source()) continue;
      const double distance = boxDistance(other.block(), place);
      if (distance >= least) continue;
      least = distance;
      next.cut = other.id;
      next.block = block.id;
    }
  if (next != selection_) select(next);
}

void Workbench::lookBeside(const Eigen::Vector3d& place, bool anyCut) {
  if (anyCut) selectCutAt(place);
  const auto result = sweep();
  if (!result || result->sweep.poses.empty()) return;
  const Sweep& row = result->sweep;
  const double level = row.planes.level(place);
  const auto nearest = std::ranges::min_element(row.poses, {}, [&](const BladePose& pose) {
    return std::abs(row.planes.level(pose.frame.origin) - level);
  });
  const int station = int(nearest - row.poses.begin());
  if (selection_.station >= 0) return selectStation(station);
  const double time = timeOfStation(station);
  if (time == playTime_) return;
  playTime_ = time;
  tellChanged(Aspect::playTime);
}

double Workbench::timeOfStation(int station) const {
  const auto result = sweep();
  if (!result || station < 0) return 0;
  const std::vector<double> times = stationTimes(result->motion, result->sweep.poses);
  return std::size_t(station) < times.size() ? times[std::size_t(station)] : 0;
}

double Workbench::stationAt(double seconds) const {
  const auto result = sweep();
  if (!result || result->sweep.poses.empty()) return -1;
  const std::vector<double> times = stationTimes(result->motion, result->sweep.poses);
  const auto next = std::ranges::lower_bound(times, seconds);
  if (next == times.end()) return double(result->sweep.poses.size()) - 1;
  if (next == times.begin()) return 0;
  const double before = *std::prev(next);
  return double(next - times.begin() - 1) + (seconds - before) / (*next - before);
}

std::vector<Eigen::Vector3d> Workbench::bladeAt(double seconds) const {
  constexpr int kPlaces = 121;
  const pipeline::CutEvaluation* cut = shownCut();
  if (!cut || !cut->run.value || cut->run.value->blades.empty()) return {};
  if (const std::optional<Halt>& halt = cut->run.value->halt; halt && seconds >= halt->time) return {};
  const std::vector<SimulatedBlade>& blades = cut->run.value->blades;
  const auto places = [](const SimulatedBlade& at) {
    std::vector<Eigen::Vector3d> points;
    for (const Elastica::State& state : at.blade.sample(kPlaces))
      points.push_back(at.frame.toWorld(state.point));
    return points;
  };
  const auto after = std::ranges::lower_bound(blades, seconds, {}, &SimulatedBlade::time);
  if (after == blades.begin()) return places(blades.front());
  if (after == blades.end()) return places(blades.back());
  const SimulatedBlade &a = *(after - 1), &b = *after;
  const double share = (seconds - a.time) / (b.time - a.time);
  std::vector<Eigen::Vector3d> points = places(a);
  const std::vector<Eigen::Vector3d> next = places(b);
  for (std::size_t k = 0; k < points.size(); ++k) points[k] += share * (next[k] - points[k]);
  return points;
}

Change Workbench::settleSelection() {
  const auto there = std::ranges::find(design().cuts, selection_.cut, &Cut::id);
  const Cut& cut = there == design().cuts.end() ? design().cuts.front() : *there;
  if (there != design().cuts.end() && cut.block == selection_.block) return {};
  selection_ = {Selection::Kind::result, -1, cut.block, cut.id};
  return {Aspect::selection, {{cut.id, model::kAspectsOfCut}}};
}

Change Workbench::resultChange() {
  Change change = model::difference(toldShown_.get(), shown().get());
  change |= model::difference(toldNewest_.get(), runner_.evaluation().get());
  toldShown_ = shown();
  toldNewest_ = runner_.evaluation();
  if (sketchTold_ && !sketch()) {
    sketchTold_ = false;
    change.whole |= Aspect::sketch;
  }
  // What only adds to the result on the screen leaves that as it is.
  if (!change.any(Aspect::thoughts) || change.any(~model::Aspects(Aspect::thoughts)))
    change.whole |= Aspect::result;
  return change;
}

void Workbench::onDesignChanged() {
  Change change = settleSelection();
  if (!document_.empty()) runner_.evaluate(document_.design(), live_);
  lastLive_ = live_;
  exportProblem_.clear();
  change.whole |= Aspect::design | Aspect::state;
  emit changed(change);
}

namespace {

Message messageOf(const Finding& finding) {
  return {finding.severity, QString::fromStdString(printable(words::listed(finding, words::Reader::window))),
          finding, finding.remedies};
}

}  // namespace

void Workbench::tell(const Notice& notice) {
  Notice told = notice;
  told.text = asSentence(told.text);
  emit noticed(told);
}

QString Workbench::asSentence(QString text) const {
  if (text.isEmpty()) return text;
  const auto begins = [&](const std::string& name) {
    const QString own = QString::fromStdString(name);
    return !own.isEmpty() && text.startsWith(own) &&
           (text.size() == own.size() || !text[own.size()].isLetterOrNumber());
  };
  const auto named = [&](const auto& list, const auto& nameOf) {
    return std::ranges::any_of(list, [&](const auto& one) { return begins(std::invoke(nameOf, one)); });
  };
  const Design& now = design();
  const QString first = text.section(QLatin1Char(' '), 0, 0);
  const bool isFile = first.chopped(1).contains(QLatin1Char('.'));
  if (isFile || named(now.stock, &StockBlock::id) || named(now.cuts, &Cut::id) ||
      named(now.sources, &Source::id) || named(now.variables, &Variable::name))
    return text;
  text[0] = text[0].toUpper();
  return text;
}

std::vector<Message> Workbench::messages() const {
  std::vector<Message> all = messages_;
  if (!exportFindings_.empty() && runner_.evaluation() &&
      model::exportKey(*runner_.evaluation()) == exported_)
    std::ranges::transform(exportFindings_, std::back_inserter(all), messageOf);
  return all;
}

void Workbench::onFinished() {
  const std::vector<Message> before = std::exchange(messages_, {});
  emit noticesOutdated(Topic::evaluation);
  if (const std::optional<Error>& error = runner_.error()) {
    const QString text = asSentence(QString::fromStdString(printable(error->message)));
    messages_.push_back({Severity::error, text, {}, error->remedies});
    Notice notice{Severity::error, QString::fromStdString(error->message), {}, {}, Topic::evaluation};
    for (const Remedy& remedy : error->remedies) {
      if (!notice.action.isEmpty() || !canApply(remedy)) continue;
      notice.action = QString::fromStdString(words::action(remedy));
      notice.run = [this, remedy] { apply(remedy); };
    }
    if (sourceMissing()) {
      notice.action = tr("Locate…");
      notice.run = [this] { emit locateRequested(); };
    }
    tell(notice);
  }
  if (runner_.evaluation())
    std::ranges::transform(runner_.evaluation()->findings(), std::back_inserter(messages_), messageOf);
  Change change = resultChange();
  // A list that is the same stays as it is, with what is chosen of it.
  const auto same = [](const Message& a, const Message& b) {
    return a.severity == b.severity && a.text == b.text;
  };
  change.whole |= Aspect::state;
  if (change.whole.testFlag(Aspect::result) || !std::ranges::equal(before, messages_, same))
    change.whole |= Aspect::messages;
  if (const auto result = sweep()) {
    const int count = int(result->sweep.poses.size());
    if (selection_.kind == Selection::Kind::station && selection_.station >= count) {
      selection_.station = count - 1;
      change.whole |= Aspect::selection;
    }
    playTime_ = std::min(playTime_, playEnd());
  }
  noteSourceRead();
  judgeSize();
  if (!runner_.error()) tellDirection();
  emit changed(change);
}

void Workbench::judgeSize() {
  const geometry::Target* target = newestTarget();
  if (!target || !fileInfo() || document_.design()->source().surface) return;  // who designs knows the unit
  const Eigen::Vector3d size = target->bounds().size();
  if (std::exchange(judgedSize_, size) == size) return;
  const double largest = size.maxCoeff();
  if (pipeline::isPlausibleSize(largest)) return emit noticesOutdated(Topic::unit);
  const auto text = [](double mm) { return QString::fromStdString(shortText(mm, 4)); };
  tell(
      {Severity::warning,
       tr("Is the unit right? The surface measures %1 × %2 × %3 mm, its file was read in %4. Choose the unit "
          "meant under Input ▸ Read as, or go on.")
           .arg(text(size.x()), text(size.y()), text(size.z()), QString::fromStdString(fileInfo()->readAs)),
       tr("Go on"), [] {}, Topic::unit});
}

Result<void> Workbench::refuse(Topic topic, const Error& error) {
  tell(topic, error);
  return tl::unexpected<Error>(error);
}

void Workbench::editDesign(const QString& text, const std::function<void(Design&)>& change, int mergeId,
                           bool live) {
  Design after = design();
  change(after);
  for (const std::string& place : binding_.places)
    if (binding_.bound) {
      after.bindings[place] = *binding_.bound;
      freeRivals(after.bindings, place);
    } else if (place.ends_with('/')) {
      std::erase_if(after.bindings, [&](const auto& told) { return told.first.starts_with(place); });
    } else {
      after.bindings.erase(place);
    }
  if (const auto kept = firstChanged(objectsOf(document_.marks().locked), design(), after)) {
    tell(Topic::locked, Severity::info,
         (kept->kind == Object::Kind::stations
              ? tr("Locked: %1 stay as they are; their lock in the tree of objects lets them be changed")
              : tr("Locked: %1 stays as it is; its lock in the tree of objects lets it be changed"))
             .arg(QString::fromStdString(printable(nameOf(design(), *kept)))));
    // Fields show what is there.
    return tellChanged(Aspect::design);
  }
  live_ = live;
  document_.editDesign(text, mergeId, [&after](Design& design) { design = std::move(after); });
  live_ = false;
}

void Workbench::undo() {
  const std::shared_ptr<const Design> before = document_.design();
  document_.undoStack().undo();
  tellUnlocked(*before, tr("the step that was taken back"));
}

void Workbench::redo() {
  const std::shared_ptr<const Design> before = document_.design();
  document_.undoStack().redo();
  tellUnlocked(*before, tr("the step that was made again"));
}

void Workbench::tellUnlocked(const Design& before, const QString& step) {
  // Marks follow a name that another step gave or took.
  const NewNames names = newNames(before, design());
  if (PartMarks marks = withNewNames(document_.marks(), names); marks != document_.marks()) {
    document_.setMarks(std::move(marks));
    emit objectsChanged();
  }
  const Design was = calledSo(before, names);
  const auto other = firstChanged(objectsOf(document_.marks().locked), was, design());
  if (!other) return;
  const QString name = QString::fromStdString(printable(nameOf(was, *other)));
  tell(Topic::made, Severity::info,
       (other->kind == Object::Kind::stations ? tr("The %1 are locked, but were changed by %2")
                                              : tr("%1 is locked, but was changed by %2"))
           .arg(name, step));
}

bool Workbench::handHolds() const { return lastLive_ && QGuiApplication::mouseButtons() != Qt::NoButton; }

void Workbench::editBound(const std::string& place, const std::optional<BoundNumber>& bound,
                          const std::function<void()>& edit) {
  binding_ = {{place}, bound};
  edit();
  binding_ = {};
}

void Workbench::setHidden(const Object& object, bool hidden) {
  if (hidden == this->hidden(object)) return;
  PartMarks marks = document_.marks();
  std::set<std::string>& ids = idsOf(marks.hidden, object.kind);
  hidden ? void(ids.insert(object.id)) : void(ids.erase(object.id));
  document_.setMarks(std::move(marks));
  emit objectsChanged();
}

void Workbench::setLocked(const Object& object, bool locked) {
  if (locked == this->locked(object)) return;
  PartMarks marks = document_.marks();
  std::set<std::string>& ids = idsOf(marks.locked, object.kind);
  locked ? void(ids.insert(object.id)) : void(ids.erase(object.id));
  document_.setMarks(std::move(marks));
  emit noticesOutdated(Topic::locked);
  emit objectsChanged();
}

Result<void> Workbench::rename(const Object& object, const std::string& name) {
  const bool isCurve = object.kind == Object::Kind::curve;
  if (name == object.id && !isCurve) return {};
  const Result<Design> changed = renamed(design(), object, name);
  if (!changed) return refuse(Topic::declined, changed.error());
  // With a block of a grid its cuts are called otherwise, and with one of these those of other blocks.
  const NewNames names = newNames(design(), *changed);
  Selection next = selection_;
  followName(names.blocks, next.block);
  followName(names.cuts, next.cut);
  const std::string was = isCurve ? nameOf(design(), object) : object.id;
  editDesign(tr("Rename %1").arg(QString::fromStdString(printable(was))),
             [&changed](Design& design) { design = *changed; });
  // Marks call a curve by its place.
  if (design() != *changed || isCurve) return {};
  // The old name stays hidden too: undo brings it back.
  document_.setMarks(withNewNames(document_.marks(), names));
  if (next != selection_) select(next);
  emit objectsChanged();
  return {};
}

void Workbench::editCut(const QString& text, const std::function<void(Cut&)>& change, int mergeId,
                        bool live) {
  editDesign(
      text,
      [&](Design& design) {
        Cut& own = cutOf(design);
        const Cut before = own;
        change(own);
        if (!design.grid) return;
        // The cuts of a grid that are alike stay so: what goes on from block to block is changed as one, and
        // told by the same expressions.
        const auto placeOf = [&design](const Cut& cut) {
          return "/cuts/" + std::to_string(&cut - design.cuts.data()) + "/";
        };
        const std::vector<std::string> bound = binding_.places;
        for (Cut& other : design.cuts) {
          Cut alike = before;
          alike.id = other.id;
          alike.block = other.block;
          if (&other == &own || other != alike) continue;
          change(other);
          for (const std::string& place : bound)
            if (place.starts_with(placeOf(own)))
              binding_.places.push_back(placeOf(other) + place.substr(placeOf(own).size()));
        }
      },
      mergeId, live);
}

void Workbench::editSurface(const QString& text, const std::function<void(DesignedSurface&)>& change,
                            int mergeId, bool live) {
  editDesign(
      text,
      [&](Design& design) {
        if (std::optional<DesignedSurface>& surface = design.sourceOf(cutOf(design)).surface)
          change(*surface);
      },
      mergeId, live);
}

void Workbench::editBlock(const QString& text, const std::function<void(StockBlock&)>& change, int mergeId,
                          bool live) {
  editDesign(
      text,
      [&](Design& design) {
        change(*std::ranges::find(design.stock, selection_.block, &StockBlock::id));
        if (design.grid && design.stock != stockOf(*design.grid)) design.grid.reset();
      },
      mergeId, live);
}

}  // namespace bw::app
