/// @file
/// The core of drive control as the Python module mtr_drive_control_core, for benchmarks, tests and simulations in one
/// process.
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <tuple>

#include "mtr_core/python_problem.hpp"
#include "mtr_core/steady_time.hpp"
#include "mtr_drive_control/drive_control.hpp"
#include "mtr_drive_control/interventions.hpp"
#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {
namespace {

namespace py = pybind11;

/// Reads numbers by the names of the parameters; an unknown name is an error.
template <typename P, typename Rows>
P parameters_of(const Rows& rows, const py::dict& values) {
  P parameters;
  for (const auto& [key, value] : values) {
    const std::string name = py::str(key);
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return name == each.name; });
    if (row == rows.end()) {
      throw py::key_error(name);
    }
    parameters.*(row->member) = value.template cast<double>();
  }
  return parameters;
}

template <typename P, typename Rows>
py::dict values_of(const Rows& rows, const P& parameters) {
  py::dict values;
  for (const auto& row : rows) {
    values[row.name] = parameters.*(row.member);
  }
  return values;
}

/// Converts an object with the attributes of mtr_simulation.readings.Scan.
std::shared_ptr<const Sweep> sweep_of(const py::object& scan) {
  if (scan.is_none()) {
    return nullptr;
  }
  const auto number = [&](const char* name) { return scan.attr(name).cast<double>(); };
  const auto ranges = scan.attr("ranges_m").cast<py::array_t<float, py::array::c_style | py::array::forcecast>>();
  return std::make_shared<const Sweep>(Sweep{scan.attr("stamp_ns").cast<std::int64_t>(), number("angle_min_rad"),
                                             number("angle_increment_rad"), number("time_increment_s"),
                                             number("range_min_m"), number("range_max_m"),
                                             std::vector<float>(ranges.data(), ranges.data() + ranges.size()), "", "",
                                             py::hasattr(scan, "scan_time_s") ? number("scan_time_s") : 0.0});
}

std::optional<Motion> motion_of(std::int64_t stamp_ns, const py::object& odometry) {
  if (odometry.is_none()) {
    return std::nullopt;
  }
  const auto number = [&](const char* name) { return odometry.attr(name).cast<double>(); };
  return Motion{stamp_ns,
                Pose(number("x_m"), number("y_m"), number("heading_rad")),
                {number("linear_mps"), number("angular_radps")}};
}

/// Converts an object with the attributes of mtr_simulation.readings.ImuReading.
std::optional<ImuReading> imu_of(std::int64_t stamp_ns, const py::object& imu) {
  if (imu.is_none()) {
    return std::nullopt;
  }
  using Vector = std::array<double, 3>;
  return ImuReading{stamp_ns, imu.attr("angular_velocity").cast<Vector>(), imu.attr("acceleration").cast<Vector>()};
}

std::optional<SourceCommand> command_of(std::int64_t tick_ns, const std::optional<std::pair<double, double>>& desired) {
  return desired ? std::optional<SourceCommand>({tick_ns, {desired->first, desired->second}, true}) : std::nullopt;
}

std::pair<double, double> follow(VelocityLimiter& limiter, double linear_mps, double angular_radps) {
  limiter.send(limiter.toward({linear_mps, angular_radps}));
  return {limiter.sent().linear_mps, limiter.sent().angular_radps};
}

Decision step(DriveControl& control, std::int64_t tick_ns, const std::optional<std::pair<double, double>>& planner,
              const std::optional<std::pair<double, double>>& manual, const std::vector<std::string>& locks,
              const py::object& front, const py::object& rear, const py::object& odometry, double key_height_m,
              const py::object& imu, const std::optional<LocalizedMap>& map) {
  Inputs inputs;
  for (const std::string& owner : locks) {
    inputs.locks.push_back({owner, mtr_core::problem_with_text("Locked by " + owner + ".")});
  }
  inputs.planner = command_of(tick_ns, planner);
  inputs.manual = command_of(tick_ns, manual);
  inputs.sensors = {sweep_of(front), sweep_of(rear), motion_of(tick_ns, odometry), map};
  inputs.key = KeyHeight{tick_ns, key_height_m};
  inputs.imu = imu_of(tick_ns, imu);
  return control.step(tick_ns, inputs);
}

