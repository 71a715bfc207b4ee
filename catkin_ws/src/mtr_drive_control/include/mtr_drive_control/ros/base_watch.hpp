/// @file
/// Changes of the base's limits during operation.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "mtr_drive_control/base_limits.hpp"

namespace mtr_drive_control {

/// Reads the limits of the base's controller every 5 s, in a separate thread. A slow or missing master causes no delay,
/// and leaves the last result in force.
class BaseWatch {
 public:
  /// @param controller namespace of the parameters
  /// @param limits values at the start
  BaseWatch(std::string controller, const Parameters& parameters, const BaseLimits& limits);
  ~BaseWatch();
  BaseWatch(const BaseWatch&) = delete;
  BaseWatch& operator=(const BaseWatch&) = delete;

  /// The changed limit; empty without one.
  std::string change() const;

 private:
  void look();
  void run();

  const std::string controller_;
  const Parameters parameters_;
  const BaseLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::string change_;
  std::thread thread_;
};

}  // namespace mtr_drive_control
