// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/blade_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "bw/core/sweep/firm_row.h"
#include "sweep/row_between.h"

namespace bw {

namespace {

constexpr std::size_t kTried = 30;  // sections of the row
constexpr double kStep = 5;         // mm: lengths are its multiples
constexpr double kLonger = 1.025;   // each length that is tried first, of the one before
constexpr double kCoarser = 1.05;   // and from kFine on
constexpr int kFine = 8;
constexpr int kFirst = 16;          // of these, at least: the longest is 1.8 times the shortest
constexpr std::size_t kAtOnce = 4;  // of these; where the last ones serve no more, no longer one is tried
constexpr std::array kMargins = {0.0, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6};
constexpr std::size_t kNearer = 12;  // lengths at most with one smaller clearance
constexpr double kShortest = 0.99;   // of the longest section: what a blade has between its leads at least

double rounded(double length) { return kStep * std::round(length / kStep); }

/// Sections of a row that blades are tried on.
struct Some {
  std::vector<Section> sections;
  bool all = false;  ///< of the row: then a blade goes from one to the next as it will
};

/// Some of the sections, evenly, and the longest.
Some someOf(const std::vector<Section>& all) {
  std::vector<const Section*> chosen;
  for (const Section& section : all)
    if (section.chosen >= 0) chosen.push_back(&section);
  std::set<std::size_t> taken;
  for (std::size_t k = 0; k < kTried && !chosen.empty(); ++k)
    taken.insert((chosen.size() - 1) * k / (kTried - 1));
  const auto longest =
      std::ranges::max_element(chosen, {}, [](const Section* section) { return section->curve().length(); });
  if (longest != chosen.end()) taken.insert(std::size_t(longest - chosen.begin()));
  Some some{{}, taken.size() == chosen.size()};
  for (const std::size_t i : taken) some.sections.push_back(*chosen[i]);
  return some;
}

/// All that blades follow.
Some allOf(const std::vector<Section>& sections) {
  Some all{{}, true};
  std::ranges::copy_if(sections, std::back_inserter(all.sections),
                       [](const Section& section) { return section.chosen >= 0; });
  return all;
}

/// True if the grips are far enough from the block, and the blade from what it lies on.
bool reachesFar(const StationCheck& station, const CheckRequest& request) {
  return station.clearance >= request.clearance && !station.nearBottom;
}

/// Tries blades on a row.
class Trials {
 public:
  Trials(const Some& some, const Box& block, const PlaneFamily& planes, const RunContext& context,
         int threads = 1)
      : some_(some), block_(block), planes_(planes) {
    quiet_.stop = context.stop;
    quiet_.threads = threads;
  }

  RowTrial operator()(const LengthRequest& request) const {
    const FitRequest& fit = request.fit;
    RowTrial trial{fit.blade.length};
    trial.asked = request.check.margin;
    trial.clearance = request.check.clearance;
    Findings unused;
    const Result<Sweep> sweep = buildSweep(some_.sections, fit, block_, planes_, quiet_, unused);
    if (!sweep) return trial;
    trial.reaches = true;
    // What is told soonest comes first: to seek other shapes takes ten times as long as all before it.
    if (!look(trial, *sweep, request) || !leads(planEntryExit(*sweep, request.ends, quiet_))) return trial;
    const Result<FirmRow> firm = firmRow(*sweep, quiet_, some_.all ? Along::ways : Along::stations);
    if (!firm) return trial;
    const Sweep& row = firm->row ? *firm->row : *sweep;
    if (firm->row && !look(trial, row, request)) return trial;
    trial.rest = restOn(row, firm->certainty, request);
    if (trial.serves() && !staysWithGripsOff(row, request.check)) trial.rest = Rest::lost;
    if (!some_.all || !trial.serves()) return trial;
    const Result<double> between = sweep::offBetween(row, quiet_);
    if (!between || std::isinf(*between))
      trial.rest = Rest::lost;
    else
      trial.deviation = std::max(trial.deviation, *between);
    if (!trial.serves()) return trial;
    // As robots move its grips: what it does on the way is all that this finds.
    const Result<RowMotion> way = followRow(row, request.follow, quiet_);
    if (!way || !way->findings.empty()) trial.rest = Rest::lost;
    return trial;
  }

