// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "step_salvage.h"

#include <Interface_Check.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_ContextDependentShapeRepresentation.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_HArray1OfFace.hxx>
#include <StepShape_HArray1OfShell.hxx>
#include <StepShape_OrientedFace.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_Shell.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <TCollection_HAsciiString.hxx>

#include <map>
#include <memory>
#include <set>

#include "cad_format.h"

namespace bw::geometry {

namespace {

constexpr std::size_t kNamedAtMost = 5;  // entities that one finding names

template <class T>
Handle(T) as(const Handle(Standard_Transient) & entity) {
  return Handle(T)::DownCast(entity);
}

bool isShape(const Handle(Standard_Transient) & entity) {
  const std::string type = entity->DynamicType()->Name();
  return type.rfind("StepGeom_", 0) == 0 || type.rfind("StepShape_", 0) == 0;
}

/// True for what tells where shapes belong.
bool placesShapes(const Handle(Standard_Transient) & entity) {
  return !as<StepShape_ContextDependentShapeRepresentation>(entity).IsNull() ||
         !as<StepShape_ShapeDefinitionRepresentation>(entity).IsNull();
}

bool isUnit(const Handle(Standard_Transient) & entity) {
  const std::string type = entity->DynamicType()->Name();
  return type.rfind("StepBasic_", 0) == 0 && type.find("Unit") != std::string::npos;
}

std::string plural(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The entities of a list that are kept, as a list; null if none is.
template <class Array, class Item, class Keep>
Handle(Array) kept(const std::vector<Item>& items, const Keep& keep) {
  std::vector<Item> left;
  for (const Item& item : items) {
    if (keep(item)) left.push_back(item);
  }
  if (left.empty()) return {};
  Handle(Array) list = new Array(1, int(left.size()));
  for (std::size_t i = 0; i < left.size(); ++i) list->SetValue(int(i) + 1, left[i]);
  return list;
}

/// Gives an empty name to what has none.
template <class Entity>
void giveName(const Handle(Entity) & entity) {
  if (!entity.IsNull() && entity->Name().IsNull()) entity->SetName(new TCollection_HAsciiString());
}

class Salvager {
 public:
  Salvager(const Handle(StepData_StepModel) & model, std::string_view text) : model_(model), text_(text) {}

  Salvage run() {
    findDamage();
    if (!result_.fault.empty() || damaged_.empty()) return result_;
    for (int i = 1; i <= model_->NbEntities(); ++i)
      byId_[model_->IdentLabel(model_->Value(i))] = model_->Value(i);
    std::vector<int> sources;
    for (const auto& entry : damaged_) sources.push_back(entry.first);
    spread(sources);
    spread(thinShells());
    if (result_.fault.empty()) tidyRepresentations();
    if (result_.fault.empty()) tell();
    return result_;
  }

 private:
  /// Gives names to the nameless and collects the damaged.
  void findDamage() {
    std::set<int> nameless;
    for (int i = 1; i <= model_->NbEntities(); ++i) {
      const Handle(Standard_Transient) entity = model_->Value(i);
      if (!as<StepShape_Face>(entity).IsNull() && as<StepShape_OrientedFace>(entity).IsNull()) ++faces_;
      const Handle(Interface_Check) check = model_->Check(i, Standard_True);
      if (check.IsNull() || !check->HasFailed()) continue;
      const int id = model_->IdentLabel(entity);
      const std::string fail = check->CFail(1);
      if (isUnit(entity))
        result_.unitDamage = "its unit #" + std::to_string(id) + " is damaged (" + fail + ")";
      if (!isShape(entity)) continue;
      const Handle(StepRepr_RepresentationItem) item = as<StepRepr_RepresentationItem>(entity);
      const Handle(StepRepr_Representation) shapes = as<StepRepr_Representation>(entity);
      // No face hangs on the rest: dimensions and tolerances.
      if (item.IsNull() && shapes.IsNull() && !placesShapes(entity)) continue;
      // The name is read first; a record of the wrong length is not read at all, which is another failure.
      if (fail.find("name)") != std::string::npos && !(item.IsNull() && shapes.IsNull())) {
        giveName(item);
        giveName(shapes);
        nameless.insert(id);
        if (check->NbFails() == 1) continue;
      }
      damaged_.emplace(id, fail);
      if (item.IsNull() && (shapes.IsNull() || shapes->Items().IsNull())) refuse(id);
    }
    if (nameless.empty()) return;
    const bool one = nameless.size() == 1;
    result_.mended.push_back(plural(nameless.size(), "entity has", "entities have") +
                             " no name where STEP asks for one (" + entityList(nameless) + ") and " +
                             (one ? "is" : "are") + " read as unnamed");
  }

  void refuse(int id) {
    if (!result_.fault.empty()) return;
    const auto it = damaged_.find(id);
    result_.fault = "its entity #" + std::to_string(id) + " is damaged" +
                    (it == damaged_.end() ? std::string() : " (" + it->second + ")") +
                    " and its shapes cannot be placed without it; copy or export it again";
  }

  /// Follows from damaged or emptied entities to everything that needs them, as far as the faces.
  void spread(std::vector<int> queue) {
    if (queue.empty()) return;
    if (!references_) references_ = std::make_unique<StepReferences>(text_);
    while (!queue.empty()) {
      const int id = queue.back();
      queue.pop_back();
      const auto found = byId_.find(id);
      if (found == byId_.end() || !lost_.insert(id).second) continue;
      const Handle(Standard_Transient)& entity = found->second;
      if (!as<StepShape_Face>(entity).IsNull()) {
        lostFaces_.insert(id);
        continue;
      }
      const Handle(StepShape_ConnectedFaceSet) shell = as<StepShape_ConnectedFaceSet>(entity);
      const bool listed = !shell.IsNull() && !shell->CfsFaces().IsNull();
      if ((listed && !emptied_.count(id)) || !as<StepRepr_Representation>(entity).IsNull()) {
        lost_.erase(id);  // what is left of its list is used
        continue;
      }
      for (const int user : references_->usersOf(id)) {
        const auto it = byId_.find(user);
        if (it == byId_.end()) continue;
        if (!as<StepRepr_ItemDefinedTransformation>(it->second).IsNull() ||
            !as<StepRepr_RepresentationMap>(it->second).IsNull()) {
          refuse(id);
        } else if (as<StepRepr_Representation>(it->second).IsNull() &&
                   as<StepShape_ShellBasedSurfaceModel>(it->second).IsNull() && isShape(it->second)) {
          queue.push_back(user);
        }
      }
    }
  }

  bool keeps(const Handle(Standard_Transient) & entity) const {
    return !entity.IsNull() && !lost_.count(model_->IdentLabel(entity));
  }

  /// Takes lost faces out of their shells and lost shells out of their models; what has nothing left.
  std::vector<int> thinShells() {
    std::vector<int> empty;
    for (const auto& [id, entity] : byId_) {
      const Handle(StepShape_ConnectedFaceSet) shell = as<StepShape_ConnectedFaceSet>(entity);
      if (shell.IsNull() || shell->DynamicType()->SubType("StepShape_OrientedClosedShell") ||
          shell->DynamicType()->SubType("StepShape_OrientedOpenShell") || shell->CfsFaces().IsNull())
        continue;
      std::vector<Handle(StepShape_Face)> faces;
      for (int i = 1; i <= shell->NbCfsFaces(); ++i) faces.push_back(shell->CfsFacesValue(i));
      const auto left = kept<StepShape_HArray1OfFace>(faces, [&](const auto& f) { return keeps(f); });
      if (left.IsNull()) {
        emptied_.insert(id);
        empty.push_back(id);
      } else {
        shell->SetCfsFaces(left);
      }
    }
    std::set<int> gone(empty.begin(), empty.end());
    for (const auto& [id, entity] : byId_) {
      const Handle(StepShape_ShellBasedSurfaceModel) model = as<StepShape_ShellBasedSurfaceModel>(entity);
      if (model.IsNull() || model->SbsmBoundary().IsNull()) continue;
      std::vector<StepShape_Shell> shells;
      for (int i = 1; i <= model->NbSbsmBoundary(); ++i) shells.push_back(model->SbsmBoundaryValue(i));
      const auto left = kept<StepShape_HArray1OfShell>(shells, [&](const StepShape_Shell& s) {
        return keeps(s.Value()) && !gone.count(model_->IdentLabel(s.Value()));
      });
      if (left.IsNull()) {
        empty.push_back(id);
      } else {
        model->SetSbsmBoundary(left);
      }
    }
    return empty;
  }

  void tidyRepresentations() {
    for (const auto& [id, entity] : byId_) {
      const Handle(StepRepr_Representation) shapes = as<StepRepr_Representation>(entity);
      if (shapes.IsNull() || shapes->Items().IsNull()) continue;
      std::vector<Handle(StepRepr_RepresentationItem)> items;
      for (int i = 1; i <= shapes->NbItems(); ++i) items.push_back(shapes->ItemsValue(i));
      auto left =
          kept<StepRepr_HArray1OfRepresentationItem>(items, [&](const auto& item) { return keeps(item); });
      if (left.IsNull()) {  // a list cannot be empty
        left = new StepRepr_HArray1OfRepresentationItem(1, 1);
        const Handle(StepRepr_RepresentationItem) nothing = new StepRepr_RepresentationItem;
        nothing->Init(new TCollection_HAsciiString());
        left->SetValue(1, nothing);
      }
      shapes->SetItems(left);
    }
  }

  void tell() {
    std::set<int> ids;
    for (const auto& entry : damaged_) ids.insert(entry.first);
    result_.damage = plural(ids.size(), "entity is damaged", "entities are damaged") + " (" +
                     entityList(ids) + ": " + damaged_.begin()->second + ")";
    if (faces_ > 0 && lostFaces_.size() >= std::size_t(faces_))
      result_.fault = result_.damage + ", and no face can be used without; copy or export it again";
  }

  const Handle(StepData_StepModel) & model_;
  std::string_view text_;
  Salvage result_;
  int faces_ = 0;
  std::map<int, std::string> damaged_;  // by number: what is wrong
  std::map<int, Handle(Standard_Transient)> byId_;
  std::unique_ptr<StepReferences> references_;
  std::set<int> lost_, lostFaces_, emptied_;
};

}  // namespace

std::string entityList(const std::set<int>& entities) {
  std::string text;
  std::size_t told = 0;
  for (const int id : entities) {
    if (told == kNamedAtMost) break;
    text += (told++ ? ", #" : "#") + std::to_string(id);
  }
  if (entities.size() > told) text += " and " + std::to_string(entities.size() - told) + " more";
  return text;
}

Salvage salvage(const Handle(StepData_StepModel) & model, std::string_view text) {
  return Salvager(model, text).run();
}

}  // namespace bw::geometry
