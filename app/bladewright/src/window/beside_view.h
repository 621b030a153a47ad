// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QFrame>
#include <QGridLayout>
#include <QLabel>

#include <optional>
#include <string>
#include <utility>

#include "bw/scene/scene.h"
#include "bw/view/scene_view.h"
#include "versions/comparison.h"

namespace bw::app {

/// The picture, and where something is compared with it a second one at its left: both are looked at from the
/// same place, and one legend at the right of both tells their colours, where there is room for it.
class BesideView : public QWidget {
  Q_OBJECT

 public:
  BesideView(const Comparison& comparison, view::SceneView& present, QWidget* parent = nullptr);

  /// The second picture; null before the first comparison.
  view::SceneView* other() { return other_; }
  /// Where the legend stands while something is compared; null before the first comparison.
  view::SceneView* legend() { return legend_; }
  bool compared() const { return comparison_.beside().what != Beside::What::nothing; }
  /// The names over the two pictures.
  QString nameThen() const { return then_->text(); }
  QString nameNow() const { return now_->text(); }

  /// Another content of the present picture.
  void setContent(const scene::Content& content);
  /// The same of some things of it alone.
  void replace(scene::Content content);
  /// The style of both, but for what only the present one has: what is selected, moved or marked.
  void setStyle(const scene::Style& style);
  using QWidget::setStyle;
  void setNavigation(view::Navigation navigation);
  /// Something else is compared, or what is compared came to something else.
  void refresh();
  /// The present picture at any size in pixels, with its legend.
  QImage picture(const QSize& pixels, double pixelRatio);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 signals:
  /// The legend was double-clicked.
  void legendActivated();
  /// What lies under the cursor in the second picture.
  void hovered(const bw::scene::Pick& pick);

 private:
  void makeOther();
  /// The present picture shows another content.
  void followContent();
  void refreshNames();
  /// Where the second picture is looked at from.
  void follow();
  /// Shows the legend beside the pictures where there is one and room for it.
  void placeLegend();
  /// The range of the legend over both pictures; empty where no map is shown, or the person chose one.
  std::optional<std::pair<double, double>> rangeOfBoth(const scene::Style& style, const scene::Style& other);

  const Comparison& comparison_;
  view::SceneView& present_;
  view::SceneView *other_ = nullptr, *legend_ = nullptr;
  scene::Style style_;  ///< as it was given
  QGridLayout* grid_;
  QLabel *then_, *now_;
  QFrame* line_;
  view::Navigation navigation_ = view::Navigation::rhino;
  bool following_ = false;
  /// What the range of both was found for.
  struct Ranged {
    std::string map;
    double tolerance = 0;
    std::size_t items = 0;
    bool operator==(const Ranged&) const = default;
  };
  std::optional<Ranged> ranged_;  ///< empty after another content
  std::optional<std::pair<double, double>> range_;
};

}  // namespace bw::app
