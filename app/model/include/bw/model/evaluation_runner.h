// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/design/design.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/reach.h"
#include "bw/pipeline/region.h"
#include "bw/pipeline/sketch.h"

namespace bw::model {

/// Runs the pipeline on one thread of its own, so that the window never waits. Use it from the interface
/// thread; every signal is sent there. A newer design cancels the older run; results of earlier runs are
/// handed on, so that only what changed is computed again.
class EvaluationRunner : public QObject {
  Q_OBJECT

 public:
  /// Other work on a result, for instance the files of an export: may fail, may be stopped, reports progress.
  using Task = std::function<Result<void>(pipeline::Evaluation evaluation, const RunContext& context)>;

  explicit EvaluationRunner(QObject* parent = nullptr);
  /// Stops what runs and waits for it.
  ~EvaluationRunner() override;

  /// Evaluates `design` as soon as possible. A running evaluation is stopped at once. If `live` (a hand moves
  /// something), a sketch of it comes first where one can be drawn, and the evaluation only once the hand
  /// rests; where none can, a running evaluation may finish if it takes about as long as the last one, so
  /// that the picture follows the hand.
  void evaluate(const std::shared_ptr<const Design>& design, bool live = false);
  /// Runs `task` on the newest result after the evaluations asked for so far; without one it is refused,
  /// unless it needs none. `done` is called on the interface thread.
  enum class Needs { result, nothing };
  void submit(const QString& name, Task task, std::function<void(const Result<void>&)> done,
              Needs needs = Needs::result);
  /// Gives what was read of the first source beside the evaluations: the next one takes it where it is what
  /// it would read.
  void provide(pipeline::Stage<pipeline::SourceRequest, pipeline::CadSource> source);
  /// Seeks how far something may be moved from the newest result, while nothing else is to be done: `at`
  /// makes the design that is moved by so much, `farthest` at most. What was sought before is forgotten.
  void seekReach(std::function<Design(double)> at, double farthest);
  /// The same of all ways in a plane, after that: `at` makes the design that is moved by so many mm along
  /// both axes of it. Ends with the reach.
  void seekRegion(std::function<Design(const Eigen::Vector2d&)> at);
  void endReach();
  /// Where it is wanted, so that it is known first whether it may go there (`ReachSearch::aim`).
  void aimReach(double by);
  /// What was found of it so far; empty where nothing was.
  const std::optional<pipeline::Reach>& reach() const { return reach_; }
  const std::optional<pipeline::Region>& region() const { return region_; }
  /// Stops whatever runs and forgets what waits.
  void cancel();
  /// Forgets the results (another design was opened).
  void clear();

  bool busy() const { return busy_; }
  double progress() const { return progress_; }
  const QString& step() const { return step_; }

  /// The newest result; stages that failed or were not reached are null. Null before the first.
  const std::shared_ptr<const pipeline::Evaluation>& evaluation() const { return evaluation_; }
  /// The newest result with a sweep, which may belong to an older design than `evaluation()`.
  const std::shared_ptr<const pipeline::Evaluation>& lastComplete() const { return lastComplete_; }
  /// Why the newest evaluation stopped short; empty if it did not.
  const std::optional<Error>& error() const { return error_; }
  /// What follows the hand until the evaluation of its design is there; null while none does.
  const std::shared_ptr<const pipeline::Sketch>& sketch() const { return sketch_; }
  /// The design that `evaluation()` or `error()` belongs to; null before the first.
  const std::shared_ptr<const Design>& evaluatedDesign() const { return evaluatedDesign_; }

 signals:
  /// Work began or ended.
  void busyChanged(bool busy);
  /// `fraction` in [0, 1]; `step` in words.
  void progressed(double fraction, const QString& step);
  /// A newer result (or error) stands in evaluation() and error().
  void finished();
  /// A newer sketch stands in sketch().
  void sketched();
  /// More of what is sought stands in reach() or region().
  void reached();
  /// The user stopped the work; the newest design has no result.
  void cancelled();

 private:
  struct Order {
    std::uint64_t number = 0;
    std::shared_ptr<const Design> design;  // an evaluation, else a task
    Task task;
    std::function<void(const Result<void>&)> done;
    QString name;
    Needs needs = Needs::result;
    bool live = false;
  };

