// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/model/evaluation_runner.h"
#include "bw/pipeline/pipeline.h"
#include "workbench/workbench.h"

namespace bw::app {

/// What stands in a second picture beside the present result.
struct Beside {
  enum class What {
    nothing,
    target,  ///< the surface that is to be cut
    before,  ///< the state before the last change
    version  ///< one that was given a name
  };
  What what = What::nothing;
  std::string version = {};  ///< its name
  bool operator==(const Beside&) const = default;
};

/// What the present state is compared with, and what that comes to: computed in the background, while the
/// present design goes on.
class Comparison : public QObject {
  Q_OBJECT

 public:
  explicit Comparison(Workbench& bench, QObject* parent = nullptr);

  const Beside& beside() const { return beside_; }
  /// Chooses another; one that is not there is none.
  void choose(const Beside& beside);
  /// Whether there is a state before the last change.
  bool hasBefore() const;

  /// The other state; null where it is none, or the present one.
  const std::shared_ptr<const Design>& design() const { return design_; }
  /// What it came to, as far as it came; null until that is known.
  const std::shared_ptr<const pipeline::Evaluation>& evaluation() const { return evaluation_; }
  /// Why it came no farther.
  const std::optional<Error>& error() const { return error_; }
  /// It is being computed.
  bool busy() const { return making_ != nullptr; }

 signals:
  /// Another is chosen, or what is chosen is called or made otherwise.
  void chosen();
  /// `evaluation`, `error` or `busy` is another.
  void computed();

 private:
  void follow(const Change& change);
  /// Finds what is chosen in the design as it is now, and tells where that is another.
  void find();
  /// The same; computes it.
  void settle();
  void order(const std::shared_ptr<const Design>& design);
  void forget();

  Workbench& bench_;
  Beside beside_;
  std::shared_ptr<const Design> design_;
  std::shared_ptr<const pipeline::Evaluation> evaluation_, making_;
  std::optional<Error> error_;
  std::unique_ptr<model::EvaluationRunner> runner_;  ///< of its own; null before there is something to do
};

}  // namespace bw::app
