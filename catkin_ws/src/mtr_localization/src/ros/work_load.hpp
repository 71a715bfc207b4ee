/// @file
/// Computing time of scans, for diagnostics.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace mtr_localization {

/// Wall time of estimates that used scans: mean over some seconds, and maximum.
class WorkLoad {
 public:
  class Timer {
   public:
    double elapsed_ms() const {
      return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun_).count();
    }

   private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  };

  /// Adds the duration of an estimate and its number of scans.
  void add(double elapsed_ms, int scans) {
    if (scans > 0) {
      mean_ms_ += kForgetting * (elapsed_ms / scans - mean_ms_);
      max_ms_ = std::max(max_ms_, elapsed_ms);
    }
  }

  double mean_ms_per_scan() const { return mean_ms_; }
  double max_ms() const { return max_ms_; }

 private:
  static constexpr double kForgetting = 0.02;
  double mean_ms_ = 0.0;
  double max_ms_ = 0.0;
};

}  // namespace mtr_localization
