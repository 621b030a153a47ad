// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// How the scene follows the workbench, and the workbench what is picked in the scene.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/scene_content.h"
#include "controls/numbers.h"
#include "window/curve_handles.h"
#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr double kUnmeasured = 0.6;  ///< as what is out of date

}  // namespace

scene::Content MainWindow::sceneContent() {
  if (const pipeline::Sketch* sketch = bench_.sketch()) return pipeline::sceneContent(*sketch);
  const auto shown = bench_.shown();
  if (!shown) return {};
  scene::Content content = pipeline::sceneContent(*shown);
  const auto& newest = bench_.runner().evaluation();
  if (newest && newest != shown) {
    // The block stands where it was put, and the file is the present one, even if nothing could be cut.
    const scene::Content now = pipeline::sceneContent(*newest);
    for (const scene::Kind kind : {scene::Kind::block, scene::Kind::face}) {
      if (kind == scene::Kind::block && !now.first<Box>()) continue;
      content.remove(kind);
      std::ranges::copy_if(now.items, std::back_inserter(content.items),
                           [kind](const scene::Item& item) { return item.kind() == kind; });
    }
  }
  return content;
}

void MainWindow::follow(const Change& change) {
  if (change.any(Aspect::design)) {
    editClock_.start();
    refreshTitle();
    refreshComparison();
  }
  if (change.any(Aspect::selection | Aspect::result)) marker_.reset();
  if (change.any(Aspect::result))
    refreshResult(change.any(Aspect::source | Aspect::sketch | Aspect::part | model::kAspectsOfCut));
  else if (change.any(Aspect::sketch))
    refreshSketch();
  else if (change.any(Aspect::selection | Aspect::playTime | Aspect::thoughts))
    refreshStyle();
  if (change.any(Aspect::state | Aspect::progress)) refreshState();
}

void MainWindow::refreshResult(bool content) {
  const auto evaluation = bench_.shown();
  if (content) {
    tellHovered({}, *view_);  // what the pointer was over may be elsewhere
    beside_->setContent(sceneContent());
    shownSketch_ = bench_.runner().sketch();
  }
  // The opening view is of the target until there is a first result, which leads to its block, unless the
  // user has gone elsewhere meanwhile.
  if (evaluation && fitNext_) {
    const scene::Camera now = view_->camera();
    if (!opening_ || (opening_->position == now.position && opening_->focus == now.focus)) {
      view_->open();
      opening_ = view_->camera();
    }
    fitNext_ = !evaluation->result();
  }
  staleTimer_.stop();
  staleShown_ = false;
  refreshStyle();
  if (evaluation && bench_.current()) {
    awaitingFrame_ = true;
    view_->update();
  }
}

void MainWindow::refreshSketch() {
  const std::shared_ptr<const pipeline::Sketch> sketch = bench_.runner().sketch();
  tellHovered({}, *view_);
  std::optional<scene::Content> change;
  if (sketch && shownSketch_) change = pipeline::sceneChange(*sketch, *shownSketch_);
  if (change)
    beside_->replace(std::move(*change));
  else
    beside_->setContent(sceneContent());
  shownSketch_ = sketch;
  refreshStyle();
}

std::optional<scene::SectionPlane> MainWindow::sectionPlane() const {
  const Sweep* row = bench_.row();
  if (!sectioned_ || !row || row->poses.empty()) return std::nullopt;
  const auto& stations = row->poses;
  // The moving blade leads while it plays, the selected station otherwise, the middle if there is neither.
  const bool follow = bench_.moving() && (motion_->playing() || bench_.selection().station < 0);
  const double at = follow                            ? bench_.stationAt(bench_.playTime())
                    : bench_.selection().station >= 0 ? bench_.selection().station
                                                      : 0.5 * double(stations.size() - 1);
  const auto before = std::size_t(std::clamp(std::floor(at), 0.0, double(stations.size() - 1)));
  const std::size_t after = std::min(before + 1, stations.size() - 1);
  const double share = std::clamp(at - double(before), 0.0, 1.0);
  const Frame &a = stations[before].frame, &b = stations[after].frame;
  return scene::SectionPlane{(1 - share) * a.origin + share * b.origin,
                             sectionSide_ * ((1 - share) * a.normal + share * b.normal).normalized()};
}

scene::ItemId MainWindow::selectedRow() const {
  if (const auto shown = bench_.shown())
    for (int b = 0; b < int(shown->blocks.size()); ++b) {
      const auto& cuts = shown->blocks[std::size_t(b)].cuts;
      const auto cut = std::ranges::find(cuts, bench_.selection().cut, &pipeline::CutEvaluation::id);
      if (cut != cuts.end()) return {b, int(cut - cuts.begin()), 0};
    }
  return {0, 0, 0};
}

