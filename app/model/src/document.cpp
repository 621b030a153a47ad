// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/document.h"

#include "bw/core/job.h"
#include "bw/model/edit_design.h"

namespace bw::model {

namespace fs = std::filesystem;

namespace {

constexpr int kAutosaveDelay = 3000;  // ms after the last edit

bool sameDesign(const Design& a, const Design& b) {
  return a.name == b.name && a.source == b.source && jobToJson(a.job) == jobToJson(b.job);
}

}  // namespace

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

bool Document::modified() const { return recovered_ || !undo_.isClean(); }

QString Document::title() const {
  return QString::fromStdString(file_.empty() ? design_->name : file_.stem().string());
}

void Document::edit(Design after, const QString& text, int mergeId) {
  if (sameDesign(*design_, after)) return;
  undo_.push(new EditDesign(*this, design_, std::make_shared<const Design>(std::move(after)), text, mergeId));
}

void Document::editJob(const QString& text, int mergeId, const std::function<void(Job&)>& change) {
  Design after = *design_;
  change(after.job);
  edit(std::move(after), text, mergeId);
}

void Document::exchange(const std::shared_ptr<const Design>& design) {
  design_ = design;
  if (recovery_) autosaveTimer_.start();
  emit designChanged();
}

void Document::replace(Design design, const fs::path& file) {
  design_ = std::make_shared<const Design>(std::move(design));
  file_ = file;
  recovered_ = false;
  forgetAutosave();
  undo_.clear();
  emit replaced();
  emit designChanged();
  emit titleChanged();
}

void Document::start(Design design) { replace(std::move(design), {}); }

void Document::recover(Design design, const fs::path& file) {
  replace(std::move(design), file);
  recovered_ = true;
  autosaveNow();
  emit titleChanged();
}

Result<void> Document::open(const fs::path& file) {
  Result<Design> design = loadDesign(file);
  if (!design) return tl::unexpected<Error>(design.error());
  replace(std::move(*design), file);
  return {};
}

Result<void> Document::saveAs(const fs::path& file) {
  if (Result<void> saved = saveDesign(*design_, file); !saved) return saved;
  file_ = file;
  recovered_ = false;
  forgetAutosave();
  undo_.setClean();
  emit titleChanged();
  return {};
}

void Document::forgetAutosave() {
  autosaveTimer_.stop();
  writer_.waitForDone();
  if (recovery_) recovery_->clear();
}

void Document::autosaveNow(bool wait) {
  autosaveTimer_.stop();
  if (!recovery_ || empty() || !modified()) return;
  writer_.start([this, recovery = recovery_, design = design_, file = file_] {
    const Result<void> written = recovery->write(*design, file);
    const QString problem = written ? QString() : QString::fromStdString(written.error().message);
    QMetaObject::invokeMethod(
        this, [this, problem] { noteAutosave(problem); }, Qt::QueuedConnection);
  });
  if (wait) writer_.waitForDone();
}

void Document::noteAutosave(const QString& problem) {
  const bool isNew = !problem.isEmpty() && autosaveProblem_.isEmpty();
  autosaveProblem_ = problem;
  if (isNew) emit autosaveFailed(problem);
}

}  // namespace bw::model
