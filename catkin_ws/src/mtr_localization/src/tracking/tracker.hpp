/// @file
/// Agreement of scans with the map, corrections of the pose, and relocalization.
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

/// Verdict on the predicted pose from a scan set.
enum class Judgement { kNoMap, kAgrees, kDisagrees, kLost };

/// Compares scans with the growing or the adjusted map. It does not change the pose; the caller does.
class ScanTracker {
 public:
  enum class State { kNoMap, kMapping, kLocalized };

  explicit ScanTracker(const TrackingParameters& parameters) : parameters_(parameters), matcher_(parameters) {}

  State state() const { return state_; }
  bool has_map() const { return state_ != State::kNoMap; }
  bool lost() const { return static_cast<bool>(lost_reason_); }
  /// Empty unless lost.
  const mtr_core::Problem& lost_reason() const { return lost_reason_; }
  /// True if the pose is near the true one: not lost, or continuously propagated by wheels and gyro since.
  bool is_reckoned() const { return !lost() || is_reckoned_; }
  /// True if the scans leave a direction free or show something else.
  bool degenerate() const { return degenerate_; }
  /// True if a pose in the adjusted map is more uncertain than allowed.
  bool is_too_uncertain(const PoseFilter& filter) const {
    return state_ == State::kLocalized && filter.position_sigma_m() > parameters_.lost_sigma_m;
  }
  const TrackingFigures& figures() const { return figures_; }
  const SurfelMap& surfaces() const { return map_->surfaces; }

  /// Starts an empty map at a step.
  void begin_map(const FilterStep& here);
  /// Adds a key frame to the growing map.
  void extend(const KeyFrame& frame);
  /// Switches to the adjusted map at a step. Returns the number of its persistent error sources.
  int enter(const AdjustedMap& map, const FilterStep& here);
  /// Declares the pose lost: the robot may be anywhere near, regardless of wheels and gyro.
  void lose(const mtr_core::Problem& reason);

  /// Like `lose`, for a pose in an adjusted map.
  /// @param reckoned the pose is near the true one, so it is resumed when the view agrees; otherwise only a search
  /// restores it
  void doubt(const mtr_core::Problem& reason, bool reckoned);

  /// Restarts the reference of agreement here, after a motion other than a prediction.
  void lead(const FilterStep& here) { agreed_odom_ = here.odom; }

  /// Like `lose`, without a map to search until another one starts.
  void give_up(const mtr_core::Problem& reason);

  /// Judges the pose by the share of the expected view that is seen, and updates whether it is lost.
  Judgement judge(const ScanSet& set, const FilterHistory& history);
  /// Matches a scan at the pose of a step.
  ScanMatch match(const ScanPoints& scan, const PoseFilter& filter) const;
  /// True if a match has enough points to correct a pose.
  static bool is_enough(const ScanMatch& match);
  /// Stores the figures of a match; returns true if it has enough points to correct a pose.
  bool accept(const ScanMatch& match);
  /// Returns true if a scan fits the map exactly at the pose of a step, which excludes poses that only look similar.
  /// Updates whether the pose is lost.
  bool fits(const ScanPoints& scan, const FilterStep& step);
  /// While lost: resumes the pose of wheels and gyro when the obstruction has gone, otherwise searches for places that
  /// explain several views. In a growing map, only the pose of wheels and gyro is tried. Returns the pose found in the
  /// adjusted map.
  std::optional<Relocalization::Found> relocalize(const ScanSet& set, const ScanPoints& scan,
                                                  const FilterHistory& history);

 private:
  void lose_sight(const mtr_core::Problem& reason);
  void find(const FilterStep& step);
  void note_agreement(const FilterStep& step);
  bool agrees(const Agreement& all);
  bool is_unexplained(const Agreement& all) const;
  /// True if no evidence confirms the pose, although the view disagreed before or surfaces should be in view.
  bool is_unanswered(const Agreement& all) const;
  double patience_after(const Agreement& all, const Eigen::Vector2d& slope, const FilterStep& step) const;
  bool is_beyond_patience(const Agreement& all, const FilterStep& step) const;
  Relocalization::Found matched_near(const View& view, const PoseFilter& filter) const;
  bool is_uncovered(const View& view, const PoseVector& pose, const FilterHistory& history, const FilterStep& step);

  TrackingParameters parameters_;
  ScanMatcher matcher_;
  State state_ = State::kNoMap;
  GrowingMap growing_;
  /// Replaced as a whole, never modified.
  std::unique_ptr<const ReferenceMap> map_ = std::make_unique<ReferenceMap>();
  std::optional<Relocalization> search_;
  mtr_core::Problem lost_reason_;
  /// True if wheels and gyro measured the whole motion since the last agreement.
  bool is_reckoned_ = false;
  /// True if surfaces were missing since the last agreement, not only hidden by nearer objects.
  bool is_contradicted_ = false;
  ContradictionWatch contradictions_;
  /// True if the last view agreed, or did not contradict.
  bool has_agreed_ = false;
  /// Time and pose of the last agreement.
  std::int64_t agreed_ns_ = 0;
  PoseVector agreed_odom_ = PoseVector::Zero();
  /// Tolerated duration of disagreement from then on while a nearer object hides the view.
  double patience_s_ = 0.0;
  /// Last time when returns fitted the map exactly, or were too few to decide.
  std::int64_t fitted_ns_ = 0;
  /// Used while lost.
  UncoveredView uncovered_;
  /// Time of the first view while lost.
  std::optional<std::int64_t> lost_ns_;
  bool degenerate_ = false;
  TrackingFigures figures_;
};

}  // namespace mtr_localization
