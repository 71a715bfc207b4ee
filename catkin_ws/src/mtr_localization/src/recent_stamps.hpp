/// @file
/// Which times transforms have been sent for: tf takes no second one of a time, and complains of each.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace mtr_localization {

/// The newest stamps, in whatever order they came: a sweep that ended before the newest pose comes after it, and one
/// whose processing was late may end at the time of any pose of the last tenths of a second.
class RecentStamps {
 public:
  /// Notes a stamp.
  /// @return false when it is one of those
  bool note(std::int64_t stamp_ns) {
    if (std::find(stamps_ns_.begin(), stamps_ns_.begin() + count_, stamp_ns) != stamps_ns_.begin() + count_) {
      return false;
    }
    stamps_ns_[next_] = stamp_ns;
    next_ = (next_ + 1) % kCapacity;
    count_ = std::min(count_ + 1, kCapacity);
    return true;
  }

 private:
  /// A second of poses and of the sweeps of two fast LiDARs.
  static constexpr std::ptrdiff_t kCapacity = 150;
  std::array<std::int64_t, kCapacity> stamps_ns_{};
  std::ptrdiff_t next_ = 0;
  std::ptrdiff_t count_ = 0;
};

}  // namespace mtr_localization
