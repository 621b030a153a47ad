// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/part.h"

#include <BOPTools_AlgoTools.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepGProp_Domain.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepGProp_Vinert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <IntTools_Context.hxx>
#include <Message_ProgressIndicator.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeReal.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/text/number_text.h"
#include "knife.h"
#include "occt.h"
#include "part_impl.h"
#include "shape_points.h"
#include "tolerances.h"

namespace bw::geometry {

TopoDS_Shape compoundOf(const std::vector<TopoDS_Shape>& solids) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& solid : solids) builder.Add(all, solid);
  return all;
}

namespace {

constexpr double kFuzzy = 1e-5;     // mm: what lies nearer is the same for the booleans
constexpr double kVolume = 1e-5;    // relative, of one face's share of a volume; 1e-9 is what comes of it
constexpr double kBalance = 1e-5;   // of the block: what pieces may lack of what they were cut from
constexpr double kRounding = 1e-9;  // of the block: a cut that takes no more takes nothing
constexpr double kSpacings = 64;    // in the block's diagonal, between points that are looked at
constexpr double kSag = 1.0 / 16;   // of that spacing, of chords along curved edges and faces
constexpr std::size_t kMostLooked = 1000;   // points of what is left that are held against each cut
constexpr double kAside = 0.01;             // mm that a knife gives way where it seems to part films alone
constexpr double kFilm = 0.1;               // mm, of mean thickness: what no blade leaves of the foam
constexpr double kReach = 1e-3;             // mm: what reaches so far over a cut is no rounding
constexpr double kLoosest = 0.05;           // mm, likewise where edges lie off their faces
constexpr double kGrazing = 0.05;           // sine of the angle to a surface below which a point is beside it
constexpr double kDeflection = 1.0 / 2000;  // of the block's diagonal, for display

std::string pointText(const Eigen::Vector3d& p) {
  return "(" + fixedText(p.x(), 1) + ", " + fixedText(p.y(), 1) + ", " + fixedText(p.z(), 1) + ") mm";
}

/// Lets booleans be stopped.
class StopAsked : public Message_ProgressIndicator {
 public:
  explicit StopAsked(const RunContext& context) : context_(context) {}
  Standard_Boolean UserBreak() override { return context_.stopped(); }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

 private:
  const RunContext& context_;
};

struct Piece {
  TopoDS_Shape solid;
  double volume = 0;  ///< mm³
  /// It exists in numbers alone: where a blade runs along a face of the block, what lies between both is
  /// parted from the rest. It is melted with what is taken away.
  bool film = false;
};

/// Volumes of solids, as sums over their faces of what lies between each and one point. What parts two solids
/// bounds both, and is integrated once.
class Volumes {
 public:
  explicit Volumes(const gp_Pnt& from) : from_(from) {}

  double of(const TopoDS_Shape& solid) {
    double volume = 0;
    for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
      const TopAbs_Orientation side = it.Current().Orientation();
      if (side != TopAbs_FORWARD && side != TopAbs_REVERSED) continue;
      if (!known_.IsBound(it.Current())) known_.Bind(it.Current(), behind(TopoDS::Face(it.Current())));
      volume += (side == TopAbs_FORWARD ? 1 : -1) * known_.Find(it.Current());
    }
    return volume;
  }

 private:
  double behind(const TopoDS_Face& either) const {
    const TopoDS_Face face = TopoDS::Face(either.Oriented(TopAbs_FORWARD));
    BRepGProp_Face surface(face);
    BRepGProp_Domain domain(face);
    BRepGProp_Vinert share;
    share.SetLocation(from_);
    share.Perform(surface, domain, kVolume);
    return share.Mass();
  }

  gp_Pnt from_;
  TopTools_DataMapOfShapeReal known_;
};

bool isFilm(const TopoDS_Shape& solid, double volume) {
  constexpr double kClearly = 4;  // times as thick, with as many points of each face as its degree asks for
  GProp_GProps rough, properties;
  BRepGProp::SurfaceProperties(solid, rough);
  if (2 * volume > kClearly * kFilm * rough.Mass()) return false;
  BRepGProp::SurfaceProperties(solid, properties, kVolume);
  return 2 * volume < kFilm * properties.Mass();
}

double sum(const std::vector<Piece>& pieces) {
  double volume = 0;
  for (const Piece& piece : pieces) volume += piece.volume;
  return volume;
}

std::vector<TopoDS_Shape> solidsOf(const std::vector<Piece>& pieces) {
  std::vector<TopoDS_Shape> solids;
  for (const Piece& piece : pieces) solids.push_back(piece.solid);
  return solids;
}