void MainWindow::hideObjects(scene::Style& style) const {
  const auto shown = bench_.shown();
  if (!shown) return;
  const auto hide = [&style](const scene::ItemId& id, std::initializer_list<scene::Kind> kinds) {
    for (const scene::Kind kind : kinds) {
      scene::Look look = style[kind];
      look.visible = false;
      style.items[{kind, id}] = look;
    }
  };
  using enum scene::Kind;
  // Cuts of one surface have one target, which is seen with any of them.
  struct Shared {
    scene::ItemId id;
    bool seen = false;
  };
  std::map<const TriangleMesh*, Shared> targets;
  for (int b = 0; b < int(shown->blocks.size()); ++b) {
    const pipeline::BlockEvaluation& own = shown->blocks[std::size_t(b)];
    const bool all = bench_.hidden({Object::Kind::block, own.id});
    if (all) hide({b}, {block, part});
    // An edge of what is left of the block is seen with that, else with both surfaces that meet in it.
    const bool ofPart =
        !bench_.sketch() && own.part.value && !own.part.value->mesh.triangles.empty() && style[part].visible;
    std::vector<char> apart;
    for (const pipeline::CutEvaluation& cut : own.cuts)
      apart.push_back(all || (!ofPart && bench_.hidden({Object::Kind::cut, cut.id})));
    if (std::ranges::count(apart, 1) > 0)
      for (std::size_t c = 0; c < apart.size(); ++c)
        for (std::size_t d = c + 1; d < apart.size(); ++d)
          if (apart[c] || apart[d]) hide({b, int(c), int(d)}, {crease});
    for (int c = 0; c < int(own.cuts.size()); ++c) {
      const std::string& id = own.cuts[std::size_t(c)].id;
      const auto there = std::ranges::find(bench_.design().cuts, id, &Cut::id);
      const bool whole = all || bench_.hidden({Object::Kind::cut, id});
      if (whole) hide({b, c, 0}, {cut, station, blade});
      if (bench_.hidden({Object::Kind::stations, id})) hide({b, c, 0}, {station});
      const bool gone = whole || (there != bench_.design().cuts.end() &&
                                  bench_.hidden({Object::Kind::surface, there->source}));
      const TriangleMesh* mesh = own.cuts[std::size_t(c)].targetMesh.value.get();
      Shared& surface = targets.try_emplace(mesh, Shared{{b, c}}).first->second;
      surface.seen = surface.seen || !gone;
    }
  }
  const std::vector<std::string> leftOut = pipeline::blocksLeftOut(*shown);
  for (std::size_t k = 0; k < leftOut.size(); ++k)
    if (bench_.hidden({Object::Kind::block, leftOut[k]})) hide({int(shown->blocks.size() + k)}, {block});
  for (const auto& [mesh, surface] : targets)
    if (!surface.seen) hide(surface.id, {target});
  const std::vector<Source>& sources = shown->design.sources;
  for (int i = 0; i < int(sources.size()); ++i)
    if (bench_.hidden({Object::Kind::surface, sources[std::size_t(i)].id})) hide({-1, i}, {told});
}

void MainWindow::refreshStyle() {
  scene::Style style = mapBar_->style();
  style.dark = theme_.dark();
  style.tolerance = bench_.design().process.tolerance;
  style.stale = staleShown_;
  style.selected = style.moving = selectedRow();
  style.selected.station = bench_.selection().station;
  style.playhead = bench_.moving() ? bench_.stationAt(bench_.playTime()) : -1;
  // While a hand moves something the blade stands where the row has it: the run is that of the result.
  if (bench_.moving() && !bench_.sketch()) style.movingBlade = bench_.bladeAt(bench_.playTime());
  style.section = sectionPlane();
  style.marker = marker_;
  // Where surfaces that follow a hand meet is not measured.
  if (bench_.sketch()) style[scene::Kind::crease].opacity = kUnmeasured;
  // What key blades under a hand tell is not looked at.
  if (bench_.sketch()) style[scene::Kind::told].visible = false;
  hideObjects(style);
  faces_->applyTo(style);
  handles_->applyTo(style);
  markCurves(bench_, style.handles);
  blockHandles_->applyTo(style);
  beside_->setStyle(style);
  const Field* mapped = mappedField(*view_);
  // Creases have their map of their own.
  const MapInfo* map = view_->legendRange() ? cutMap(style[scene::Kind::cut].map) : nullptr;
  mapBar_->setRangeUnit(mapped ? QString::fromStdString(mapped->unit)
                        : map  ? QString::fromUtf8(map->unit)
                               : QString());
  mapBar_->setRangeInUse(view_->legendRange());
  const auto result = bench_.shown();
  const bool creases = result && pipeline::hasCreases(*result);
  mapBar_->setCreases(creases);
  inspector_->setStale(staleShown_ || bench_.sketch());  // its numbers are those of the result
  refreshSummary();
  commands_["view.handles"]->setChecked(handles_->shown());
  refreshHandleCommands();
  for (const auto& [id, isOn] : toggles_) commands_[id]->setChecked(isOn(style));
  for (const std::string& name : MapBar::fieldNames())
    commands_[QString::fromStdString("map." + name)]->setChecked(style[scene::Kind::cut].map == name);
  for (const MapInfo& one : cutMaps())
    commands_["map." + QString(one.name)]->setEnabled(one.ofCut || creases);
  commands_["view.section"]->setChecked(sectioned_);
}