 private:
  /// What the stations of a row tell; true if they keep the rules.
  bool look(RowTrial& trial, const Sweep& sweep, const LengthRequest& request) const {
    CheckRequest limits = request.check;
    limits.gripError = limits.gripAngle = 0;  // takes long: asked where all else serves
    const Result<SweepCheck> check = checkSweep(sweep, limits, quiet_);
    if (!check) return false;
    trial.reaches = true;
    trial.margin = 1;
    trial.deviation = 0;
    for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
      const StationCheck& seen = check->stations[i];
      trial.margin = std::min({trial.margin, seen.stabilityMargin, seen.outOfPlaneMargin});
      // What its weight brought into another shape may rest firmly there.
      if (!seen.stable || !sweep.fits[i].unknown.empty()) trial.margin = std::min(trial.margin, 0.0);
      trial.deviation = std::max(trial.deviation, sweep.fits[i].fit.hausdorff);
      trial.reaches = trial.reaches && reachesFar(seen, request.check);
    }
    return keepsLimits(sweep, *check, request.check) && trial.deviation <= request.check.tolerance;
  }

  bool staysWithGripsOff(const Sweep& row, const CheckRequest& limits) const {
    const Result<SweepCheck> check = checkSweep(row, limits, quiet_);
    return check && std::ranges::none_of(check->stations, &StationCheck::snapsByGrip);
  }

  /// True if a way leads into the row, and one out of it.
  static bool leads(const Result<EntryExit>& ends) {
    return ends && !ends->entry.poses.empty() && !ends->exit.poses.empty();
  }

  /// How the worst of the stations rests, the way between them let be.
  Rest restOn(const Sweep& sweep, const RowCertainty& certainty, const LengthRequest& request) const {
    Rest worst = Rest::certain;
    for (const StationCertainty& station : certainty.stations) {
      if (station.certain()) continue;
      if (!std::isfinite(station.energy)) return Rest::lost;
      worst = Rest::held;
    }
    const std::optional<double> barrier = certainty.leastBarrier();
    if (!barrier || *barrier < kLeastBarrier) return Rest::lost;
    const Result<EntryExit> ends = planEntryExit(sweep, request.ends, quiet_);
    if (!leads(ends)) return Rest::lost;
    return worst == Rest::certain || ends->entry.margin >= request.check.margin ? worst : Rest::lost;
  }

