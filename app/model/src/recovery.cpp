// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/recovery.h"

#include <QString>
#include <QUuid>

#include <system_error>
#include <vector>

#include "bw/core/file_set.h"

namespace bw::model {

namespace fs = std::filesystem;

namespace {

fs::path withSuffix(const fs::path& base, const char* suffix) { return fs::path(base.string() + suffix); }

void removeCopy(const fs::path& base) {
  std::error_code ignored;
  fs::remove(withSuffix(base, ".bladewright"), ignored);
  fs::remove(withSuffix(base, ".origin"), ignored);
}

std::unique_ptr<QLockFile> lockFor(const fs::path& base) {
  auto lock = std::make_unique<QLockFile>(QString::fromStdString(withSuffix(base, ".lock").string()));
  // The owner lives as long as its process, however long the program stays open.
  lock->setStaleLockTime(0);
  return lock;
}

}  // namespace

RecoveryFile::RecoveryFile(const fs::path& folder) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  base_ = folder / QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString();
  lock_ = lockFor(base_);
  lock_->tryLock(0);
}

RecoveryFile::~RecoveryFile() { removeCopy(base_); }

Result<void> RecoveryFile::write(const Design& design, const fs::path& file) {
  if (Result<void> ok = writeFile(withSuffix(base_, ".origin"), file.string()); !ok) return ok;
  return saveDesign(design, withSuffix(base_, ".bladewright"));
}

void RecoveryFile::clear() { removeCopy(base_); }

std::optional<Recovered> takeRecovered(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> copies;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".bladewright") copies.push_back(entry.path());
  for (const fs::path& copy : copies) {
    const fs::path base = fs::path(copy).replace_extension();
    const std::unique_ptr<QLockFile> lock = lockFor(base);
    if (!lock->tryLock(0)) continue;
    Result<Design> design = loadDesign(copy);
    const Result<std::string> origin = readFile(withSuffix(base, ".origin"), 1 << 16);
    removeCopy(base);
    if (design) return Recovered{std::move(*design), origin ? fs::path(*origin) : fs::path()};
  }
  return std::nullopt;
}

}  // namespace bw::model
