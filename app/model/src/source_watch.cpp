// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/source_watch.h"

#include <sys/stat.h>

#include <QString>

namespace bw::model {

namespace {

constexpr int kRest = 300;  // ms without a change: whoever writes is done
constexpr std::uint64_t kLargestRead = std::uint64_t(64) << 20;

}  // namespace

SourceWatch::SourceWatch(QObject* parent) : QObject(parent) {
  settling_.setSingleShot(true);
  settling_.setInterval(kRest);
  connect(&settling_, &QTimer::timeout, this, &SourceWatch::settle);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, &SourceWatch::look);
  connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, &SourceWatch::look);
}

std::optional<SourceWatch::Stamp> SourceWatch::stampOf(const std::filesystem::path& file) {
  struct stat info {};
  if (file.empty() || ::stat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  return Stamp{std::uint64_t(info.st_size), std::uint64_t(info.st_ino),
               std::int64_t(info.st_mtim.tv_sec) * 1'000'000'000 + info.st_mtim.tv_nsec};
}

std::optional<Fingerprint> SourceWatch::content() const {
  const std::optional<Stamp> stamp = stampOf(file_);
  if (!stamp || stamp->size > kLargestRead) return std::nullopt;
  const Result<Fingerprint> read = fingerprintOfFile(file_);
  return read ? std::optional(*read) : std::nullopt;
}

void SourceWatch::watch(const std::filesystem::path& file) {
  if (file == file_) return;
  if (const QStringList all = watcher_.files() + watcher_.directories(); !all.isEmpty())
    watcher_.removePaths(all);
  file_ = file;
  settling_.stop();
  known_ = seen_ = stampOf(file_);
  knownContent_ = content();
  if (file_.empty()) return;
  watcher_.addPath(QString::fromStdString(file_.parent_path().string()));
  follow();
}

void SourceWatch::accept(const Fingerprint& read) {
  settling_.stop();
  known_ = seen_ = stampOf(file_);
  knownContent_ = read;
  const std::optional<Fingerprint> now = content();
  if (known_ && (known_->size != read.size || (now && *now != read))) emit changed();
}

void SourceWatch::follow() {
  // A file that is renamed into the place of another is a new one to the system.
  const QString path = QString::fromStdString(file_.string());
  if (!watcher_.files().contains(path) && stampOf(file_)) watcher_.addPath(path);
}

void SourceWatch::look() {
  if (file_.empty()) return;
  follow();
  const std::optional<Stamp> now = stampOf(file_);
  if (now == seen_ && now == known_) return;
  seen_ = now;
  settling_.start();
}

void SourceWatch::settle() {
  follow();
  const std::optional<Stamp> now = stampOf(file_);
  if (now != seen_) {
    seen_ = now;
    return settling_.start();
  }
  if (now == known_) return;
  const bool wasGone = !known_;
  known_ = now;
  if (!now) return emit gone();
  const std::optional<Fingerprint> content = this->content();
  const bool same = content && content == knownContent_;
  knownContent_ = content;
  if (!same)
    emit changed();
  else if (wasGone)
    emit back();
}

}  // namespace bw::model
