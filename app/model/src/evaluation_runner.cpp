// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/model/evaluation_runner.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace bw::model {

namespace {

// While a slider is dragged a run may still take half as long again as the last one, within these bounds in
// ms.
constexpr double kLivePatience = 1.5, kLeastPatience = 250, kMostPatience = 1500;
constexpr std::chrono::milliseconds kProgressInterval{30};
constexpr std::chrono::milliseconds kRest{300};      // after a result, before more is added to it
constexpr std::chrono::milliseconds kHandRest{200};  // after a sketch, before its design is evaluated
constexpr std::chrono::milliseconds kLedBack{100};   // that a hand has to go back to its border
constexpr std::chrono::milliseconds kOnward{200};    // between pictures of a hand that its reach follows

/// `now` with the stages that it did not reach taken from `before`: their keys tell later whether they still
/// hold.
std::shared_ptr<const pipeline::Evaluation> withEarlierStages(pipeline::Evaluation now,
                                                              const pipeline::Evaluation* before) {
  if (before) now.takeMissing(*before);
  return std::make_shared<const pipeline::Evaluation>(std::move(now));
}

/// The targets are shown even where a later step failed.
void addMeshes(pipeline::Evaluation& evaluation) {
  for (pipeline::BlockEvaluation& block : evaluation.blocks)
    for (pipeline::CutEvaluation& cut : block.cuts)
      (void)pipeline::meshTarget(cut, nullptr, evaluation.seconds.read);
}

}  // namespace

EvaluationRunner::EvaluationRunner(QObject* parent) : QObject(parent) {
  patience_.setSingleShot(true);
  connect(&patience_, &QTimer::timeout, this, &EvaluationRunner::stopOutdatedRun);
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

EvaluationRunner::~EvaluationRunner() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    running_.request_stop();
  }
  thread_.request_stop();
  thread_.join();
}

void EvaluationRunner::evaluate(const std::shared_ptr<const Design>& design, bool live) {
  int superseded = 0;
  {
    const std::lock_guard lock(mutex_);
    for (auto order = waiting_.begin(); order != waiting_.end();) {
      if (order->design) {
        order = waiting_.erase(order);
        ++superseded;
      } else {
        ++order;
      }
    }
    waiting_.push_back({++lastNumber_, design, {}, {}, {}, Needs::result, live});
    if (((!live || sketches_) && runningIsEvaluation_) || secondThoughts_) running_.request_stop();
  }
  open_ += 1 - superseded;
  wake_.notify_one();
  if (!live)
    patience_.stop();
  else if (!patience_.isActive())
    patience_.start(int(std::clamp(1e3 * kLivePatience * lastSeconds_, kLeastPatience, kMostPatience)));
  if (!std::exchange(busy_, true)) {
    progress_ = 0;
    step_.clear();
    emit busyChanged(true);
  }
}

void EvaluationRunner::submit(const QString& name, Task task, std::function<void(const Result<void>&)> done,
                              Needs needs) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({++lastNumber_, nullptr, std::move(task), std::move(done), name, needs, false});
    if (secondThoughts_) running_.request_stop();
  }
  ++open_;
  wake_.notify_one();
  if (!std::exchange(busy_, true)) {
    progress_ = 0;
    step_ = name;
    emit busyChanged(true);
  }
}

void EvaluationRunner::stopOutdatedRun() {
  const std::lock_guard lock(mutex_);
  if (newerWaits() && runningIsEvaluation_) running_.request_stop();
}

void EvaluationRunner::cancel() {
  stopAll();
  if (std::exchange(sketch_, nullptr)) emit sketched();
  emit cancelled();
}

void EvaluationRunner::stopAll() {
  patience_.stop();
  std::deque<Order> dropped;
  {
    const std::lock_guard lock(mutex_);
    dropped.swap(waiting_);
    running_.request_stop();
  }
  for (const Order& order : dropped) {
    --open_;
    if (order.done) order.done(stoppedError());
  }
  endOrder();
}