/// What a knife makes of solids, and the faces that it leaves there.
struct Split {
  std::vector<TopoDS_Shape> solids;
  TopTools_MapOfShape faces;
};

Result<Split> split(const std::vector<Piece>& pieces, const Knife& knife, const RunContext& context) {
  TopTools_ListOfShape arguments, tools;
  for (const Piece& piece : pieces) arguments.Append(piece.solid);
  tools.Append(knife.face());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.SetFuzzyValue(kFuzzy);
  splitter.SetNonDestructive(Standard_True);
  const Handle(Message_ProgressIndicator) stop = new StopAsked(context);
  splitter.Build(stop->Start());
  if (context.stopped()) return stoppedError();
  if (splitter.HasErrors()) {
    std::ostringstream why;
    splitter.DumpErrors(why);
    std::string text = why.str();
    std::ranges::replace(text, '\n', ' ');
    return fail(ErrorCode::noSolution,
                "cut \"" + knife.id() + "\" could not be made through what is left of the block (" + text +
                    "); move it by a little",
                knife.id());
  }
  Split result;
  for (TopExp_Explorer it(splitter.Shape(), TopAbs_SOLID); it.More(); it.Next())
    result.solids.push_back(it.Current());
  for (const TopoDS_Shape& face : splitter.Modified(knife.face())) result.faces.Add(face);
  result.faces.Add(knife.face());
  return result;
}

/// Where a face ends inside of the solid without bounding it, if one does.
std::optional<Eigen::Vector3d> endInside(const TopoDS_Shape& solid) {
  TopExp_Explorer it(solid, TopAbs_FACE);
  while (it.More() &&
         (it.Current().Orientation() == TopAbs_FORWARD || it.Current().Orientation() == TopAbs_REVERSED))
    it.Next();
  if (!it.More()) return {};
  const TopoDS_Shape loose = it.Current();
  TopTools_IndexedDataMapOfShapeListOfShape facesOf;
  TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, facesOf);
  for (TopExp_Explorer edge(loose, TopAbs_EDGE); edge.More(); edge.Next()) {
    if (facesOf.FindFromKey(edge.Current()).Extent() != 1) continue;
    const BRepAdaptor_Curve curve(TopoDS::Edge(edge.Current()));
    return toEigen(curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter())));
  }
  return toEigen(BRep_Tool::Pnt(TopoDS::Vertex(TopExp_Explorer(loose, TopAbs_VERTEX).Current())));
}

tl::unexpected<Error> bothSides(const Knife& knife, const Eigen::Vector3d& p) {
  return fail(ErrorCode::noSolution,
              "cut \"" + knife.id() +
                  "\" does not part what is left of the block, which lies on both sides of it, "
                  "such as at " +
                  pointText(p) + "; extend its surface past the foam all around, or move it by a little",
              knife.id());
}

/// Whether a piece stays that the knife's faces bound: they tell on which side of them foam is. Empty if none
/// does.
Result<std::optional<bool>> keptByFaces(const TopoDS_Shape& solid, const Split& cut, const Knife& knife) {
  std::optional<bool> kept;
  const Handle(IntTools_Context) tools = new IntTools_Context;
  for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
    if (!cut.faces.Contains(it.Current())) continue;
    int error = 0;
    // Faces look out of their solid, so that foam lies behind them.
    const bool against =
        BOPTools_AlgoTools::IsSplitToReverse(TopoDS::Face(it.Current()), knife.face(), tools, &error);
    if (error != 0) continue;
    const bool stays = against == knife.forward();
    if (kept && *kept != stays) {
      GProp_GProps properties;
      BRepGProp::SurfaceProperties(it.Current(), properties);
      return bothSides(knife, toEigen(properties.CentreOfMass()));
    }
    kept = stays;
  }
  return kept;
}

/// Whether a piece stays that the knife passes by: by the side on which its points lie.
Result<bool> keptByPlace(const TopoDS_Shape& solid, double sag, const Knife& knife) {
  double above = 0, below = 0, sines = 0;
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> points = pointsOn(solid, sag);
  SurfaceSampler::Foot last;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Result<Knife::Place> place = knife.place(points[i], i > 0 ? &last : nullptr);
    if (!place) return tl::unexpected(place.error());
    last = place->foot;
    if (place->distance > kReach) sines += place->height / place->distance / double(points.size());
    if (place->beside()) continue;
    if (place->height > above) high = points[i];
    above = std::max(above, place->height);
    below = std::max(below, -place->height);
  }
  if (above > kReach && below > kReach) return bothSides(knife, high);
  if (above > kReach || below > kReach) return above > below;
  if (!(std::abs(sines) > kGrazing) && !points.empty())
    return fail(ErrorCode::badInput,
                "cut \"" + knife.id() + "\" runs beside a piece of what is left of the block, near " +
                    pointText(points.front()) +
                    ", and it is not decided on which side of it that is; extend its surface past the foam "
                    "all around",
                knife.id());
  return sines > 0;
}

