// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QUndoCommand>

#include <memory>

#include "bw/core/design/design.h"

namespace bw::model {

class Document;

/// The one undoable edit: exchanges the design of a document. Edits with the same `mergeId` ≥ 0 that follow
/// each other (one drag of a slider) become one step.
class EditDesign : public QUndoCommand {
 public:
  EditDesign(Document& document, std::shared_ptr<const Design> before, std::shared_ptr<const Design> after,
             const QString& text, int mergeId);

  void undo() override;
  void redo() override;
  int id() const override { return mergeId_; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& document_;
  std::shared_ptr<const Design> before_, after_;
  int mergeId_;
};

}  // namespace bw::model
