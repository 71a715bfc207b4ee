/// @file
/// Inputs of localization from a recorded bag.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "mapping/mapper.hpp"
#include "replay/options.hpp"
#include "ros/conversions.hpp"
#include "samples.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization::replay {

using Event = std::variant<ImuSample, MapOrder, GnssFix, Sweep, WheelSample>;

/// Returns messages in the order of their completion times, independent of the recording order.
class BagReader {
 public:
  explicit BagReader(const Options& options) : options_(options) {}

  /// Throws std::runtime_error with one sentence if the bag cannot be read, or lacks scans, IMU or wheel odometry.
  void open();

  /// Returns false at the end of the bag.
  bool next(Event& event);

  /// Percentage of the bag that has been read.
  int percent() const;

  /// True if the bag contains mapping orders, which start and end the drive round the Car.
  bool has_orders() const { return has_orders_; }

 private:
  /// Completion time and rank; at equal times, wheel odometry is last, because it triggers the estimate.
  using Key = std::pair<std::int64_t, std::size_t>;

  void require(const std::string& topic, const std::string& what);
  void read_mounts();
  void read_message(const rosbag::MessageInstance& message);
  void read_fix(const rosbag::MessageInstance& message);
  void read_scan(const rosbag::MessageInstance& message, Lidar lidar);
  Mount mount_of(const std::string& frame, Lidar lidar) const;
  void wait(std::int64_t time_ns, Event event);

  const Options& options_;
  rosbag::Bag bag_;
  bool has_orders_ = false;
  tf2::BufferCore frames_;
  std::optional<rosbag::View> view_;
  rosbag::View::iterator position_;
  std::int64_t recorded_ns_ = 0;
  std::int64_t begin_ns_ = 0;
  std::int64_t whole_ns_ = 0;
  std::multimap<Key, Event> waiting_;
};

}  // namespace mtr_localization::replay