/// Map of an empty site, free up to this distance from its origin, with the pose of odom in it.
LocalizedMap empty_map(double half_side_m, const std::tuple<double, double, double>& map_from_odom) {
  constexpr double kCellM = 0.1;
  const auto side = static_cast<std::size_t>(2.0 * half_side_m / kCellM);
  auto map = std::make_shared<SiteMap>();
  map->free = {Pose(-half_side_m, -half_side_m, 0.0), kCellM, side, std::vector<bool>(side * side, true)};
  const auto& [x_m, y_m, heading_rad] = map_from_odom;
  return {map, Pose(x_m, y_m, heading_rad)};
}

/// Newest sweep of a LiDAR, unchanged until another is set.
class SweepHolder {
 public:
  void take(const py::object& scan) { sweep_ = sweep_of(scan); }
  const std::shared_ptr<const Sweep>& sweep() const { return sweep_; }

 private:
  std::shared_ptr<const Sweep> sweep_;
};

/// Stamp in ns, m/s, rad/s, and true if the source is active.
using CommandTuple = std::tuple<std::int64_t, double, double, bool>;

std::optional<SourceCommand> source_command_of(const std::optional<CommandTuple>& command) {
  if (!command) {
    return std::nullopt;
  }
  const auto& [stamp_ns, linear_mps, angular_radps, active] = *command;
  return SourceCommand{stamp_ns, {linear_mps, angular_radps}, active};
}

/// Drive control of a whole robot, including the locks and counters of its node.
class RobotDrive {
 public:
  RobotDrive(const std::string& urdf, bool has_rear_lidar, const std::vector<std::string>& lock_owners, double period_s)
      : control_(Parameters{}, CollisionParameters{}, shape_of(mtr_description::RobotGeometry(urdf), has_rear_lidar),
                 period_s),
        locks_(lock_owners, Parameters{}.lock_timeout_s, in_lockstep()) {
    check_balance(Parameters{}, mtr_description::RobotGeometry(urdf));
  }

  void take_scan(bool is_rear, const py::object& scan) { (is_rear ? rear_ : front_).take(scan); }

  void take_lock(const std::string& owner, std::int64_t stamp_ns, bool engaged,
                 const std::vector<mtr_core::ProblemTuple>& problems, const std::string& reason) {
    locks_.take(owner, {stamp_ns, engaged, mtr_core::problem_in(problems, reason)});
  }

  /// @param key stamp in ns and height in m, if known
  /// @param speed_limit stamp in ns and m/s of the state machine's newest mode; empty before the first one
  Decision step(std::int64_t tick_ns, const py::object& odometry, const py::object& imu,
                const std::optional<std::pair<std::int64_t, double>>& key, const std::optional<CommandTuple>& planner,
                const std::optional<std::pair<std::int64_t, double>>& speed_limit) {
    Inputs inputs;
    inputs.sensors = {front_.sweep(), rear_.sweep(), motion_of(tick_ns, odometry)};
    inputs.imu = imu_of(tick_ns, imu);
    inputs.key = key ? std::optional<KeyHeight>({key->first, key->second}) : std::nullopt;
    inputs.locks = locks_.engaged_at(tick_ns);
    inputs.locks_age_s = locks_.age_s();
    inputs.planner = source_command_of(planner);
    inputs.speed_limit =
        speed_limit ? SpeedLimit{speed_limit->first, speed_limit->second} : SpeedLimit{mtr_core::kNeverNs, 0.0};
    Decision decision = control_.step(tick_ns, inputs);
    counted_ = counter_.count(decision);
    return decision;
  }

  /// Manual drives, blockages and lock stops so far.
  std::tuple<std::uint32_t, std::uint32_t, std::uint32_t> interventions() const {
    return {counted_.manual_drives, counted_.blockages, counted_.lock_stops};
  }

 private:
  /// All senders have already published, so there is nothing to wait for.
  static mtr_core::Waiting in_lockstep() {
    return {[](double) { return false; }, [] { return 0.0; }, 0.0};
  }

  DriveControl control_;
  MotionLocks locks_;
  SweepHolder front_;
  SweepHolder rear_;
  InterventionCounter counter_;
  Interventions counted_;
};

void bind_robot(py::module& module) {
  py::class_<RobotDrive>(module, "RobotDrive")
      .def(py::init<const std::string&, bool, const std::vector<std::string>&, double>(), py::arg("urdf"),
           py::arg("rear_lidar"), py::arg("lock_owners"), py::arg("period_s"))
      .def("take_scan", &RobotDrive::take_scan, py::arg("is_rear"), py::arg("scan"))
      .def("take_lock", &RobotDrive::take_lock, py::arg("owner"), py::arg("stamp_ns"), py::arg("engaged"),
           py::arg("problems") = std::vector<mtr_core::ProblemTuple>(), py::arg("reason") = "")
      .def("step", &RobotDrive::step, py::arg("tick_ns"), py::kw_only(), py::arg("odometry"), py::arg("imu"),
           py::arg("key"), py::arg("planner"), py::arg("speed_limit"),
           "Velocity of this tick in lock-step, with what its node keeps.")
      .def_property_readonly("interventions", &RobotDrive::interventions);
}

}  // namespace

