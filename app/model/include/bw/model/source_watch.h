// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "bw/core/files/fingerprint.h"

namespace bw::model {

/// Tells when a file gets another content, once that rests: whether it is written in place or another file
/// is renamed over it. A file that is only touched is not told, up to 64 MB; a larger one is not read for
/// that.
class SourceWatch : public QObject {
  Q_OBJECT

 public:
  explicit SourceWatch(QObject* parent = nullptr);

  /// Watches `file` from now on, and takes its present content as known; empty: nothing. Reads files of up
  /// to 64 MB whole, once.
  void watch(const std::filesystem::path& file);
  const std::filesystem::path& file() const { return file_; }
  /// Takes a content as known: it was read. Tells at once if the file has another one by now.
  void accept(const Fingerprint& read);
  /// Looks now. Network drives tell of no changes by themselves: call it when the person comes back.
  void look();
  /// False while a change is waited out.
  bool resting() const { return !settling_.isActive(); }

 signals:
  void changed();
  void gone();
  /// It was gone, and is there again as it was.
  void back();

 private:
  /// What the file system knows of a file.
  struct Stamp {
    std::uint64_t size = 0, inode = 0;
    std::int64_t time = 0;
    bool operator==(const Stamp&) const = default;
  };

  static std::optional<Stamp> stampOf(const std::filesystem::path& file);
  std::optional<Fingerprint> content() const;
  void follow();
  void settle();

  QFileSystemWatcher watcher_;
  QTimer settling_;
  std::filesystem::path file_;
  std::optional<Stamp> known_, seen_;
  std::optional<Fingerprint> knownContent_;
};

}  // namespace bw::model
