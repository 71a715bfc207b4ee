/// @file
/// Keeps the map and the pose in files, beside the work, so that a restart goes on with them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/saved_map.hpp"

namespace mtr_localization {

/// Files of one run of roslaunch: a map of another run is not gone on with, for the robot may have been anywhere since.
/// Writing waits for the disk in a thread of its own; of two writes of one file the newer counts.
class MemoryFiles {
 public:
  /// @param folder is made when there is something to keep; empty: nothing is kept
  /// @param run_id of roslaunch; empty: nothing is kept
  MemoryFiles(const std::string& folder, std::string run_id);
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;
  /// What is still to be written is written before.
  ~MemoryFiles();

  /// What a process of this run left; none when there is nothing of use, which is told in the log.
  std::optional<SavedMap> map();
  std::optional<RememberedPose> pose() const;

  void keep_map(SavedMap map);
  /// A pose that was answered: a valid one in an adjusted map is kept now and then, any other ends what was kept.
  void note(const Estimate& estimate);

 private:
  void keep_pose(const Estimate& estimate);
  void later(const std::string& path, std::function<void()> work);
  void run();

  std::string map_path_;
  std::string pose_path_;
  std::string run_id_;
  bool has_map_ = false;
  bool has_pose_ = false;
  std::int64_t kept_ns_ = 0;

  std::mutex mutex_;
  std::condition_variable is_changed_;
  std::map<std::string, std::function<void()>> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace mtr_localization
