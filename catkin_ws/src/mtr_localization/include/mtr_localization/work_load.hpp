/// @file
/// What scans cost, for a person.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace mtr_localization {

/// Wall time of answers that used scans: its mean over some seconds, and its maximum.
class WorkLoad {
 public:
  class Watch {
   public:
    double elapsed_ms() const {
      return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun_).count();
    }

   private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  };

  /// An answer took so long and used so many scans.
  void add(double elapsed_ms, int scans) {
    if (scans > 0) {
      mean_ms_ += kForgetting * (elapsed_ms / scans - mean_ms_);
      longest_ms_ = std::max(longest_ms_, elapsed_ms);
    }
  }

  double mean_ms_per_scan() const { return mean_ms_; }
  double longest_ms() const { return longest_ms_; }

 private:
  static constexpr double kForgetting = 0.02;
  double mean_ms_ = 0.0;
  double longest_ms_ = 0.0;
};

}  // namespace mtr_localization
