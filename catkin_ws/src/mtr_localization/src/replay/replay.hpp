/// @file
/// Replay of a bag through the localizer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "localizer.hpp"
#include "replay/bag_reader.hpp"
#include "replay/loop_detector.hpp"
#include "replay/options.hpp"

namespace mtr_localization::replay {

/// Message of the localizer: its code, first stamp and number of occurrences.
struct Note {
  std::string code;
  std::int64_t first_ns = 0;
  int count = 0;
};

/// Result of a replay.
struct Result {
  std::vector<Estimate> trajectory;
  /// Last map, or an invalid one with the reason.
  MapResult map;
  /// True if the map was made from this bag, false if it was given in the options.
  bool is_map_new = true;
  /// Messages of the localizer, by text.
  std::map<std::string, Note> messages;
  /// Counts of rejected scans, by LiDAR and reason.
  std::map<std::pair<Lidar, std::string>, int> refusals;
  int imu_samples = 0;
  int wheel_samples = 0;
  int sweeps = 0;
  int sweeps_refused = 0;
  int sweeps_used = 0;
  /// CPU time of tracking, and its maximum for one message of wheel odometry or gyro.
  double tracking_s = 0.0;
  double max_ms = 0.0;
  /// CPU time of the adjustment.
  double adjustment_s = 0.0;
  double wall_s = 0.0;
};

/// Callback with the percentage of the bag that has been read, whenever it increases.
using Progress = std::function<void(int percent)>;

/// Replays one bag with its orders; without orders, it collects from the start and freezes at loop closure.
class Replay {
 public:
  explicit Replay(const Options& options) : options_(options), reader_(options), localizer_(options.parameters) {}

  /// Throws std::runtime_error with one sentence if the bag is not usable.
  Result run(const Progress& progress = {});

 private:
  /// Without any used scan, the trajectory is unconfirmed dead reckoning.
  void invalidate_trajectory();
  void go_on_with_map();
  void begin_at(const WheelSample& sample);
  void take(const ImuSample& sample);
  void take(MapOrder order);
  void take(const GnssFix& fix);
  void take(Sweep sweep);
  void take(WheelSample sample);
  /// Collects the estimates of wheel odometry, or of a gyro sample for which odometry was waiting.
  void track(const std::function<std::vector<Estimate>()>& answer);
  void give_order(std::int64_t now_ns);
  void finish_map();
  void note(const mtr_core::Problem& problem, std::int64_t stamp_ns);

  Options options_;
  BagReader reader_;
  Localizer localizer_;
  LoopDetector loop_;
  Result result_;
  /// Previous map, until the first odometry defines the pose on it.
  std::optional<Memory> memory_;
  bool has_map_ = false;
};

}  // namespace mtr_localization::replay