  const Some& some_;
  const Box& block_;
  const PlaneFamily& planes_;
  RunContext quiet_;
};

/// What lies too far from the sections does not serve, however firmly it rests.
void judgeDistance(RowTrial& trial, double tolerance) {
  if (trial.deviation > tolerance) trial.rest = Rest::lost;
}

/// The request with another blade length, clearance and margin.
LengthRequest requestFor(LengthRequest request, double length, double clearance, double margin) {
  request.fit.blade.length = length;
  request.fit.blade.autoLength = false;
  request.fit.clearance = request.check.clearance = clearance;
  request.fit.margin = request.check.margin = request.ends.margin = margin;
  return request;
}

/// The best of those that serve; null if none does.
template <class Trade>
RowTrial* bestOf(Trade& trade) {
  RowTrial* best = nullptr;
  for (RowTrial& one : trade.trials)
    if (one.serves() && (!best || trade.isBetter(one, *best))) best = &one;
  return best;
}

/// Of those that are about as firm as the firmest the shortest: more of a blade hangs lower, and lies farther
/// off, for next to nothing.
RowTrial* bestOf(BladeLengths& lengths) {
  constexpr double kAsFirm = 0.85;
  RowTrial* firmest = nullptr;
  for (RowTrial& one : lengths.trials)
    if (one.serves() && (!firmest || isFirmer(one, *firmest))) firmest = &one;
  for (RowTrial& one : lengths.trials)  // ascending
    if (one.serves() && one.rest == firmest->rest && one.margin >= kAsFirm * firmest->margin) return &one;
  return firmest;
}

/// The one to ask about after one that was refused, if any was.
template <class Trade>
RowTrial* nextOf(Trade& trade, const RowTrial*) {
  return bestOf(trade);
}

/// Of lengths that are as firm the neighbours of one that was refused would be refused, too: the one farthest
/// from all that do not serve and from the ends of what was tried.
RowTrial* nextOf(BladeLengths& lengths, const RowTrial* refused) {
  RowTrial* best = bestOf(lengths);
  if (!refused || !best || std::abs(best - refused) > 1) return best;
  constexpr double kAsFirm = 1e-3;  // of margin
  RowTrial* next = nullptr;
  double most = -1;
  for (RowTrial& one : lengths.trials) {
    if (!one.serves() || one.rest != best->rest || one.margin < best->margin - kAsFirm) continue;
    double room =
        std::min(one.length / lengths.trials.front().length, lengths.trials.back().length / one.length);
    for (const RowTrial& other : lengths.trials)
      if (!other.serves())
        room = std::min(room, std::max(one.length / other.length, other.length / one.length));
    if (room <= most) continue;
    most = room;
    next = &one;
  }
  return next;
}

/// The first of those that serve, the best first, that serves as a whole; null if none is known to.
template <class Trade>
const RowTrial* confirmedOf(Trade& trade, const ServesWhole& whole) {
  const RowTrial* found = nullptr;
  const RowTrial* refused = nullptr;  // the last one
  bool misled = false;                // by the sections that were tried
  for (int asked = 0; asked < kMostConfirmed && !found; ++asked) {
    RowTrial* best = nextOf(trade, refused);
    if (!best) return nullptr;
    if (whole(*best)) {
      found = best;
    } else {
      best->rest = Rest::lost;
      refused = best;
      misled = true;
    }
  }
  for (RowTrial& one : trade.trials)
    if (misled && &one != found && one.serves()) one.rest = Rest::unknown;
  return found;
}

/// Tries on all sections, one at a time with all threads, what was tried on some.
class OnAll {
 public:
  OnAll(const std::vector<Section>& sections, const Some& some, const LengthRequest& request,
        const Box& block, const PlaneFamily& planes, const RunContext& context)
      : known_(some.all),
        all_(known_ ? Some() : allOf(sections)),
        request_(request),
        trial_(all_, block, planes, context, context.threads) {}
  OnAll(const OnAll&) = delete;  // its trials look at its own sections
  OnAll& operator=(const OnAll&) = delete;

  bool operator()(RowTrial& trial) const {
    if (known_) return true;
    trial = trial_(requestFor(request_, trial.length, trial.clearance, trial.asked));
    judgeDistance(trial, request_.check.tolerance);
    return trial.serves();
  }

