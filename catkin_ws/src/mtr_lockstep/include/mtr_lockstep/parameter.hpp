/// @file
/// One numeric parameter of a node with its unit and allowed range, as Python's mtr_core.errors.check_range. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace mtr_lockstep {

/// A parameter is missing or out of range; the node does not start. The text is one sentence for a person.
class ConfigurationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns value when low <= value <= high (so NaN never passes); else throws ConfigurationError.
inline double check_range(const std::string& name, double value, double low, double high, const std::string& unit) {
  if (value >= low && value <= high) {
    return value;
  }
  std::ostringstream text;
  text << "Parameter " << name << " is " << value << " " << unit << "; allowed is " << low << " to " << high << " "
       << unit << ".";
  throw ConfigurationError(text.str());
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

}  // namespace mtr_lockstep
