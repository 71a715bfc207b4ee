/// @file
/// Collects key-frames by order and has them adjusted, without holding up tracking.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <vector>

#include "mtr_localization/key_frame_selector.hpp"
#include "mtr_localization/map_names.hpp"
#include "mtr_localization/parameters.hpp"

namespace mtr_localization {

/// What the mapper shall do, as ordered by the Car locator; repeated, so each is a desired state.
struct MapOrder {
  enum class Phase { kIdle, kCollect, kFreeze };
  std::int64_t stamp_ns = 0;
  std::uint64_t map_car_id = 0;
  Phase phase = Phase::kIdle;
};

/// What the thread makes of the key-frames.
struct MadeMap {
  AdjustedMap map;
  OccupancyGrid grid;
};

/// Key-frames of one mapping order, and their adjustment in a thread of its own.
class MapBuilder {
 public:
  using Adjust = std::function<AdjustedMap(const std::vector<KeyFrame>&)>;
  enum class State { kNone, kCollecting, kPaused, kAdjusting, kDone };

  MapBuilder(const Parameters& parameters, Adjust adjust);

  State state() const { return state_; }
  std::uint64_t map_car_id() const { return map_car_id_; }
  const std::vector<KeyFrame>& key_frames() const { return key_frames_; }

  /// True: a new map begins.
  bool order(const MapOrder& order, std::int64_t effect_delay_ns);

  /// The robot moved so far along its path and turned so much.
  void travel(double distance_m, double angle_rad) { selector_.travel(distance_m, angle_rad); }

  /// Takes the view; false when it completes no key-frame.
  bool add(const View& view);

  /// The adjusted map from the instant on at which poses are to be in it; once. In lock-step it waits for the thread.
  std::optional<MadeMap> result(std::int64_t now_ns, bool waits);

 private:
  KeyFrameSelector selector_;
  Adjust adjust_;
  State state_ = State::kNone;
  std::uint64_t map_car_id_ = 0;
  std::vector<KeyFrame> key_frames_;
  std::future<MadeMap> adjusting_;
  std::int64_t effect_ns_ = 0;
};

}  // namespace mtr_localization