 private:
  bool known_;
  Some all_;
  const LengthRequest& request_;
  Trials trial_;
};

/// What tells whether a trial serves: as asked for, or on all sections.
template <class... Arguments>
ServesWhole wholeOr(const ServesWhole& asked, const Arguments&... arguments) {
  if (asked) return asked;
  return [all = std::make_shared<const OnAll>(arguments...)](RowTrial& trial) { return (*all)(trial); };
}

Result<Some> sectionsToTry(const std::vector<Section>& all) {
  Some some = someOf(all);
  if (some.sections.empty())
    return fail(ErrorCode::badInput,
                "there are no sections to try blades on; place the block so that it meets the target",
                "sections", 0.0, 1.0);
  return some;
}

double longestOf(const std::vector<Section>& sections) {
  double longest = 0;
  for (const Section& section : sections) longest = std::max(longest, section.curve().length());
  return longest;
}

/// The shortest blade that may reach to grips so far from the block.
double shortestFor(double longest, double clearance) {
  return std::ceil((kShortest * longest + 2 * clearance) / kStep) * kStep;
}

/// A length with which grips are clear of a block on both sides, if the blade between them is not much bent.
double enoughFor(const Box& block, const Frame& plane, double clearance) {
  constexpr double kBent = 1.3;
  const double width = block.size.x() * std::abs(block.frame.x.dot(plane.x)) +
                       block.size.y() * std::abs(block.frame.y.dot(plane.x)) +
                       block.size.z() * std::abs(block.frame.normal.dot(plane.x));
  return kBent * (width + 2 * clearance);
}

/// The lengths that are tried first, ascending: so many, and more as long as they are not `enough`.
std::vector<double> lengthsFrom(double shortest, double enough) {
  constexpr int kMost = 3 * kFirst;
  std::vector<double> lengths;
  double next = shortest;
  for (int i = 0; (i < kFirst || (i < kMost && next <= enough)) && next <= Blade::kLongest; ++i) {
    lengths.push_back(next);
    next = std::max(next + kStep, rounded((i < kFine ? kLonger : kCoarser) * next));
  }
  return lengths;
}

/// Those that a smaller clearance makes possible, ascending: finely at first, where a slack blade is firmest.
std::vector<double> lengthsBetween(double shortest, double end) {
  std::vector<double> lengths;
  double next = shortest;
  for (std::size_t i = 0; i < kNearer && next < end; ++i) {
    lengths.push_back(next);
    next = i + 1 < kAtOnce ? next + kStep : std::max(next + kStep, rounded(kLonger * next));
  }
  return lengths;
}

/// Lets grips come nearer to the block.
class NearerGrips {
 public:
  NearerGrips(const Some& some, const LengthRequest& request, const Box& block, const PlaneFamily& planes,
              const RunContext& context)
      : request_(request),
        context_(context),
        trial_(some, block, planes, context),
        longest_(longestOf(some.sections)) {
    if (!request.fit.blade.autoLength) trade_.own = request.fit.blade.length;
  }

  Result<ClearanceTrade> seek() {
    double low = kLeastClearance, high = request_.check.clearance;
    if (high <= low) return trade_;
    Result<bool> serves = servesAt(low);
    if (!serves || !*serves) high = low;
    while (high - low > kStep) {
      const double middle = std::max(low + kStep, rounded(0.5 * (low + high)));
      if (middle >= high) break;
      serves = servesAt(middle);
      if (!serves) break;
      (*serves ? low : high) = middle;
    }
    if (!serves) return tl::unexpected<Error>(serves.error());
    std::ranges::sort(trade_.trials, {}, [](const RowTrial& t) { return std::pair(t.clearance, t.length); });
    return std::move(trade_);
  }

 private:
  /// Whether some length serves on the sections.
  Result<bool> servesAt(double clearance) {
    std::vector<double> lengths =
        lengthsBetween(shortestFor(longest_, clearance), shortestFor(longest_, request_.check.clearance));
    if (trade_.own) {
      std::erase(lengths, *trade_.own);
      lengths.insert(lengths.begin(), *trade_.own);
    }
    for (std::size_t first = 0; first < lengths.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, lengths.size() - first);
      Result<std::vector<RowTrial>> made = tryAll(clearance, &lengths[first], count);
      if (!made) return tl::unexpected<Error>(made.error());
      trade_.trials.insert(trade_.trials.end(), made->begin(), made->end());
      if (std::ranges::any_of(*made, &RowTrial::serves)) return true;
    }
    return false;
  }

  Result<std::vector<RowTrial>> tryAll(double clearance, const double* lengths, std::size_t count) {
    std::vector<RowTrial> made(count);
    const Result<void> ok = parallelFor(context_, int(count), [&](int i) {
      made[std::size_t(i)] = trial_(requestFor(request_, lengths[i], clearance, request_.check.margin));
      judgeDistance(made[std::size_t(i)], request_.check.tolerance);
    });
    if (!ok) return tl::unexpected<Error>(ok.error());
    if (context_.stopped()) return stoppedError();
    return made;
  }

  const LengthRequest& request_;
  const RunContext& context_;
  Trials trial_;
  double longest_;
  ClearanceTrade trade_;
};

}  // namespace

