/// @file
/// Sweeps on their way from the sensor to the filter.
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

/// Keeps sweeps until the filter has lived through them; refuses those that make no sense.
class ScanQueue {
 public:
  /// @param lag_ns from a sweep's end until it is used, in lock-step; without it, it is used at once
  explicit ScanQueue(std::optional<std::int64_t> lag_ns) : lag_ns_(lag_ns) {}

  /// Takes a sweep; one sentence when it is refused, else empty.
  std::string add(Sweep sweep);

  /// Sweeps that are due when the history has come so far, oldest first; those of one step together.
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