void EvaluationRunner::provide(pipeline::Stage<pipeline::SourceRequest, pipeline::CadSource> source) {
  const std::lock_guard lock(mutex_);
  auto next = previous_ ? std::make_shared<pipeline::Evaluation>(*previous_)
                        : std::make_shared<pipeline::Evaluation>();
  next->source = std::move(source);
  previous_ = std::move(next);
}

void EvaluationRunner::clear() {
  stopAll();
  {
    const std::lock_guard lock(mutex_);
    previous_.reset();
    newest_.reset();
    finished_.reset();
    sketches_ = false;
    ++reachNumber_;
    reachAt_ = {};
    ++regionNumber_;
    regionAt_ = {};
  }
  sketch_.reset();
  reach_.reset();
  region_.reset();
  firstWanted_ = lastNumber_ + 1;
  evaluation_.reset();
  lastComplete_.reset();
  evaluatedDesign_.reset();
  error_.reset();
}

void EvaluationRunner::work(const std::stop_token& stop) {
  std::shared_ptr<const pipeline::Evaluation> thought;  // what may be added to
  while (!stop.stop_requested()) {
    Order order;
    std::shared_ptr<const pipeline::Evaluation> previous, newest;
    RunContext context;
    {
      std::unique_lock lock(mutex_);
      while (waiting_.empty()) {
        lock.unlock();
        // How far a hand may go, which waits for it, comes before what takes longer.
        bool looked = lookFarther(stop) || confirmBorder(stop) || lookAround(stop);
        lock.lock();
        if (!looked && thought && thought == newest_ && waiting_.empty()) {
          looked = true;
          running_ = std::stop_source();
          secondThoughts_ = true;
          const std::stop_token stopped = running_.get_token();
          lock.unlock();
          thinkAgain(thought, stopped, stop);
          lock.lock();
          // A hand that takes hold of something puts it off; whatever else stops it ends it.
          const bool putOff = stopped.stop_requested() && soughtAnew();
          thought = putOff && newest_ && newest_->result() ? newest_ : nullptr;
        }
        const auto asked = [this] { return !waiting_.empty() || soughtAnew(); };
        if (!looked && !wake_.wait(lock, stop, asked)) return;
      }
      order = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = std::stop_source();
      // A sketch is drawn to its end, so that pictures follow a hand however fast it is.
      runningIsEvaluation_ = order.design != nullptr && !(order.live && sketches_);
      context.stop = running_.get_token();
      previous = previous_;
      newest = newest_;
      takeSearch();  // as long as the result is the one that something is moved from
    }
    context.progress = [this, number = order.number, last = std::chrono::steady_clock::time_point()](
                           double fraction, std::string_view step) mutable {
      const auto now = std::chrono::steady_clock::now();
      if (now - last < kProgressInterval) return;
      last = now;
      QMetaObject::invokeMethod(
          this,
          [this, number, fraction, text = QString::fromUtf8(step.data(), qsizetype(step.size()))] {
            noteProgress(number, fraction, text);
          },
          Qt::QueuedConnection);
    };

    std::shared_ptr<const pipeline::Evaluation> evaluation;
    std::optional<Error> error;
    try {
      if (drawSketch(order, context, stop)) {
        error = stoppedError().value();
      } else if (order.design) {
        if (std::optional<pipeline::Evaluation> called =
                previous ? pipeline::calledAs(*previous, *order.design) : std::nullopt)
          previous = std::make_shared<const pipeline::Evaluation>(*std::move(called));
        pipeline::Outcome outcome = pipeline::evaluate(*order.design, previous.get(), context);
        error = std::move(outcome.error);
        if (error && error->code != ErrorCode::cancelled) addMeshes(outcome.evaluation);
        if (!error || error->code != ErrorCode::cancelled)
          pipeline::addFaceMesh(outcome.evaluation, previous.get(), context);
        evaluation = std::make_shared<const pipeline::Evaluation>(std::move(outcome.evaluation));
        if (!error) sketcher_.emplace(evaluation);
        const std::lock_guard lock(mutex_);
        newest_ = evaluation;
        if (!error || error->code != ErrorCode::cancelled) finished_ = evaluation;
        previous_ = withEarlierStages(*evaluation, previous.get());
        sketches_ = sketches_ || !error;
        // What was sought while there was nothing to go out from is looked for now.
        constexpr auto kNone = std::uint64_t(-1);
        if (!error && reachAt_ && !search_) searched_ = kNone;
        if (!error && regionAt_ && !around_) aroundNumber_ = kNone;
      } else if (order.needs == Needs::result && (!newest || !newest->result())) {
        error = Error{ErrorCode::badInput,
                      "the design has no finished result; mend what stands under Messages first"};
      } else if (Result<void> done = order.task(newest ? *newest : pipeline::Evaluation(), context); !done) {
        error = done.error();
      }
    } catch (const std::exception& exception) {
      error = Error{ErrorCode::internal, std::string("the computation broke off: ") + exception.what() +
                                             "; change the setting that was edited last or report this"};
    }
    // A task leaves the result as it is, and what was to be added to that is not forgotten.
    thought = order.design ? (error ? nullptr : evaluation) : newest && newest->result() ? newest : nullptr;
    {
      const std::lock_guard lock(mutex_);
      running_ = std::stop_source(std::nostopstate);
      runningIsEvaluation_ = false;
    }
    QMetaObject::invokeMethod(
        this, [this, order, evaluation, error] { deliver(order, evaluation, error); }, Qt::QueuedConnection);
  }
}