bool keepsLimits(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request) {
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    const StationCheck& seen = check.stations[i];
    if (!seen.stable || seen.stabilityMargin < request.margin || seen.outOfPlaneMargin <= 0 ||
        seen.sideways > request.tolerance || seen.crossesItself || seen.gripsSwapped ||
        !reachesFar(seen, request) || !sweep.fits[i].unknown.empty() ||
        sweep.poses[i].maxCurvature() > sweep.request.blade.maxCurvature())
      return false;
  }
  return true;
}

bool isFirmer(const RowTrial& a, const RowTrial& b) {
  if (a.rest != b.rest) return a.rest == Rest::certain;
  return a.margin > b.margin;
}

bool MarginTrade::isBetter(const RowTrial& a, const RowTrial& b) const {
  if ((a.asked >= least) != (b.asked >= least)) return a.asked >= least;
  return a.asked >= least ? a.asked < b.asked : a.asked > b.asked;
}

bool ClearanceTrade::isBetter(const RowTrial& a, const RowTrial& b) const {
  if (a.clearance != b.clearance) return a.clearance > b.clearance;
  return (a.length == own) != (b.length == own) ? a.length == own : isFirmer(a, b);
}

std::vector<BladeLengths::Band> BladeLengths::bands() const {
  std::vector<Band> found;
  bool onward = false;
  for (const RowTrial& trial : trials) {
    if (onward && trial.serves() && found.back().rest == trial.rest)
      found.back().to = trial.length;
    else if (trial.serves())
      found.push_back({trial.length, trial.length, trial.rest});
    onward = trial.serves();
  }
  return found;
}

const RowTrial* BladeLengths::at(double length) const {
  const auto after = std::ranges::upper_bound(trials, length, {}, &RowTrial::length);
  return after == trials.begin() ? nullptr : &*(after - 1);
}

void confirm(BladeLengths& lengths, const ServesWhole& whole) {
  const RowTrial* best = confirmedOf(lengths, whole);
  lengths.best = best ? std::optional(best->length) : std::nullopt;
}

void confirm(MarginTrade& trade, const ServesWhole& whole) {
  const RowTrial* best = confirmedOf(trade, whole);
  trade.best = best ? std::optional(best->asked) : std::nullopt;
}

void confirm(ClearanceTrade& trade, const ServesWhole& whole) {
  const RowTrial* best = confirmedOf(trade, whole);
  trade.best = best ? std::optional(*best) : std::nullopt;
}

Result<BladeLengths> bladeLengths(const std::vector<Section>& sections, const LengthRequest& request,
                                  const Box& block, const PlaneFamily& planes, const RunContext& context,
                                  const ServesWhole& whole) {
  const Result<Some> some = sectionsToTry(sections);
  if (!some) return tl::unexpected<Error>(some.error());
  const Trials trial(*some, block, planes, context);
  BladeLengths lengths;
  lengths.stations = int(some->sections.size());
  std::vector<RowTrial>& trials = lengths.trials;
  const auto tryAll = [&](const std::set<double>& asked) -> Result<bool> {
    const std::vector<double> list(asked.begin(), asked.end());
    std::vector<RowTrial> made(list.size());
    const Result<void> ok = parallelFor(context, int(list.size()), [&](int i) {
      made[std::size_t(i)] =
          trial(requestFor(request, list[std::size_t(i)], request.check.clearance, request.check.margin));
    });
    if (!ok) return tl::unexpected<Error>(ok.error());
    if (context.stopped()) return stoppedError();
    trials.insert(trials.end(), made.begin(), made.end());
    std::ranges::sort(trials, {}, &RowTrial::length);
    return std::ranges::any_of(made, &RowTrial::serves);
  };

  bool served = false;
  const std::vector<double> ladder =
      lengthsFrom(shortestFor(longestOf(some->sections), request.check.clearance),
                  enoughFor(block, some->sections.front().frame, request.check.clearance));
  for (std::size_t first = 0; first < ladder.size(); first += kAtOnce) {
    const std::size_t last = std::min(first + kAtOnce, ladder.size());
    const Result<bool> serves =
        tryAll({ladder.begin() + std::ptrdiff_t(first), ladder.begin() + std::ptrdiff_t(last)});
    if (!serves) return tl::unexpected<Error>(serves.error());
    if (served && !*serves) break;
    served = served || *serves;
  }
  for (;;) {
    std::set<double> asked;
    for (std::size_t i = 1; i < trials.size(); ++i)
      if ((trials[i].rest != trials[i - 1].rest || trials[i].reaches != trials[i - 1].reaches) &&
          trials[i].length - trials[i - 1].length > kStep)
        asked.insert(rounded(0.5 * (trials[i].length + trials[i - 1].length)));
    if (asked.empty()) break;
    if (const Result<bool> serves = tryAll(asked); !serves) return tl::unexpected<Error>(serves.error());
  }

  for (RowTrial& one : trials) judgeDistance(one, request.check.tolerance);
  confirm(lengths, wholeOr(whole, sections, *some, request, block, planes, context));
  if (context.stopped()) return stoppedError();
  return lengths;
}

