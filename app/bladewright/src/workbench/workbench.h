// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTime>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/model/change.h"
#include "bw/model/document.h"
#include "bw/model/evaluation_runner.h"
#include "bw/model/settings.h"
#include "bw/model/source_watch.h"
#include "bw/model/step_state.h"
#include "bw/pipeline/pipeline.h"
#include "workbench/drawing.h"
#include "workbench/handover.h"
#include "workbench/objects.h"

namespace bw::app {

using model::Aspect;
using model::Change;
using model::Selection;

/// One line of the messages: a finding, or why there is no result.
struct Message {
  Severity severity = Severity::info;
  QString text;
  std::optional<Finding> finding = std::nullopt;
  Remedies remedies = {};
};

/// A button below the messages: its words, and what it makes of the design.
struct Offer {
  QString text;
  std::function<void(Design&)> change;
};

/// Where a message is about.
struct Spot {
  Severity severity = Severity::info;
  QString text;
  std::optional<Eigen::Vector3d> point;  ///< in the file's frame; empty where it has no place of its own
  Bounds bounds;  ///< its station's blade and the block: what shows it in its surroundings
};

/// What a notice is about. A new one takes the place of the last of its topic.
enum class Topic {
  evaluation,  ///< the newest result: outdated by the next
  source,      ///< the CAD file of the open design: outdated when another design is opened
  unit,        ///< whether its size can be meant: likewise, and by a size that can
  file,        ///< opening, recovering and saving the open design: likewise, and by a save
  autosave,    ///< outdated once autosave works again
  recovery,    ///< what earlier sessions left: outdated when one of these is gone on with
  written,     ///< what an export wrote: outdated when another design is opened
  locked,      ///< what is locked and was to be changed: outdated when another lock is
  made,        ///< what a command made of the design: outdated by the next change of it
  refusal,     ///< a text in a field that keeps an export from beginning: outdated when it changes
  declined     ///< why a command or an export did not do what was asked: outdated by the next change
};

/// A line above the picture that tells something; `action` is the text of its button, if it has one. It
/// stands until it is answered or its topic is outdated.
struct Notice {
  Severity severity = Severity::info;
  QString text;
  QString action;
  std::function<void()> run;
  Topic topic = Topic::declined;
};

/// The window's state without widgets: document, results, selection and playhead. Widgets read it and call
/// it; it tells them what changed.
class Workbench : public QObject {
  Q_OBJECT

 public:
  /// `recoveryFolder` empty: no autosave.
  Workbench(model::Settings& settings, const std::filesystem::path& recoveryFolder,
            QObject* parent = nullptr);

  model::Settings& settings() { return settings_; }
  model::Document& document() { return document_; }
  model::EvaluationRunner& runner() { return runner_; }
  const Design& design() const { return *document_.design(); }

  /// The result on the screen: the newest one that has a sweep, or the newest without; null before the first.
  std::shared_ptr<const pipeline::Evaluation> shown() const;
  /// Of the result on the screen the cut selected, or null; and what it came to.
  const pipeline::CutEvaluation* shownCut() const;
  std::optional<pipeline::CutResult> sweep() const;
  /// What follows the hand in place of the result, until the evaluation of its design is there; null while
  /// nothing does.
  const pipeline::Sketch* sketch() const { return runner_.sketch().get(); }
  /// Its cut that is selected; null if there is none.
  const pipeline::CutSketch* sketchedCut() const;
  /// The blades to be seen of the cut selected: those that follow the hand, else those of the result. Null if
  /// there are none.
  const Sweep* row() const;
  /// Of the newest evaluation, whether or not it came to a result: what is known of the CAD file, and the
  /// surface of the cut selected. Null before they are read.
  const geometry::CadInfo* fileInfo() const;
  const geometry::Target* newestTarget() const;
  /// True while the result on the screen belongs to an older design.
  bool stale() const;
  /// True where the present design came to no result, so that what is on the screen is an older one's.
  bool failed() const { return !runner_.busy() && runner_.error().has_value(); }
  /// True if the result on the screen is the whole result of the present design.
  bool current() const;
  model::StepStates stepStates() const;
  /// All findings of the newest result, its error first, and of the programs written from it.
  std::vector<Message> messages() const;
  /// True if `apply` changes the design.
  bool canApply(const Remedy& remedy) const;
  /// Does what a remedy advises, as one undoable step.
  void apply(const Remedy& remedy);
  /// What can be done about a message: its remedies that change the design, and what its numbers say. The
  /// cut that the message is about must be the one selected, as `showPlace` leaves it.
  std::vector<Offer> offersOf(const Message& message) const;

