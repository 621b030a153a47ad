// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "bw/core/issue.h"
#include "bw/model/document.h"
#include "bw/model/evaluation_runner.h"
#include "bw/model/settings.h"
#include "bw/model/step_state.h"
#include "bw/pipeline/pipeline.h"

namespace bw::app {

/// What the user looks at.
struct Selection {
  enum class Kind { result, surface, block, blade, station };
  Kind kind = Kind::result;
  int station = -1;  ///< position in the sweep's stations, for Kind::station
  bool operator==(const Selection&) const = default;
};

/// A line above the picture that tells something without asking for attention; `action` is the text of its
/// button, if it has one.
struct Notice {
  Severity severity = Severity::info;
  QString text;
  QString action;
  std::function<void()> run;
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
  const Job& job() const { return document_.design()->job; }

  /// The result on the screen: the newest one that has a sweep, or the newest without; null before the first.
  std::shared_ptr<const pipeline::Evaluation> shown() const;
  /// The sweep on the screen or null.
  const pipeline::SweepResult* sweep() const;
  /// True while the result on the screen belongs to an older design.
  bool stale() const;
  /// True if the result on the screen is the whole result of the present design.
  bool current() const;
  model::StepStates stepStates() const;
  /// All findings of the newest result, its error first, and of the programs written from it.
  Issues messages() const;

  const Selection& selection() const { return selection_; }
  void select(const Selection& selection);
  void selectStation(int station) { select({Selection::Kind::station, station}); }

  /// Seconds from the start of the cut.
  double playTime() const { return playTime_; }
  double playEnd() const;
  void setPlayTime(double seconds);
  /// The time at which the blade passes a station.
  double timeOfStation(int station) const;
  /// The station (fractional) that the blade stands at; −1 without a result.
  double stationAt(double seconds) const;
  /// Whether the moving blade is shown: true once the timeline was used.
  bool moving() const { return moving_; }
  void setMoving(bool moving);

  /// Opens a CAD file or a .bladewright file by its suffix. Failures become a notice too.
  Result<void> openFile(const std::filesystem::path& file);
  Result<void> openExample(const std::string& name);
  bool saveTo(const std::filesystem::path& file);
  /// Writes report, geometry, stations and programs to `folder` in the background.
  void exportAll(const std::filesystem::path& folder);
  /// Writes the robot programs alone.
  void exportPrograms(const std::filesystem::path& folder);
  bool exporting() const { return exporting_; }
  /// Where the last export went; empty before.
  const std::filesystem::path& exportFolder() const { return exportFolder_; }

  void tell(Notice notice);

  /// Edits the job as one undoable step; `mergeId` ≥ 0 joins the moves of one drag, `live` while the mouse
  /// still holds the handle.
  void editJob(const QString& text, const std::function<void(Job&)>& change, int mergeId = -1,
               bool live = false);
  /// A number for the moves of one drag.
  int newMergeId() { return ++lastMergeId_; }

 signals:
  void resultChanged();  ///< another result is on the screen
  void messagesChanged();
  void stateChanged();  ///< step states, staleness or messages changed
  void progressed();
  void selectionChanged();
  void playTimeChanged();
  void noticed(const bw::app::Notice& notice);
  /// Notices of an earlier state no longer hold.
  void noticesOutdated();
  void frameRequested(const bw::Bounds& bounds);

 public slots:
  /// Selects and frames the place of a finding.
  void showPlace(const bw::Issue& issue);

 private:
  void onDesignChanged();
  void onFinished();
  void write(const std::filesystem::path& folder, const QString& name, bool everything);
  void tellWritten(const Issues& findings, std::size_t removed);
  void askAboutSize();

  model::Settings& settings_;
  model::Document document_;
  model::EvaluationRunner runner_;
  Selection selection_;
  double playTime_ = 0;
  bool moving_ = false;
  bool live_ = false;
  bool exporting_ = false;
  bool sizeAsked_ = false;
  int lastMergeId_ = 0;
  Issues messages_;        ///< of the newest result
  Issues exportFindings_;  ///< of the programs written last from that result
  std::filesystem::path exportFolder_;
  std::shared_ptr<const Design> exported_;
  QString exportProblem_;
};

}  // namespace bw::app
