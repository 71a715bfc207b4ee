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

#include "mtr_localization/filter_history.hpp"
#include "mtr_localization/sweep.hpp"

namespace mtr_localization {

/// Sweeps that hold at one step of the filter, and their points.
struct Look {
  std::vector<Sweep> sweeps;
  ScanPoints scan;
  /// Step of the history whose stamp is the scan's.
  std::size_t step;
};

/// Keeps sweeps until the filter has lived through them; refuses those that make no sense.
class SweepQueue {
 public:
  /// @param lag_ns from a sweep's end until it is used, in lock-step; without it, it is used at once
  explicit SweepQueue(std::optional<std::int64_t> lag_ns) : lag_ns_(lag_ns) {}

  /// Takes a sweep; false when it is refused: see `problem`.
  bool add(Sweep sweep);

  /// Sweeps that are due when the history has come so far, oldest first; those of one step together.
  std::vector<Look> take_due(const FilterHistory& history);

  /// Why the last sweep was refused, one sentence; empty while sweeps are good.
  const std::string& problem() const { return problem_; }
  int refused() const { return refused_; }
  int used() const { return used_; }

 private:
  bool refuse(const std::string& problem);
  std::int64_t due_ns(const Sweep& sweep) const;

  std::optional<std::int64_t> lag_ns_;
  std::deque<Sweep> waiting_;
  std::array<std::optional<std::int64_t>, kLidars> newest_ns_;
  std::string problem_;
  int refused_ = 0;
  int used_ = 0;
};

}  // namespace mtr_localization
