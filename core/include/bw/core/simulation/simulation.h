// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/blade/blade.h"
#include "bw/core/heavy/heavy_blade.h"
#include "bw/core/motion/motion.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/plane_family.h"

namespace bw {

/// The blade at a moment of a motion that is run.
struct SimulatedBlade {
  double time = 0;          ///< s
  std::size_t instant = 0;  ///< of the motion, the last one that was passed
  Frame frame;              ///< of the plane in which it bends, in the file's frame
  HeavyBlade blade;
  double margin = 1;            ///< of stability
  bool atInstant = false;       ///< not between two
  double outOfPlaneMargin = 1;  ///< of a round one against leaving its plane; 1 for a flat one
  bool crossesItself = false;
};

/// Where a blade cannot go on as its ends are moved.
struct Halt {
  enum class Why {
    tears,     ///< its grips are farther apart than it is long
    offPlane,  ///< its ends are not in one plane (within 0.5 mm and 0.5°)
    lost       ///< no shape at rest is found, or the one there cannot be followed
  };
  Why why = Why::lost;
  double time = 0;                                  ///< s
  std::size_t instant = 0;                          ///< of the motion, the last one that was passed
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the middle between the grips, in the file's frame
  double apart = 0;                                 ///< mm, of the grips
  double off = 0, twist = 0;                        ///< mm and rad, of its ends from one plane
  std::string reason = {};                          ///< of `lost`: what the search says
};
/// "tears", "off-plane", "lost".
const char* haltName(Halt::Why why);

/// Where and when something is seen on a run.
struct RunSpot {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the file's frame
  double time = 0;                                  ///< s
  std::size_t instant = 0;                          ///< of the motion, the last one that was passed
};

/// How fast points of the blade go, mm/s, and where they do.
struct RunSpeeds {
  double min = 0, max = 0;
  RunSpot minAt = {}, maxAt = {};
};

/// Moments of a run, one after the other, and the one among them where it is worst: places in
/// `Simulation::blades`.
struct RunStretch {
  std::size_t first = 0, last = 0, worst = 0;
};

/// What a motion does to the blade, found from the poses of its ends alone.
struct Simulation {
  std::vector<SimulatedBlade> blades;  ///< in the order of time
  std::optional<Halt> halt;            ///< none if it runs to the end: the blades are those before it
  bool decided = true;  ///< at the first instant one shape alone is at rest, or clearly the lowest
  struct Snap {
    double time = 0;  ///< s
    std::size_t instant = 0;
  };
  std::vector<Snap> snaps;
  /// mm, how far a blade may lie from the straight line that was taken for it, its shape not being found.
  double straightWithin = 0;
  double marginMin = 1;
  double minRadius = 0;                  ///< mm; 0 for a blade that stays straight
  std::optional<RunSpeeds> speeds = {};  ///< of the whole blade; none before it has moved

  /// Where the blade crosses itself, and where a round one does not rest in its plane. All of it as one
  /// stretch where they are many.
  std::vector<RunStretch> crossings() const;
  std::vector<RunStretch> twists() const;
  std::vector<RunStretch> loose(double margin) const;  ///< of less stability

  /// The surface that the whole blade sweeps: a row a moment, points at equal arc length, in the file's
  /// frame.
  SurfaceGrid swept(int places = 101) const;
};

/// Runs a motion: between two instants the ends go straight and turn evenly (slerp), as a controller moves
/// them. The blade begins in the lowest shape at rest between the grips of the first instant and stays on its
/// branch, with its weight (N/mm of a length, in the file's frame); where that ends it snaps into the lowest
/// shape there is. What no blade can do ends it: `Simulation::halt`. Errors: badInput for other than two
/// ends; `cancelled`. Some 0.1 s for 100 instants.
[[nodiscard]] Result<Simulation> simulate(const Motion& motion, const Blade& blade,
                                          const Eigen::Vector3d& weight, const RunContext& context);

/// How far what a motion cuts lies from what was designed. Means are over the area that is cut.
struct SimulatedSurface {
  double toDesignMax = 0, toDesignMean = 0;  ///< mm, from the surface shown, in the planes of the blade
  double toDesignAtTargets = 0;              ///< mm, the largest at the instants of the motion
  double toTargetMax = 0, toTargetMean = 0;  ///< mm, of the same places, from the target
  RunSpot toDesignAt = {}, toTargetAt = {};  ///< where it is farthest from the one and from the other
  std::optional<RunSpeeds> speeds = {};      ///< of the points that cut; none where they do not go on
  double covered = 0;                        ///< 0…1, of the travel of the surface shown
};

/// Of the places of the blade that lie over the surface shown, whose rows lie in `planes`, and in the block,
/// or nearest to what of the target lies there; of a run that halts what comes before. `cut`, unless it is
/// null, gets what is cut: a row a moment from where the blade comes over the surface to where it leaves it,
/// at equal arc length, with the fields "deviation" (mm from the target, signed where it has sides) and
/// "from_shown" (mm), beside the block not a number. Errors: those of the sampler; `cancelled`.
[[nodiscard]] Result<SimulatedSurface> compare(const Simulation& simulation, const SurfaceGrid& shown,
                                               const Box& block, const PlaneFamily& planes,
                                               const SurfaceSampler& target, const RunContext& context,
                                               SurfaceGrid* cut = nullptr);

}  // namespace bw
