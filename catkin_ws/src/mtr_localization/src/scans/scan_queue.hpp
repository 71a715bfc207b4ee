/// @file
/// Queue of sweeps between sensor and filter.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "motion/filter_history.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

/// Buffers sweeps until the filter has passed their time stamps; rejects implausible ones.
class ScanQueue {
 public:
  /// @param lag_ns delay from the end of a sweep to its use in lock-step; without it, sweeps are used at once
  explicit ScanQueue(std::optional<std::int64_t> lag_ns) : lag_ns_(lag_ns) {}

  /// Adds a sweep. Returns one sentence if it is rejected, otherwise an empty text.
  std::string add(Sweep sweep);

  /// Returns sweeps that are due at the newest step, oldest first; sweeps of one step form a set.
  std::vector<ScanSet> take_due(const FilterHistory& history);

  int refused() const { return refused_; }
  int used() const { return used_; }

 private:
  std::string problem_with(const Sweep& sweep) const;
  bool is_repeated(const Sweep& sweep) const;
  std::int64_t due_ns(const Sweep& sweep) const;

  std::optional<std::int64_t> lag_ns_;
  std::deque<Sweep> waiting_;
  std::array<std::optional<std::int64_t>, kLidars> newest_ns_;
  std::array<std::vector<float>, kLidars> newest_ranges_;
  int refused_ = 0;
  int used_ = 0;
};

}  // namespace mtr_localization
