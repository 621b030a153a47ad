// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Valid work on what the window works on, at random and without end: pulls, numbers, sections, cuts, blocks,
// variables, versions, marks, names, remedies, steps back and forth, while results and sketches come as they
// may. Whatever was done, undo leads back to the beginning, the design that is saved is the one that is
// opened, nothing is told as an error but that a design cannot be cut, and memory does not grow.
//
// BW_MONKEY_ACTIONS and BW_MONKEY_SEED make it busier, or another.
#include <gtest/gtest.h>

#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include <malloc.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "bw/core/design/block_grid.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/grid_change.h"
#include "bw/core/design/section_list.h"
#include "patience.h"
#include "workbench/workbench.h"

namespace bw::app {
namespace {

constexpr int kRound = 200;  // actions on one example
constexpr const char* kExamples[] = {
    "single-block",     "ripple-along",         "ripple-across",    "twist", "bump", "key-blade-fan",
    "three-block-wall", "ruled-between-curves", "two-crossing-cuts"};

int setting(const char* name, int fallback) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : fallback;
}

/// MiB of memory that this process holds, without what is free in its heaps.
double heldMemory() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  long pages = 0, resident = 0;
  statm >> pages >> resident;
  return double(resident) * 4096 / (1 << 20);
}

class WorkbenchMonkey : public testing::Test {
 protected:
  void SetUp() override {
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    settings_ = std::make_unique<model::Settings>();
    bench_ = std::make_unique<Workbench>(*settings_, std::filesystem::path());
    random_.seed(std::uint32_t(setting("BW_MONKEY_SEED", 20261126)));
    QObject::connect(&bench_->document(), &model::Document::designChanged, [this] { ++changes_; });
    QObject::connect(bench_.get(), &Workbench::noticed, [this](const Notice& notice) {
      // Not every design can be cut.
      if (notice.severity == Severity::error && notice.topic != Topic::evaluation) errors_ << notice.text;
    });
  }

  const Design& design() const { return bench_->design(); }
  int upTo(int last) { return std::uniform_int_distribution<int>(0, last)(random_); }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  template <class List>
  auto& any(List& list) {
    return list[std::size_t(upTo(int(std::size(list)) - 1))];
  }

  /// Takes what a change of the design made; one that it may not have is none.
  void take(const char* name, const Result<Design>& changed) {
    if (changed) bench_->editDesign(name, [&](Design& design) { design = *changed; });
  }

  /// Some moves of one hand, back again or not.
  void pull() {
    DesignedSurface* held = nullptr;
    Design next = design();
    std::vector<std::size_t> designed;
    for (std::size_t i = 0; i < next.sources.size(); ++i)
      if (next.sources[i].surface) designed.push_back(i);
    if (designed.empty()) return;
    held = &*next.sources[any(designed)].surface;
    const int merge = bench_->newMergeId();
    const std::uint32_t same = random_();
    for (int step = upTo(5); step >= 0; --step) {
      std::mt19937 here(same);
      const auto pick = [&here](std::size_t count) { return std::size_t(here() % count); };
      const double by = between(-3, 3);
      if (auto* poles = std::get_if<PolesSurface>(&held->shape)) {
        poles->poles[pick(poles->poles.size())].height += by;
      } else if (auto* loft = std::get_if<SectionsSurface>(&held->shape)) {
        SectionCurve& section = loft->sections[pick(loft->sections.size())];
        const std::size_t point = pick(section.points.size());
        const Eigen::Vector2d to = section.points[point] + Eigen::Vector2d(0, by);
        if (section.kind == SectionCurve::Kind::bezier)
          moveBezierPole(section.points, point, to);
        else
          section.points[point] = to;
      } else if (auto* keys = std::get_if<BladesSurface>(&held->shape)) {
        KeyBlade& blade = keys->blades[pick(keys->blades.size())];
        if (here() % 2)
          blade.middle.y() += by;
        else
          blade.angle += by / 300;
      } else {
        held->origin.z() += by;
      }
      bench_->editDesign(
          "Pull", [&](Design& design) { design.sources = next.sources; }, merge, true);
      QCoreApplication::processEvents();
    }
    if (upTo(2))
      bench_->editDesign(
          "Pull", [](Design&) {}, merge, false);
  }

