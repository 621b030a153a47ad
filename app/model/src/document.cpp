// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/document.h"

#include <QUndoCommand>

#include <utility>

#include "bw/core/design/design.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/surface_curves.h"
#include "bw/model/history.h"

namespace bw::model {

namespace fs = std::filesystem;

namespace {

fs::path absolutePath(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = file.empty() ? file : fs::absolute(file, error);
  return error ? file : absolute;
}

std::optional<Fingerprint> fingerprintNow(const fs::path& file) {
  const Result<Fingerprint> now = fingerprintOfFile(file);
  return now ? std::optional(*now) : std::nullopt;
}

}  // namespace

/// The one undoable edit: exchanges the design of a document. Edits with the same `mergeId` ≥ 0 that follow
/// each other (one drag of a slider) become one step.
class EditDesign : public QUndoCommand {
 public:
  EditDesign(Document& document, Design after, const QString& text, int mergeId)
      : QUndoCommand(text),
        document_(document),
        before_(document.design()),
        after_(std::make_shared<const Design>(std::move(after))),
        mergeId_(mergeId) {}

  void undo() override { document_.exchange(before_); }
  void redo() override { document_.exchange(after_); }
  int id() const override { return mergeId_; }
  const std::shared_ptr<const Design>& before() const { return before_; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* next = static_cast<const EditDesign*>(other);
    if (mergeId_ < 0 || next->mergeId_ != mergeId_) return false;
    after_ = next->after_;
    // A pull that ends where it began is none.
    setObsolete(*after_ == *before_);
    return true;
  }