/// What a knife leaves of pieces, and takes.
struct Halves {
  std::vector<Piece> kept, removed;
};

/// What knives leave of pieces.
struct Left {
  std::vector<Piece> pieces;
  std::size_t solids = 0;  ///< that the last of them made, on both sides, without films
  bool doubted = false;    ///< it made films, and parted nothing besides
};

/// The knife of a cut that lies `towards` mm to the side that stays.
Result<Knife> movedKnife(const PartCut& cut, double towards) {
  SplineSurface moved = *cut.surface;
  for (Eigen::Vector3d& pole : moved.poles) pole += towards * cut.kept.normalized();
  return Knife::make({cut.id, &moved, cut.kept});
}

/// A block that is cut, cut by cut.
class Carving {
 public:
  explicit Carving(const Box& block)
      : block_(block), volume_(block.size.prod()), spacing_(block.size.norm() / kSpacings) {
    const Frame& frame = block.frame;
    const gp_Ax2 axes(toPoint(frame.origin), gp_Dir(frame.normal.x(), frame.normal.y(), frame.normal.z()),
                      gp_Dir(frame.x.x(), frame.x.y(), frame.x.z()));
    whole_ = {{BRepPrimAPI_MakeBox(axes, block.size.x(), block.size.y(), block.size.z()).Solid(), volume_}};
    left_ = whole_;
  }

  const std::vector<Piece>& left() const { return left_; }

  Result<PartStep> make(const PartCut& cut, const RunContext& context) {
    Result<Knife> knife = Knife::make(cut);
    if (!knife) return tl::unexpected(knife.error());
    knives_.push_back(std::move(*knife));
    Result<Left> made = leftBy(context);
    const bool missed = !made && made.error().code == ErrorCode::noSolution;
    if (missed || (made && made->doubted)) {
      // Where a knife runs along a face of the block by microns there are films, and OpenCASCADE may miss
      // that it parts the rest; where it touches a face or another cut, it may miss where they meet.
      for (const double towards : {kAside, -kAside}) {
        Result<Knife> moved = movedKnife(cut, towards);
        if (!moved) continue;
        std::swap(knives_.back(), *moved);
        Result<Left> other = leftBy(context);
        if (other ? missed || other->solids > made->solids : other.error().code == ErrorCode::cancelled) {
          made = std::move(other);
          break;
        }
        std::swap(knives_.back(), *moved);
      }
    }
    if (!made) return tl::unexpected(made.error());
    std::vector<Piece>* kept = &made->pieces;
    PartStep step;
    step.removed = sum(left_) - sum(*kept);
    if (!(step.removed >= -kBalance * volume_))
      return fail(ErrorCode::noSolution,
                  "cut \"" + knives_.back().id() + "\" leaves " + shortText(sum(*kept), 9) +
                      " mm³, where only " + shortText(sum(left_), 9) +
                      " mm³ were before it; move it by a little",
                  knives_.back().id(), sum(*kept), sum(left_));
    if (step.removed <= kRounding * volume_) {
      step.removed = 0;
    } else {
      const Result<double> thickest = farthestBehind(knives_.back());
      if (!thickest) return tl::unexpected(thickest.error());
      step.thickest = *thickest;
    }
    left_ = std::move(*kept);
    return step;
  }

 private:
  /// Orders of all knives up to `last` but the one in which they came.
  static std::vector<std::vector<std::size_t>> otherOrders(std::size_t last) {
    if (last == 0) return {};
    std::vector<std::size_t> first = {last}, back = {last}, second = {last - 1, last};
    for (std::size_t i = 0; i < last; ++i) {
      first.push_back(i);
      back.push_back(last - 1 - i);
      if (i + 1 < last) second.push_back(i);
    }
    if (last == 1) return {first};
    return {first, back, second};
  }