bool EvaluationRunner::drawSketch(const Order& order, const RunContext& context, const std::stop_token& end) {
  {
    const std::lock_guard lock(mutex_);
    if (!order.live || !sketches_) return false;
  }
  if (!lookFirst(order.number, context, end)) return true;
  const bool drawn = showSketch(order.number, *order.design, context);
  // Beyond what can be sketched the hand may lead back as soon as its reach is known. That is found to its
  // end first: an evaluation of what cannot be cut, and the advice on it, may take a hundred times as long.
  if (drawn || search_) {
    const auto until = std::chrono::steady_clock::now() + kHandRest;
    const auto asked = [this] { return !waiting_.empty(); };
    const auto goesOn = [this, until] {
      return (search_ && search_->looking()) || std::chrono::steady_clock::now() < until;
    };
    std::unique_lock lock(mutex_);
    while (!asked() && !end.stop_requested() && goesOn()) {
      lock.unlock();
      const bool looked = lookFarther(end);
      lock.lock();
      if (!looked) wake_.wait_until(lock, end, until, asked);
    }
    if (newerWaits() || end.stop_requested()) return true;
  }
  const std::lock_guard lock(mutex_);
  runningIsEvaluation_ = true;
  // Where none can be drawn the evaluation is what follows the hand: the next move does not stop it, and
  // sketches go on from its result.
  sketches_ = sketches_ && drawn;
  return false;
}

void EvaluationRunner::seekReach(std::function<Design(double)> at, double farthest) {
  reach_.reset();
  {
    const std::lock_guard lock(mutex_);
    ++reachNumber_;
    reachAt_ = std::move(at);
    reachFarthest_ = farthest;
    reachAim_ = 0;
    if (secondThoughts_) running_.request_stop();
  }
  wake_.notify_one();
}

void EvaluationRunner::seekRegion(std::function<Design(const Eigen::Vector2d&)> at) {
  region_.reset();
  {
    const std::lock_guard lock(mutex_);
    ++regionNumber_;
    regionAt_ = std::move(at);
    if (secondThoughts_) running_.request_stop();
  }
  wake_.notify_one();
}

void EvaluationRunner::endReach() {
  seekReach({}, 0);
  seekRegion({});
}

void EvaluationRunner::aimReach(double by) {
  const std::lock_guard lock(mutex_);
  reachAim_ = by;
}

