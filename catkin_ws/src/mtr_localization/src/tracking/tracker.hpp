/// @file
/// Whether the LiDARs see what the map shows, what their scans say about the pose, and where it is when it is lost.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "figures.hpp"
#include "map_names.hpp"
#include "motion/filter_history.hpp"
#include "parameters.hpp"
#include "scans/sweep.hpp"
#include "tracking/agreement.hpp"
#include "tracking/contradiction_watch.hpp"
#include "tracking/matcher.hpp"
#include "tracking/relocalization.hpp"
#include "tracking/uncovered_view.hpp"
#include "tracking/view.hpp"

namespace mtr_localization {

/// What a scan set says of the pose that wheels and gyro predict.
enum class Judgement { kNoMap, kAgrees, kDisagrees, kLost };

/// Compares scans with the growing or the adjusted map. It changes no pose: who calls it does.
class ScanTracker {
 public:
  enum class State { kNoMap, kMapping, kLocalized };

  explicit ScanTracker(const TrackingParameters& parameters) : parameters_(parameters), matcher_(parameters) {}

  State state() const { return state_; }
  bool has_map() const { return state_ != State::kNoMap; }
  bool lost() const { return static_cast<bool>(lost_reason_); }
  /// None unless lost.
  const mtr_core::Problem& lost_reason() const { return lost_reason_; }
  /// The pose is near the true one: not lost, or wheels and gyro have led it on since.
  bool is_reckoned() const { return !lost() || is_reckoned_; }
  /// The scans leave a direction free, or show something else.
  bool degenerate() const { return degenerate_; }
  /// A pose in the adjusted map that is less certain than may be.
  bool is_too_uncertain(const PoseFilter& filter) const {
    return state_ == State::kLocalized && filter.position_sigma_m() > parameters_.lost_sigma_m;
  }
  const TrackingFigures& figures() const { return figures_; }
  const SurfelMap& surfaces() const { return map_->surfaces; }

  /// An empty map begins at a step.
  void begin_map(const FilterStep& here);
  /// A key frame of the growing map.
  void extend(const KeyFrame& frame);
  /// Poses are in the adjusted map from a step on. Returns the number of its lasting error sources.
  int enter(const AdjustedMap& map, const FilterStep& here);
  /// The robot may be anywhere near, whatever wheels and gyro say.
  void lose(const mtr_core::Problem& reason);

  /// As `lose`, of a pose in an adjusted map. @param reckoned it is near the true one, so that it is taken up when the
  /// view there agrees; else only a search finds it
  void doubt(const mtr_core::Problem& reason, bool reckoned);

  /// Something else than predictions has led the pose here: what is near counts from here.
  void lead(const FilterStep& here) { agreed_odom_ = here.odom; }

  /// As `lose`, and there is no map to be found in until another begins.
  void give_up(const mtr_core::Problem& reason);

  /// Whether the pose is the right one: so much of the expected view is seen. Knows from then on when it is lost.
  Judgement judge(const ScanSet& set, const FilterHistory& history);
  /// What a scan says about the pose of a step.
  ScanMatch match(const ScanPoints& scan, const PoseFilter& filter) const;
  /// It is of enough points to correct a pose.
  static bool is_enough(const ScanMatch& match);
  /// Notes the figures of a match; true when it is of enough points to correct a pose.
  bool accept(const ScanMatch& match);
  /// Whether a scan lies exactly on the map at the pose of a step, which may look much like the right one and not be
  /// it. Knows from then on when the pose is lost.
  bool fits(const ScanPoints& scan, const FilterStep& step);
  /// While lost: takes the pose of wheels and gyro up again when what hid the view has gone, else looks for places that
  /// explain several views; in a growing map the pose of wheels and gyro is the only one that is tried. Returns the
  /// pose that was found in the adjusted map.
  std::optional<Relocalization::Found> relocalize(const ScanSet& set, const ScanPoints& scan,
                                                  const FilterHistory& history);

 private:
  void lose_sight(const mtr_core::Problem& reason);
  void find(const FilterStep& step);
  void note_agreement(const FilterStep& step);
  bool agrees(const Agreement& all);
  bool is_unexplained(const Agreement& all) const;
  /// Nothing tells whether the pose is right, although the view disagreed before, or surfaces should be in view.
  bool is_unanswered(const Agreement& all) const;
  double patience_after(const Agreement& all, const Eigen::Vector2d& slope, const FilterStep& step) const;
  bool is_beyond_patience(const Agreement& all, const FilterStep& step) const;
  Relocalization::Found matched_near(const View& view, const PoseFilter& filter) const;
  bool is_uncovered(const View& view, const PoseVector& pose, const FilterHistory& history, const FilterStep& step);

  TrackingParameters parameters_;
  ScanMatcher matcher_;
  State state_ = State::kNoMap;
  GrowingMap growing_;
  /// Replaced as a whole, never changed.
  std::unique_ptr<const ReferenceMap> map_ = std::make_unique<ReferenceMap>();
  std::optional<Relocalization> search_;
  mtr_core::Problem lost_reason_;
  /// Wheels and gyro saw all of the motion since the view agreed last.
  bool is_reckoned_ = false;
  /// Since the view agreed last, surfaces were not where the map has them; not only hidden by something nearer.
  bool is_contradicted_ = false;
  ContradictionWatch contradictions_;
  /// The last view agreed, or nothing spoke against it.
  bool has_agreed_ = false;
  /// When and where the view agreed last.
  std::int64_t agreed_ns_ = 0;
  PoseVector agreed_odom_ = PoseVector::Zero();
  /// For how long the view may disagree from then on while something nearer hides it.
  double patience_s_ = 0.0;
  /// When returns lay exactly on the map, or there were too few to tell.
  std::int64_t fitted_ns_ = 0;
  /// While lost.
  UncoveredView uncovered_;
  /// While lost: when that was seen first.
  std::optional<std::int64_t> lost_ns_;
  bool degenerate_ = false;
  TrackingFigures figures_;
};

}  // namespace mtr_localization
