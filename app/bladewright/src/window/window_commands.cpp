// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The commands of the window and the menus that hold them.
#include <QApplication>
#include <QMenuBar>
#include <QMessageBox>

#include <algorithm>
#include <array>
#include <tuple>

#include "bw/core/sweep/maps.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/key_blades.h"
#include "controls/numbers.h"
#include "controls/typed_field.h"
#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr std::array<int, 4> kHandleGrids = {5, 10, 25, 50};  // mm

QString handleGridCommand(int spacing) { return QStringLiteral("handles.grid%1").arg(spacing); }

}  // namespace

void MainWindow::makeCommands() {
  const auto add = [this](const char* id, const QString& text, const char* icon, const QString& tip,
                          const QList<QKeySequence>& keys, std::function<void(bool)> run,
                          bool checkable = false) {
    return commands_.add({id, text, icon, tip, keys, checkable}, std::move(run));
  };
  // What is written or left is what was let go, not what is on its way.
  const auto addOfFile = [this, add](const char* id, const QString& text, const char* icon,
                                     const QString& tip, const QList<QKeySequence>& keys,
                                     const std::function<void(bool)>& run) {
    return add(id, text, icon, tip, keys, [this, run](bool checked) {
      if (!view_->holding() && !bench_.handHolds()) return run(checked);
      bench_.tell(Topic::evaluation, Severity::info, tr("Let go of what you hold first."));
    });
  };
  addOfFile("file.newBlock", tr("&New single block"), "new",
            tr("A surface of 4 × 6 poles in a block of 600 × 800 × 500 mm"), {QKeySequence::New},
            [this](bool) { openExample(pipeline::kSingleBlock); });
  addOfFile("file.newWall", tr("New &wall of blocks"), "grid",
            tr("A surface through sections over three blocks of 600 × 800 × 500 mm side by side"),
            {QKeySequence("Ctrl+Shift+N")}, [this](bool) { openExample(pipeline::kBlockWall); });
  addOfFile("file.open", tr("&Open CAD surface…"), "open",
            tr("A STEP, IGES or BREP file, or the curves of one or of a DXF drawing"), {QKeySequence::Open},
            [this](bool) {
              if (const QString file = questions_.openSurface(); !file.isEmpty()) openFile(file);
            });
  addOfFile("file.openDesign", tr("Open &design…"), "folder", tr("A .bladewright file"),
            {QKeySequence("Ctrl+Shift+O")}, [this](bool) {
              if (const QString file = questions_.openDesign(); !file.isEmpty()) openFile(file);
            });
  addOfFile("file.replace", tr("Replace s&urface…"), "", tr("Another CAD file under the same settings"), {},
            [this](bool) { replaceSurface(tr("Replace surface")); });
  addOfFile("file.reload", tr("Re&load surface"), "", tr("Read the CAD file again; settings and undo stay"),
            {QKeySequence("Ctrl+R")}, [this](bool) { bench_.reloadSource(); });
  addOfFile("file.locate", tr("Loca&te surface…"), "", tr("Say where the CAD file is now"), {},
            [this](bool) { locateSurface(); });
  addOfFile("file.save", tr("&Save"), "save", tr("Save the design"), {QKeySequence::Save},
            [this](bool) { save(); });
  addOfFile("file.saveAs", tr("Save &as…"), "", tr("Save the design under another name"),
            {QKeySequence("Ctrl+Shift+S")}, [this](bool) { saveAs(); });
  addOfFile("file.export", tr("&Export everything…"), "export",
            tr("Report (HTML, PDF), CAD surface, mesh, stations, programs and pictures into a folder"),
            {QKeySequence("Ctrl+E")}, [this](bool) { exportEverything(); });
  addOfFile("file.programs", tr("Export &programs…"), "program", tr("The robot programs alone"), {},
            [this](bool) { exportPrograms(); });
  addOfFile("file.picture", tr("Export p&icture…"), "picture", tr("The view as PNG at any size"),
            {QKeySequence("Ctrl+Shift+E")}, [this](bool) { exportPicture(); });
  addOfFile("file.unsaved", tr("&Unsaved work…"), "", tr("Designs that an earlier session left unsaved"), {},
            [this](bool) { showUnsaved(); });
  addOfFile("file.close", tr("&Close"), "close", tr("Back to the start page"), {QKeySequence("Ctrl+W")},
            [this](bool) {
              if (mayLeave()) showStartPage();
            });
  addOfFile("file.quit", tr("&Quit"), "", {}, {QKeySequence("Ctrl+Q")}, [this](bool) { close(); });

  add("edit.undo", tr("&Undo"), "undo", {}, undoKeys(), [this](bool) { bench_.undo(); });
  add("edit.redo", tr("&Redo"), "redo", {}, redoKeys(), [this](bool) { bench_.redo(); });
  QUndoStack& undo = bench_.document().undoStack();
  const auto undoText = [this](const char* id, const QString& word, const QString& text) {
    // An & in a name marks no key.
    commands_[id]->setText(text.isEmpty() ? word : word + " " + withinSentence(text).replace('&', "&&"));
  };
  connect(&undo, &QUndoStack::undoTextChanged, this,
          [=, this](const QString& text) { undoText("edit.undo", tr("&Undo"), text); });
  connect(&undo, &QUndoStack::redoTextChanged, this,
          [=, this](const QString& text) { undoText("edit.redo", tr("&Redo"), text); });
  connect(&undo, &QUndoStack::canUndoChanged, commands_["edit.undo"], &QAction::setEnabled);
  connect(&undo, &QUndoStack::canRedoChanged, commands_["edit.redo"], &QAction::setEnabled);
  commands_["edit.undo"]->setEnabled(false);
  commands_["edit.redo"]->setEnabled(false);
  add("edit.palette", tr("Find a &command…"), "search", tr("Every command by its name"),
      {QKeySequence("Ctrl+K")}, [this](bool) { palette_->open(); });
  add("edit.compute", tr("Compute &again"), "process",
      tr("Compute what has no result yet, from the CAD file as it is now"), {QKeySequence("F5")},
      [this](bool) {
        if (!bench_.document().empty()) bench_.runner().evaluate(bench_.document().design());
      });
  add("design.keys", tr("Surface as &key blades"), "",
      tr("Tell the surface by the fewest key blades that come near to it, a quarter of the tolerance"), {},
      [this](bool) { takeKeyBlades(pipeline::Told::target); });
  add("design.adopt", tr("&Adopt what is cut"), "",
      tr("The surface that the blades cut becomes the design, told by key blades"), {},
      [this](bool) { takeKeyBlades(pipeline::Told::cut); });
  add("design.moulds", tr("&Two moulds for a panel…"), "",
      tr("A second block for each, of which the other side of the surface is cut: both stand back from it by "
         "half of the panel"),
      {}, [this](bool) { makeMoulds(); });
  add("blade.measure", tr("&Measure blade length…"), "measure",
      tr("The length of the mounted blade from how far it sags"), {QKeySequence("Ctrl+L")},
      [this](bool) { showMeasurePage(); });
  add("edit.cancel", tr("&Stop computing"), "", tr("Stop the running job"), {QKeySequence("Esc")},
      [this](bool) {
        if (view_->holding())
          view_->letGo();
        else if (bench_.runner().busy())
          bench_.runner().cancel();
        else
          faces_->setChoosing(false);
      });
  add(
      "input.chooseFaces", tr("C&hoose faces in the picture"), "surface",
      tr("Click the faces of the file that are to be cut"), {QKeySequence("C")},
      [this](bool on) { faces_->setChoosing(on); }, true);
  for (const auto& [id, name, mouse] :
       {std::tuple("mouse.rhino", tr("Mouse like &Rhino"), model::MouseChoice::rhino),
        std::tuple("mouse.blender", tr("Mouse like &Blender"), model::MouseChoice::blender),
        std::tuple("mouse.solidworks", tr("Mouse like &SolidWorks"), model::MouseChoice::solidworks)})
    add(
        id, name, "", tr("Which buttons turn, move and scale the view"), {},
        [this, mouse = mouse](bool) { setNavigation(mouse); }, true);

  static const std::array<std::tuple<const char*, const char*, const char*, scene::View>, 7> kViews = {
      {{"view.iso", QT_TR_NOOP("&Isometric"), "view-iso", scene::View::iso},
       {"view.top", QT_TR_NOOP("&Top"), "view-top", scene::View::top},
       {"view.bottom", QT_TR_NOOP("B&ottom"), "", scene::View::bottom},
       {"view.front", QT_TR_NOOP("&Front"), "", scene::View::front},
       {"view.back", QT_TR_NOOP("&Back"), "", scene::View::back},
       {"view.left", QT_TR_NOOP("&Left"), "", scene::View::left},
       {"view.right", QT_TR_NOOP("&Right"), "", scene::View::right}}};
  int key = 1;
  for (const auto& [id, text, icon, view] : kViews) {
    QString plain = tr(text);
    plain.remove('&');
    add(id, tr(text), icon, tr("%1 view").arg(plain), {QKeySequence(QString::number(key++))},
        [this, view = view](bool) { view_->setView(view); });
  }
  add("view.fit", tr("&Fit all"), "fit", tr("Fit everything into the picture"), {QKeySequence("Shift+F")},
      [this](bool) { view_->fitAll(); });
  add("view.fitSelection", tr("Fit &selection"), "",
      tr("Fit the selected thing into the picture, or the block with its blades"), {QKeySequence("F")},
      [this](bool) { fitSelection(); });
  add(
      "view.parallel", tr("&Parallel view"), "parallel", tr("Parallel instead of perspective"),
      {QKeySequence("P")}, [this](bool on) { view_->setParallel(on); }, true);
  add(
      "view.handles", tr("&Handles"), "",
      tr("Pull the poles of a designed surface, the points of its sections, and the block that is selected"),
      {QKeySequence("H")}, [this](bool on) { handles_->setShown(on); }, true);
  makeHandleCommands();
  const auto toggle = [&](const char* id, const QString& text, const char* icon, const QString& tip,
                          const QList<QKeySequence>& keys, StyleSwitch isOn) {
    toggles_.emplace_back(id, isOn);
    add(
        id, text, icon, tip, keys,
        [this, isOn](bool on) {
          scene::Style style = mapBar_->style();
          isOn(style) = on;
          mapBar_->setStyle(style);
          refreshStyle();
        },
        true);
  };
  toggle("view.shadows", tr("S&oft shadows"), "eye",
         tr("Shade the surface where it is less open to the light"), {},
         switchOf<&scene::Style::softShadows>);
  add(
      "view.section", tr("Se&ction through the scene"), "section",
      tr("Cut the scene open at the selected station or the moving blade"), {QKeySequence("X")},
      [this](bool on) {
        sectioned_ = on;
        // The half that the eye is on goes away.
        if (const auto plane = sectionPlane();
            plane && (view_->camera().position - plane->point).dot(plane->normal) < 0)
          sectionSide_ = -sectionSide_;
        refreshStyle();
        refreshState();
      },
      true);
  add("view.sectionFlip", tr("Other half of the s&ection"), "", tr("Take the other half away"),
      {QKeySequence("Shift+X")}, [this](bool) {
        sectionSide_ = -sectionSide_;
        refreshStyle();
      });
  toggle("view.isolines", tr("Is&olines"), "isolines", tr("Lines of equal value at the ticks of the legend"),
         {QKeySequence("I")}, switchOf<&scene::Style::isolines>);
  toggle("show.target", tr("Target surface"), "target", tr("Show the target surface"),
         {QKeySequence("Alt+T")}, shows<scene::Kind::target>);
  toggle("show.cut", tr("Cut surface"), "cut", tr("Show the cut surface"), {QKeySequence("Alt+C")},
         shows<scene::Kind::cut>);
  toggle("show.stations", tr("Stations"), "station", tr("Show the stations"), {QKeySequence("Alt+S")},
         shows<scene::Kind::station>);
  toggle("show.blades", tr("Whole blades"), "blade", tr("Show the whole blade at every station"),
         {QKeySequence("Alt+B")}, shows<scene::Kind::blade>);
  toggle("show.block", tr("Block"), "block", tr("Show the foam block"), {QKeySequence("Alt+K")},
         shows<scene::Kind::block>);
  toggle("show.grid", tr("Ground grid"), "grid", tr("Show the ground grid"), {QKeySequence("Alt+G")},
         switchOf<&scene::Style::showGrid>);
  key = 1;
  const auto addMap = [&](const QString& name, const QString& text, const QString& icon) {
    add(
        qUtf8Printable("map." + name), text, qUtf8Printable(icon),
        tr("What the colours of the cut surface show"), {QKeySequence("Alt+" + QString::number(key++ % 10))},
        [this, name = name.toStdString()](bool) {
          mapBar_->chooseField(name);
          refreshStyle();  // the map that is on keeps its tick
        },
        true);
  };
  // The maps of cut surfaces, none, and that of creases.
  const auto addMaps = [&](bool ofCut) {
    for (const MapInfo& map : cutMaps())
      if (map.ofCut == ofCut)
        addMap(map.name, tr("Map: %1").arg(QString::fromUtf8(map.title)),
               QString(map.name).replace('_', '-'));
  };
  addMaps(true);
  addMap("none", tr("No map"), "surface");
  addMaps(false);
  add(
      "panel.workflow", tr("&Workflow"), "setup", tr("Show the panel at the left"), {QKeySequence("Ctrl+1")},
      [this](bool on) { workflow_->setVisible(on); }, true);
  add(
      "panel.bottom", tr("&Section, motion, messages, blocks"), "station", tr("Show the panel below"),
      {QKeySequence("Ctrl+2")}, [this](bool on) { tabs_->setVisible(on); }, true);
  add(
      "panel.inspector", tr("Objects, &inspector, versions"), "measure", tr("Show the panel at the right"),
      {QKeySequence("Ctrl+3")}, [this](bool on) { sides_->setVisible(on); }, true);
  for (const char* id : {"panel.workflow", "panel.bottom", "panel.inspector"})
    commands_[id]->setChecked(true);
  for (const auto& [id, text, choice] :
       {std::tuple("theme.system", tr("Theme of the s&ystem"), model::ThemeChoice::system),
        std::tuple("theme.light", tr("&Light theme"), model::ThemeChoice::light),
        std::tuple("theme.dark", tr("&Dark theme"), model::ThemeChoice::dark)})
    add(
        id, text, "", tr("Colours of the window"), {}, [this, choice = choice](bool) { applyTheme(choice); },
        true);

  add("station.next", tr("&Next station"), "step-forward", tr("Select the next station"), {QKeySequence(".")},
      [this](bool) {
        bench_.selectStation(bench_.selection().station + 1);
        tabs_->setCurrentWidget(section_);
      });
  add("station.previous", tr("Station &before"), "step-back", tr("Select the station before"),
      {QKeySequence(",")}, [this](bool) {
        bench_.selectStation(std::max(0, bench_.selection().station - 1));
        tabs_->setCurrentWidget(section_);
      });
  add("station.none", tr("Select n&othing"), "", tr("Back to the numbers of the whole result"),
      {QKeySequence("Ctrl+D")}, [this](bool) { bench_.select({}); });
  add("motion.play", tr("&Play or pause"), "play", tr("Move the blade through the block"),
      {QKeySequence("Space")}, [this](bool) {
        tabs_->setCurrentWidget(motion_);
        motion_->togglePlay();
      });
  add("motion.start", tr("To the &start"), "to-start", tr("Blade to the start of the motion"),
      {QKeySequence("Home")}, [this](bool) { motion_->goTo(0); });
  add("motion.end", tr("To the &end"), "to-end", tr("Blade to the end of the motion"), {QKeySequence("End")},
      [this](bool) { motion_->goTo(bench_.playEnd()); });
  add("tab.section", tr("Show se&ction"), "station", tr("The selected station in its plane"),
      {QKeySequence("Ctrl+4")}, [this](bool) { tabs_->setCurrentWidget(section_); });
  add("tab.motion", tr("Show &motion"), "speed", tr("The timeline"), {QKeySequence("Ctrl+5")},
      [this](bool) { tabs_->setCurrentWidget(motion_); });
  add("tab.messages", tr("Show m&essages"), "info", tr("All findings"), {QKeySequence("Ctrl+6")},
      [this](bool) { tabs_->setCurrentWidget(messages_); });
  add("tab.blocks", tr("Show &blocks"), "block", tr("The plan of the blocks, and their cuts"),
      {QKeySequence("Ctrl+7")}, [this](bool) {
        tabs_->setVisible(true);
        commands_["panel.bottom"]->setChecked(true);
        tabs_->setCurrentWidget(blocks_);
      });
  makeVersionCommands();
  add("help.guide", tr("&Guide and keys"), "info", tr("How the window works, and every key"),
      {QKeySequence("F1")}, [this](bool) { guide_->open(); });
  add("help.about", tr("&About Bladewright"), "", {}, {}, [this](bool) {
    QMessageBox box(QMessageBox::NoIcon, tr("About Bladewright"),
                    tr("<b>Bladewright %1</b><br>Design of surfaces that a hot, flexible blade cuts from "
                       "foam.<br>MIT licence.")
                        .arg(QApplication::applicationVersion()),
                    QMessageBox::Ok, this);
    box.setIconPixmap(QIcon(":/icons/bladewright.svg").pixmap(64, 64));
    box.exec();
  });
}

