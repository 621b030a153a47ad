// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

#include <string>
#include <vector>

#include "controls/fields.h"
#include "controls/layout.h"
#include "controls/theme.h"
#include "controls/typed_field.h"
#include "versions/comparison.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The line in which the present state gets a name.
class VersionName : public TypedField {
  Q_OBJECT

 public:
  explicit VersionName(Workbench& bench, QWidget* parent = nullptr);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override { return {}; }
  QString limitsText() const override;

 private:
  Workbench& bench_;
};

/// The named versions of the design, the oldest first: F2 renames one, Del takes it away, Enter goes back to
/// it.
class VersionList : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { name, differs };
  VersionList(Workbench& bench, QWidget* parent = nullptr);

  /// The version chosen in the list; empty if there is none.
  std::string chosen() const;
  void choose(const std::string& version);
  /// Shows the versions that there are.
  void refresh();
  /// Tells of each in how much it differs from the present state.
  void countDifferences();
  /// Begins another name for the one chosen.
  void editName();
  void goBack();
  void removeChosen();

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 signals:
  void chosenChanged();
  /// The same by the hand.
  void picked();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void rename(const std::string& version, const QString& next);
  /// Makes a step of what `change` makes of the design, or tells why not.
  void edit(const QString& step, const Result<Design>& changed);

  Workbench& bench_;
  std::vector<NamedVersion> built_;  ///< that it shows
  bool busy_ = false;
};

/// The history of a design: names for states of it, what they differ in from the present one, and the numbers
/// of the one that is compared with it.
class VersionPanel : public SidePanel {
  Q_OBJECT

 public:
  VersionPanel(Workbench& bench, Comparison& comparison, const Theme& theme, QWidget* parent = nullptr);

  /// Puts the cursor into the name of a new version.
  void beginNaming();
  VersionName& name() { return *name_; }
  VersionList& list() { return *list_; }
  QPushButton& compareButton() { return *compare_; }
  /// The lines below: a number, or what differs, then and now.
  QStringList shownNumbers() const;
  QStringList shownDifferences() const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Line {
    QLabel* name;
    ValueLabel *then, *now;
  };
  void refresh();
  void refreshNumbers();
  void refreshDifferences();
  /// The state that is told of: that of the comparison, else the version chosen; null if there is none.
  const Design* told(QString& name) const;

  Workbench& bench_;
  Comparison& comparison_;
  VersionName* name_;
  VersionList* list_;
  QPushButton *back_, *compare_, *rename_, *remove_;
  QLabel *none_, *title_, *state_;
  QWidget* table_;
  std::vector<Line> numbers_;
  QWidget* differences_;
  QVBoxLayout* differenceLines_;
  QStringList shownDifferences_;
  QTimer settle_;  ///< from a change of the design until what differs is told anew
};

}  // namespace bw::app
