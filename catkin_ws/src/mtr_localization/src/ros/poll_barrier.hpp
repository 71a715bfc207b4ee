/// @file
/// Waiting until all messages that have arrived at this process are read.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/poll_manager.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace mtr_localization {

/// Flushes the receive sockets. One thread of roscpp reads all connections in turn. On a busy machine it may be
/// suspended in between, so that wheel messages of half a second were read while IMU messages still wait in their
/// socket.
class PollBarrier {
 public:
  PollBarrier()
      : listener_(ros::PollManager::instance()->addPollThreadListener([this] {
          const std::lock_guard<std::mutex> lock(mutex_);
          ++passes_;
          changed_.notify_all();
        })) {}
  ~PollBarrier() { ros::PollManager::instance()->removePollThreadListener(listener_); }
  PollBarrier(const PollBarrier&) = delete;
  PollBarrier& operator=(const PollBarrier&) = delete;

  /// Returns after all connections were read once since the call, or after max_wall_s.
  void wait(double max_wall_s) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(max_wall_s);
    // The current pass may already be past a connection, so a complete one must follow.
    for (int pass = 0; pass < 2; ++pass) {
      std::unique_lock<std::mutex> lock(mutex_);
      const unsigned before = passes_;
      // Without the signal, the reading thread would wait for the next message.
      ros::PollManager::instance()->getPollSet().signal();
      if (!changed_.wait_until(lock, deadline, [&] { return passes_ != before; })) {
        return;
      }
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned passes_ = 0;
  boost::signals2::connection listener_;
};

}  // namespace mtr_localization
