/// @file
/// A bag through the localizer.
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

/// A sentence of the localizer: its code, the stamp at which it came first, and how often it came.
struct Note {
  std::string code;
  std::int64_t first_ns = 0;
  int count = 0;
};

/// What the bag gave.
struct Result {
  std::vector<Estimate> trajectory;
  /// The last map that was made; without any, invalid and with the reason.
  MapResult map;
  /// It was made of this bag; else it came with the options.
  bool is_map_new = true;
  /// Sentences of the localizer, by text.
  std::map<std::string, Note> messages;
  /// Reasons for refused scans, by LiDAR and text.
  std::map<std::pair<Lidar, std::string>, int> refusals;
  int imu_samples = 0;
  int wheel_samples = 0;
  int sweeps = 0;
  int sweeps_refused = 0;
  int sweeps_used = 0;
  /// CPU time of tracking, and the longest of one answer to wheel odometry or gyro.
  double tracking_s = 0.0;
  double max_ms = 0.0;
  /// CPU time of the adjustment.
  double adjustment_s = 0.0;
  double wall_s = 0.0;
};

/// Is told the part of the bag that has been read, in whole percent, whenever it has grown.
using Progress = std::function<void(int percent)>;

/// Feeds one bag; takes the bag's orders, or collects from the start and freezes when the path closes.
class Replay {
 public:
  explicit Replay(const Options& options) : options_(options), reader_(options), localizer_(options.parameters) {}

  /// Throws std::runtime_error with one sentence when the bag cannot be used.
  Result run(const Progress& progress = {});

 private:
  /// Without one used scan the trajectory is dead reckoning, which nothing has confirmed.
  void invalidate_trajectory();
  void go_on_with_map();
  void begin_at(const WheelSample& sample);
  void take(const ImuSample& sample);
  void take(MapOrder order);
  void take(const GnssFix& fix);
  void take(Sweep sweep);
  void take(WheelSample sample);
  /// Takes poses: wheel odometry's that came in time, or a gyro sample's that odometry had to wait for.
  void track(const std::function<std::vector<Estimate>()>& answer);
  void give_order(std::int64_t now_ns);
  void finish_map();
  void note(const mtr_core::Problem& problem, std::int64_t stamp_ns);

  Options options_;
  BagReader reader_;
  Localizer localizer_;
  LoopDetector loop_;
  Result result_;
  /// Until the first odometry says where the robot is in it.
  std::optional<Memory> memory_;
  bool has_map_ = false;
};

}  // namespace mtr_localization::replay
