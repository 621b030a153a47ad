// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QImage>
#include <QString>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw::model {

class FileLock;

/// What a copy knows of the design's own file.
struct Origin {
  std::filesystem::path file;         ///< where the design was last saved; empty if never
  std::optional<Fingerprint> onDisk;  ///< of that file when it was opened or saved
};

/// The autosaved copy of one running window. It is locked as long as the program runs; a copy without a
/// living owner was left by a crash, by a kill or by the end of the session.
class RecoveryFile {
 public:
  /// Chooses an unused name in `folder`. Nothing is written yet.
  explicit RecoveryFile(const std::filesystem::path& folder);
  /// Takes over a copy that nobody owns: from now on it is this one's. An error if it is gone or another
  /// window works on it.
  static Result<std::shared_ptr<RecoveryFile>> adopt(const std::filesystem::path& copy);
  /// Lets go of the copy, which stays until somebody recovers or discards it.
  ~RecoveryFile();
  RecoveryFile(const RecoveryFile&) = delete;
  RecoveryFile& operator=(const RecoveryFile&) = delete;

  /// Writes the copy, atomically. A `picture` that is not null is
  /// kept beside it; that it cannot be written is no failure of the copy.
  Result<void> write(const Design& design, const Origin& origin, const QImage& picture);
  /// As it was written last; empty before.
  Origin origin() const;
  /// Removes the copy: the design was saved or discarded.
  void clear();

 private:
  RecoveryFile();

  std::filesystem::path base_;  ///< the copy's path without its suffix
  std::unique_ptr<FileLock> lock_;
};

/// A copy without a living owner, as it is listed.
struct RecoveryCopy {
  std::filesystem::path copy;  ///< the file itself, in the folder of the copies
  std::filesystem::path file;  ///< where the design was last saved; empty if never
  QString name;                ///< of the design; empty where the copy cannot be read
  QDateTime time;              ///< of the copy
  std::uintmax_t size = 0;     ///< of the copy, bytes
  QImage picture;              ///< null if there is none
  QString problem;             ///< why the copy cannot be read; empty if it can
};

/// All copies in `folder` that no running program owns, newest first, those that cannot be read too; none is
/// removed. What dead owners left beside them goes: locks without a copy, unfinished files.
std::vector<RecoveryCopy> listRecovery(const std::filesystem::path& folder);

/// Removes a copy that nobody owns, with what belongs to it; the person said so. False if another window
/// works on it.
bool discardRecovery(const std::filesystem::path& copy);

}  // namespace bw::model