 private:
  Document& document_;
  std::shared_ptr<const Design> before_, after_;
  int mergeId_;
};

std::shared_ptr<const Design> designBefore(Document& document) {
  const Design now = withoutVersions(*document.design());
  const QUndoStack& history = document.undoStack();
  for (int i = history.index() - 1; i >= 0; --i) {
    const auto* step = dynamic_cast<const EditDesign*>(history.command(i));
    if (step && withoutVersions(*step->before()) != now) return step->before();
  }
  return nullptr;
}

Document::Document(const fs::path& recoveryFolder, QObject* parent)
    : QObject(parent), design_(std::make_shared<const Design>()) {
  if (!recoveryFolder.empty()) recovery_ = std::make_shared<RecoveryFile>(recoveryFolder);
  writer_.setMaxThreadCount(1);
  autosaveTimer_.setSingleShot(true);
  autosaveTimer_.setInterval(kAutosaveDelay);
  connect(&autosaveTimer_, &QTimer::timeout, this, [this] { autosaveNow(); });
  connect(&undo_, &QUndoStack::cleanChanged, this, &Document::titleChanged);
}

Document::~Document() { writer_.waitForDone(); }

bool Document::modified() const {
  return recovered_ || !undo_.isClean() || (!file_.empty() && marks_ != savedMarks_);
}

bool Document::changedOnDisk() const {
  if (file_.empty()) return false;
  const std::optional<Fingerprint> now = fingerprintNow(file_);
  return now && now != onDisk_;
}

QString Document::title() const {
  return QString::fromStdString(file_.empty() ? design_->name : file_.stem().string());
}

void Document::edit(Design after, const QString& text, int mergeId) {
  followNames(*design_, after);
  if (*design_ == after) return;
  undo_.push(new EditDesign(*this, std::move(after), text, mergeId));
}

void Document::editDesign(const QString& text, int mergeId, const std::function<void(Design&)>& change) {
  Design after = *design_;
  change(after);
  edit(std::move(after), text, mergeId);
}

void Document::exchange(const std::shared_ptr<const Design>& design) {
  // A step of the history does not know what was saved since.
  std::shared_ptr<const Design> next = design;
  if (const Source& now = design_->source(), &then = design->source();
      now.path == then.path && now.bytes.empty() && then.bytes.empty() && now.saved != then.saved) {
    auto known = std::make_shared<Design>(*design);
    known->source().saved = now.saved;
    next = std::move(known);
  }
  marks_ = followed(marks_, *design_, *next);
  design_ = std::move(next);
  copySoon();
  emit designChanged();
}

void Document::copySoon() {
  // A clock that is running goes on: edits that never pause are copied too.
  if (recovery_ && !autosaveTimer_.isActive()) autosaveTimer_.start();
}

void Document::setMarks(PartMarks marks) {
  if (marks == marks_) return;
  marks_ = std::move(marks);
  copySoon();
  emit titleChanged();
}

std::shared_ptr<Design> Document::marked() const {
  auto stored = std::make_shared<Design>(*design_);
  stored->marks = marks_;
  return stored;
}

void Document::replace(Design design, const fs::path& file, const std::optional<Fingerprint>& onDisk,
                       std::shared_ptr<RecoveryFile> recovery) {
  discardCopy();
  if (recovery) recovery_ = std::move(recovery);
  marks_ = savedMarks_ = std::exchange(design.marks, {});
  design_ = std::make_shared<const Design>(std::move(design));
  file_ = absolutePath(file);
  onDisk_ = onDisk;
  read_.reset();
  recovered_ = false;
  undo_.clear();
  emit replaced();
  emit designChanged();
  emit titleChanged();
}

void Document::start(Design design) { replace(std::move(design), {}, std::nullopt); }

Result<void> Document::recover(const fs::path& copy) {
  Result<std::shared_ptr<RecoveryFile>> recovery = RecoveryFile::adopt(copy);
  if (!recovery) return tl::unexpected<Error>(recovery.error());
  Result<Design> design = loadDesign(copy);
  if (!design) {
    Error error = design.error();
    error.message += "; the copy stays as it is: " + copy.string();
    return tl::unexpected<Error>(std::move(error));
  }
  const Origin origin = (*recovery)->origin();
  replace(std::move(*design), origin.file, origin.onDisk, std::move(*recovery));
  recovered_ = true;
  emit titleChanged();
  return {};
}

Result<void> Document::open(const fs::path& file, int* version) {
  // Looked at first: what another writes while it is read counts as a change.
  const std::optional<Fingerprint> onDisk = fingerprintNow(file);
  Result<Design> design = loadDesign(absolutePath(file), version);
  if (!design) return tl::unexpected<Error>(design.error());
  replace(std::move(*design), file, onDisk);
  return {};
}

Result<void> Document::saveAs(const fs::path& file, const std::optional<std::string>& name) {
  const std::shared_ptr<Design> stored = marked();
  if (name) stored->name = *name;
  const Source& source = stored->source();
  if (read_ && read_->first == source.path && source.bytes.empty() && !source.surface)
    stored->source().saved = read_->second;
  else
    noteSources(*stored);
  if (Result<void> saved = saveDesign(*stored, file); !saved) return saved;
  editDesign(tr("Name the design"), -1, [&stored](Design& design) { design.name = stored->name; });
  const bool noted = stored->source().saved != design_->source().saved;
  stored->marks = {};
  if (noted) design_ = stored;
  savedMarks_ = marks_;
  file_ = absolutePath(file);
  onDisk_ = fingerprintNow(file);
  recovered_ = false;
  discardCopy();
  undo_.setClean();
  if (noted) emit designChanged();
  emit titleChanged();
  return {};
}

void Document::discardCopy() {
  autosaveTimer_.stop();
  writer_.waitForDone();
  if (recovery_) recovery_->clear();
}

void Document::autosaveNow(bool wait) {
  autosaveTimer_.stop();
  if (!recovery_ || empty()) return;
  if (!modified()) return discardCopy();  // undone: the design's own file has it all
  if (!wait && writer_.activeThreadCount() > 0) return autosaveTimer_.start();  // a slow disk: one at a time
  const QImage picture = pictureMaker_ ? pictureMaker_() : QImage();
  writer_.start([this, recovery = recovery_, design = marked(), origin = Origin{file_, onDisk_}, picture] {
    const Result<void> written = recovery->write(*design, origin, picture);
    const QString problem = written ? QString() : QString::fromStdString(written.error().message);
    QMetaObject::invokeMethod(
        this, [this, problem] { noteAutosave(problem); }, Qt::QueuedConnection);
  });
  if (wait) writer_.waitForDone();
}

void Document::noteAutosave(const QString& problem) {
  const bool failed = !problem.isEmpty(), failedBefore = std::exchange(autosaveFails_, failed);
  // Space may come back without another edit.
  if (failed && modified() && !autosaveTimer_.isActive()) autosaveTimer_.start();
  if (failed && !failedBefore) emit autosaveFailed(problem);
  if (!failed && failedBefore) emit autosaveMended();
}

}  // namespace bw::model
