/// @file
/// Conversion of bag topics to events in the order of their stamps.
// SPDX-License-Identifier: Apache-2.0
#include "replay/bag_reader.hpp"

#include <mtr_msgs/MappingOrder.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>
#include <vector>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization::replay {
namespace {

namespace names = mtr_core::names;

const char kStaticFrames[] = "/tf_static";
// Upper bound of the recording delay of a message after its completion, and relative to other messages.
constexpr std::int64_t kDisorderNs = 500'000'000;

template <typename M>
typename M::ConstPtr message_of(const rosbag::MessageInstance& message) {
  typename M::ConstPtr content = message.instantiate<M>();
  if (!content) {
    throw std::runtime_error("Topic " + message.getTopic() + " is of type " + message.getDataType() +
                             ", which is not what it should be.");
  }
  return content;
}

}  // namespace

void BagReader::open() {
  try {
    bag_.open(options_.bag, rosbag::bagmode::Read);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error("Bag " + options_.bag + " cannot be read: " + error.what() + ".");
  }
  require(names::kWheelOdometry, "wheel odometry");
  require(names::kImuData, "IMU data");
  require(names::kFrontScan, "scans");
  read_mounts();
  std::vector<std::string> topics = {names::kFrontScan, names::kImuData, names::kNavsatFix, names::kWheelOdometry};
  if (!options_.front_only) {
    topics.emplace_back(names::kRearScan);
  }
  has_orders_ = !options_.loop_end_ns && rosbag::View(bag_, rosbag::TopicQuery(names::kMappingOrder)).size() > 0;
  if (has_orders_) {
    topics.emplace_back(names::kMappingOrder);
  }
  view_.emplace(bag_, rosbag::TopicQuery(topics));
  position_ = view_->begin();
  begin_ns_ = mtr_core::to_ns(view_->getBeginTime());
  whole_ns_ = mtr_core::to_ns(view_->getEndTime()) - begin_ns_;
}

void BagReader::require(const std::string& topic, const std::string& what) {
  if (rosbag::View(bag_, rosbag::TopicQuery(topic)).size() == 0) {
    throw std::runtime_error("Bag " + options_.bag + " has no " + what + ": there is nothing on " + topic + ".");
  }
}

void BagReader::read_mounts() {
  for (const rosbag::MessageInstance& message : rosbag::View(bag_, rosbag::TopicQuery(std::string(kStaticFrames)))) {
    for (const geometry_msgs::TransformStamped& transform : message_of<tf2_msgs::TFMessage>(message)->transforms) {
      frames_.setTransform(transform, "bag", true);
    }
  }
}

bool BagReader::next(Event& event) {
  while (position_ != view_->end() &&
         (waiting_.empty() || waiting_.begin()->first.first + kDisorderNs > recorded_ns_)) {
    read_message(*position_);
    ++position_;
  }
  if (waiting_.empty()) {
    return false;
  }
  event = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  return true;
}

int BagReader::percent() const {
  return whole_ns_ > 0 ? static_cast<int>(100 * (recorded_ns_ - begin_ns_) / whole_ns_) : 100;
}

void BagReader::read_message(const rosbag::MessageInstance& message) {
  recorded_ns_ = mtr_core::to_ns(message.getTime());
  const std::string& topic = message.getTopic();
  if (topic == names::kImuData) {
    const ImuSample sample = imu_sample_of(*message_of<sensor_msgs::Imu>(message));
    wait(sample.stamp_ns, sample);
  } else if (topic == names::kWheelOdometry) {
    const WheelSample sample = wheel_sample_of(*message_of<nav_msgs::Odometry>(message));
    wait(sample.stamp_ns, sample);
  } else if (topic == names::kMappingOrder) {
    const MapOrder order = order_of(*message_of<mtr_msgs::MappingOrder>(message));
    wait(order.stamp_ns, order);
  } else if (topic == names::kNavsatFix) {
    read_fix(message);
  } else {
    read_scan(message, topic == names::kFrontScan ? Lidar::kFront : Lidar::kRear);
  }
}

void BagReader::read_fix(const rosbag::MessageInstance& message) {
  const sensor_msgs::NavSatFix::ConstPtr fix = message_of<sensor_msgs::NavSatFix>(message);
  try {
    const auto mount = frames_.lookupTransform(names::kBase, fix->header.frame_id, ros::Time(0));
    const GnssFix sample = gnss_fix_of(*fix, pose_of(mount.transform).head<2>());
    wait(sample.stamp_ns, sample);
  } catch (const tf2::TransformException&) {
    // Without the mount of the antenna in the bag, fixes are not usable.
  }
}

void BagReader::read_scan(const rosbag::MessageInstance& message, Lidar lidar) {
  const sensor_msgs::LaserScan::ConstPtr scan = message_of<sensor_msgs::LaserScan>(message);
  Sweep sweep = sweep_of(*scan, lidar, mount_of(scan->header.frame_id, lidar));
  // Computed before the move, because it requires the number of beams.
  const std::int64_t end_ns = sweep.end_ns();
  wait(end_ns, std::move(sweep));
}

Mount BagReader::mount_of(const std::string& frame, Lidar lidar) const {
  const Mounting& given = options_.mounting;
  try {
    if (const auto mount = mount_from(frames_.lookupTransform(names::kBase, frame, ros::Time(0)))) {
      return *mount;
    }
  } catch (const tf2::TransformException&) {
    // Without a transform in the bag, the parameters define the mount.
    return lidar == Lidar::kFront
               ? Mount{{given.front_lidar_x_m, given.front_lidar_y_m, given.front_lidar_heading_rad}, 0.0, false}
               : Mount{{given.rear_lidar_x_m, given.rear_lidar_y_m, given.rear_lidar_heading_rad}, 0.0, false};
  }
  throw std::runtime_error("The LiDAR of frame " + frame + " is not level on the robot.");
}

void BagReader::wait(std::int64_t time_ns, Event event) {
  const Key key(time_ns, event.index());
  waiting_.emplace(key, std::move(event));
}

}  // namespace mtr_localization::replay
