/// @file
/// Output of a replay: CSV of poses, JSON of figures, and map files.
// SPDX-License-Identifier: Apache-2.0
#include "replay/result_files.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <stdexcept>

#include "mtr_surfel_map/map_files.hpp"
#include "ros/conversions.hpp"
#include "ros/map_messages.hpp"
#include "ros/saved_map.hpp"

namespace mtr_localization::replay {
namespace {

double seconds(std::int64_t stamp_ns) { return static_cast<double>(stamp_ns) * 1e-9; }

std::ofstream open(const std::string& path) {
  std::ofstream file(path);
  if (!file) {
    throw std::runtime_error("File " + path + " cannot be written.");
  }
  file << std::fixed << std::setprecision(6);
  return file;
}

void write_trajectory(const std::vector<Estimate>& trajectory, const std::string& path) {
  std::ofstream file = open(path);
  file << "stamp_s,x_m,y_m,heading_rad,cxx,cxy,cxh,cyx,cyy,cyh,chx,chy,chh,valid,mode,degenerate,map_revision\n";
  for (const Estimate& estimate : trajectory) {
    const mtr_msgs::LocalizedPose message = message_of(estimate);
    file << std::fixed << seconds(estimate.stamp_ns) << ',' << message.x << ',' << message.y << ',' << message.heading
         << std::scientific;
    for (const double value : message.covariance) {
      file << ',' << value;
    }
    file << ',' << int{message.valid} << ',' << int{message.mode} << ',' << int{message.degenerate} << ','
         << message.map_revision << '\n';
  }
}

/// Writes valid poses in the format of the TUM tools and evo: time, position, quaternion.
void write_tum(const std::vector<Estimate>& trajectory, const std::string& path) {
  std::ofstream file = open(path);
  file << std::fixed << "# timestamp tx ty tz qx qy qz qw\n";
  for (const Estimate& estimate : trajectory) {
    if (estimate.valid) {
      file << seconds(estimate.stamp_ns) << ' ' << estimate.x_m << ' ' << estimate.y_m << " 0 0 0 "
           << std::sin(0.5 * estimate.heading_rad) << ' ' << std::cos(0.5 * estimate.heading_rad) << '\n';
    }
  }
}

/// Quotes a text for JSON; messages do not contain control characters.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      result += '\\';
    }
    result += character;
  }
  return result + "\"";
}

void write_messages(std::ofstream& file, const Result& result) {
  file << "  \"messages\": [";
  const char* separator = "";
  for (const auto& [message, note] : result.messages) {
    file << separator << "\n    {\"first_s\": " << seconds(note.first_ns) << ", \"message\": " << quoted(message)
         << ", \"code\": " << quoted(note.code) << ", \"count\": " << note.count << '}';
    separator = ",";
  }
  file << "\n  ]\n";
}

void write_refusals(std::ofstream& file, const Result& result) {
  file << "  \"refusals\": [";
  const char* separator = "";
  for (const auto& [refusal, count] : result.refusals) {
    file << separator << "\n    {\"lidar\": " << quoted(refusal.first == Lidar::kFront ? "front" : "rear")
         << ", \"message\": " << quoted(refusal.second) << ", \"count\": " << count << '}';
    separator = ",";
  }
  file << "\n  ],\n";
}

void write_summary(const Result& result, const std::string& bag, const std::string& path) {
  const AdjustedMap& map = result.map.map;
  const std::vector<Estimate>& track = result.trajectory;
  const auto valid = std::count_if(track.begin(), track.end(), [](const Estimate& pose) { return pose.valid; });
  const double duration_s = track.empty() ? 0.0 : seconds(track.back().stamp_ns - track.front().stamp_ns);
  const RangeBias& bias = map.range_bias;
  std::ofstream file = open(path);
  file << "{\n  \"bag\": " << quoted(bag) << ",\n  \"duration_s\": " << duration_s
       << ",\n  \"imu_samples\": " << result.imu_samples << ",\n  \"wheel_samples\": " << result.wheel_samples
       << ",\n  \"scans\": " << result.sweeps << ",\n  \"scans_used\": " << result.sweeps_used
       << ",\n  \"scans_refused\": " << result.sweeps_refused << ",\n  \"poses\": " << track.size()
       << ",\n  \"poses_valid\": " << valid << ",\n  \"map_valid\": " << (map.valid ? "true" : "false")
       << ",\n  \"map_revision\": " << result.map.revision << ",\n  \"map_from_s\": " << seconds(result.map.stamp_ns)
       << ",\n  \"map_message\": " << quoted(map.message.text) << ",\n  \"key_frames\": " << map.key_frames.size()
       << ",\n  \"surfels\": " << map.surfels.size() << ",\n  \"range_bias_m\": " << bias.value_m[0]
       << ",\n  \"range_bias_sigma_m\": " << std::sqrt(bias.covariance(0, 0))
       << ",\n  \"rear_range_bias_m\": " << bias.value_m[1]
       << ",\n  \"rear_range_bias_sigma_m\": " << std::sqrt(bias.covariance(1, 1))
       << ",\n  \"cpu_ms_per_scan\": " << (result.sweeps_used > 0 ? 1e3 * result.tracking_s / result.sweeps_used : 0.0)
       << ",\n  \"worst_latency_ms\": " << result.max_ms << ",\n  \"adjustment_cpu_s\": " << result.adjustment_s
       << ",\n  \"wall_s\": " << result.wall_s << ",\n";
  write_refusals(file, result);
  write_messages(file, result);
  file << "}\n";
}

void write_map(const MapResult& result, const std::string& folder) {
  mtr_surfel_map::write_surfaces(result.map, folder + "/surfaces.csv");
  mtr_surfel_map::write_key_frames(result.map, folder + "/key_frames.csv");
  mtr_surfel_map::write_grid(result.grid, folder);
  if (result.map.valid) {
    write_bag(saved_map_of(result, message_of(result), grid_message_of(result)), folder + "/map.bag");
  }
}

}  // namespace

void write_files(const Result& result, const std::string& bag, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error("Folder " + folder + " cannot be made: " + error.message() + ".");
  }
  write_trajectory(result.trajectory, folder + "/trajectory.csv");
  write_tum(result.trajectory, folder + "/trajectory.tum");
  if (result.is_map_new) {
    write_map(result.map, folder);
  }
  write_summary(result, bag, folder + "/summary.json");
}

}  // namespace mtr_localization::replay