  /// Its block and cut are always those of a cut of the design.
  const Selection& selection() const { return selection_; }
  void select(Selection next);
  void selectStation(int station) { select({Selection::Kind::station, station}); }
  /// The cut and the block selected, in the design.
  const Cut& cut() const;
  const StockBlock& block() const;
  /// What the cut selected is of.
  const Source& source() const { return design().sourceOf(cut()); }

  /// Seconds from the start of the cut.
  double playTime() const { return playTime_; }
  double playEnd() const;
  void setPlayTime(double seconds);
  /// Turns to the station beside a place, in the file's frame: it is selected where a station is, else the
  /// time is that at which the blade passes there. `anyCut`: of the cut in whose block the place lies, if
  /// that is of the same source.
  void lookBeside(const Eigen::Vector3d& place, bool anyCut);
  /// The time at which the blade passes a station.
  double timeOfStation(int station) const;
  /// The station (fractional) that the blade stands at; −1 without a result.
  double stationAt(double seconds) const;
  /// The blade at a time of the motion that is run, from grip to grip, in the file's frame; empty as long as
  /// that is not known.
  std::vector<Eigen::Vector3d> bladeAt(double seconds) const;
  /// Whether the moving blade is shown: true once the timeline was used.
  bool moving() const { return moving_; }
  void setMoving(bool moving);

  /// Opens a CAD file or a .bladewright file by its suffix; what holds curves alone, or is large, is read in
  /// the background first (`reading`). Failures become a notice too.
  Result<void> openFile(const std::filesystem::path& file);
  /// True while a file is being read that opens a design when it is.
  bool reading() const { return reading_ != nullptr; }
  /// Why the last one did not open one; nothing where it did.
  const std::optional<Error>& readingError() const { return readingError_; }
  /// Who is asked before a design that was edited while a file was read gives way to that one.
  void setLeaveQuestion(std::function<bool()> mayLeave) { mayLeave_ = std::move(mayLeave); }
  /// The drawing that the open design was made from, if its curves lie on several layers; else null.
  const Drawing* drawing() const { return drawing_ && drawing_->layers.size() > 1 ? &*drawing_ : nullptr; }
  /// Makes the surface anew of a layer of the drawing, in the background, as one undoable step; a failure
  /// becomes a notice.
  void takeLayer(const Drawing::Layer& layer);
  Result<void> openExample(const std::string& name);
  /// Goes on with an autosaved copy. Failures become a notice too, and the copy stays.
  Result<void> recover(const std::filesystem::path& copy);
  /// `Document::saveAs`; false where that failed, which becomes a notice.
  bool saveTo(const std::filesystem::path& file, const std::optional<std::string>& name = {});

  /// The CAD file of the open design, embedded ones by the place they came from; empty if that is not known.
  std::filesystem::path sourceFile() const;
  /// True if the design is linked to a file that is not there.
  bool sourceMissing() const;
  bool canReload() const;
  /// True if the design was made from curves of a file that is known since it was opened.
  bool fromDrawing() const { return drawing_ && design().source().surface; }
  /// Whether that file, or the CAD file that the design is linked to, is read again by itself when it
  /// changes; remembered between starts.
  bool followsFile() const { return settings_.followsFile(); }
  void setFollowsFile(bool on);
  /// When a file that had changed was last read again; invalid if none was since the design was opened.
  const QTime& readAgainAt() const { return readAgainAt_; }
  /// Another CAD file under the same settings, as one undoable step named `text`; it is embedded if the one
  /// before was.
  Result<void> replaceSource(const std::filesystem::path& file, const QString& text);
  /// Reads the file again; a copy in the design is replaced, and so is the surface made of a drawing, as an
  /// undoable step.
  void reloadSource();
  /// Looks whether the CAD file changed, where no message about it comes (network drives).
  void lookAtSource() { watch_.look(); }

  /// What becomes of files of an earlier export in the folder chosen.
  enum class Earlier { replace, newFolder, cancel };
  using EarlierQuestion = std::function<Earlier(const std::filesystem::path& folder,
                                                const std::vector<std::filesystem::path>& files,
                                                const std::filesystem::path& newFolder)>;
  /// Who is asked before an export replaces or removes `files` (relative to `folder`); without a question
  /// they are kept, and the export goes to `newFolder`, a name beside it that is free.
  void setEarlierQuestion(EarlierQuestion question) { earlierQuestion_ = std::move(question); }
  /// What an export writes: kinds of files as they were chosen last, blocks as they were for this design.
  pipeline::Wanted wanted() const;
  void setWanted(pipeline::FileKind kind, bool on);
  void setBlockWanted(const std::string& block, bool on);
  bool anyBlockWanted() const;
  /// Writes all that a colleague needs to understand the result without this program to `folder`, in the
  /// background: report (HTML, PDF, JSON) with `pictures`, geometry (STEP, IGES, STL, OBJ), stations,
  /// programs and the design; of these what is `wanted`.
  void exportAll(const std::filesystem::path& folder, std::vector<pipeline::ReportPicture> pictures = {});
  /// Writes the robot programs alone.
  void exportPrograms(const std::filesystem::path& folder);
  /// True if an export can be ordered: the result of the present design stands or is being computed.
  bool canExport() const {
    return !exporting_ && !document_.empty() && anyBlockWanted() && (current() || runner_.busy());
  }
  bool canExportPrograms() const { return canExport() && !design().output.programs.empty(); }
  bool exporting() const { return exporting_; }
  /// The folder that exports of the open design go to; empty where each is to ask for one.
  const std::filesystem::path& exportTo() const { return exportTo_; }
  void setExportTo(const std::filesystem::path& folder);
  /// Where the last export of the open design went; empty before.
  const std::filesystem::path& exportFolder() const { return exportFolder_; }
  /// What it wrote there, relative to it, in the order of writing.
  const std::vector<WrittenFile>& exportedFiles() const { return exportedFiles_; }