  /// What all knives leave.
  Result<Left> leftBy(const RunContext& context) const {
    const std::size_t last = knives_.size() - 1;
    Result<Left> kept = cut(left_, {last}, context);
    if (!kept && kept.error().code == ErrorCode::noSolution) {
      // What is left does not depend on the order, but which intersections OpenCASCADE misses does.
      for (const std::vector<std::size_t>& order : otherOrders(last)) {
        Result<Left> other = cut(whole_, order, context);
        if (!other && other.error().code != ErrorCode::cancelled) continue;
        kept = std::move(other);
        break;
      }
    }
    return kept;
  }

  /// What the knives of `order` leave of `pieces`, checked against all knives.
  Result<Left> cut(std::vector<Piece> pieces, const std::vector<std::size_t>& order,
                   const RunContext& context) const {
    Left left;
    for (const std::size_t i : order) {
      if (pieces.empty()) break;
      Result<Halves> halves = halve(pieces, knives_[i], context);
      if (!halves) return tl::unexpected(halves.error());
      if (i + 1 == knives_.size()) {
        const auto films = std::size_t(std::ranges::count_if(halves->kept, &Piece::film) +
                                       std::ranges::count_if(halves->removed, &Piece::film));
        left.solids = halves->kept.size() + halves->removed.size() - films;
        left.doubted = films > 0 && left.solids <= pieces.size();
      }
      pieces = std::move(halves->kept);
    }
    if (auto ok = checkSides(pieces); !ok) return tl::unexpected(ok.error());
    std::erase_if(pieces, [](const Piece& piece) { return piece.film; });
    std::ranges::stable_sort(pieces, std::greater(), &Piece::volume);
    left.pieces = std::move(pieces);
    return left;
  }

  Result<Halves> halve(const std::vector<Piece>& pieces, const Knife& knife,
                       const RunContext& context) const {
    const Result<Split> cut = split(pieces, knife, context);
    if (!cut) return tl::unexpected(cut.error());
    Halves halves;
    // From beside the block no face is looked at edge on.
    Volumes volumes(toPoint(2 * block_.frame.origin - block_.center()));
    for (const TopoDS_Shape& solid : cut->solids) {
      if (auto ok = checkEnds(solid, knife); !ok) return tl::unexpected(ok.error());
      Result<std::optional<bool>> stays = keptByFaces(solid, *cut, knife);
      if (!stays) return tl::unexpected(stays.error());
      if (!*stays) {
        const Result<bool> passed = keptByPlace(solid, kSag * spacing_, knife);
        if (!passed) return tl::unexpected(passed.error());
        *stays = *passed;
      }
      const double volume = volumes.of(solid);
      (**stays ? halves.kept : halves.removed).push_back({solid, volume, isFilm(solid, volume)});
    }
    if (auto ok = checkVolumes(pieces, halves, knife); !ok) return tl::unexpected(ok.error());
    return halves;
  }

  /// That the surface does not end inside of a solid that it was to part.
  static Result<void> checkEnds(const TopoDS_Shape& solid, const Knife& knife) {
    const std::optional<Eigen::Vector3d> end = endInside(solid);
    if (!end) return {};
    const Result<Knife::Place> place = knife.place(*end, nullptr);
    if (!place) return tl::unexpected(place.error());
    if (!knife.atBorder(*place)) return bothSides(knife, *end);
    return fail(ErrorCode::badInput,
                "cut \"" + knife.id() + "\" ends inside of what is left of the block, at " + pointText(*end) +
                    "; extend its surface until it comes out of the foam all around",
                knife.id());
  }

  Result<void> checkVolumes(const std::vector<Piece>& pieces, const Halves& halves,
                            const Knife& knife) const {
    const double before = sum(pieces), after = sum(halves.kept) + sum(halves.removed);
    if (!(std::abs(after - before) <= kBalance * volume_))
      return fail(ErrorCode::noSolution,
                  "the pieces that cut \"" + knife.id() + "\" makes have " + shortText(after, 9) +
                      " mm³, where " + shortText(before, 9) + " mm³ were before it; move it by a little",
                  knife.id(), after, before);
    for (const Piece& piece : halves.kept)
      if (!(piece.volume > 0) || !BRepCheck_Analyzer(piece.solid).IsValid())
        return fail(ErrorCode::noSolution,
                    "cut \"" + knife.id() + "\" leaves a piece of " + shortText(piece.volume, 6) +
                        " mm³ that is no valid solid; move it by a little",
                    knife.id(), piece.volume);
    return {};
  }

  bool inBlock(const Eigen::Vector3d& p) const {
    const Eigen::Array3d local = block_.frame.toLocal(p).array();
    return (local >= -kReach).all() && (local <= block_.size.array() + kReach).all();
  }

