// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/recovery.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QBuffer>
#include <QFileInfo>
#include <QUuid>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "bw/core/files/file_set.h"

namespace bw::model {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCopy = ".bladewright";
constexpr const char* kOrigin = ".origin";  ///< path of the design's own file, a zero byte, its fingerprint
constexpr const char* kPicture = ".png";
constexpr const char* kLock = ".lock";
constexpr std::size_t kLongestOrigin = 1 << 16;
constexpr int kLockTries = 20;
constexpr std::chrono::milliseconds kLockPause{25};
constexpr int kTries = 100;  ///< the holder may remove the file between our opening and our locking it

fs::path withSuffix(const fs::path& base, const char* suffix) { return fs::path(base.string() + suffix); }

fs::path baseOf(const fs::path& copy) { return fs::path(copy).replace_extension(); }

void removeCopy(const fs::path& base) {
  std::error_code ignored;
  for (const char* suffix : {kCopy, kOrigin, kPicture}) fs::remove(withSuffix(base, suffix), ignored);
}

/// The name up to its first dot: what the files of one copy share, unfinished ones included.
fs::path stemOf(const fs::path& file) {
  const std::string name = file.filename().string();
  return file.parent_path() / name.substr(0, name.find('.'));
}

Origin readOrigin(const fs::path& base) {
  const Result<std::string> text = readFile(withSuffix(base, kOrigin), kLongestOrigin);
  if (!text) return {};
  const std::size_t end = std::min(text->find('\0'), text->size());
  return {text->substr(0, end),
          fingerprintFrom(std::string_view(*text).substr(std::min(end + 1, text->size())))};
}

RecoveryCopy readCopy(const fs::path& copy) {
  RecoveryCopy listed;
  listed.copy = copy;
  const QFileInfo info(QString::fromStdString(copy.string()));
  listed.time = info.lastModified();
  listed.size = std::uintmax_t(info.size());
  listed.file = readOrigin(baseOf(copy)).file;
  listed.picture.load(QString::fromStdString(withSuffix(baseOf(copy), kPicture).string()));
  if (const Result<Design> design = loadDesign(copy))
    listed.name = QString::fromStdString(design->name);
  else
    listed.problem = QString::fromStdString(design.error().message);
  return listed;
}

}  // namespace

/// An exclusive lock that the system keeps for as long as this object, and at most as long as the process,
/// lives. Neither a crash nor a process number that was given out again leaves it standing.
class FileLock {
 public:
  FileLock() = default;
  ~FileLock() { release(); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  enum class Outcome {
    held,        ///< now; also where the file system knows no locks
    busy,        ///< another holds it
    unavailable  ///< the file cannot be made or opened
  };

  /// Takes the lock of `file`, which is made if missing.
  Outcome take(const fs::path& file);
  bool held() const { return descriptor_ >= 0; }
  /// Lets go and removes the file.
  void remove() {
    if (descriptor_ >= 0) ::unlink(file_.c_str());
    release();
  }
  /// Lets go; the file stays.
  void release() {
    if (const int descriptor = std::exchange(descriptor_, -1); descriptor >= 0) ::close(descriptor);
  }

 private:
  fs::path file_;
  int descriptor_ = -1;
};

FileLock::Outcome FileLock::take(const fs::path& file) {
  release();
  for (int i = 0; i < kTries; ++i) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0) return Outcome::unavailable;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(descriptor);
      return Outcome::busy;
    }
    // Whoever held it before may have removed the file meanwhile: then this is the lock of nothing.
    struct stat mine {
    }, named{};
    if (::fstat(descriptor, &mine) == 0 && ::stat(file.c_str(), &named) == 0 && mine.st_ino == named.st_ino &&
        mine.st_dev == named.st_dev) {
      file_ = file;
      descriptor_ = descriptor;
      return Outcome::held;
    }
    ::close(descriptor);
  }
  return Outcome::busy;
}

RecoveryFile::RecoveryFile() : lock_(std::make_unique<FileLock>()) {}

RecoveryFile::RecoveryFile(const fs::path& folder) : RecoveryFile() {
  base_ = folder / QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString();
}

RecoveryFile::~RecoveryFile() = default;

Result<std::shared_ptr<RecoveryFile>> RecoveryFile::adopt(const fs::path& copy) {
  std::shared_ptr<RecoveryFile> file(new RecoveryFile);
  file->base_ = baseOf(copy);
  std::error_code error;
  const FileLock::Outcome outcome = file->lock_->take(withSuffix(file->base_, kLock));
  if (!fs::is_regular_file(copy, error)) {
    file->lock_->remove();
    return fail(ErrorCode::cannotRead,
                "the copy " + copy.string() + " is gone: it was recovered or discarded", copy.string());
  }
  if (outcome == FileLock::Outcome::busy)
    return fail(ErrorCode::cannotRead, "another window works on " + copy.string() + "; go on there",
                copy.string());
  return file;
}

Result<void> RecoveryFile::write(const Design& design, const Origin& origin, const QImage& picture) {
  std::error_code ignored;
  fs::create_directories(base_.parent_path(), ignored);
  // Who lists the copies holds each lock for a moment.
  for (int i = 0; i < kLockTries && !lock_->held(); ++i) {
    if (lock_->take(withSuffix(base_, kLock)) != FileLock::Outcome::busy) break;
    std::this_thread::sleep_for(kLockPause);
  }
  std::string known = origin.file.string();
  if (origin.onDisk) known += '\0' + fingerprintText(*origin.onDisk);
  if (Result<void> ok = writeFile(withSuffix(base_, kOrigin), known); !ok) return ok;
  if (Result<void> ok = saveDesign(design, withSuffix(base_, kCopy)); !ok) return ok;
  if (!picture.isNull()) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    if (buffer.open(QIODevice::WriteOnly) && picture.save(&buffer, "PNG"))
      static_cast<void>(writeFile(withSuffix(base_, kPicture), bytes.toStdString()));
  }
  return {};
}

Origin RecoveryFile::origin() const { return readOrigin(base_); }

void RecoveryFile::clear() {
  removeCopy(base_);
  lock_->remove();
}

std::vector<RecoveryCopy> listRecovery(const fs::path& folder) {
  std::error_code error;
  std::set<fs::path> bases;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file(error)) bases.insert(stemOf(it->path()));
  std::vector<RecoveryCopy> copies;
  for (const fs::path& base : bases) {
    FileLock lock;
    if (lock.take(withSuffix(base, kLock)) == FileLock::Outcome::busy) continue;
    const fs::path copy = withSuffix(base, kCopy);
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      const bool unfinished = it->path().filename().string().find(".part-") != std::string::npos;
      if (unfinished && stemOf(it->path()) == base) fs::remove(it->path(), error);
    }
    if (fs::exists(copy, error))
      copies.push_back(readCopy(copy));
    else
      removeCopy(base);
    lock.remove();
  }
  std::sort(copies.begin(), copies.end(), [](const RecoveryCopy& a, const RecoveryCopy& b) {
    return a.time != b.time ? a.time > b.time : a.copy < b.copy;
  });
  return copies;
}

bool discardRecovery(const fs::path& copy) {
  FileLock lock;
  if (lock.take(withSuffix(baseOf(copy), kLock)) == FileLock::Outcome::busy) return false;
  removeCopy(baseOf(copy));
  lock.remove();
  std::error_code error;
  return !fs::exists(copy, error);
}

}  // namespace bw::model