  void tell(const Notice& notice);
  /// A text as a sentence of its own, with a capital, unless it begins with a name of the design or of a
  /// file.
  QString asSentence(QString text) const;
  void tell(Topic topic, Severity severity, const QString& text) { tell({severity, text, {}, {}, topic}); }
  void tell(Topic topic, const Error& error) {
    tell(topic, Severity::error, QString::fromStdString(error.message));
  }

  /// Edits the job as one undoable step; `mergeId` ≥ 0 joins the moves of one drag, `live` while the mouse
  /// still holds the handle.
  void editDesign(const QString& text, const std::function<void(Design&)>& change, int mergeId = -1,
                  bool live = false);
  /// True while the mouse holds what was changed last: a handle, a slider, a boundary.
  bool handHolds() const;
  /// The same for the cut or the block selected.
  void editCut(const QString& text, const std::function<void(Cut&)>& change, int mergeId = -1,
               bool live = false);
  void editBlock(const QString& text, const std::function<void(StockBlock&)>& change, int mergeId = -1,
                 bool live = false);
  /// The same for the designed surface that the cut selected is of.
  void editSurface(const QString& text, const std::function<void(DesignedSurface&)>& change, int mergeId = -1,
                   bool live = false);
  /// Takes the last step back, or makes it again. What is locked goes with it, and that is told.
  void undo();
  void redo();
  /// Runs `edit`, whose step then also has the number at a place of the design's `bindings` stand for an
  /// expression, or free of it; where the place ends with a slash, all numbers below are freed. Cuts of a
  /// grid that `editCut` changes with the one selected are told by the same expression.
  void editBound(const std::string& place, const std::optional<BoundNumber>& bound,
                 const std::function<void()>& edit);
  /// What the picture leaves out, and what no edit changes: saved with the design. An edit that would change
  /// a locked object is refused, and that is told; undo goes back beyond it.
  bool hidden(const Object& object) const {
    return idsOf(document_.marks().hidden, object.kind).contains(object.id);
  }
  void setHidden(const Object& object, bool hidden);
  bool locked(const Object& object) const {
    return idsOf(document_.marks().locked, object.kind).contains(object.id);
  }
  void setLocked(const Object& object, bool locked);
  /// Another name for a block, a cut or a surface, as an undoable step; a failure becomes a notice too.
  Result<void> rename(const Object& object, const std::string& name);
  /// A number for the moves of one drag.
  int newMergeId() { return ++lastMergeId_; }

 signals:
  /// What widgets show is another; each refreshes what it shows of it.
  void changed(const bw::model::Change& change);
  void noticed(const bw::app::Notice& notice);
  /// Other objects are hidden or locked.
  void objectsChanged();
  /// Notices of that topic no longer hold.
  void noticesOutdated(bw::app::Topic topic);
  /// A finding is to be seen: frame its surroundings and mark its point.
  void spotShown(const bw::app::Spot& spot);
  /// An export stands in that folder.
  void exported(const QString& folder);
  /// A file that was read in the background is open, or is not (`readingError`).
  void readingEnded(bool opened);
  /// The person wants to say where the CAD file is now.
  void locateRequested();

 public slots:
  /// Selects and frames the place of a message.
  void showPlace(const bw::app::Message& message);

