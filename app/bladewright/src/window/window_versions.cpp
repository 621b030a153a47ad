// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Named versions in the window, and what stands beside the present picture.
#include <algorithm>

#include "bw/core/text/printable.h"
#include "window/main_window.h"

namespace bw::app {

namespace {

/// The choices of the control: nothing, the target, the state before, then the versions.
constexpr int kFirstVersion = 3;

}  // namespace

void MainWindow::makeVersionCommands() {
  commands_.add({"versions.name",
                 tr("&Name this version…"),
                 "",
                 tr("Keeps the design as it is now under a name"),
                 {QKeySequence("Ctrl+Shift+V")}},
                [this](bool) {
                  commands_["tab.versions"]->trigger();
                  versions_->beginNaming();
                });
  commands_.add({"versions.back",
                 tr("&Go back to the version"),
                 "",
                 tr("Makes the design what it was in the version chosen; undo takes it back"),
                 {}},
                [this](bool) { versions_->list().goBack(); });
  const auto beside = [this](const char* id, const QString& text, const QString& tip, Beside::What what) {
    commands_.add({id, text, "", tip, {}, true},
                  [this, what](bool on) { chooseBeside(on ? Beside{what} : Beside{}); });
  };
  beside("compare.target", tr("Compare: &target beside cut"),
         tr("The surface that is to be cut in a second picture beside the one that the blades cut"),
         Beside::What::target);
  beside("compare.before", tr("Compare: &before the last change"),
         tr("What the design came to before its last change in a second picture, under one legend"),
         Beside::What::before);
  commands_.add({"compare.version",
                 tr("Compare: &version"),
                 "",
                 tr("The version chosen in the list in a second picture, under one legend"),
                 {},
                 true},
                [this](bool on) {
                  chooseBeside(on ? Beside{Beside::What::version, versions_->list().chosen()} : Beside{});
                });
  commands_.add({"tab.versions",
                 tr("Show &versions"),
                 "",
                 tr("The named versions of the design, and what differs"),
                 {QKeySequence("Ctrl+8")}},
                [this](bool) {
                  sides_->setVisible(true);
                  commands_["panel.inspector"]->setChecked(true);
                  sides_->setCurrentWidget(versions_);
                });
}

void MainWindow::followComparison() {
  connect(&comparison_, &Comparison::chosen, this, [this] {
    beside_->refresh();
    refreshStyle();
    refreshComparison();
    placeBanner();
  });
  connect(&comparison_, &Comparison::computed, this, [this] {
    beside_->refresh();
    refreshStyle();
  });
  connect(&bench_.document().undoStack(), &QUndoStack::indexChanged, this, &MainWindow::refreshComparison);
  connect(&versions_->list(), &VersionList::chosenChanged, this, &MainWindow::refreshComparison);
  connect(mapBar_, &MapBar::comparisonChosen, this, [this](int index) {
    const auto& versions = bench_.design().versions;
    const auto version = std::size_t(index - kFirstVersion);
    if (index < kFirstVersion)
      chooseBeside({Beside::What(index)});
    else if (version < versions.size())
      chooseBeside({Beside::What::version, versions[version].name});
  });
  connect(beside_, &BesideView::hovered, this,
          [this](const scene::Pick& pick) { tellHovered(pick, *beside_->other()); });
}

void MainWindow::chooseBeside(const Beside& beside) {
  comparison_.choose(beside);
  refreshComparison();  // what could not be chosen is not shown as chosen
}

void MainWindow::refreshComparison() {
  const Beside& beside = comparison_.beside();
  const auto& versions = bench_.design().versions;
  QStringList items = {tr("Single"), tr("Target beside cut"), tr("Last change")};
  for (const NamedVersion& version : versions) items << QString::fromStdString(printable(version.name));
  int index = int(beside.what);
  if (beside.what == Beside::What::version)
    index = kFirstVersion +
            int(std::ranges::find(versions, beside.version, &NamedVersion::name) - versions.begin());
  const bool before = comparison_.hasBefore();
  mapBar_->setComparisons(items, index, before);
  const bool open = stack_->currentWidget() == columns_, one = !versions_->list().chosen().empty();
  for (const char* id : {"versions.name", "tab.versions", "compare.target"}) commands_[id]->setEnabled(open);
  for (const char* id : {"versions.back", "compare.version"}) commands_[id]->setEnabled(open && one);
  commands_["compare.before"]->setEnabled(open && before);
  commands_["compare.target"]->setChecked(beside.what == Beside::What::target);
  commands_["compare.before"]->setChecked(beside.what == Beside::What::before);
  commands_["compare.version"]->setChecked(beside.what == Beside::What::version);
}

}  // namespace bw::app
