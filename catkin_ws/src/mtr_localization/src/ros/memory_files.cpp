/// @file
/// Storage of map and pose, and the writer thread.
// SPDX-License-Identifier: Apache-2.0
#include "ros/memory_files.hpp"

#include <ros/console.h>

#include <filesystem>
#include <utility>

#include "mtr_core/clock.hpp"

namespace mtr_localization {
namespace {

// roslaunch restarts a node after 2 s, or later on a busy machine. After a longer time the robot may have been moved.
constexpr double kForgottenAfterS = 30.0;

void remove_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::remove(path, error) && error) {
    throw FileUnusable("File " + path + " cannot be removed: " + error.message() + ".");
  }
}

/// Reads a file; returns nothing if it belongs to another run or is not usable.
template <typename Content>
std::optional<Content> read(std::optional<Content> (*reader)(const std::string&), const std::string& path) {
  try {
    return reader(path);
  } catch (const FileUnusable& error) {
    ROS_WARN("%s What it knew is forgotten.", error.what());
    return std::nullopt;
  }
}

}  // namespace

MemoryFiles::MemoryFiles(const std::string& folder, std::string run_id) : run_id_(std::move(run_id)) {
  if (folder.empty() || run_id_.empty()) {
    return;
  }
  map_path_ = folder + "/localization_map.bag";
  pose_path_ = folder + "/localization_pose.bag";
  thread_ = std::thread([this] { run(); });
}

MemoryFiles::~MemoryFiles() {
  if (!thread_.joinable()) {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  is_changed_.notify_one();
  thread_.join();
}

std::optional<SavedMap> MemoryFiles::map() {
  std::optional<SavedMap> found = map_path_.empty() ? std::nullopt : read(read_map, map_path_);
  has_map_ = found && found->map.run_id == run_id_;
  return has_map_ ? std::move(found) : std::nullopt;
}

std::optional<RememberedPose> MemoryFiles::pose() const {
  const auto found = pose_path_.empty() ? std::nullopt : read(read_pose, pose_path_);
  if (!found || found->run_id != run_id_) {
    return std::nullopt;
  }
  const double age_s = static_cast<double>(mtr_core::boot_time_ns()) * 1e-9 - found->boot_time_s;
  return age_s <= kForgottenAfterS ? std::optional(remembered_pose_of(*found)) : std::nullopt;
}

void MemoryFiles::keep_map(SavedMap map) {
  has_map_ = true;
  map.map.run_id = run_id_;
  later(map_path_, [path = map_path_, map = std::move(map)] { write_bag(map, path); });
}

void MemoryFiles::note(const Estimate& estimate) {
  if (has_map_ && estimate.map_revision == 0) {
    has_map_ = false;
    later(map_path_, [path = map_path_] { remove_file(path); });
  }
  const bool is_sure = estimate.valid && estimate.mode == PoseMode::kLocalized;
  if (is_sure && (!has_pose_ || is_due(estimate.stamp_ns, kept_ns_))) {
    keep_pose(estimate);
  } else if (!is_sure && has_pose_) {
    has_pose_ = false;
    later(pose_path_, [path = pose_path_] { remove_file(path); });
  }
}

void MemoryFiles::keep_pose(const Estimate& estimate) {
  has_pose_ = true;
  kept_ns_ = estimate.stamp_ns;
  mtr_msgs::SavedPose pose = saved_pose_of(estimate);
  pose.run_id = run_id_;
  later(pose_path_, [path = pose_path_, pose] { write_bag(pose, path); });
}

void MemoryFiles::later(const std::string& path, std::function<void()> work) {
  if (!thread_.joinable()) {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_[path] = std::move(work);
  }
  is_changed_.notify_one();
}

void MemoryFiles::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ends_ || !waiting_.empty()) {
    is_changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    const auto works = std::exchange(waiting_, {});
    lock.unlock();
    for (const auto& [path, work] : works) {
      try {
        work();
      } catch (const FileUnusable& error) {
        ROS_WARN_THROTTLE(60.0, "%s After a restart the Car will have to be mapped again.", error.what());
      }
    }
    lock.lock();
  }
}

}  // namespace mtr_localization
