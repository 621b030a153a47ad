// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/requests.h"

#include <sys/stat.h>

#include <algorithm>

#include "bw/core/base/units.h"
#include "bw/core/shape/turning_planes.h"

namespace bw::pipeline {

namespace {

/// So many times the diagonal of a block is a blade of open length at most, as far as its surface is
/// followed.
constexpr double kLongestOpen = 2;

/// mm beyond the floor that a block is made to go on below its stations: what lies between them may come
/// lower.
constexpr double kReserve = 5;

bool isGiven(const Design& design, const Cut& cut) {
  const auto block = std::ranges::find(design.stock, cut.block, &StockBlock::id);
  return block != design.stock.end() && block->placement;
}

/// Of a block that is made around several surfaces no face is known that it lies on.
std::optional<double> floorOf(const Design& design, const Cut& cut) {
  if (!isGiven(design, cut) && !roomBelow(design, cut)) return {};
  return design.process.floor;
}

}  // namespace

std::optional<double> roomBelow(const Design& design, const Cut& cut) {
  const auto beside = [&cut](const Cut& other) { return other.block == cut.block && other.id != cut.id; };
  if (isGiven(design, cut) || std::ranges::any_of(design.cuts, beside)) return {};
  return design.process.floor + kReserve;
}

Blade bladeOf(const Design& design, const Cut& cut) {
  Blade blade = design.blade;
  if (!cut.length) return blade;
  blade.length = *cut.length;
  blade.autoLength = false;
  return blade;
}

std::optional<TurningPlanes> turningOf(const Design& design, const Cut& cut) {
  const std::optional<DesignedSurface>& surface = design.sourceOf(cut).surface;
  return surface ? planesOf(*surface) : std::nullopt;
}

FitRequest fitRequest(const Design& design, const Cut& cut, const Box& lies, bool joined) {
  const Process& p = design.process;
  FitRequest request{bladeOf(design, cut), p.fitLength, p.fitEndpoints, p.fitTangents,
                     p.maxPeriods,         p.tolerance, p.clearance};
  if (joined) request.fitEndpoints = request.fitTangents = true;
  if (!joined) request.extend = p.extend;
  request.margin = p.margin;
  if (request.extend == Extension::none) request.barrier = kLeastBarrier;
  request.blade.autoLength = false;
  if (p.weight)
    request.weight =
        -design.blade.weight() * (p.up ? upAs(lies, cut.pose, p.up->normalized()) : lies.frame.normal);
  return request;
}

double reachBeyond(const FitRequest& fit, const Blade& blade, const Box& lies) {
  if (fit.extend != Extension::surface) return 0;
  return 0.5 * (blade.autoLength ? std::min(Blade::kLongest, kLongestOpen * lies.size.norm()) : blade.length);
}

CheckRequest checkRequest(const Design& design, const Cut& cut) {
  const Process& p = design.process;
  CheckRequest request{p.tolerance, p.clearance, p.cuttingSpeed,
                       p.margin,    p.gripError, fromDegrees(p.gripAngle)};
  request.floor = floorOf(design, cut);
  return request;
}

CheckRequest trialCheckRequest(const Design& design, const Cut& cut) {
  CheckRequest request = checkRequest(design, cut);
  if (!isGiven(design, cut)) request.floor.reset();
  return request;
}

Kerf kerfOf(const Design& design, const Cut& cut, const Box& lies) {
  const Process& p = design.process;
  Kerf kerf;
  kerf.width = p.kerfTable.empty() ? p.kerf : kerfAt(p.kerfTable, p.cuttingSpeed);
  // One width at any speed is a width.
  const auto other = [&](const KerfAt& entry) { return entry.width != kerf.width; };
  if (std::ranges::any_of(p.kerfTable, other)) kerf.table = p.kerfTable;
  kerf.back = cut.offset;
  // Where there is none, no stage hangs on how the block lies.
  if (kerf == Kerf()) return kerf;
  kerf.kept = keptWay(lies, cut.keep);
  return kerf;
}

LengthRequest lengthRequest(const Design& design, const Cut& cut, const Box& lies, bool joined) {
  LengthRequest request{fitRequest(design, cut, lies, joined), trialCheckRequest(design, cut),
                        entryExitRequest(design, cut), followRequest(design)};
  request.ends.floor = request.check.floor;
  request.fit.blade.length = Blade().length;
  return request;
}

JointRequest jointRequest(const Design& design) {
  // mm: a grid tells its gaps. Blocks of a list (those of a wall with two moulds, or with a cut of its own)
  // had some between them, too, and nobody joins across more.
  constexpr double kApart = 50;
  return {design.process.jointGap, fromDegrees(design.process.jointKink),
          design.grid ? design.grid->widestGap() : kApart};
}

WayRequest wayRequest(const Design& design) {
  return {design.process.tolerance, design.process.clearance, design.process.motionTolerance};
}

FollowRequest followRequest(const Design& design) {
  return {design.process.motionTolerance, design.process.cuttingSpeed};
}

EntryExitRequest entryExitRequest(const Design& design, const Cut& cut) {
  // Between its poses such a way comes lower, too.
  const std::optional<double> room = roomBelow(design, cut);
  return {design.process.margin, design.process.lead, room ? room : floorOf(design, cut)};
}

MotionRequest motionRequest(const Design& design, const Cut& cut) {
  return {design.process.cuttingSpeed, design.process.lead, design.process.motionTolerance,
          floorOf(design, cut)};
}

FileStamp FileStamp::of(const std::filesystem::path& file) {
  FileStamp stamp{file};
  struct stat now;
  if (stat(file.c_str(), &now) != 0) return stamp;
  stamp.size = std::uintmax_t(now.st_size);
  // Not the time of its contents, which whoever writes may set back.
  constexpr std::int64_t kSecond = 1'000'000'000;
  stamp.changed = kSecond * now.st_ctim.tv_sec + now.st_ctim.tv_nsec;
  return stamp;
}

}  // namespace bw::pipeline