 private:
  /// Tells what is locked and was changed all the same by a step.
  void tellUnlocked(const Design& before, const QString& step);
  void onReplaced();
  void onDesignChanged();
  void onFinished();
  /// What a search for the direction came to that was asked for by a remedy.
  void tellDirection();
  void tellChanged(model::Aspects whole) { emit changed({whole}); }
  Cut& cutOf(Design& design) const;  ///< the one selected
  /// Selects the cut in whose block a place lies, or the nearest one, of those of the same source.
  void selectCutAt(const Eigen::Vector3d& place);
  /// What the numbers of a finding say: more stations where blocks meet, a block that is split across the
  /// blade where its points are too uneven, and one that reaches lower.
  std::optional<Offer> offerStations(const Finding& finding) const;
  std::optional<Offer> offerSplit(const Finding& finding) const;
  std::optional<Offer> offerPlanes(const Finding& finding) const;
  std::optional<Offer> offerLowerBlock(const Finding& finding) const;
  /// How the evaluations that are there now differ from those that were told of last.
  Change resultChange();
  /// Selects the first cut if the design has none of the selected id. What is seen of a cut is then another.
  Change settleSelection();
  static Error noFile(const std::filesystem::path& file);
  /// Tells an error and hands it on.
  Result<void> refuse(Topic topic, const Error& error);
  struct Reading;
  void beginReading(const std::filesystem::path& file);
  void endReading(Reading& read, const Result<void>& done);
  void openDrawing(Reading& read);
  /// A design of the faces of a file.
  void startFaces(const std::filesystem::path& file);
  struct Export;
  using MakePolicy = std::function<pipeline::Policy(const RunContext&)>;
  void write(const std::filesystem::path& folder, const QString& name, MakePolicy policy);
  void commit(const std::shared_ptr<Export>& files);
  void finishExport(const Export& made, const Result<void>& done);
  void tellWritten(const Export& made);
  /// Asks whether the unit is right where the size of a target can hardly be meant.
  void judgeSize();
  void followSource();
  /// The file at work: that of the drawing, or the CAD file.
  std::filesystem::path watchedFile() const;
  void onSourceChanged();
  /// Reads the file beside the design first, which stays as it is where that fails. `asked`: by a person, who
  /// gives up what a hand has changed of the surface of a drawing.
  void readLinkedAgain();
  void readDrawingAgain(bool asked);
  void endDrawing(Drawing next, const Drawing::Layer& layer, bool asked);
  /// Reads the drawing that a design which was opened tells that it is made of.
  void readDrawingOfDesign();
  void endDrawingOfDesign(const DrawingLink& link, std::optional<Drawing> next, const Result<void>& done);
  void tellReadAgain(const QString& more = {});
  void tellUnreadable(const Error& error, const std::function<void()>& again);
  void tellSourceChanged();
  void tellSourceGone();
  void noteSourceRead();
  /// What was told of the CAD file no longer holds; what does is told again.
  void outdateSource();

  model::Settings& settings_;
  model::Document document_;
  model::EvaluationRunner runner_;
  model::SourceWatch watch_;
  std::shared_ptr<Reading> reading_;  ///< null: nothing is read
  std::optional<Error> readingError_;
  std::optional<Drawing> drawing_;  ///< of the open design, as long as it is open
  std::function<bool()> mayLeave_;
  std::shared_ptr<const pipeline::CadSource> readSource_;  ///< of the newest result that has one
  std::filesystem::path readPath_;                         ///< of that
  bool sourceTold_ = false;     ///< that the source is another than when the design was saved
  bool sourceChanged_ = false;  ///< it is told that the file changed
  int sourceReadings_ = 0;      ///< of files that changed: an earlier one is outdated by the next
  QTime readAgainAt_;
  std::shared_ptr<const pipeline::Evaluation> toldShown_, toldNewest_;  ///< of the last change
  Selection selection_;
  double playTime_ = 0;
  bool moving_ = false;
  bool live_ = false;
  bool lastLive_ = false;  ///< of the last change
  /// The cut whose direction a remedy had searched, until that is told.
  std::string directionAsked_;
  bool sketchTold_ = false;  ///< views show a sketch
  bool exporting_ = false;
  std::optional<Eigen::Vector3d> judgedSize_;  ///< of the target that the unit was judged by
  int lastMergeId_ = 0;
  struct Binding {
    std::vector<std::string> places = {};
    std::optional<BoundNumber> bound = {};
  };
  Binding binding_;                      ///< of the step that is being made
  std::vector<Message> messages_;        ///< of the newest result
  Findings exportFindings_;              ///< of what was written last: other sections, and of its programs
  QStringList leftOut_;                  ///< words of kinds of files
  std::set<std::string> blocksLeftOut_;  ///< ids
  std::filesystem::path exportTo_, exportFolder_;
  std::vector<WrittenFile> exportedFiles_;
  std::string exported_;       ///< `model::exportKey` of what was written last; empty: nothing
  bool exportedPart_ = false;  ///< some of its files or blocks alone
  int opened_ = 0;             ///< designs so far: an export may end when its own is no longer open
  QString exportProblem_;
  EarlierQuestion earlierQuestion_;
};

}  // namespace bw::app
