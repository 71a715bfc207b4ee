/// @file
/// Whether anybody else commands the wheels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace mtr_drive_control {

/// A node that publishes on a topic where it must not.
struct Intruder {
  std::string node;
  std::string topic;
};

/// Asks the master once a second who publishes on the wheels' topics, in a thread of its own: a master that is slow or
/// gone delays nobody, and leaves the last answer in force.
class PublisherWatch {
 public:
  /// Looks once before it returns.
  /// @param permitted the one node that may publish on each topic
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