void MainWindow::makeHandleCommands() {
  commands_.add({"handles.number",
                 tr("Type its &numbers"),
                 "",
                 tr("Opens a field beside the handle that was pressed; Enter does, too"),
                 {}},
                [this](bool) { keys_->openField(); });
  commands_.add({"handles.symmetric",
                 tr("S&ymmetric editing"),
                 "",
                 tr("What is moved takes its mirror image with it, left and right across the travel"),
                 {QKeySequence("M")},
                 true},
                [this](bool on) { handles_->setSymmetric(on); });
  commands_.add({"handles.snap",
                 tr("Snap to a &grid"),
                 "",
                 tr("Handles move from line to line of a grid, not by whole millimetres"),
                 {QKeySequence("G")},
                 true},
                [this](bool on) {
                  handles_->setSnapping(on);
                  refreshHandleCommands();
                });
  for (const int spacing : kHandleGrids)
    commands_.add({handleGridCommand(spacing),
                   tr("Grid of %1 mm").arg(spacing),
                   "",
                   tr("The grid that handles snap to"),
                   {},
                   true},
                  [this, spacing](bool) {
                    handles_->setGrid(spacing);
                    handles_->setSnapping(true);
                    refreshHandleCommands();
                  });
  commands_.add({"handles.meet",
                 tr("Snap to &block and points"),
                 "",
                 tr("The mouse brings a handle in line with faces and middles of blocks and with other "
                    "handles, and a face of a block with those of other blocks and with the ends of the "
                    "surface, where it comes near to them; with Ctrl or Alt it does not"),
                 {QKeySequence("Shift+G")},
                 true},
                [this](bool on) { handles_->setMeeting(on); });
  // Of the picture: a field has these keys for itself.
  const auto edit = [this](const char* id, const QString& text, const QString& tip,
                           const QList<QKeySequence>& keys, void (SurfaceHandles::*run)()) {
    commands_.add({id, text, "", tip, keys}, [this, run](bool) { (handles_->*run)(); })
        ->setShortcutContext(Qt::WidgetShortcut);
  };
  edit("handles.addPoint", tr("Add &point"),
       tr("A point more on the curve, halfway to the next one; a Bézier curve is parted there"),
       {QKeySequence("Ins")}, &SurfaceHandles::addPoint);
  edit("handles.removePoint", tr("Remove p&oint"), tr("Takes the point away that was pressed"),
       {QKeySequence("Del")}, &SurfaceHandles::removePoint);
  edit("handles.addSection", tr("Add &section"),
       tr("A section or a key blade more halfway to the next one, as the surface is there"), {},
       &SurfaceHandles::addSection);
  edit("handles.removeSection", tr("&Remove section"),
       tr("Takes the section or the key blade of the handle away"), {}, &SurfaceHandles::removeSection);
  edit("handles.duplicate", tr("&Duplicate along the wall"),
       tr("The section or the key blade of the handle once more as it is, with its expressions, halfway to "
          "the next one or beyond the last"),
       {}, &SurfaceHandles::duplicate);
  edit("handles.copyShape", tr("&Copy shape to those chosen"),
       tr("Gives the rows, sections or key blades of all handles chosen the shape, with its expressions, of "
          "that which was chosen last"),
       {}, &SurfaceHandles::copyShape);
}

