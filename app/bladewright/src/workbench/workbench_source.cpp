// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The CAD file that the open design is made from: replaced, read again, looked for, watched.
#include <system_error>

#include "bw/core/files/file_set.h"
#include "workbench/workbench.h"

namespace bw::app {

namespace fs = std::filesystem;

fs::path Workbench::sourceFile() const {
  const Source& source = document_.design()->source();
  if (source.path.empty() || source.path.is_absolute()) return source.path;
  // An embedded source keeps the name that it had; it may lie beside the design.
  return document_.file().empty() ? fs::path() : document_.file().parent_path() / source.path;
}

bool Workbench::sourceMissing() const {
  const Source& source = document_.design()->source();
  std::error_code error;
  return !document_.empty() && !source.surface && source.bytes.empty() &&
         !fs::is_regular_file(source.path, error);
}

bool Workbench::canReload() const {
  std::error_code error;
  return !document_.empty() && fs::is_regular_file(sourceFile(), error);
}

Result<void> Workbench::replaceSource(const fs::path& file, const QString& text) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return refuse(Topic::source, noFile(file));
  Design design = *document_.design();
  const bool embedded = !design.source().bytes.empty();
  const fs::path absolute = fs::absolute(file, error);
  design.source().path = error ? file : absolute;
  design.source().surface.reset();
  design.source().bytes.clear();
  design.source().saved.reset();
  if (embedded) {
    Result<std::string> bytes = readFile(file);
    if (!bytes) return refuse(Topic::source, bytes.error());
    design.source().bytes = std::move(*bytes);
  }
  if (design.source().path == document_.design()->source().path)
    design.source().saved = document_.design()->source().saved;
  outdateSource();
  emit noticesOutdated(Topic::unit);
  judgedSize_.reset();
  // The same file under the same name is no step, but it may hold something else by now.
  if (design.source() == document_.design()->source())
    runner_.evaluate(document_.design());
  else
    document_.edit(std::move(design), text);
  settings_.addRecentFile(file);
  return {};
}

void Workbench::reloadSource() {
  if (!canReload()) return;
  static_cast<void>(replaceSource(sourceFile(), tr("Reload surface")));
}

void Workbench::outdateSource() {
  sourceTold_ = false;
  emit noticesOutdated(Topic::source);
}

void Workbench::followSource() { watch_.watch(document_.empty() ? fs::path() : sourceFile()); }

void Workbench::tellSourceChanged() {
  tell({Severity::warning,
        tr("The CAD file %1 has changed on disk.")
            .arg(QString::fromStdString(sourceFile().filename().string())),
        tr("Reload"), [this] { reloadSource(); }, Topic::source});
}

void Workbench::tellSourceGone() {
  if (!sourceMissing()) return;  // the design holds a copy
  tell({Severity::warning,
        tr("The CAD file %1 is no longer there; the design needs it to be computed again.")
            .arg(QString::fromStdString(sourceFile().string())),
        tr("Locate…"), [this] { emit locateRequested(); }, Topic::source});
}

void Workbench::noteSourceRead() {
  const auto& evaluation = runner_.evaluation();
  if (!evaluation) return;
  // A change of a setting reads a file that has changed, too.
  const bool read = evaluation->source.value && evaluation->source.value != readSource_;
  const Source& source = evaluation->design.source();
  const bool watched = !source.surface && source.bytes.empty() && source.path == watch_.file();
  if (read) {
    readSource_ = evaluation->source.value;
    document_.noteRead(evaluation->design.source().path, evaluation->source.value->content);
    if (watched) outdateSource();
  }
  if (evaluation->sourceFindings.empty() && sourceTold_) outdateSource();
  if (!evaluation->sourceFindings.empty() && !sourceTold_) {
    sourceTold_ = true;
    tell(Topic::source, Severity::warning,
         QString::fromStdString(words::sentence(evaluation->sourceFindings.front(), words::Reader::window)));
  }
  // Last: it tells of a content that is newer still.
  if (read && watched) watch_.accept(evaluation->source.value->content);
}

}  // namespace bw::app
