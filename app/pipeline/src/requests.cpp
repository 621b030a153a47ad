// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/requests.h"

#include <system_error>

namespace bw::pipeline {

Requests::Requests(const Job& job)
    : read{job.unit, job.sewingTolerance()},
      face(job.face),
      setup{job.block, job.direction},
      sections{job.stations, job.spacing, job.sections},
      fit{job.blade,      job.fitLength, job.fitEndpoints, job.fitTangents,
          job.maxPeriods, job.tolerance, job.clearance},
      check{job.tolerance, job.clearance, job.cuttingSpeed},
      motion{job.cuttingSpeed, job.lead},
      programs{job.programs, job.cell} {}

FileStamp FileStamp::of(const std::filesystem::path& file) {
  std::error_code error;
  FileStamp stamp{file};
  const auto size = std::filesystem::file_size(file, error);
  if (error) return stamp;
  const auto changed = std::filesystem::last_write_time(file, error);
  if (error) return stamp;
  stamp.size = size;
  stamp.changed = std::int64_t(changed.time_since_epoch().count());
  return stamp;
}

}  // namespace bw::pipeline
