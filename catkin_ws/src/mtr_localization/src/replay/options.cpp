/// @file
/// Command-line parsing.
// SPDX-License-Identifier: Apache-2.0
#include "replay/options.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace mtr_localization::replay {
namespace {

const char kUsage[] =
    "Usage: replay BAG --out DIR [--front-only] [--in-motion] [--parameter NAME=VALUE ...] "
    "[--loop-end STAMP_S | --map FILE [--begin-at X Y HEADING]]";

double number_of(const std::string& text, const std::string& what) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && std::isfinite(value)) {
      return value;
    }
  } catch (const std::logic_error&) {
    // Reported below.
  }
  throw std::runtime_error(what + " is '" + text + "', which is no number.");
}

/// Sets a parameter. Returns false if no row has the name; throws ConfigurationError for a value out of range.
template <typename Rows, typename P>
bool set(const Rows& rows, P& parameters, const std::string& name, double value) {
  for (const auto& row : rows) {
    if (name == row.name) {
      parameters.*(row.member) = mtr_core::check_range(name, value, row.low, row.high, row.unit);
      return true;
    }
  }
  return false;
}

void set_parameter(Options& options, const std::string& assignment) {
  const std::size_t sign = assignment.find('=');
  if (sign == std::string::npos) {
    throw std::runtime_error("Parameter '" + assignment + "' is not of the form NAME=VALUE.");
  }
  const std::string name = assignment.substr(0, sign);
  const double value = number_of(assignment.substr(sign + 1), "Parameter " + name);
  // Several groups may share a name: the noise of a sensor is one parameter for all its users.
  bool is_known = set(kMountingRows, options.mounting, name, value);
  for_each_group(options.parameters,
                 [&](const auto& rows, auto& group) { is_known = set(rows, group, name, value) || is_known; });
  if (!is_known) {
    throw std::runtime_error("Parameter " + name + " is unknown; see the package's README.");
  }
}

/// Appends a line for each row whose name is not yet listed.
template <typename Rows, typename P>
void tell(const Rows& rows, const P& parameters, std::set<std::string>& told, std::ostringstream& text) {
  for (const auto& row : rows) {
    if (told.insert(row.name).second) {
      text << "  " << row.name << "=" << parameters.*(row.member) << "  "
           << mtr_core::range_text(row.low, row.high, row.unit) << "\n";
    }
  }
}

}  // namespace

bool asks_for_help(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(),
                     [](const std::string& each) { return each == "--help" || each == "-h"; });
}

std::string help() {
  const Options options;
  std::set<std::string> told;
  std::ostringstream text;
  text << kUsage << "\n\nParameters with their defaults, and what is allowed:\n";
  for_each_group(options.parameters, [&](const auto& rows, const auto& group) { tell(rows, group, told, text); });
  text << "\nWhere the LiDARs sit, of a bag that does not say it:\n";
  tell(kMountingRows, options.mounting, told, text);
  return text.str();
}

Options parse(const std::vector<std::string>& arguments) {
  Options options;
  options.parameters.lockstep = true;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto next = [&]() -> const std::string& {
      if (i + 1 >= arguments.size()) {
        throw std::runtime_error(argument + " needs a value. " + kUsage);
      }
      return arguments[++i];
    };
    if (argument == "--front-only") {
      options.front_only = true;
    } else if (argument == "--in-motion") {
      options.parameters.sensors.begins_in_motion = true;
    } else if (argument == "--out") {
      options.folder = next();
    } else if (argument == "--parameter") {
      set_parameter(options, next());
    } else if (argument == "--loop-end") {
      options.loop_end_ns = std::llround(number_of(next(), argument) * 1e9);
    } else if (argument == "--map") {
      options.map = next();
    } else if (argument == "--begin-at") {
      options.begin_at.emplace();
      for (double& value : *options.begin_at) {
        value = number_of(next(), argument);
      }
    } else if (argument.rfind("--", 0) == 0 || !options.bag.empty()) {
      throw std::runtime_error("'" + argument + "' is not understood. " + kUsage);
    } else {
      options.bag = argument;
    }
  }
  if (options.bag.empty() || options.folder.empty()) {
    throw std::runtime_error(kUsage);
  }
  if (!options.map.empty() && options.loop_end_ns) {
    throw std::runtime_error("--loop-end makes a map and --map brings one; give one of them.");
  }
  if (options.begin_at && options.map.empty()) {
    throw std::runtime_error("--begin-at is a place on a map; give --map, too.");
  }
  return options;
}

}  // namespace mtr_localization::replay