  /// That what is left lies in the block and on the kept side of all knives: where an intersection was
  /// missed, a face reaches over another one, and volumes do not show it.
  Result<void> checkSides(const std::vector<Piece>& pieces) const {
    if (pieces.empty()) return {};
    const Knife& last = knives_.back();
    const std::vector<Eigen::Vector3d> points = pointsOn(compoundOf(solidsOf(pieces)), kSag * spacing_);
    const std::size_t step = points.size() / kMostLooked + 1;
    for (std::size_t i = 0; i < points.size(); i += step)
      if (!inBlock(points[i]))
        return fail(ErrorCode::noSolution,
                    "what cut \"" + last.id() + "\" leaves of the block reaches out of it at " +
                        pointText(points[i]) +
                        ", where OpenCASCADE misses an intersection; move it by a little",
                    last.id());
    // Where two surfaces bend apart, edges lie off them by as much as they say.
    double reach = kReach;
    for (const Piece& piece : pieces)
      reach = std::max(reach, BRep_Tool::MaxTolerance(piece.solid, TopAbs_EDGE));
    reach = std::min(reach, kLoosest);
    for (const Knife& knife : knives_) {
      SurfaceSampler::Foot foot;
      for (std::size_t i = 0; i < points.size(); i += step) {
        const Result<Knife::Place> place = knife.place(points[i], i > 0 ? &foot : nullptr);
        if (!place) return tl::unexpected(place.error());
        foot = place->foot;
        if (place->height < -reach && !place->beside() && inBlock(foot.point))
          return bothSides(last, points[i]);
      }
    }
    return {};
  }

  /// How far what is left before a knife reaches behind it, mm.
  Result<double> farthestBehind(const Knife& knife) const {
    double most = 0;
    SurfaceSampler::Foot foot;
    bool first = true;
    for (const Eigen::Vector3d& p : pointsOver(compoundOf(solidsOf(left_)), kSag * spacing_, spacing_)) {
      const Result<Knife::Place> place = knife.place(p, first ? nullptr : &foot);
      if (!place) return tl::unexpected(place.error());
      foot = place->foot;
      first = false;
      if (place->height < 0) most = std::max(most, place->distance);
    }
    return most;
  }

  Box block_;
  double volume_;   ///< of the block, mm³
  double spacing_;  ///< mm between points that are looked at
  std::vector<Knife> knives_;
  std::vector<Piece> whole_, left_;
};

Result<void> checkBlock(const Box& block) {
  const Frame& frame = block.frame;
  if (!frame.origin.allFinite() || !block.size.allFinite() || !(block.size.minCoeff() > kSlack))
    return fail(ErrorCode::badInput,
                "the block measures " + shortText(block.size.x()) + " × " + shortText(block.size.y()) +
                    " × " + shortText(block.size.z()) + " mm; each must be a number above zero",
                "block", block.size.minCoeff(), 0.0);
  BW_CHECK((frame.x.cross(frame.y) - frame.normal).norm() < kParallel &&
           std::abs(frame.x.norm() - 1) < kParallel);
  return {};
}

}  // namespace

Part::Part(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Result<Part> Part::make(const Box& block, std::span<const PartCut> cuts, const RunContext& context) {
  if (auto ok = checkBlock(block); !ok) return tl::unexpected(ok.error());
  silenceOcct();
  return guarded(ErrorCode::internal, "what is left of the block cannot be computed", [&]() -> Result<Part> {
    Carving carving(block);
    auto impl = std::make_shared<Impl>();
    for (const PartCut& cut : cuts) {
      if (context.stopped()) return stoppedError();
      context.report(double(impl->steps.size()) / double(cuts.size()), "part");
      const Result<PartStep> step = carving.make(cut, context);
      if (!step) return tl::unexpected(step.error());
      impl->steps.push_back(*step);
    }
    impl->block = block;
    impl->solids = solidsOf(carving.left());
    impl->volume = sum(carving.left());
    return Part(impl);
  });
}

const std::vector<PartStep>& Part::steps() const { return impl_->steps; }
double Part::blockVolume() const { return impl_->block.size.prod(); }
double Part::volume() const { return impl_->volume; }
int Part::pieces() const { return int(impl_->solids.size()); }

Result<TriangleMesh> Part::mesh(double deflection) const {
  return guarded(ErrorCode::internal, "cannot make triangles of the part", [&]() -> Result<TriangleMesh> {
    const double within = deflection > 0 ? deflection : kDeflection * impl_->block.size.norm();
    return trianglesOf(compoundOf(impl_->solids), within);
  });
}

}  // namespace bw::geometry