const Field* MainWindow::mappedField(const view::SceneView& view) {
  const auto* cut = view.content().first<scene::CutSurface>();
  return cut ? cut->grid.field(view.sceneStyle()[scene::Kind::cut].map) : nullptr;
}

void MainWindow::showSpot(const Spot& spot) {
  faces_->setChoosing(false);
  marker_.reset();
  if (spot.point) {
    marker_ = scene::Marker{*spot.point, spot.text.toStdString(), spot.severity};
  }
  refreshStyle();
  if (spot.bounds.valid())
    view_->fitBounds(spot.bounds);
  else
    view_->fitWork();
}

void MainWindow::onPicked(const scene::Pick& pick) {
  if (marker_) {
    marker_.reset();
    refreshStyle();
  }
  using Kind = Selection::Kind;
  Selection picked{pick.kind == scene::Kind::station  ? Kind::station
                   : pick.kind == scene::Kind::target ? Kind::surface
                   : pick.kind == scene::Kind::blade  ? Kind::blade
                   : pick.kind == scene::Kind::block  ? Kind::block
                                                      : Kind::result,
                   pick.station.station};
  const auto shown = bench_.shown();
  if (shown && pick.id.block >= 0 && std::size_t(pick.id.block) < shown->blocks.size()) {
    const pipeline::BlockEvaluation& block = shown->blocks[std::size_t(pick.id.block)];
    if (const auto cut = std::size_t(std::max(0, pick.id.cut)); cut < block.cuts.size()) {
      picked.block = block.id;
      picked.cut = block.cuts[cut].id;
    }
  }
  bench_.select(picked);
}

void MainWindow::onHovered(const scene::Pick& pick) {
  faces_->hover(pick.face, view_->toWidget(pick.point));
  tellHovered(pick, *view_);
}

void MainWindow::tellHovered(const scene::Pick& pick, const view::SceneView& view) {
  if (pick.kind == scene::Pick::Kind::none) {
    cursor_->clear();
    probe_->clear();
    return;
  }
  cursor_->setText(pointText(pick.point) + " mm");
  QString text;
  const Field* field = mappedField(view);
  if (pick.value && field) {
    constexpr double kNothing = 5e-4;  // of any of these units
    const double value = std::abs(*pick.value) < kNothing ? 0 : *pick.value;
    const char* word = mapWord(field->name, value);
    text = QString::fromStdString(field->title.empty() ? field->name : field->title) + " " +
           QString::fromStdString(word ? word : shortText(value, 3));
    if (!field->unit.empty()) text += (field->unit == "°" ? "" : " ") + QString::fromStdString(field->unit);
  }
  probe_->setText(text);
}

void MainWindow::fitSelection() {
  Bounds bounds;
  const pipeline::CutEvaluation* cut = bench_.shownCut();
  if (!cut) return;
  const Selection& selection = bench_.selection();
  if (const auto result = bench_.sweep(); result && selection.station >= 0) {
    const BladePose& station = result->sweep.poses[std::size_t(selection.station)];
    for (const Eigen::Vector2d& p : station.blade.sample(33)) bounds.add(station.frame.toWorld(p));
  } else if (selection.kind == Selection::Kind::surface && cut->target.value) {
    bounds = cut->target.value->bounds();
  } else if (selection.kind == Selection::Kind::block && cut->setup) {
    for (const Eigen::Vector3d& corner : cut->block().corners()) bounds.add(corner);
  }
  if (bounds.valid())
    view_->fitBounds(bounds);
  else
    view_->fitWork();
}

}  // namespace bw::app
