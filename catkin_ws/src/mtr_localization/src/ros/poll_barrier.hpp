/// @file
/// Waits until everything that has arrived at this process has been read.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/poll_manager.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace mtr_localization {

/// One thread of roscpp reads all connections, one after the other. On a busy machine it is suspended between two of
/// them, so that the wheels' messages of half a second are there while those of the IMU still wait in their socket.
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

  /// Returns when all connections have been read once since the call, or at the latest after max_wall_s.
  void wait(double max_wall_s) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(max_wall_s);
    // The pass that is under way may be past a connection; a whole one follows it.
    for (int pass = 0; pass < 2; ++pass) {
      std::unique_lock<std::mutex> lock(mutex_);
      const unsigned before = passes_;
      // Without it the reading thread would wait for the next message.
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