void EvaluationRunner::takeSearch() {
  // A move of the hand stops the evaluation of the one before, and with it nothing that is known.
  const bool possible = sketches_ && finished_ && finished_->result();
  if (std::exchange(aroundNumber_, regionNumber_) != regionNumber_) {
    around_.reset();
    if (regionAt_ && possible) around_.emplace(finished_, regionAt_);
  }
  if (std::exchange(searched_, reachNumber_) == reachNumber_) return;
  search_.reset();
  onwardAt_ = std::chrono::steady_clock::now();
  if (reachAt_ && possible) search_.emplace(finished_, reachAt_, reachFarthest_);
}

bool EvaluationRunner::newerWaits() const {
  return std::ranges::any_of(waiting_, [](const Order& order) { return order.design != nullptr; });
}

bool EvaluationRunner::showSketch(std::uint64_t number, const Design& design, const RunContext& context) {
  std::optional<pipeline::Sketch> sketch = sketcher_->draw(design, context);
  if (!sketch) return false;
  QMetaObject::invokeMethod(
      this,
      [this, number, drawn = std::make_shared<const pipeline::Sketch>(std::move(*sketch))]() mutable {
        takeSketch(number, std::move(drawn));
      },
      Qt::QueuedConnection);
  return true;
}

bool EvaluationRunner::lookFirst(std::uint64_t number, const RunContext& context,
                                 const std::stop_token& end) {
  for (bool looked = false; !end.stop_requested() && !context.stopped(); looked = true) {
    double aim = 0;
    {
      std::unique_lock lock(mutex_);
      aim = reachAim_;
      // Of another way nothing is known yet, and a hand may change its way at each of its moves.
      if (searched_ != reachNumber_ || !search_) return true;
      const bool seeks = search_->seeks(aim);
      // Who was just told that it goes no farther moves it back.
      if (looked && !seeks && search_->bars(aim))
        wake_.wait_for(lock, end, kLedBack, [this] { return newerWaits(); });
      if (looked && newerWaits()) return false;
      if (!seeks) return true;
    }
    if (!lookFarther(end) || !search_) return true;
    const auto now = std::chrono::steady_clock::now();
    if (now - onwardAt_ < kOnward || !search_->seeks(aim) || search_->reach().now != pipeline::Bar::none)
      continue;
    showSketch(number, search_->towards(aim), context);
    onwardAt_ = std::chrono::steady_clock::now();
  }
  return false;
}

bool EvaluationRunner::lookFarther(const std::stop_token& end) {
  {
    const std::lock_guard lock(mutex_);
    takeSearch();
    if (search_) search_->aim(reachAim_);
  }
  if (!search_ || !search_->looking() || end.stop_requested()) return false;
  RunContext context;
  context.stop = end;
  seek([&] { search_->look(context); });
  return true;
}

bool EvaluationRunner::inPassing(const std::function<void(const RunContext&)>& step) {
  RunContext context;
  {
    const std::lock_guard lock(mutex_);
    if (!waiting_.empty()) return false;
    running_ = std::stop_source();
    context.stop = running_.get_token();
    secondThoughts_ = true;
  }
  step(context);
  const std::lock_guard lock(mutex_);
  running_ = std::stop_source(std::nostopstate);
  secondThoughts_ = false;
  return true;
}

bool EvaluationRunner::confirmBorder(const std::stop_token& end) {
  if (!search_ || !search_->unsure() || end.stop_requested()) return false;
  {
    const std::lock_guard lock(mutex_);
    search_->aim(reachAim_);
  }
  inPassing([this](const RunContext& context) { seek([&] { search_->confirm(context); }); });
  return true;
}

bool EvaluationRunner::lookAround(const std::stop_token& end) {
  if (!around_ || !around_->looking() || end.stop_requested()) return false;
  inPassing([this](const RunContext& context) {
    try {
      around_->look(context);
    } catch (const std::exception&) {
      around_.reset();  // what was found until now stands
      return;
    }
    QMetaObject::invokeMethod(
        this,
        [this, number = aroundNumber_, region = around_->region()] {
          {
            const std::lock_guard lock(mutex_);
            if (number != regionNumber_) return;
          }
          region_ = region;
          emit reached();
        },
        Qt::QueuedConnection);
  });
  return true;
}

