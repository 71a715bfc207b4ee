/// @file
/// Detects other publishers of wheel commands.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace mtr_drive_control {

/// Node that publishes on a topic without permission.
struct Intruder {
  std::string node;
  std::string topic;
};

/// Queries the master once a second for publishers on the wheels' topics, in a separate thread: a slow or missing
/// master causes no delay, and leaves the last result in force.
class PublisherWatch {
 public:
  /// Queries once before it returns.
  /// @param permitted the only node that may publish on each topic
  explicit PublisherWatch(std::map<std::string, std::string> permitted);
  ~PublisherWatch();
  PublisherWatch(const PublisherWatch&) = delete;
  PublisherWatch& operator=(const PublisherWatch&) = delete;

  std::optional<Intruder> intruder() const;

 private:
  void look();
  void run();

  std::map<std::string, std::string> permitted_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::optional<Intruder> intruder_;
  std::thread thread_;
};

}  // namespace mtr_drive_control
