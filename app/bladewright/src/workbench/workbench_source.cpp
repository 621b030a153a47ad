// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The CAD file that the open design is made from: replaced, read again, looked for, watched.
#include <system_error>
#include <utility>

#include "bw/core/files/file_set.h"
#include "bw/core/text/printable.h"
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

fs::path Workbench::watchedFile() const {
  if (document_.empty()) return {};
  return fromDrawing() ? drawing_->path : sourceFile();
}

bool Workbench::canReload() const {
  std::error_code error;
  return !document_.empty() && fs::is_regular_file(watchedFile(), error);
}

Result<void> Workbench::replaceSource(const fs::path& file, const QString& text) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return refuse(Topic::source, noFile(file));
  Design design = *document_.design();
  const bool embedded = !design.source().bytes.empty();
  const fs::path absolute = fs::absolute(file, error);
  design.source().path = error ? file : absolute;
  design.source().surface.reset();
  design.source().drawing.reset();
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
  if (fromDrawing()) return readDrawingAgain(true);
  static_cast<void>(replaceSource(sourceFile(), tr("Reload surface")));
}

void Workbench::outdateSource() {
  sourceTold_ = sourceChanged_ = false;
  emit noticesOutdated(Topic::source);
}

void Workbench::followSource() { watch_.watch(watchedFile()); }

void Workbench::setFollowsFile(bool on) {
  settings_.setFollowsFile(on);
  if (followsFile() && sourceChanged_) onSourceChanged();
  tellChanged(Aspect::state);
}

void Workbench::onSourceChanged() {
  // A copy in the design is what the person keeps, and a surface that a hand has changed is theirs.
  const Source& source = design().source();
  const bool theirs = fromDrawing() ? !drawing_->layerOf(source.surface) : !source.bytes.empty();
  if (!followsFile() || theirs) return tellSourceChanged();
  fromDrawing() ? readDrawingAgain(false) : readLinkedAgain();
}

void Workbench::readLinkedAgain() {
  const Source source = design().source();
  const auto read = std::make_shared<pipeline::Stage<pipeline::SourceRequest, pipeline::CadSource>>();
  runner_.submit(
      tr("Reading %1").arg(QString::fromStdString(printable(source.path.filename().string()))),
      [read, now = document_.design()](const pipeline::Evaluation&,
                                       const RunContext& context) -> Result<void> {
        auto stage = pipeline::readFirstSource(*now, context);
        if (!stage) return tl::unexpected<Error>(stage.error());
        *read = std::move(*stage);
        return {};
      },
      [this, source, read, reading = ++sourceReadings_](const Result<void>& done) {
        // Another design, another file, or the next change of it took its place.
        const Source& now = design().source();
        if (reading != sourceReadings_ || now.path != source.path || now.surface || !now.bytes.empty())
          return;
        if (!done) return tellUnreadable(done.error(), [this] { readLinkedAgain(); });
        judgedSize_.reset();
        emit noticesOutdated(Topic::unit);
        runner_.provide(std::move(*read));
        runner_.evaluate(document_.design());
      },
      model::EvaluationRunner::Needs::nothing);
}

void Workbench::readDrawingAgain(bool asked) {
  const auto now = drawing_->layerOf(design().source().surface);
  const Drawing::Layer layer = now ? *now : drawing_->chosen;
  const auto next = std::make_shared<std::optional<Drawing>>();
  runner_.submit(
      tr("Reading %1").arg(QString::fromStdString(printable(drawing_->file))),
      [next, layer, path = drawing_->path, file = drawing_->file](const pipeline::Evaluation&,
                                                                  const RunContext& context) -> Result<void> {
        const Result<std::string> bytes = readFile(path);
        if (!bytes) return tl::unexpected<Error>(bytes.error());
        Result<Drawing> drawing = readDrawing(*bytes, file, layer, context);
        if (!drawing) return tl::unexpected<Error>(drawing.error());
        *next = std::move(*drawing);
        return {};
      },
      [this, next, layer, asked, path = drawing_->path,
       reading = ++sourceReadings_](const Result<void>& done) {
        if (reading != sourceReadings_ || !fromDrawing() || drawing_->path != path) return;
        if (!done)
          return tellUnreadable(done.error(), [this, asked] {
            if (fromDrawing()) readDrawingAgain(asked);
          });
        endDrawing(std::move(**next), layer, asked);
      },
      model::EvaluationRunner::Needs::nothing);
}

void Workbench::endDrawing(Drawing next, const Drawing::Layer& layer, bool asked) {
  // A hand may have been there meanwhile.
  const auto now = drawing_->layerOf(design().source().surface);
  if (!asked && !now) return tellSourceChanged();
  if (now && *now != layer) return readDrawingAgain(asked);
  const pipeline::DrawnDesign made = next.made.front();
  next.path = drawing_->path;
  Design changed = drawing_->onto(design(), made, next.linkTo(made, layer));
  // That the file has another content is no step.
  const std::optional<DrawingLink> link = std::exchange(changed.source().drawing, design().source().drawing);
  const bool other = changed != design();
  if (other) changed.source().drawing = link;
  next.earlier = drawing_->all();
  const Fingerprint content = next.content;
  const Drawing before = std::exchange(*drawing_, std::move(next));
  if (other)
    editDesign(tr("Read %1 again").arg(QString::fromStdString(printable(before.file))),
               [&changed](Design& design) { design = changed; });
  if (design() != changed) {
    // Something of it is locked, which is told.
    *drawing_ = before;
    return;
  }
  outdateSource();
  tellReadAgain(other ? tr(" It is a step that undo takes back.") : tr(" Its surface is as it was."));
  watch_.accept(content);
  // Who heard of the design did not know the drawing yet.
  tellChanged(Aspect::design);
}

