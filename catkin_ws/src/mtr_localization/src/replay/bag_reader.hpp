/// @file
/// What localization hears, from a recorded bag.
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

/// Messages in the order of the times at which each was complete, whatever order they were recorded in.
class BagReader {
 public:
  explicit BagReader(const Options& options) : options_(options) {}

  /// Throws std::runtime_error with one sentence when the bag cannot be read or lacks scans, IMU or wheel odometry.
  void open();

  /// False at the end of the bag.
  bool next(Event& event);

  /// How much of the bag has been read.
  int percent() const;

  /// True when the bag says itself when the way round the Car begins and ends.
  bool has_orders() const { return has_orders_; }

 private:
  /// Time when it was complete; of one time wheel odometry comes last, because it asks for the pose.
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
