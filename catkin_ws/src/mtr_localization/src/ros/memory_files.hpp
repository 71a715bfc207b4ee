/// @file
/// Stores map and pose in files in the background, so that a restart can resume with them.
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

/// Files of one run of roslaunch. A map of another run is not resumed, because the robot may have been moved since. A
/// separate thread waits for the disk; of two pending writes to one file, the newer one is executed.
class MemoryFiles {
 public:
  /// @param folder is created when needed; if empty, nothing is stored
  /// @param run_id of roslaunch; if empty, nothing is stored
  MemoryFiles(const std::string& folder, std::string run_id);
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;
  /// Finishes pending writes.
  ~MemoryFiles();

  /// Returns the map of a previous process in this run, or nothing and a log message without a usable one.
  std::optional<SavedMap> map();
  std::optional<RememberedPose> pose() const;

  void keep_map(SavedMap map);
  /// Stores a valid pose in an adjusted map periodically; any other pose deletes the stored one.
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
