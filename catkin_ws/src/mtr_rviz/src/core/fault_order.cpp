/// @file
/// Orders to the fault injection node, and sentences about active faults.
// SPDX-License-Identifier: Apache-2.0
#include "core/fault_order.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_rviz {

std::optional<FaultOrder> order_of(const FaultCatalogue& catalogue, const FaultOrder& wanted) {
  const auto part = catalogue.find(wanted.part);
  if (part == catalogue.end()) {
    return std::nullopt;
  }
  const bool is_known =
      wanted.kind == kNoFault || std::find(part->second.begin(), part->second.end(), wanted.kind) != part->second.end();
  const bool has_numbers = std::isfinite(wanted.duration_s) && wanted.duration_s > 0.0 &&
                           std::isfinite(wanted.amount) && wanted.amount >= 0.0;
  return is_known && has_numbers ? std::optional<FaultOrder>(wanted) : std::nullopt;
}

std::string fault_sentence(const std::string& part, const std::string& kind, double left_s) {
  const int whole_s = static_cast<int>(std::ceil(std::max(left_s, 0.0)));
  return part + ": " + kind + ", for another " + std::to_string(whole_s) + " s.";
}

}  // namespace mtr_rviz