void EvaluationRunner::seek(const std::function<void()>& step) {
  try {
    step();
  } catch (const std::exception&) {
    search_.reset();  // what was found until now stands
    return;
  }
  QMetaObject::invokeMethod(
      this,
      [this, number = searched_, reach = search_->reach()] {
        {
          const std::lock_guard lock(mutex_);
          if (number != reachNumber_) return;
        }
        reach_ = reach;
        emit reached();
      },
      Qt::QueuedConnection);
}

void EvaluationRunner::takeSketch(std::uint64_t number, std::shared_ptr<const pipeline::Sketch> sketch) {
  if (number < firstWanted_) return;
  sketch_ = std::move(sketch);
  emit sketched();
}

void EvaluationRunner::thinkAgain(const std::shared_ptr<const pipeline::Evaluation>& first,
                                  const std::stop_token& stop, const std::stop_token& end) {
  {
    // While a hand moves something the next design comes soon.
    std::unique_lock lock(mutex_);
    const bool asked = wake_.wait_for(lock, end, kRest, [this] { return !waiting_.empty(); });
    if (asked || end.stop_requested() || stop.stop_requested()) {
      running_ = std::stop_source(std::nostopstate);
      secondThoughts_ = false;
      return;
    }
  }
  RunContext context;
  context.stop = stop;
  for (std::shared_ptr<const pipeline::Evaluation> now = first;;) {
    pipeline::Evaluation more = *now;
    bool added = false;
    try {
      added = pipeline::addSecondThought(more, context);
    } catch (const std::exception&) {
      // What stands is not touched by what was to come on top of it.
    }
    auto next = std::make_shared<const pipeline::Evaluation>(std::move(more));
    const std::lock_guard lock(mutex_);
    added = added && newest_ == now;
    if (added) {
      newest_ = finished_ = next;
      previous_ = withEarlierStages(*next, previous_.get());
      QMetaObject::invokeMethod(
          this, [this, now, next] { takeMore(now, next); }, Qt::QueuedConnection);
    }
    if (!added || stop.stop_requested()) {
      running_ = std::stop_source(std::nostopstate);
      secondThoughts_ = false;
      return;
    }
    now = std::move(next);
  }
}

void EvaluationRunner::takeMore(const std::shared_ptr<const pipeline::Evaluation>& before,
                                const std::shared_ptr<const pipeline::Evaluation>& more) {
  if (evaluation_ != before) return;
  if (lastComplete_ == before) lastComplete_ = more;
  evaluation_ = more;
  emit finished();
}

void EvaluationRunner::noteProgress(std::uint64_t number, double fraction, const QString& step) {
  if (number < firstWanted_) return;
  progress_ = fraction;
  if (!step.isEmpty()) step_ = step;
  emit progressed(progress_, step_);
}

void EvaluationRunner::deliver(const Order& order, std::shared_ptr<const pipeline::Evaluation> evaluation,
                               std::optional<Error> error) {
  --open_;
  const bool wanted = order.number >= firstWanted_;
  const bool stopped = error && error->code == ErrorCode::cancelled;
  if (order.design) {
    if (wanted && !stopped && evaluation) {
      // An older run that was allowed to finish while a slider moves is shown too: the newer follows.
      if (evaluation->result()) lastComplete_ = evaluation;
      lastSeconds_ = evaluation->seconds.total;
      evaluation_ = std::move(evaluation);
      sketch_.reset();
      evaluatedDesign_ = order.design;
      error_ = std::move(error);
      patience_.stop();
      emit finished();
    }
  } else if (order.done) {
    order.done(error ? Result<void>(tl::unexpected<Error>(*error)) : Result<void>());
  }
  endOrder();
}

void EvaluationRunner::endOrder() {
  if (open_ == 0 && std::exchange(busy_, false)) {
    progress_ = 0;
    step_.clear();
    emit busyChanged(false);
  }
}

}  // namespace bw::model