void Workbench::readDrawingOfDesign() {
  const Source& source = design().source();
  if (!source.drawing || !source.surface) return;
  const DrawingLink link = *source.drawing;
  const auto next = std::make_shared<std::optional<Drawing>>();
  const std::string name = link.path.filename().string();
  runner_.submit(
      tr("Reading %1").arg(QString::fromStdString(printable(name))),
      [next, link, name](const pipeline::Evaluation&, const RunContext& context) -> Result<void> {
        const Result<std::string> bytes = readFile(link.path);
        if (!bytes) return tl::unexpected<Error>(bytes.error());
        Result<Drawing> drawing = readDrawing(*bytes, name, link.layer, context);
        if (!drawing) return tl::unexpected<Error>(drawing.error());
        *next = std::move(*drawing);
        return {};
      },
      [this, next, link, opened = opened_, reading = ++sourceReadings_](const Result<void>& done) {
        if (opened == opened_ && reading == sourceReadings_) endDrawingOfDesign(link, std::move(*next), done);
      },
      model::EvaluationRunner::Needs::nothing);
}

void Workbench::endDrawingOfDesign(const DrawingLink& link, std::optional<Drawing> next,
                                   const Result<void>& done) {
  const Source& source = design().source();
  if (!source.drawing || !source.surface || source.drawing->path != link.path) return;
  // As it was when the surface was made of it.
  Drawing before;
  before.file = link.path.filename().string();
  before.path = link.path;
  before.content = link.read;
  if (isAsDrawn(link, *source.surface)) before.add(link.layer, pipeline::madeBefore(link, *source.surface));
  before.chosen = link.layer;
  before.earlier = {pipeline::madeBefore(link, *source.surface)};
  const bool same = next && next->content == link.read;
  if (next) {
    before.curves = next->curves;
    before.layers = next->layers;
  }
  drawing_ = std::move(before);
  followSource();
  std::error_code error;
  if (!done && !fs::is_regular_file(link.path, error))
    tellSourceGone();
  else if (!done)
    tellUnreadable(done.error(), [this] { readDrawingAgain(true); });
  else if (same)
    watch_.accept(link.read);
  else if (followsFile() && drawing_->layerOf(source.surface))
    endDrawing(std::move(*next), link.layer, false);
  else
    tellSourceChanged();
  tellChanged(Aspect::design);
}

void Workbench::tellReadAgain(const QString& more) {
  readAgainAt_ = QTime::currentTime();
  tell(Topic::source, Severity::info,
       tr("The file %1 has changed on disk and was read again at %2; all settings stay.%3")
           .arg(QString::fromStdString(printable(watch_.file().filename().string())),
                readAgainAt_.toString(QStringLiteral("HH:mm:ss")), more));
}

void Workbench::tellUnreadable(const Error& error, const std::function<void()>& again) {
  if (error.code == ErrorCode::cancelled) return tellSourceChanged();
  sourceChanged_ = true;
  tell({Severity::warning,
        tr("The file %1 has changed on disk and cannot be used as it is now: %2. What was read of it before "
           "stays; it "
           "is "
           "read again when it is saved next.")
            .arg(QString::fromStdString(printable(watch_.file().filename().string())),
                 QString::fromStdString(printable(error.message))),
        tr("Try again"), again, Topic::source});
}

void Workbench::tellSourceChanged() {
  sourceChanged_ = true;
  const QString name = QString::fromStdString(watch_.file().filename().string());
  tell(
      {Severity::warning,
       fromDrawing() && !drawing_->layerOf(design().source().surface)
           ? tr("The drawing %1 has changed on disk. The surface made of it was changed here since: a reload "
                "takes its place.")
                 .arg(name)
           : tr("The CAD file %1 has changed on disk.").arg(name),
       tr("Reload"), [this] { reloadSource(); }, Topic::source});
}

void Workbench::tellSourceGone() {
  if (fromDrawing())
    return tell(Topic::source, Severity::info,
                tr("The drawing %1 is no longer there; the design holds its surface and goes on without it.")
                    .arg(QString::fromStdString(watch_.file().string())));
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
  const bool again = read && watched && followsFile() && readSource_ && readPath_ == source.path &&
                     readSource_->content != evaluation->source.value->content;
  if (read) {
    readSource_ = evaluation->source.value;
    readPath_ = source.path;
    document_.noteRead(evaluation->design.source().path, evaluation->source.value->content);
    if (watched) outdateSource();
  }
  if (evaluation->sourceFindings.empty() && sourceTold_) outdateSource();
  if (again) {
    // That it is another than when the design was saved stands among the messages.
    sourceTold_ = !evaluation->sourceFindings.empty();
    tellReadAgain();
  }
  if (!evaluation->sourceFindings.empty() && !sourceTold_) {
    sourceTold_ = true;
    tell(Topic::source, Severity::warning,
         QString::fromStdString(words::sentence(evaluation->sourceFindings.front(), words::Reader::window)));
  }
  // Last: it tells of a content that is newer still.
  if (read && watched) watch_.accept(evaluation->source.value->content);
}

}  // namespace bw::app
