// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Designs, surfaces and results as files.
#include <algorithm>
#include <stop_token>
#include <utility>

#include "bw/core/files/file_set.h"
#include "bw/core/text/printable.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/drawn_design.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/result_folder.h"
#include "workbench/workbench.h"

namespace bw::app {

namespace fs = std::filesystem;

namespace {

/// A CAD file up to this size is looked at before it is opened, which takes some 10 ms.
constexpr std::uintmax_t kReadAtOnce = 4'000'000;  // bytes

fs::path absoluteOf(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  return error ? file : absolute;
}

}  // namespace

Error Workbench::noFile(const fs::path& file) {
  const QString text = tr("there is no file %1").arg(QString::fromStdString(file.string()));
  return {ErrorCode::cannotRead, text.toStdString(), file.string()};
}

Result<void> Workbench::openFile(const fs::path& file) {
  if (lowerSuffix(file) == ".bladewright") {
    int version = Design::kVersion;
    if (Result<void> opened = document_.open(file, &version); !opened)
      return refuse(Topic::file, opened.error());
    if (version != Design::kVersion)
      tell(Topic::file, Severity::info,
           QString::fromStdString(words::sentence(
               {Severity::info, EarlierDesign{file.filename().string(), version, Design::kVersion}},
               words::Reader::window)));
    readDrawingOfDesign();
  } else {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return refuse(Topic::file, noFile(file));
    const std::uintmax_t size = fs::file_size(file, error);
    bool inBackground = !error && size > kReadAtOnce;
    if (!inBackground) {
      const Result<std::string> bytes = readFile(file);
      inBackground = bytes && pipeline::holdsCurvesAlone(*bytes);
    }
    if (inBackground) {
      beginReading(file);
      return {};
    }
    startFaces(file);
  }
  settings_.addRecentFile(file);
  return {};
}

void Workbench::startFaces(const fs::path& file) {
  Design design;
  design.name = file.stem().string();
  design.source().path = absoluteOf(file);
  if (Result<Blade> blade = bladePreset(design.blade.name)) design.blade = *blade;
  document_.start(std::move(design));
}

/// A file that is being read.
struct Workbench::Reading {
  fs::path file;
  int opened = 0;                        ///< which design was open when it began
  std::shared_ptr<const Design> before;  ///< that, as it was then
  std::stop_source stop = {};
  std::optional<Drawing> drawing = {};  ///< what was read; nothing where the file has faces
};

void Workbench::beginReading(const fs::path& file) {
  // Whoever opens another file no longer waits for the one before.
  if (reading_) reading_->stop.request_stop();
  reading_ = std::make_shared<Reading>(Reading{file, opened_, document_.design()});
  emit noticesOutdated(Topic::file);
  runner_.submit(
      tr("Reading %1").arg(QString::fromStdString(printable(file.filename().string()))),
      [read = reading_](const pipeline::Evaluation&, const RunContext& context) -> Result<void> {
        const std::stop_callback stopToo(context.stop, [&read] { read->stop.request_stop(); });
        RunContext own = context;
        own.stop = read->stop.get_token();
        const Result<std::string> bytes = readFile(read->file);
        if (!bytes) return tl::unexpected<Error>(bytes.error());
        if (own.stopped()) return stoppedError();
        if (!pipeline::holdsCurvesAlone(*bytes)) return {};
        Result<Drawing> drawing = readDrawing(*bytes, read->file.filename().string(), own);
        if (!drawing) return tl::unexpected<Error>(drawing.error());
        read->drawing = std::move(*drawing);
        return {};
      },
      [this, read = reading_](const Result<void>& done) { endReading(*read, done); },
      model::EvaluationRunner::Needs::nothing);
  tellChanged(Aspect::state);
}

void Workbench::endReading(Reading& read, const Result<void>& done) {
  // Another file took its place, or another design.
  if (reading_.get() != &read) return;
  reading_.reset();
  readingError_ = done ? std::nullopt : std::optional(done.error());
  const QString name = QString::fromStdString(printable(read.file.filename().string()));
  if (!done && done.error().code == ErrorCode::cancelled) {
    tell(Topic::file, Severity::info, tr("The reading of %1 was stopped; it was not opened.").arg(name));
  } else if (!done) {
    tell(Topic::file, done.error());
  } else if (document_.design() != read.before && mayLeave_ && !mayLeave_()) {
    readingError_ = stoppedError().value();
  } else {
    if (read.drawing)
      openDrawing(read);
    else
      startFaces(read.file);
    settings_.addRecentFile(read.file);
  }
  tellChanged(Aspect::state);
  emit readingEnded(!readingError_);
}

void Workbench::openDrawing(Reading& read) {
  const pipeline::DrawnDesign& drawn = read.drawing->made.front();
  const Drawing::Layer layer = read.drawing->taken.front();
  QString told = QString::fromStdString(printable(pipeline::drawnText(drawn, read.file.filename().string())));
  if (!drawn.leftOut.empty())
    told += tr("; left out: %1").arg(QString::fromStdString(printable(drawn.leftOut.front())));
  told = tr("%1. It is a new design, which is not saved yet; lengths were taken in %2.")
             .arg(told, QString::fromStdString(printable(drawn.unit)));
  if (layer)
    told += tr(" The layer “%1” alone was taken, since all together give no surface: %2. Input ▸ Layer takes "
               "another.")
                .arg(QString::fromStdString(printable(*layer)),
                     QString::fromStdString(printable(read.drawing->whyOne)));
  else if (read.drawing->layers.size() > 1)
    told += tr(" All its layers were taken; Input ▸ Layer takes one.");
  read.drawing->path = absoluteOf(read.file);
  Design design = drawn.design;
  design.source().drawing = read.drawing->linkTo(drawn, layer);
  document_.start(std::move(design));
  drawing_ = std::move(read.drawing);
  tell(Topic::file, Severity::info, told);
  // What was written while it was read is told now.
  followSource();
  watch_.accept(drawing_->content);
  // Who heard of the design did not know the drawing yet.
  tellChanged(Aspect::design);
}

void Workbench::takeLayer(const Drawing::Layer& layer) {
  if (!drawing_) return;
  if (const auto now = drawing_->layerOf(design().source().surface); now && *now == layer) return;
  const QString name =
      layer ? tr("Take layer %1").arg(QString::fromStdString(printable(*layer))) : tr("Take all layers");
  const auto made = std::make_shared<std::optional<pipeline::DrawnDesign>>();
  runner_.submit(
      name,
      [made, layer, drawing = *drawing_](const pipeline::Evaluation&,
                                         const RunContext& context) -> Result<void> {
        Result<pipeline::DrawnDesign> design = drawing.make(layer, context);
        if (!design) return tl::unexpected<Error>(design.error());
        *made = std::move(*design);
        return {};
      },
      [this, made, layer, name, opened = opened_, curves = drawing_->curves](const Result<void>& done) {
        if (opened != opened_) return;
        // The file was read again meanwhile: its curves are others.
        if (curves != drawing_->curves) return takeLayer(layer);
        if (!done) {
          if (done.error().code != ErrorCode::cancelled) tell(Topic::file, done.error());
          return tellChanged(Aspect::design);  // the field shows what is there
        }
        const Design changed = drawing_->onto(design(), **made, drawing_->linkTo(**made, layer));
        drawing_->add(layer, **made);
        editDesign(name, [&changed](Design& design) { design = changed; });
        if (design() != changed) return;  // something of it is locked, which is told
        tell(Topic::file, Severity::info,
             QString::fromStdString(printable(pipeline::drawnText(**made, drawing_->file))) +
                 QLatin1Char('.'));
      },
      model::EvaluationRunner::Needs::nothing);
}

Result<void> Workbench::openExample(const std::string& name) {
  Result<Design> design = pipeline::exampleDesign(name);
  if (!design) return refuse(Topic::file, design.error());
  document_.start(std::move(*design));
  return {};
}

Result<void> Workbench::recover(const fs::path& copy) {
  if (Result<void> recovered = document_.recover(copy); !recovered)
    return refuse(Topic::recovery, recovered.error());
  emit noticesOutdated(Topic::recovery);
  tell(Topic::file, Severity::info,
       tr("Unsaved work on “%1” was recovered. It is not saved yet.").arg(document_.title()));
  readDrawingOfDesign();
  return {};
}

bool Workbench::saveTo(const fs::path& file, const std::optional<std::string>& name) {
  if (Result<void> saved = document_.saveAs(file, name); !saved) {
    tell(Topic::file, saved.error());
    return false;
  }
  emit noticesOutdated(Topic::file);
  settings_.addRecentFile(file);
  return true;
}

/// One export on its way: made first, then, if that replaces nothing or may, put in place.
struct Workbench::Export {
  fs::path folder;
  QString name;
  int opened = 0;   ///< which design it is of
  std::string key;  ///< `model::exportKey`
  Source source;
  FileSet files;
  Findings findings;              ///< of the check of the programs
  Findings takenOver;             ///< sections that are other than those on the screen
  std::vector<fs::path> earlier;  ///< in the folder, which this one would replace or remove
  std::size_t removed = 0;
  bool stands = false;
  bool part = false;  ///< of the files or blocks
};

namespace {

/// Files in `folder` that `files` would replace or remove.
std::vector<fs::path> earlierExport(const FileSet& files, const fs::path& folder) {
  std::vector<fs::path> earlier = pipeline::earlierFiles(folder, files);
  std::error_code ignored;
  for (const fs::path& path : files.paths())
    if (fs::exists(folder / path, ignored)) earlier.push_back(path);
  return earlier;
}

/// A name like "out 2" beside `folder` that nothing has yet.
fs::path freeFolder(const fs::path& folder) {
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  std::error_code ignored;
  for (int number = 2;; ++number) {
    const fs::path free = whole.string() + " " + std::to_string(number);
    if (!fs::exists(fs::symlink_status(free, ignored))) return free;
  }
}

Result<void> put(const FileSet& files, const fs::path& folder, const Source& source, std::size_t& removed) {
  const Result<std::vector<fs::path>> gone = pipeline::commitAfresh(
      files, folder, source.bytes.empty() ? std::vector{source.path} : std::vector<fs::path>());
  if (!gone) return tl::unexpected<Error>(gone.error());
  removed = gone->size();
  return {};
}

}  // namespace

void Workbench::write(const fs::path& folder, const QString& name, MakePolicy policy) {
  exporting_ = true;
  exportProblem_.clear();
  const auto made = std::make_shared<Export>();
  made->folder = folder;
  made->name = name;
  made->opened = opened_;
  // What the open design would lose to the one beside its results.
  std::string lost;
  if (pipeline::sameFile(folder / pipeline::kDesignFile, document_.file())) {
    Design stored = design();
    stored.marks = document_.marks();
    lost = pipeline::lostInResults(stored);
  }
  const auto task = [made, lost, policy = std::move(policy)](pipeline::Evaluation evaluation,
                                                             const RunContext& context) -> Result<void> {
    made->key = model::exportKey(evaluation);
    made->source = evaluation.design.source();
    const pipeline::Policy asked = policy(context);
    made->part = asked.wanted != pipeline::Wanted();
    pipeline::Product product = pipeline::produce(std::move(evaluation), made->folder, asked, context);
    if (product.error) return tl::unexpected<Error>(*product.error);
    if (context.stopped()) return stoppedError();
    made->files = std::move(product.files);
    if (!lost.empty() && std::ranges::count(made->files.paths(), fs::path(pipeline::kDesignFile)) > 0)
      return fail(ErrorCode::badInput,
                  tr("%1 in that folder is the open design, which %2; choose another folder")
                      .arg(QString::fromUtf8(pipeline::kDesignFile), QString::fromStdString(lost))
                      .toStdString(),
                  "folder");
    made->findings = product.evaluation.programs;
    // Nothing is left to write where the only program is refused.
    if (made->files.paths().empty() && !made->findings.empty())
      return fail(ErrorCode::badInput, words::sentence(made->findings.front(), words::Reader::window),
                  "programs");
    made->takenOver = product.takenOver();
    made->earlier = earlierExport(made->files, made->folder);
    if (!made->earlier.empty()) return {};
    made->stands = true;
    return put(made->files, made->folder, made->source, made->removed);
  };
  runner_.submit(name, task, [this, made](const Result<void>& done) {
    if (!done || made->stands) return finishExport(*made, done);
    if (made->opened != opened_) return finishExport(*made, stoppedError());
    const fs::path other = freeFolder(made->folder);
    switch (earlierQuestion_ ? earlierQuestion_(made->folder, made->earlier, other) : Earlier::newFolder) {
      case Earlier::replace:
        return commit(made);
      case Earlier::newFolder:
        made->folder = other;
        return commit(made);
      case Earlier::cancel:
        return finishExport(*made, stoppedError());
    }
  });
  tellChanged(Aspect::state);
}

void Workbench::commit(const std::shared_ptr<Export>& made) {
  runner_.submit(
      made->name,
      [made](const pipeline::Evaluation&, const RunContext&) {
        return put(made->files, made->folder, made->source, made->removed);
      },
      [this, made](const Result<void>& done) { finishExport(*made, done); },
      model::EvaluationRunner::Needs::nothing);
}

void Workbench::finishExport(const Export& made, const Result<void>& done) {
  exporting_ = false;
  const bool open = made.opened == opened_;
  if (done) {
    if (open) {
      exported_ = made.key;
      exportedPart_ = made.part;
      exportFolder_ = made.folder;
      exportedFiles_ = writtenFiles(made.files);
      exportFindings_ = made.takenOver;
      exportFindings_.insert(exportFindings_.end(), made.findings.begin(), made.findings.end());
      tellChanged(Aspect::messages);
    }
    tellWritten(made);
    emit exported(QString::fromStdString(made.folder.string()));
  } else if (done.error().code == ErrorCode::cancelled) {
    tell(Topic::written, Severity::info, tr("The export was stopped; nothing was written."));
  } else {
    if (open) exportProblem_ = QString::fromStdString(done.error().message);
    tell(Topic::declined, done.error());
  }
  tellChanged(Aspect::state);
}

void Workbench::tellWritten(const Export& made) {
  for (const Topic earlier : {Topic::written, Topic::declined}) emit noticesOutdated(earlier);
  const std::vector<WrittenFile> files = writtenFiles(made.files);
  std::uintmax_t bytes = 0;
  for (const WrittenFile& file : files) bytes += file.bytes;
  QString written = (files.size() == 1 ? tr("%1 file (%2) written to %3") : tr("%1 files (%2) written to %3"))
                        .arg(files.size())
                        .arg(QString::fromStdString(pipeline::sizeText(bytes)),
                             QString::fromStdString(made.folder.string()));
  if (made.removed > 0)
    written += made.removed == 1 ? tr(" (1 file of an earlier run was removed)")
                                 : tr(" (%1 files of an earlier run were removed)").arg(made.removed);
  if (!made.takenOver.empty())
    return tell(Topic::written, Severity::warning,
                tr("%1, but they are not what the screen shows: %2.")
                    .arg(written, QString::fromStdString(
                                      words::sentence(made.takenOver.front(), words::Reader::window))));
  const Findings& findings = made.findings;
  if (findings.empty()) return tell(Topic::written, Severity::info, written);
  const QString first = QString::fromStdString(words::sentence(findings.front(), words::Reader::window));
  if (findings.front().kind() == FindingKind::program)
    return tell(Topic::declined, findings.front().severity, tr("%1, but %2.").arg(written, first));
  const QString more =
      findings.size() > 1 ? tr(" The messages hold all %1 findings.").arg(findings.size()) : QString();
  tell(Topic::written, Severity::warning,
       tr("%1. The check of the programs warns: %2.%3").arg(written, asSentence(first), more));
}

pipeline::Wanted Workbench::wanted() const {
  pipeline::Wanted wanted;
  for (std::size_t kind = 0; kind < pipeline::kFileKinds; ++kind)
    wanted.kinds[kind] = !leftOut_.contains(QLatin1String(pipeline::kFileKindInfos[kind].word));
  // Ids of blocks that are gone tell nothing.
  const auto left = [this](const StockBlock& block) { return blocksLeftOut_.contains(block.id); };
  if (std::ranges::any_of(design().stock, left))
    for (const StockBlock& block : design().stock)
      if (!left(block)) wanted.blocks.push_back(block.id);
  return wanted;
}

void Workbench::setWanted(pipeline::FileKind kind, bool on) {
  const QString word = pipeline::kFileKindInfos[std::size_t(kind)].word;
  leftOut_.removeAll(word);
  if (!on) leftOut_ << word;
  settings_.setLeftOut(leftOut_);
  tellChanged(Aspect::state);
}

void Workbench::setExportTo(const std::filesystem::path& folder) {
  if (std::exchange(exportTo_, folder) != folder) tellChanged(Aspect::state);
}

void Workbench::setBlockWanted(const std::string& block, bool on) {
  on ? void(blocksLeftOut_.erase(block)) : void(blocksLeftOut_.insert(block));
  tellChanged(Aspect::state);
}

bool Workbench::anyBlockWanted() const {
  return std::ranges::any_of(design().stock,
                             [this](const StockBlock& block) { return !blocksLeftOut_.contains(block.id); });
}

void Workbench::exportAll(const fs::path& folder, std::vector<pipeline::ReportPicture> pictures) {
  write(folder, tr("Writing files"),
        [pictures = std::move(pictures), wanted = wanted()](const RunContext& context) {
          pipeline::Policy policy;
          policy.wanted = wanted;
          policy.reader = words::Reader::window;
          return pipeline::withHandover(
              std::move(policy), [pictures](const pipeline::Evaluation&) { return pictures; }, context);
        });
}

void Workbench::exportPrograms(const fs::path& folder) {
  write(folder, tr("Writing programs"),
        [name = document_.design()->name, wanted = wanted()](const RunContext&) {
          pipeline::Policy policy;
          policy.contents = pipeline::Policy::Contents::programs;
          policy.reader = words::Reader::window;
          policy.programName = name;
          policy.wanted = wanted;
          return policy;
        });
}

}  // namespace bw::app