  void number() {
    bench_->editDesign("Number", [this](Design& design) {
      Process& process = design.process;
      switch (upTo(11)) {
        case 0:
          process.tolerance = between(0.5, 4);
          break;
        case 1:
          process.cuttingSpeed = between(5, 40);
          break;
        case 2:
          process.kerf = upTo(1) ? between(0, 3) : 0;
          break;
        case 3:
          process.clearance = between(30, 90);
          break;
        case 4:
          process.floor = between(0, 40);
          break;
        case 5:
          process.margin = between(0.05, 0.4);
          break;
        case 6:
          process.weight = !process.weight;
          break;
        case 7:
          process.lead = between(5, 60);
          break;
        case 8:
          process.extend = Extension(upTo(3));
          break;
        case 9:
          process.gripError = between(0, 1);
          break;
        case 10:
          process.join = Join(upTo(1));
          break;
        default:
          design.blade.length = between(700, 1100);
      }
    });
  }

  void cut() {
    const int what = upTo(6);
    if (what == 5 && design().cuts.size() > 1)
      return bench_->editDesign("Fewer cuts", [](Design& design) { design.cuts.pop_back(); });
    bench_->editCut("Cut", [&](Cut& cut) {
      switch (what) {
        case 0:
          cut.sections = {.stations = 5 + upTo(35)};
          break;
        case 1:
          cut.sections = {.spacing = between(15, 60)};
          break;
        case 2:
          cut.pose.quarters = upTo(3);
          break;
        case 3:
          cut.length = upTo(1) ? std::optional(between(700, 1100)) : std::nullopt;
          break;
        case 4:
          cut.order = upTo(1) ? std::optional(1 + upTo(4)) : std::nullopt;
          break;
        default:
          cut.keep = upTo(1) ? KeptSide::below : KeptSide::above;
      }
    });
  }

  void sections() {
    const std::size_t source = std::size_t(upTo(int(design().sources.size()) - 1));
    const auto& surface = design().sources[source].surface;
    if (!surface) return;
    if (const auto* loft = std::get_if<SectionsSurface>(&surface->shape)) {
      const std::size_t section = std::size_t(upTo(int(loft->sections.size()) - 1));
      const std::size_t point = std::size_t(upTo(int(loft->sections[section].points.size()) - 1));
      switch (upTo(3)) {
        case 0:
          return take("Add section", withSectionAfter(design(), source, section));
        case 1:
          return take("Remove section", withoutSection(design(), source, section));
        case 2:
          return take("Add point", withPointAfter(design(), source, section, point));
        default:
          return take("Remove point", withoutPoint(design(), source, section, point));
      }
    }
    if (const auto* keys = std::get_if<BladesSurface>(&surface->shape)) {
      const std::size_t blade = std::size_t(upTo(int(keys->blades.size()) - 2));
      take("Key blades",
           upTo(1) ? withBladeAfter(design(), source, blade) : withoutBlade(design(), source, blade));
    }
  }

  void grid() {
    if (!design().grid) return;
    take("Grid", withGrid(design(), *design().grid,
                          withCount(*design().grid, std::size_t(upTo(1)), 1 + upTo(2), upTo(1) == 1),
                          design().stock.front().id));
  }

  void variable() {
    if (design().variables.empty()) return;
    Design next = design();
    Variable& variable = any(next.variables);
    variable.value = between(variable.min, variable.max);
    take("Variable", resolved(next));
  }

  void version() {
    const std::vector<NamedVersion>& versions = design().versions;
    if (versions.empty() || (versions.size() < 8 && upTo(1)))
      return take("Keep", withVersion(design(), "state " + std::to_string(++named_)));
    const std::string& name = versions[std::size_t(upTo(int(versions.size()) - 1))].name;
    switch (upTo(2)) {
      case 0:
        return take("Back", atVersion(design(), name));
      case 1:
        return take("Name", withVersionRenamed(design(), name, "state " + std::to_string(++named_)));
      default:
        return take("Drop", withoutVersion(design(), name));
    }
  }

  void mark() {
    Object object;
    switch (upTo(3)) {
      case 0:
        object = {Object::Kind::block, any(design().stock).id};
        break;
      case 1:
        object = {Object::Kind::surface, any(design().sources).id};
        break;
      default:
        object = {Object::Kind::cut, any(design().cuts).id};
    }
    switch (upTo(2)) {
      case 0:
        return bench_->setHidden(object, !bench_->hidden(object));
      case 1:
        // What is locked would soon be all there is.
        return bench_->setLocked(object, !bench_->locked(object) && upTo(3) == 0);
      default:
        if (!design().grid || object.kind == Object::Kind::surface)
          std::ignore = bench_->rename(object, "part-" + std::to_string(++named_));
    }
  }

