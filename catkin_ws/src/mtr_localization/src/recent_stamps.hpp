/// @file
/// Stamps of published transforms, to avoid duplicates, which tf ignores with a warning.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace mtr_localization {

/// Newest stamps in order of publication. A sweep may end before the newest pose, and a delayed one at the time of any
/// pose of the last tenths of a second.
class RecentStamps {
 public:
  /// Stores a stamp.
  /// @return false if it was already stored
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
  /// Covers a second of poses and of the sweeps of two fast LiDARs.
  static constexpr std::ptrdiff_t kCapacity = 150;
  std::array<std::int64_t, kCapacity> stamps_ns_{};
  std::ptrdiff_t next_ = 0;
  std::ptrdiff_t count_ = 0;
};

}  // namespace mtr_localization