PYBIND11_MODULE(mtr_drive_control_core, module) {
  module.doc() = "The core of drive control: from desired velocities, sweeps and odometry to the wheels' velocity.";
  module.def("default_limits", [] { return values_of(kRows, Parameters{}); });
  module.def("default_collision", [] { return values_of(kCollisionRows, CollisionParameters{}); });
  module.def(
      "limits_at",
      [](double key_height_m, const py::dict& limits) {
        return values_of<Parameters>(kRows, limits_at(parameters_of<Parameters>(kRows, limits), key_height_m));
      },
      py::arg("key_height_m"), py::arg("limits") = py::dict());
  module.def(
      "yaw_rate_at",
      [](double key_height_m, double linear_mps) {
        return limits_at(Parameters{}, key_height_m).yaw_rate_at_radps(linear_mps);
      },
      py::arg("key_height_m"), py::arg("linear_mps"), "Largest permitted yaw rate at a speed.");
  py::class_<VelocityLimiter>(module, "VelocityLimiter")
      .def(py::init([](double key_height_m, double period_s) {
             return VelocityLimiter(limits_at(Parameters{}, key_height_m), period_s);
           }),
           py::arg("key_height_m"), py::arg("period_s") = 0.02)
      .def("follow", &follow, py::arg("linear_mps"), py::arg("angular_radps"),
           "Velocity sent next on the way to the wanted one.");
  py::class_<Decision>(module, "Decision")
      .def_property_readonly("linear_mps", [](const Decision& decision) { return decision.velocity.linear_mps; })
      .def_property_readonly("angular_radps", [](const Decision& decision) { return decision.velocity.angular_radps; })
      .def_readonly("source", &Decision::source)
      .def_readonly("engaged_locks", &Decision::engaged_locks)
      .def_property_readonly("message", [](const Decision& decision) { return decision.message.text; })
      .def_property_readonly("problems", [](const Decision& decision) { return mtr_core::tuples_of(decision.message); })
      .def_property_readonly("zone", [](const Decision& decision) { return static_cast<int>(decision.zone); })
      .def_property_readonly(
          "obstacle_m", [](const Decision& decision) { return decision.hindrance.value_or(Hindrance{}).distance_m; })
      .def_property_readonly("obstacle_bearing", [](const Decision& decision) {
        return decision.hindrance.value_or(Hindrance{}).bearing_rad;
      });
  py::class_<LocalizedMap>(module, "LocalizedMap");
  module.def("empty_map", &empty_map, py::arg("half_side_m"),
             py::arg("map_from_odom") = std::tuple<double, double, double>(0.0, 0.0, 0.0));
  py::class_<DriveControl>(module, "DriveControl")
      .def(py::init([](const std::string& urdf, bool rear_lidar, const py::dict& limits, const py::dict& collision,
                       double period_s, bool contact_skirt) {
             const mtr_description::RobotGeometry geometry(urdf);
             const auto parameters = parameters_of<Parameters>(kRows, limits);
             check_balance(parameters, geometry);
             auto margins = parameters_of<CollisionParameters>(kCollisionRows, collision);
             margins.contact_skirt = contact_skirt;
             return DriveControl(parameters, margins, shape_of(geometry, rear_lidar), period_s);
           }),
           py::arg("urdf"), py::arg("rear_lidar") = true, py::arg("limits") = py::dict(),
           py::arg("collision") = py::dict(), py::arg("period_s") = 0.02, py::arg("contact_skirt") = false)
      .def("step", &step, py::arg("tick_ns"), py::kw_only(), py::arg("planner") = py::none(),
           py::arg("manual") = py::none(), py::arg("locks") = std::vector<std::string>(), py::arg("front") = py::none(),
           py::arg("rear") = py::none(), py::arg("odometry") = py::none(), py::arg("key_height_m") = 0.35,
           py::arg("imu") = py::none(), py::arg("map") = py::none(),
           "Velocity of this tick; front and rear are the newest sweeps, the same again until there is a new one.");
  bind_robot(module);
}

}  // namespace mtr_drive_control
