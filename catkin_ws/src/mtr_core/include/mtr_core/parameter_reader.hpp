/// @file
/// Reads a node's parameters from the parameter server's values, like Python's mtr_core.parameters. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "mtr_core/parameter.hpp"

namespace mtr_core {

/// Reads values one by one; `finish` rejects values that were not read and returns the effective ones.
class ParameterReader {
 public:
  /// @param values a struct; anything else counts as empty
  explicit ParameterReader(const XmlRpc::XmlRpcValue& values) : values_(values) {}

  /// Overwrites the numbers in parameters; throws ConfigurationError for a value that is not a number or out of range.
  template <typename Rows, typename P>
  void read_numbers(const Rows& rows, P& parameters) {
    for (const ParameterRow<P>& row : rows) {
      double& value = parameters.*(row.member);
      if (has(row.name)) {
        value = number(row.name, "a number, " + range_text(row.low, row.high, row.unit));
      }
      check_range(row.name, value, row.low, row.high, row.unit);
      tell(row.name, with_unit(value, row.unit));
    }
  }

  /// Overwrites a switch; throws ConfigurationError for a value that is neither true nor false.
  void read(const std::string& name, bool& value) {
    if (has(name)) {
      require(values_[name].getType() == XmlRpc::XmlRpcValue::TypeBoolean, name, "true or false");
      value = static_cast<bool&>(values_[name]);
    }
    tell(name, value ? "true" : "false");
  }

  /// Overwrites a text; throws ConfigurationError for an empty text and for other types.
  void read(const std::string& name, std::string& value) {
    if (has(name)) {
      const bool is_text = values_[name].getType() == XmlRpc::XmlRpcValue::TypeString;
      const std::string given = is_text ? static_cast<std::string&>(values_[name]) : "";
      require(!given.empty(), name, "a text");
      value = given;
    }
    tell(name, value);
  }

  /// Overwrites a text that must be one of the choices; throws ConfigurationError for anything else.
  void read(const std::string& name, std::string& value, const std::set<std::string>& choices) {
    if (has(name)) {
      const bool is_text = values_[name].getType() == XmlRpc::XmlRpcValue::TypeString;
      const std::string given = is_text ? static_cast<std::string&>(values_[name]) : "";
      std::string allowed;
      for (const std::string& choice : choices) {
        allowed += (allowed.empty() ? "" : " or ") + choice;
      }
      require(choices.count(given) > 0, name, allowed);
      value = given;
    }
    tell(name, value);
  }

  /// Overwrites a list of texts; throws ConfigurationError for anything else.
  void read(const std::string& name, std::vector<std::string>& value) {
    if (has(name)) {
      value = texts(name);
    }
    std::string list;
    for (const std::string& each : value) {
      list += (list.empty() ? "'" : ", '") + each + "'";
    }
    tell(name, "[" + list + "]");
  }

  /// Accepts values that other code reads.
  void ignore(const std::set<std::string>& names) { known_.insert(names.begin(), names.end()); }

  /// Returns all effective values in one line; throws ConfigurationError if a given value was not read.
  std::string finish() {
    if (values_.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
      for (const auto& entry : values_) {
        if (known_.count(entry.first) == 0) {
          throw ConfigurationError("Parameter " + entry.first + " is unknown; allowed are " + known_names() + ".");
        }
      }
    }
    return line_;
  }

 private:
  bool has(const std::string& name) {
    known_.insert(name);
    return values_.getType() == XmlRpc::XmlRpcValue::TypeStruct && values_.hasMember(name);
  }

  void require(bool right, const std::string& name, const std::string& allowed) {
    if (!right) {
      std::ostringstream text;
      text << "Parameter " << name << " is ";
      values_[name].write(text);
      throw ConfigurationError(text.str() + "; allowed is " + allowed + ".");
    }
  }

  double number(const std::string& name, const std::string& allowed) {
    XmlRpc::XmlRpcValue& value = values_[name];
    if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) {
      return static_cast<int&>(value);
    }
    require(value.getType() == XmlRpc::XmlRpcValue::TypeDouble, name, allowed);
    return static_cast<double&>(value);
  }

  std::vector<std::string> texts(const std::string& name) {
    XmlRpc::XmlRpcValue& value = values_[name];
    bool right = value.getType() == XmlRpc::XmlRpcValue::TypeArray;
    std::vector<std::string> found;
    for (int i = 0; right && i < value.size(); ++i) {
      right = value[i].getType() == XmlRpc::XmlRpcValue::TypeString;
      found.push_back(right ? static_cast<std::string&>(value[i]) : "");
    }
    require(right, name, "a list of texts");
    return found;
  }

  void tell(const std::string& name, const std::string& value) {
    line_ += (line_.empty() ? "" : ", ") + name + " " + value;
  }

  std::string known_names() const {
    std::string list;
    for (const std::string& name : known_) {
      list += (list.empty() ? "" : ", ") + name;
    }
    return list;
  }

  XmlRpc::XmlRpcValue values_;
  std::set<std::string> known_;
  std::string line_;
};

}  // namespace mtr_core
