/// @file
/// Conversion between map, messages and bags.
// SPDX-License-Identifier: Apache-2.0
#include "ros/saved_map.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "mtr_core/clock.hpp"
#include "mtr_core/names.hpp"
#include "ros/conversions.hpp"

namespace mtr_localization {
namespace {

constexpr char kMapTopic[] = "/localization/saved_map";
constexpr char kPoseTopic[] = "/localization/saved_pose";
// The smallest valid time: messages in bags cannot have time 0.
const ros::Time kNever = ros::TIME_MIN;

using Message = mtr_msgs::SavedMap;

void append(std::vector<double>& row, const Surfel& surfel) {
  row.insert(row.end(), {surfel.position.x(), surfel.position.y(), surfel.normal.x(), surfel.normal.y(),
                         surfel.length_m, surfel.sigma_m, static_cast<double>(surfel.hits), surfel.lowest_rise_m,
                         surfel.highest_rise_m, surfel.lean, surfel.lean_sigma});
}

Surfel surfel_of(const double* row) {
  Surfel surfel{{row[0], row[1]}, {row[2], row[3]}, row[4], row[5], static_cast<int>(row[6])};
  surfel.lowest_rise_m = row[7];
  surfel.highest_rise_m = row[8];
  surfel.lean = row[9];
  surfel.lean_sigma = row[10];
  return surfel;
}

ros::Time time_of_bag(const ros::Time& stamp) { return std::max(stamp, kNever); }

void write_whole(const std::string& path, const std::function<void(rosbag::Bag&)>& write) {
  const std::string part = path + ".part";
  try {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    rosbag::Bag bag(part, rosbag::bagmode::Write);
    write(bag);
    bag.close();
    std::filesystem::rename(part, path);
  } catch (const std::exception& error) {
    throw FileUnusable("File " + path + " cannot be written: " + error.what() + ".");
  }
}

/// Returns the only message of a topic.
template <typename M>
M message_in(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0) {
    throw FileUnusable("it has no " + topic);
  }
  const auto message = view.begin()->instantiate<M>();
  if (!message) {
    throw FileUnusable("its " + topic + " is of another version");
  }
  return *message;
}

template <typename Result>
std::optional<Result> read_bag(const std::string& path, const std::function<Result(const rosbag::Bag&)>& read) {
  if (!std::filesystem::exists(path)) {
    return std::nullopt;
  }
  try {
    const rosbag::Bag bag(path, rosbag::bagmode::Read);
    return read(bag);
  } catch (const std::exception& error) {
    throw FileUnusable("File " + path + " cannot be used: " + error.what() + ".");
  }
}

}  // namespace

SavedMap saved_map_of(const MapResult& result, const mtr_msgs::SurfaceMap& surfaces,
                      const nav_msgs::OccupancyGrid& grid) {
  SavedMap saved;
  saved.grid = grid;
  saved.map.surfaces = surfaces;
  for (const Surfel& surfel : result.map.surfels) {
    append(saved.map.surfels, surfel);
  }
  const auto& covariance = result.map.range_bias.covariance;
  saved.map.range_bias_covariance = {covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)};
  return saved;
}

mtr_msgs::SavedPose saved_pose_of(const Estimate& estimate) {
  mtr_msgs::SavedPose saved;
  saved.boot_time_s = static_cast<double>(mtr_core::boot_time_ns()) * 1e-9;
  saved.pose = message_of(estimate);
  std::copy(estimate.wheel_odom.begin(), estimate.wheel_odom.end(), saved.wheel_odometry.begin());
  return saved;
}

Memory memory_of(const mtr_msgs::SavedMap& map) {
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (map.surfels.empty() || map.surfels.size() % Message::COLUMNS != 0 ||
      !std::all_of(map.surfels.begin(), map.surfels.end(), is_number)) {
    throw FileUnusable("the saved map is damaged");
  }
  Memory memory;
  memory.map_car_id = map.surfaces.map_car_id;
  memory.revision = map.surfaces.revision;
  memory.map.valid = true;
  for (std::size_t first = 0; first < map.surfels.size(); first += Message::COLUMNS) {
    memory.map.surfels.push_back(surfel_of(&map.surfels[first]));
  }
  RangeBias& bias = memory.map.range_bias;
  bias.value_m << map.surfaces.range_bias_m, map.surfaces.rear_range_bias_m;
  const auto& covariance = map.range_bias_covariance;
  bias.covariance << covariance[0], covariance[1], covariance[2], covariance[3];
  return memory;
}

RememberedPose remembered_pose_of(const mtr_msgs::SavedPose& saved) {
  RememberedPose pose;
  pose.pose << saved.pose.x, saved.pose.y, saved.pose.heading;
  pose.covariance = Eigen::Map<const Eigen::Matrix3d>(saved.pose.covariance.data());
  std::copy(saved.wheel_odometry.begin(), saved.wheel_odometry.end(), pose.wheel_odom.begin());
  pose.origin_id = saved.pose.origin_id;
  return pose;
}

void write_bag(const SavedMap& map, const std::string& path) {
  const ros::Time stamp = time_of_bag(map.map.surfaces.header.stamp);
  write_whole(path, [&](rosbag::Bag& bag) {
    bag.write(kMapTopic, stamp, map.map);
    bag.write(mtr_core::names::kMapGrid, stamp, map.grid);
  });
}

void write_bag(const mtr_msgs::SavedPose& pose, const std::string& path) {
  write_whole(path, [&](rosbag::Bag& bag) { bag.write(kPoseTopic, time_of_bag(pose.pose.header.stamp), pose); });
}

std::optional<SavedMap> read_map(const std::string& path) {
  return read_bag<SavedMap>(path, [](const rosbag::Bag& bag) {
    SavedMap saved{message_in<mtr_msgs::SavedMap>(bag, kMapTopic),
                   message_in<nav_msgs::OccupancyGrid>(bag, mtr_core::names::kMapGrid)};
    // Check that the map can be resumed: otherwise a node that fails on a damaged file would be restarted forever.
    memory_of(saved.map);
    return saved;
  });
}

std::optional<mtr_msgs::SavedPose> read_pose(const std::string& path) {
  return read_bag<mtr_msgs::SavedPose>(
      path, [](const rosbag::Bag& bag) { return message_in<mtr_msgs::SavedPose>(bag, kPoseTopic); });
}

}  // namespace mtr_localization