void MainWindow::refreshHandleCommands() {
  const bool point = handles_->sectionPoint().has_value(), blade = handles_->keyBlade().has_value();
  const std::size_t chosen = handles_->shown() ? handles_->chosen().size() : 0;
  const QString one = chosen == 0  ? tr("Not now: no handle is chosen.")
                      : chosen > 1 ? tr("Not now: %1 handles are chosen; choose one.").arg(chosen)
                                   : QString();
  const auto unless = [&](bool able, const QString& why) {
    return able ? QString() : one.isEmpty() ? why : one;
  };
  for (const char* id : {"handles.addPoint", "handles.removePoint"})
    commands_.allow(id, unless(point, tr("Not now: the handle is none of a curve.")));
  for (const char* id : {"handles.addSection", "handles.removeSection", "handles.duplicate"})
    commands_.allow(id, unless(point || blade, tr("Not now: the handle is of no curve and no key blade.")));
  commands_["handles.addSection"]->setText(blade ? tr("Add key &blade") : tr("Add &section"));
  commands_["handles.removeSection"]->setText(blade ? tr("&Remove key blade") : tr("&Remove section"));
  commands_.allow("handles.copyShape",
                  handles_->others().empty() ? tr("Not now: choose handles of several of them.") : QString());
  commands_.allow("handles.number", chosen == 0 ? one : QString());
  const bool possible = handles_->possible();
  commands_["handles.symmetric"]->setEnabled(possible);
  commands_["handles.symmetric"]->setChecked(handles_->symmetric());
  commands_["handles.meet"]->setEnabled(possible || !bench_.document().empty());
  commands_["handles.meet"]->setChecked(handles_->meeting());
  commands_["handles.snap"]->setEnabled(possible);
  commands_["handles.snap"]->setChecked(handles_->snapping());
  for (const int spacing : kHandleGrids) {
    commands_[handleGridCommand(spacing)]->setEnabled(possible);
    commands_[handleGridCommand(spacing)]->setChecked(handles_->snapping() && handles_->grid() == spacing);
  }
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, std::initializer_list<const char*> ids) {
    for (const char* id : ids) {
      if (*id)
        menu->addAction(commands_[id]);
      else
        menu->addSeparator();
    }
    menu->setToolTipsVisible(true);
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  fill(file, {"file.newBlock", "file.newWall", "file.open", "file.openDesign"});
  recentMenu_ = file->addMenu(tr("Open &recent"));
  fill(file,
       {"file.unsaved", "", "file.save", "file.saveAs", "", "file.replace", "file.reload", "file.locate", "",
        "file.export", "file.programs", "file.picture", "", "file.close", "file.quit"});
  QMenu* edit = menuBar()->addMenu(tr("&Edit"));
  fill(edit, {"edit.undo", "edit.redo", "", "edit.compute", "edit.cancel", ""});
  handleMenu_ = edit->addMenu(tr("&Handle"));
  fill(handleMenu_, {"handles.number", "", "handles.addPoint", "handles.removePoint", "handles.addSection",
                     "handles.removeSection", "handles.duplicate", "handles.copyShape", "",
                     "handles.symmetric", "handles.meet", "handles.snap"});
  for (const int spacing : kHandleGrids) fill(handleMenu_, {qUtf8Printable(handleGridCommand(spacing))});
  fill(edit, {"versions.name", "versions.back", ""});
  fill(edit, {"input.chooseFaces", "design.keys", "design.adopt", "design.moulds", "blade.measure", "",
              "edit.palette"});
  QMenu* view = menuBar()->addMenu(tr("&View"));
  fill(view, {"view.iso", "view.top", "view.bottom", "view.front", "view.back", "view.left", "view.right", "",
              "view.fit", "view.fitSelection", "view.parallel", "", "view.section", "view.sectionFlip",
              "view.shadows", "view.handles", ""});
  QMenu* maps = view->addMenu(tr("&Map"));
  for (const std::string& name : MapBar::fieldNames())
    fill(maps, {qUtf8Printable("map." + QString::fromStdString(name))});
  fill(maps, {"", "view.isolines"});
  fill(view->addMenu(tr("&Compare")), {"compare.target", "compare.before", "compare.version"});
  fill(view->addMenu(tr("S&how")),
       {"show.target", "show.cut", "show.stations", "show.blades", "show.block", "show.grid"});
  fill(view->addMenu(tr("Pa&nels")), {"panel.workflow", "panel.bottom", "panel.inspector", "", "tab.section",
                                      "tab.motion", "tab.messages", "tab.blocks", "tab.versions"});
  view->addSeparator();
  fill(view->addMenu(tr("Th&eme")), {"theme.system", "theme.light", "theme.dark"});
  fill(view->addMenu(tr("M&ouse")), {"mouse.rhino", "mouse.blender", "mouse.solidworks"});
  fill(menuBar()->addMenu(tr("&Motion")),
       {"motion.play", "motion.start", "motion.end", "", "station.previous", "station.next", "station.none"});
  fill(menuBar()->addMenu(tr("&Help")), {"help.guide", "edit.palette", "", "help.about"});
}

}  // namespace bw::app
