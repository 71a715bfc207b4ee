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
#include "tracking/matcher.hpp"
#include "tracking/relocalization.hpp"

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
  /// The scans leave a direction free, or show something else.
  bool degenerate() const { return degenerate_; }
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

  /// Whether the pose is the right one: so much of the expected view is seen. Knows from then on when it is lost.
  Judgement judge(const ScanSet& set, const FilterHistory& history);
  /// What a scan says about the pose of a step.
  ScanMatch match(const ScanPoints& scan, const PoseFilter& filter) const;
  /// Notes the figures of a match; true when it is of enough points to correct a pose.
  bool accept(const ScanMatch& match);
  /// While lost: waits until the view agrees again with where wheels and gyro have led, and in an adjusted map
  /// searches. Returns the pose that was found by search.
  std::optional<Relocalization::Found> relocalize(const ScanSet& set, const ScanPoints& scan,
                                                  const FilterHistory& history);

 private:
  void lose_sight(const mtr_core::Problem& reason);
  void find(const FilterStep& step);
  Agreement agreement(const ScanSet& set, const FilterHistory& history) const;
  bool agrees(const Agreement& all);
  bool is_beyond_patience(const Agreement& all, const FilterStep& step) const;
  void resume(const ScanSet& set, const FilterHistory& history);
  std::optional<Relocalization::Found> search(const SearchView& view, const FilterStep& step);

  TrackingParameters parameters_;
  ScanMatcher matcher_;
  State state_ = State::kNoMap;
  GrowingMap growing_;
  /// Replaced as a whole, never changed.
  std::unique_ptr<const ReferenceMap> map_ = std::make_unique<ReferenceMap>();
  std::optional<Relocalization> search_;
  mtr_core::Problem lost_reason_;
  /// While lost: wheels and gyro saw all of the motion.
  bool is_reckoned_ = false;
  /// When and where the view agreed last.
  std::int64_t agreed_ns_ = 0;
  PoseVector agreed_odom_ = PoseVector::Zero();
  /// Scan sets in a row that agree again.
  int agreeing_ = 0;
  bool degenerate_ = false;
  TrackingFigures figures_;
};

}  // namespace mtr_localization