void findNearest(BladeLengths& lengths, const std::vector<Section>& sections, const LengthRequest& request,
                 const Box& block, const PlaneFamily& planes, const RunContext& context) {
  constexpr int kMost = 8;
  const Result<Some> some = sectionsToTry(sections);
  if (lengths.trials.empty() || !some) return;
  const OnAll onAll(sections, *some, request, block, planes, context);
  const auto nearness = [](const RowTrial& trial) {
    const bool rests = trial.reaches && trial.margin > 0;
    return std::pair(rests, rests ? -trial.deviation : trial.margin);
  };
  std::set<double> known;
  const auto nearest = [&] { return std::ranges::max_element(lengths.trials, {}, nearness); };
  while (int(known.size()) < kMost && !context.stopped() && known.insert(nearest()->length).second)
    onAll(*nearest());
  // Of those that were looked at, as far as there are any.
  const auto onKnown = [&](const RowTrial& trial) {
    return std::pair(known.contains(trial.length), nearness(trial));
  };
  lengths.nearest = std::ranges::max_element(lengths.trials, {}, onKnown)->length;
}

Result<MarginTrade> marginTrade(const std::vector<Section>& sections, const LengthRequest& request,
                                const Box& block, const PlaneFamily& planes, const RunContext& context,
                                const ServesWhole& whole) {
  const Result<Some> some = sectionsToTry(sections);
  if (!some) return tl::unexpected<Error>(some.error());
  for (const Section& section : some->sections)
    if (section.curve().length() > request.fit.blade.length)
      return fail(ErrorCode::badInput, "the blade is shorter than a section; take a longer one first",
                  "blade", request.fit.blade.length, section.curve().length());
  std::set<double> asked(kMargins.begin(), kMargins.end());
  asked.insert(request.check.margin);
  const std::vector<double> list(asked.begin(), asked.end());
  const Trials trial(*some, block, planes, context);
  MarginTrade trade;
  trade.least = request.check.margin;
  trade.trials.resize(list.size());
  const Result<void> ok = parallelFor(context, int(list.size()), [&](int i) {
    trade.trials[std::size_t(i)] =
        trial(requestFor(request, request.fit.blade.length, request.check.clearance, list[std::size_t(i)]));
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  for (RowTrial& one : trade.trials) judgeDistance(one, request.check.tolerance);
  confirm(trade, wholeOr(whole, sections, *some, request, block, planes, context));
  if (context.stopped()) return stoppedError();
  return trade;
}

Result<ClearanceTrade> clearanceTrade(const std::vector<Section>& sections, const LengthRequest& request,
                                      const Box& block, const PlaneFamily& planes, const RunContext& context,
                                      const ServesWhole& whole) {
  const Result<Some> some = sectionsToTry(sections);
  if (!some) return tl::unexpected<Error>(some.error());
  Result<ClearanceTrade> trade = NearerGrips(*some, request, block, planes, context).seek();
  if (!trade) return trade;
  confirm(*trade, wholeOr(whole, sections, *some, request, block, planes, context));
  if (context.stopped()) return stoppedError();
  return trade;
}

}  // namespace bw
