// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/edit_design.h"

#include "bw/model/document.h"

namespace bw::model {

EditDesign::EditDesign(Document& document, std::shared_ptr<const Design> before,
                       std::shared_ptr<const Design> after, const QString& text, int mergeId)
    : QUndoCommand(text),
      document_(document),
      before_(std::move(before)),
      after_(std::move(after)),
      mergeId_(mergeId) {}

void EditDesign::undo() { document_.exchange(before_); }

void EditDesign::redo() { document_.exchange(after_); }

bool EditDesign::mergeWith(const QUndoCommand* other) {
  const auto* next = static_cast<const EditDesign*>(other);
  if (mergeId_ < 0 || next->mergeId_ != mergeId_) return false;
  after_ = next->after_;
  return true;
}

}  // namespace bw::model
