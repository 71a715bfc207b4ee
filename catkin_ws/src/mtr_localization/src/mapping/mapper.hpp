/// @file
/// Mapping: orders and key frames become maps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <vector>

#include "map_names.hpp"
#include "mapping/key_frame_selector.hpp"
#include "mapping/map_drift.hpp"
#include "motion/filter_history.hpp"
#include "parameters.hpp"

namespace mtr_localization {

/// State requested by the Car locator; orders are repeated, so each is a desired state.
struct MapOrder {
  enum class Phase { kIdle, kCollect, kFreeze };
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  Phase phase = Phase::kIdle;
};

/// Result of an order to freeze the map.
struct MapResult {
  /// Robot time from which on poses are in this map.
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  std::uint32_t revision = 0;
  AdjustedMap map;
  OccupancyGrid grid;
};

/// Collects the key frames of one map on order and adjusts them in a thread.
class Mapper {
 public:
  /// Makes a map from key frames; runs in the thread.
  using Adjust = std::function<AdjustedMap(const std::vector<KeyFrame>&)>;

  Mapper(const Parameters& parameters, Adjust adjust);

  /// Resumes with a previous map until another one is ordered.
  void go_on(std::uint64_t map_car_id, std::uint32_t revision);

  void add_order(const MapOrder& order) { orders_.push_back(order); }

  /// Adds the motion of one step, if it is known.
  /// @param heading_rad of the robot in map
  /// @param lost true if the pose is lost
  void travel(const FilterInput& input, double heading_rad, bool lost);

  /// Adds a motion that was not measured.
  /// @param covariance of the motion in odom: x (m), y (m), heading (rad)
  void lead(const Eigen::Matrix3d& covariance) { selector_.lead(covariance); }

  /// Executes orders that are due; returns true when a new map starts.
  bool begins(std::int64_t now_ns);

  /// Adds a scan. Returns the key frame that it completes, or null; valid until the next call.
  const KeyFrame* add(const KeyFrameCandidate& candidate);

  /// Returns the adjusted map once, at the time from which on poses are in it, otherwise null. It may be invalid, see
  /// `valid`. The pointer is valid until take_result. In lock-step, the call waits for the thread.
  const AdjustedMap* finish(std::int64_t now_ns);

  /// Returns each result of an order to freeze once.
  std::optional<MapResult> take_result();

  const std::vector<KeyFrame>& key_frames() const { return key_frames_; }
  /// Revision of the map that poses are in, 0 for none.
  std::uint32_t revision() const { return revision_; }
  /// Drift of the growing map since its start: x (m), y (m), heading (rad).
  const Eigen::Matrix3d& drift_covariance() const { return drift_.covariance(); }

 private:
  enum class State { kNone, kCollecting, kPaused, kAdjusting, kDone };

  bool handle(const MapOrder& order);
  void begin(std::uint64_t map_car_id);
  void start_adjustment(std::int64_t effect_ns);
  bool is_finished(std::int64_t now_ns) const;

  Parameters parameters_;
  Adjust adjust_;
  KeyFrameSelector selector_;
  std::deque<MapOrder> orders_;
  State state_ = State::kNone;
  std::uint64_t map_car_id_ = 0;
  std::vector<KeyFrame> key_frames_;
  MapDrift drift_;
  /// Distance travelled since the pose was lost; 0 otherwise.
  double lost_travel_m_ = 0.0;
  /// Map and grid without stamp, id and revision.
  std::future<MapResult> adjusting_;
  std::int64_t effect_ns_ = 0;
  std::uint32_t newest_revision_ = 0;
  std::uint32_t revision_ = 0;
  std::optional<MapResult> result_;
};

}  // namespace mtr_localization
