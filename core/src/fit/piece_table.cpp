// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/piece_table.h"

#include <algorithm>
#include <cmath>
#include "bw/core/base/units.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// Phases a period, and steps in which a period is integrated.
constexpr std::size_t kPhases = 16;
constexpr std::size_t kSteps = 192;
// Largest angle against the force of what swings, and modulus of what turns over.
constexpr std::array kSwings = {0.2, 0.5, 0.8, 1.1, 1.4, 1.7, 2.0, 2.3, 2.6, 2.85, 3.03, 3.12};
constexpr std::array kTurns = {1.001, 1.03, 1.15, 1.4, 2.0, 4.0};
// Lengths of the pieces in periods.
constexpr std::array kPeriods = {0.1, 0.2, 0.32, 0.46, 0.62, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2,
                                 2.4, 2.6, 2.8,  3.0,  3.2,  3.4, 3.6, 3.8, 4.0, 4.2, 4.4, 4.6, 4.8,
                                 5.0, 5.2, 5.4,  5.6,  5.8,  6.0, 6.2, 6.4, 6.6, 6.8, 7.0};
constexpr std::array kTurnPeriods = {0.1, 0.2, 0.32, 0.46, 0.62, 0.8, 1.0, 1.2, 1.4};
// Bends at the ends of taut pieces, and √f of these.
constexpr std::array kBends = {-2.8, -2.0, -1.4, -0.9, -0.5, -0.2, 0.2, 0.5, 0.9, 1.4, 2.0, 2.8};
constexpr std::array kTensions = {7.0, 10.0, 14.0, 20.0, 28.0, 40.0};

// Angle against the force, its rate, and place.
struct State {
  double angle = 0, rate = 0, x = 0, y = 0;
};

// One period of the pendulum χ'' = −sin χ from χ = 0.
struct Swing {
  double period = 0;
  double turn = 0;     ///< of χ over a period
  double advance = 0;  ///< along the force
  std::array<State, kSteps + 1> states;

  // `k`: half the largest rate.
  explicit Swing(double k) {
    const bool over = k > 1;
    period = over ? 2 * std::comp_ellint_1(1 / k) / k : 4 * std::comp_ellint_1(k);
    turn = over ? 2 * kPi : 0;
    const double h = period / kSteps;
    State now{0, 2 * k, 0, 0};
    states[0] = now;
    const auto slope = [](const State& s) {
      return State{s.rate, -std::sin(s.angle), std::cos(s.angle), std::sin(s.angle)};
    };
    const auto add = [](const State& s, const State& d, double by) {
      return State{s.angle + by * d.angle, s.rate + by * d.rate, s.x + by * d.x, s.y + by * d.y};
    };
    for (std::size_t i = 1; i <= kSteps; ++i) {
      const State a = slope(now), b = slope(add(now, a, h / 2)), c = slope(add(now, b, h / 2)),
                  d = slope(add(now, c, h));
      now = add(add(add(add(now, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
      states[i] = now;
    }
    advance = now.x;
  }

  State at(double s) const {
    const double turns = std::floor(s / period);
    const double place = (s / period - turns) * kSteps;
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), kSteps - 1);
    const double part = place - static_cast<double>(i);
    const State &a = states[i], &b = states[i + 1];
    const auto mix = [&](double p, double q) { return p + part * (q - p); };
    return {mix(a.angle, b.angle) + turns * turn, mix(a.rate, b.rate), mix(a.x, b.x) + turns * advance,
            mix(a.y, b.y)};
  }
};

// A piece of length 1 by its states at arc lengths in [−½, ½]; `force` against which the angles are told.
template <class At>
ElasticaPiece pieceOf(const At& at, double force) {
  const State middle = at(0);
  const Vector2d back(std::cos(middle.angle), -std::sin(middle.angle));
  const auto point = [&](double s) -> Vector2d {
    const State state = at(s);
    return turned(back, {state.x - middle.x, state.y - middle.y});
  };
  const CurvePoints points(point);
  return {{middle.rate, force * std::cos(middle.angle), -force * std::sin(middle.angle)},
          points,
          point(-0.5) - points.mean,
          point(0.5) - points.mean,
          -points.mean,
          direction(at(-0.5).angle - middle.angle),
          direction(at(0.5).angle - middle.angle)};
}

ElasticaPiece cut(const Swing& swing, double phase, double periods, double sense) {
  const double length = periods * swing.period;
  return pieceOf(
      [&](double s) {
        const State state = swing.at(phase * swing.period + s * length);
        return State{sense * state.angle, sense * state.rate * length, state.x / length,
                     sense * state.y / length};
      },
      length * length);
}

// A bend in a part of the single loop, at a distance from its grip on a blade of tension √f: tan ¼χ = tan ¼α
// exp(−√f s).
State bendAt(double bend, double tension, double distance) {
  const double angle = 4 * std::atan(std::tan(bend / 4) * std::exp(-tension * distance));
  return {angle, 2 * tension * std::sin(angle / 2),
          distance - 2 / tension * (std::cos(angle / 2) - std::cos(bend / 2)),
          2 / tension * (std::sin(bend / 2) - std::sin(angle / 2))};
}

// Two bends with a straight stretch between them, which do not know of each other.
ElasticaPiece taut(double tension, double startBend, double endBend) {
  const State whole = bendAt(endBend, tension, 1);
  return pieceOf(
      [&](double s) {
        const State a = bendAt(startBend, tension, 0.5 + s), b = bendAt(endBend, tension, 0.5 - s);
        return State{a.angle + b.angle, b.rate - a.rate, a.x + whole.x - b.x - (0.5 + s),
                     a.y + whole.y - b.y};
      },
      -tension * tension);
}

// Sheets from that one on differ in one number alone.
void link(std::vector<PieceSheet>& table, std::size_t from) {
  for (std::size_t i = from; i < table.size(); ++i) {
    if (i > 0) table[i].first = table[i - 1].first + table[i - 1].pieces.size();
    table[i].shorter = i > from;
    table[i].longer = i + 1 < table.size();
  }
}

template <class Moduli, class Lengths, class Modulus>
void addSwinging(std::vector<PieceSheet>& table, const Moduli& moduli, const Lengths& lengths, double sense,
                 const Modulus& modulus) {
  const std::size_t first = table.size();
  for (const double length : lengths) table.push_back({length, kPhases, true});
  for (const double value : moduli) {
    const Swing swing(modulus(value));
    for (std::size_t sheet = first; sheet < table.size(); ++sheet)
      for (std::size_t p = 0; p < kPhases; ++p)
        table[sheet].pieces.push_back(
            cut(swing, static_cast<double>(p) / kPhases, table[sheet].periods, sense));
  }
  link(table, first);
}

void addTaut(std::vector<PieceSheet>& table) {
  const std::size_t first = table.size();
  for (const double tension : kTensions) {
    PieceSheet& sheet = table.emplace_back(PieceSheet{0, kBends.size(), false});
    for (const double start : kBends)
      for (const double end : kBends) sheet.pieces.push_back(taut(tension, start, end));
  }
  link(table, first);
}

}  // namespace

const std::vector<PieceSheet>& pieceTable() {
  static const std::vector<PieceSheet> table = [] {
    std::vector<PieceSheet> made;
    addSwinging(made, kSwings, kPeriods, 1, [](double angle) { return std::sin(0.5 * angle); });
    for (const double sense : {1.0, -1.0})
      addSwinging(made, kTurns, kTurnPeriods, sense, [](double k) { return k; });
    addTaut(made);
    return made;
  }();
  return table;
}

}  // namespace bw::fit
