/// @file
/// Corrects the pose by scans, and knows when it cannot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mtr_localization/filter_history.hpp"
#include "mtr_localization/map_names.hpp"
#include "mtr_localization/pose_search.hpp"
#include "mtr_localization/scan_matcher.hpp"
#include "mtr_localization/sweep_queue.hpp"
#include "mtr_localization/view_agreement.hpp"

namespace mtr_localization {

/// Figures of the newest look, for a person.
struct TrackingFigures {
  int points = 0;
  int matched = 0;
  double residual_rms = 0.0;
  /// Share of what the map lets expect that is seen, or of what is seen that it explains; the larger one.
  double agreement = 1.0;
  /// 1 sigma of a single look in its weakest direction.
  double weakest_sigma_m = 0.0;
};

/// Tracks against the growing or the frozen map.
class ScanTracker {
 public:
  enum class State { kNoMap, kMapping, kLocalized };

  explicit ScanTracker(const TrackingParameters& parameters) : parameters_(parameters), matcher_(parameters) {}

  State state() const { return state_; }
  bool lost() const { return !lost_reason_.empty(); }
  /// One sentence while lost.
  const std::string& lost_reason() const { return lost_reason_; }
  bool degenerate() const { return degenerate_; }
  const TrackingFigures& figures() const { return figures_; }
  const SurfelMap& surfaces() const { return map_->surfaces; }

  /// An empty map begins where the robot is.
  void begin_mapping(FilterHistory& history);
  /// A key-frame of the growing map.
  void extend(const PoseVector& pose, const ScanPoints& scan);
  /// Poses are in the adjusted map from now on.
  void freeze(const AdjustedMap& map, FilterHistory& history);
  /// The robot may be anywhere near, whatever wheels and gyro say; the reason is a sentence.
  void lose(const std::string& reason);

  /// Corrects the history at the look's step; while lost in a frozen map searches, in a growing one waits until the
  /// view agrees again with where wheels and gyro have led.
  void track(const Look& look, FilterHistory& history);

 private:
  void judge(const Look& look, const FilterHistory& history);
  void lose_sight(const std::string& reason);
  Agreement agreement(const Look& look, const FilterHistory& history) const;
  bool agrees(const Agreement& all);
  bool is_beyond_patience(const Agreement& all, const FilterStep& step) const;
  void resume(const Look& look, const FilterHistory& history);
  void correct(const Look& look, FilterHistory& history);
  void search(const Look& look, FilterHistory& history);
  double position_sigma(const PoseFilter& filter) const;

  TrackingParameters parameters_;
  ScanMatcher matcher_;
  State state_ = State::kNoMap;
  GrowingMap growing_;
  /// Replaced as a whole, never changed.
  std::unique_ptr<const ReferenceMap> map_ = std::make_unique<ReferenceMap>();
  std::optional<PoseSearch> search_;
  std::string lost_reason_;
  /// While lost: wheels and gyro have told all of the motion.
  bool is_reckoned_ = false;
  /// When and where the view agreed last.
  std::int64_t agreed_ns_ = 0;
  PoseVector agreed_odom_ = PoseVector::Zero();
  bool agrees_ = true;
  /// Sweeps in a row that agree again.
  int agreeing_ = 0;
  bool degenerate_ = false;
  TrackingFigures figures_;
};

}  // namespace mtr_localization
