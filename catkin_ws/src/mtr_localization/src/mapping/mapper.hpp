/// @file
/// From orders and key frames to maps.
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

/// What the mapper shall do, as ordered by the Car locator; repeated, so each is a desired state.
struct MapOrder {
  enum class Phase { kIdle, kCollect, kFreeze };
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  Phase phase = Phase::kIdle;
};

/// The answer to an order to freeze the map.
struct MapResult {
  /// Robot time from which poses are in this map.
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  std::uint32_t revision = 0;
  AdjustedMap map;
  OccupancyGrid grid;
};

/// Key frames of one map as ordered, and their adjustment in a thread of its own.
class Mapper {
 public:
  /// Makes a map of key frames; runs in the thread.
  using Adjust = std::function<AdjustedMap(const std::vector<KeyFrame>&)>;

  Mapper(const Parameters& parameters, Adjust adjust);

  /// Poses are in a map of before, until another is ordered.
  void go_on(std::uint64_t map_car_id, std::uint32_t revision);

  void add_order(const MapOrder& order) { orders_.push_back(order); }

  /// The robot moved so during one step, or its motion is unknown. @param heading_rad of the robot in map @param lost
  /// its pose is
  void travel(const FilterInput& input, double heading_rad, bool lost);

  /// It moved unseen. @param covariance of the way in odom: x (m), y (m), heading (rad)
  void lead(const Eigen::Matrix3d& covariance) { selector_.lead(covariance); }

  /// Carries out the orders that are due; true when a new map begins.
  bool begins(std::int64_t now_ns);

  /// Takes the next scan; the key frame that it completes, else null. Valid until the next call.
  const KeyFrame* add(const KeyFrameCandidate& candidate);

  /// The adjusted map from the instant on at which poses are to be in it, once; null at any other time. It may be one
  /// that cannot be trusted, see its `valid`. There until take_result. In lock-step it waits for the thread.
  const AdjustedMap* finish(std::int64_t now_ns);

  /// The newest answer to an order to freeze, each once.
  std::optional<MapResult> take_result();

  const std::vector<KeyFrame>& key_frames() const { return key_frames_; }
  /// Map that poses are in, 0: none.
  std::uint32_t revision() const { return revision_; }
  /// Drift of the growing map since its beginning: x (m), y (m), heading (rad).
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
  /// Since the pose was lost; 0 when it is not.
  double lost_travel_m_ = 0.0;
  /// Map and grid without stamp, id and revision.
  std::future<MapResult> adjusting_;
  std::int64_t effect_ns_ = 0;
  std::uint32_t newest_revision_ = 0;
  std::uint32_t revision_ = 0;
  std::optional<MapResult> result_;
};

}  // namespace mtr_localization
