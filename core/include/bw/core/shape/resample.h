// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/shape/designed_surface.h"

namespace bw {

/// The same surface by another number of poles: where its grid is even, through as many points of it as there
/// are poles; poles that were moved beside their places are over them again. The degree falls where there are
/// too few poles for it. With as many poles as before and none moved it is the same (to 1e-9 of its height);
/// more poles hold it ever more closely. Errors: those of `splineOf`, for either number.
Result<PolesSurface> resampled(const PolesSurface& surface, int columns, int rows);

}  // namespace bw
