/// @file
/// One numeric parameter of a node with its unit and allowed range, like Python's mtr_core.errors.check_range. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace mtr_core {

/// A parameter is missing or out of range; the node does not start. The text is one sentence for a person.
class ConfigurationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the value with its unit, if it has one.
inline std::string with_unit(double value, const std::string& unit) {
  std::ostringstream text;
  text << value << (unit.empty() ? "" : " ") << unit;
  return text.str();
}

/// Returns the range with its unit, if it has one.
inline std::string range_text(double low, double high, const std::string& unit) {
  std::ostringstream text;
  text << low << " to " << with_unit(high, unit);
  return text.str();
}

/// Returns value if low <= value <= high, otherwise throws ConfigurationError; NaN always throws.
inline double check_range(const std::string& name, double value, double low, double high, const std::string& unit) {
  if (value >= low && value <= high) {
    return value;
  }
  throw ConfigurationError("Parameter " + name + " is " + with_unit(value, unit) + "; allowed is " +
                           range_text(low, high, unit) + ".");
}

/// A parameter's place in the struct P that holds all parameters of a node.
template <typename P>
struct ParameterRow {
  const char* name;
  double P::*member;
  double low;
  double high;
  const char* unit;
};

}  // namespace mtr_core
