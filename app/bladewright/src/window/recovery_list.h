// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QVBoxLayout>

#include <filesystem>
#include <vector>

#include "bw/model/recovery.h"
#include "controls/theme.h"

namespace bw::app {

/// Unsaved designs that a crash, a kill or the end of a session left behind: picture, name, place, date and
/// size of each, newest first, with a button to go on and one to discard. Hidden while there are none.
class RecoveryList : public QFrame {
  Q_OBJECT

 public:
  RecoveryList(const Theme& theme, const std::filesystem::path& folder, QWidget* parent = nullptr);
  /// Looks into the folder again.
  void refresh();
  const std::vector<model::RecoveryCopy>& copies() const { return copies_; }

 signals:
  void openRequested(const QString& copy);
  void discardRequested(const QString& copy, const QString& name);
  /// It has other rows.
  void refreshed();

 private:
  QWidget* makeRow(const model::RecoveryCopy& copy);

  const Theme& theme_;
  std::filesystem::path folder_;
  std::vector<model::RecoveryCopy> copies_;
  QVBoxLayout* rows_;
};

}  // namespace bw::app
