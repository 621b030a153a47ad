// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <QUndoStack>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/model/recovery.h"

namespace bw::model {

/// What the window works on: an immutable design that edits swap, the file it belongs to, and its undo
/// history. Lives on the interface thread.
class Document : public QObject {
  Q_OBJECT

 public:
  /// The copy stands at the latest so many ms after the first edit that it lacks, plus the time of writing.
  static constexpr int kAutosaveDelay = 3000;

  /// `recoveryFolder` takes the autosaved copy; an empty path switches autosave off.
  explicit Document(const std::filesystem::path& recoveryFolder, QObject* parent = nullptr);
  /// Leaves the autosaved copy as it is: only saving, discarding or another design take it away.
  ~Document() override;

  /// Without marks: those are told by `marks()`.
  const std::shared_ptr<const Design>& design() const { return design_; }
  /// True until a CAD file or a design was opened.
  bool empty() const { return design_->source().empty(); }
  /// The .bladewright file; empty if never saved.
  const std::filesystem::path& file() const { return file_; }
  /// True if edits, or marks of a design that has a file, are not saved.
  bool modified() const;
  /// True if the file holds something else than what was opened from it or saved to it last: somebody else
  /// wrote it. False where it is gone.
  bool changedOnDisk() const;
  /// Name for the title bar: the design file's name, else the design's name.
  QString title() const;
  QUndoStack& undoStack() { return undo_; }

  /// Replaces the design as one undoable step named `text` ("Change stations"). Nothing happens if `after`
  /// equals the present design.
  void edit(Design after, const QString& text, int mergeId = -1);
  /// The same by changing it.
  void editDesign(const QString& text, int mergeId, const std::function<void(Design&)>& change);

  /// What is hidden and locked: saved with the design, and no step of its history.
  const PartMarks& marks() const { return marks_; }
  void setMarks(PartMarks marks);

  /// Starts a design that has no file yet. The undo history is emptied.
  void start(Design design);
  /// Goes on with an autosaved copy that nobody owns (`RecoveryCopy::copy`): the design counts as modified,
  /// the copy becomes this document's own. On failure nothing changes, and the copy stays.
  Result<void> recover(const std::filesystem::path& copy);
  /// Opens a .bladewright file; on failure nothing changes. `version` gets that of the file's form.
  Result<void> open(const std::filesystem::path& file, int* version = nullptr);
  /// Tells which content of a linked source the results were made from: saving records that one rather than
  /// what the file holds by then.
  void noteRead(const std::filesystem::path& source, const Fingerprint& read) { read_ = {source, read}; }
  /// Saves to `file`, atomically; it becomes the document's file. `name`: the design is called so from then
  /// on, in a step of its own. On failure nothing changes, the history included.
  Result<void> saveAs(const std::filesystem::path& file, const std::optional<std::string>& name = {});

  /// Makes the picture that is kept beside the copy; called on the interface thread.
  void setPictureMaker(std::function<QImage()> maker) { pictureMaker_ = std::move(maker); }
  /// Writes the autosaved copy now instead of a few seconds after an edit; done in the background unless
  /// `wait`.
  void autosaveNow(bool wait = false);
  /// Removes the autosaved copy: the person gives the changes up.
  void discardCopy();

 signals:
  /// The design was swapped (edit, undo, redo, open, start).
  void designChanged();
  /// Another design was started or opened: views go back to their beginning.
  void replaced();
  /// Title, file or modified mark changed.
  void titleChanged();
  /// Autosave failed for the first time since it last worked.
  void autosaveFailed(const QString& message);
  /// Autosave works again.
  void autosaveMended();

 private:
  friend class EditDesign;
  void exchange(const std::shared_ptr<const Design>& design);
  void replace(Design design, const std::filesystem::path& file, const std::optional<Fingerprint>& onDisk,
               std::shared_ptr<RecoveryFile> recovery = nullptr);
  void noteAutosave(const QString& problem);
  /// The design with the marks, as files hold it.
  std::shared_ptr<Design> marked() const;
  /// Copies the design a while after the first change that the copy lacks.
  void copySoon();

  std::shared_ptr<const Design> design_;
  PartMarks marks_, savedMarks_;
  std::filesystem::path file_;
  std::optional<Fingerprint> onDisk_;  ///< of file_ when it was opened or saved
  std::optional<std::pair<std::filesystem::path, Fingerprint>> read_;  ///< a source as results know it
  QUndoStack undo_;
  bool recovered_ = false;

  std::shared_ptr<RecoveryFile> recovery_;
  std::function<QImage()> pictureMaker_;
  QThreadPool writer_;  ///< one thread: copies are written in the order of the edits
  QTimer autosaveTimer_;
  bool autosaveFails_ = false;  ///< the last one did
};

}  // namespace bw::model