  void see() {
    const Cut& cut = any(design().cuts);
    bench_->select({Selection::Kind(upTo(3)), -1, cut.block, cut.id});
    if (bench_->row() && !bench_->row()->poses.empty())
      bench_->selectStation(upTo(int(bench_->row()->poses.size()) - 1));
    bench_->setPlayTime(between(0, 30));
  }

  void remedy() {
    const std::vector<Message> messages = bench_->messages();
    if (messages.empty()) return;
    const Message& message = messages[std::size_t(upTo(int(messages.size()) - 1))];
    bench_->showPlace(message);
    const std::vector<Offer> offers = bench_->offersOf(message);
    if (!offers.empty())
      bench_->editDesign("Offer", offers[std::size_t(upTo(int(offers.size()) - 1))].change);
  }

  void act() {
    QUndoStack& steps = bench_->document().undoStack();
    switch (upTo(15)) {
      case 0:
      case 1:
      case 2:
        return pull();
      case 3:
      case 4:
        return number();
      case 5:
        return cut();
      case 6:
        return sections();
      case 7:
        return grid();
      case 8:
        return variable();
      case 9:
        return version();
      case 10:
        return mark();
      case 11:
        return see();
      case 12:
        return steps.undo();
      case 13:
        return steps.redo();
      case 14:
        return steps.setIndex(upTo(steps.count()));
      default:
        if (upTo(9) == 0) {
          // Some of it comes to its end.
          EXPECT_TRUE(QTest::qWaitFor([&] { return !bench_->runner().busy(); }, kPatience));
          return remedy();
        }
        QTest::qWait(upTo(20));
    }
  }

  void saveAndOpen() {
    const std::filesystem::path file = std::filesystem::path(folder_.path().toStdString()) / "m.bladewright";
    Design kept = design();
    kept.marks = bench_->document().marks();
    const Result<void> saved = saveDesign(kept, file);
    ASSERT_TRUE(saved) << saved.error().message;
    const Result<Design> opened = loadDesign(file);
    ASSERT_TRUE(opened) << opened.error().message;
    for (Cut& cut : kept.cuts)
      if (cut.direction) cut.direction->normalize();
    EXPECT_EQ(designToJson(*opened), designToJson(kept));
  }

  QTemporaryDir folder_;
  std::unique_ptr<model::Settings> settings_;
  std::unique_ptr<Workbench> bench_;
  std::mt19937 random_;
  QStringList errors_;
  int named_ = 0;
  int changes_ = 0;  // of the design
};

TEST_F(WorkbenchMonkey, WorksForHours) {
  const int rounds = std::max(1, setting("BW_MONKEY_ACTIONS", 1800) / kRound);
  constexpr int kAll = int(std::size(kExamples));
  double early = 0, late = 0;  // MiB
  for (int round = 0; round < rounds; ++round) {
    const char* example = kExamples[std::size_t(round) % std::size(kExamples)];
    ASSERT_TRUE(bench_->openExample(example)) << example;
    const std::string before = designToJson(design());
    for (int i = 0; i < kRound; ++i) {
      act();
      QCoreApplication::processEvents();
      if (i % 20 == 19) saveAndOpen();
      ASSERT_TRUE(errors_.empty()) << example << ", action " << i << ": " << errors_.join("; ").toStdString();
      if (HasFailure()) FAIL() << example << ", round " << round << ", action " << i;
    }
    bench_->document().undoStack().setIndex(0);
    ASSERT_EQ(designToJson(design()), before) << example << ", round " << round;
    // The memory is looked at where there is no history, and nothing under way.
    ASSERT_TRUE(QTest::qWaitFor([&] { return !bench_->runner().busy(); }, kPatience)) << example;
    ASSERT_TRUE(bench_->current()) << example << ": " << bench_->runner().error().value_or(Error{}).message;
    if (round % kAll == kAll - 1) {
      late = heldMemory();
      if (round < 2 * kAll) early = late;  // all has been held once, and most of it twice
    }
  }
  EXPECT_LE(late, early + 60) << "MiB, after " << rounds * kRound << " actions";
  EXPECT_GT(changes_, rounds * kRound / 2) << "most actions change something";
  RecordProperty("changes", changes_);
  RecordProperty("early_mib", int(early));
  RecordProperty("late_mib", int(late));
}

}  // namespace
}  // namespace bw::app