  void work(const std::stop_token& stop);
  /// Adds to a result that was handed out what takes longer, as long as nothing else is asked for, and hands
  /// it out again.
  void thinkAgain(const std::shared_ptr<const pipeline::Evaluation>& first, const std::stop_token& stop,
                  const std::stop_token& end);
  /// Draws a sketch of a live order and waits for the hand to rest. True where a newer design came meanwhile,
  /// so that this one need not be evaluated.
  bool drawSketch(const Order& order, const RunContext& context, const std::stop_token& end);
  /// Begins with the reach and the region asked for last, from the newest result; with mutex_ locked.
  void takeSearch();
  bool soughtAnew() const { return searched_ != reachNumber_ || aroundNumber_ != regionNumber_; }
  /// True if a newer design than the one at work waits; with mutex_ locked.
  bool newerWaits() const;
  /// Draws a sketch and hands it out; false where none can be drawn.
  bool showSketch(std::uint64_t number, const Design& design, const RunContext& context);
  /// Looks at the reach before a hand that is beyond what is known of it is shown there, since it may have to
  /// be led back: meanwhile it is shown as far as is known. False where a newer design came, so that this one
  /// need not be shown.
  bool lookFirst(std::uint64_t number, const RunContext& context, const std::stop_token& end);
  /// One more look at the reach that is sought; false where there is nothing to look for.
  bool lookFarther(const std::stop_token& end);
  /// Holds a border of it against an evaluation until something else is asked for; false where there is none
  /// to hold.
  bool confirmBorder(const std::stop_token& end);
  /// One more look at the region that is sought, until something else is asked for; false likewise.
  bool lookAround(const std::stop_token& end);
  /// Has the worker do what gives way to whatever is asked for; false where something is asked for already.
  bool inPassing(const std::function<void(const RunContext&)>& step);
  /// A step of the search, and what is known after it.
  void seek(const std::function<void()>& step);
  void takeSketch(std::uint64_t number, std::shared_ptr<const pipeline::Sketch> sketch);
  void takeMore(const std::shared_ptr<const pipeline::Evaluation>& before,
                const std::shared_ptr<const pipeline::Evaluation>& more);
  void deliver(const Order& order, std::shared_ptr<const pipeline::Evaluation> evaluation,
               std::optional<Error> error);
  void noteProgress(std::uint64_t number, double fraction, const QString& step);
  void endOrder();
  void stopAll();
  void stopOutdatedRun();

  // Shared with the worker, guarded by mutex_.
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Order> waiting_;
  std::stop_source running_{std::nostopstate};
  bool runningIsEvaluation_ = false;
  bool sketches_ = false;                                 // the worker may draw sketches
  bool secondThoughts_ = false;                           // what runs adds to a result that is there
  std::shared_ptr<const pipeline::Evaluation> previous_;  // with earlier stages, to be used again
  std::shared_ptr<const pipeline::Evaluation> newest_;    // as it came out
  std::shared_ptr<const pipeline::Evaluation> finished_;  // the same, but of none that was stopped

  std::uint64_t reachNumber_ = 0;  // counts what was sought
  std::function<Design(double)> reachAt_;
  double reachFarthest_ = 0;
  double reachAim_ = 0;
  std::uint64_t regionNumber_ = 0;
  std::function<Design(const Eigen::Vector2d&)> regionAt_;

  // Of the worker.
  std::optional<pipeline::Sketcher> sketcher_;  // from the newest result
  std::optional<pipeline::ReachSearch> search_;
  std::optional<pipeline::RegionSearch> around_;
  std::uint64_t searched_ = 0, aroundNumber_ = 0;   // the numbers of these
  std::chrono::steady_clock::time_point onwardAt_;  // the last picture of a hand that its reach follows

  // Of the interface thread.
  std::uint64_t lastNumber_ = 0, firstWanted_ = 0;
  int open_ = 0;  ///< orders given and not yet ended
  bool busy_ = false;
  double progress_ = 0;
  double lastSeconds_ = 0;  ///< that the newest result took
  QString step_;
  std::shared_ptr<const pipeline::Evaluation> evaluation_, lastComplete_;
  std::shared_ptr<const pipeline::Sketch> sketch_;
  std::optional<pipeline::Reach> reach_;
  std::optional<pipeline::Region> region_;
  std::shared_ptr<const Design> evaluatedDesign_;
  std::optional<Error> error_;
  QTimer patience_;

  std::jthread thread_;  // last: it starts when all else is there
};

}  // namespace bw::model
