/// @file
/// The core of drive control as the Python module mtr_drive_control_core, for benchmarks and tests.
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "mtr_drive_control/drive_control.hpp"
#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {
namespace {

namespace py = pybind11;

/// Numbers by the names of the parameters; an unknown name is an error.
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

/// From an object with the attributes of mtr_simulation.readings.Scan.
std::shared_ptr<const Sweep> sweep_of(const py::object& scan) {
  if (scan.is_none()) {
    return nullptr;
  }
  const auto number = [&](const char* name) { return scan.attr(name).cast<double>(); };
  return std::make_shared<const Sweep>(
      Sweep{scan.attr("stamp_ns").cast<std::int64_t>(), number("angle_min_rad"), number("angle_increment_rad"),
            number("time_increment_s"), number("range_min_m"), number("range_max_m"),
            scan.attr("ranges_m").attr("tolist")().cast<std::vector<float>>(), "", ""});
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

/// From an object with the attributes of mtr_simulation.readings.ImuReading.
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
              const py::object& imu) {
  Inputs inputs;
  for (const std::string& owner : locks) {
    inputs.locks.push_back({owner, mtr_core::problem_with_text("Locked by " + owner + ".")});
  }
  inputs.planner = command_of(tick_ns, planner);
  inputs.manual = command_of(tick_ns, manual);
  inputs.sensors = {sweep_of(front), sweep_of(rear), motion_of(tick_ns, odometry)};
  inputs.key = KeyHeight{tick_ns, key_height_m};
  inputs.imu = imu_of(tick_ns, imu);
  return control.step(tick_ns, inputs);
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
      .def_property_readonly("message", [](const Decision& decision) { return decision.message.text; })
      .def_property_readonly("zone", [](const Decision& decision) { return static_cast<int>(decision.zone); })
      .def_property_readonly(
          "obstacle_m", [](const Decision& decision) { return decision.hindrance.value_or(Hindrance{}).distance_m; })
      .def_property_readonly("obstacle_bearing", [](const Decision& decision) {
        return decision.hindrance.value_or(Hindrance{}).bearing_rad;
      });
  py::class_<DriveControl>(module, "DriveControl")
      .def(py::init([](const std::string& urdf, bool rear_lidar, const py::dict& limits, const py::dict& collision,
                       double period_s) {
             const mtr_description::RobotGeometry geometry(urdf);
             const auto parameters = parameters_of<Parameters>(kRows, limits);
             check_balance(parameters, geometry);
             return DriveControl(parameters, parameters_of<CollisionParameters>(kCollisionRows, collision),
                                 shape_of(geometry, rear_lidar), period_s);
           }),
           py::arg("urdf"), py::arg("rear_lidar") = true, py::arg("limits") = py::dict(),
           py::arg("collision") = py::dict(), py::arg("period_s") = 0.02)
      .def("step", &step, py::arg("tick_ns"), py::kw_only(), py::arg("planner") = py::none(),
           py::arg("manual") = py::none(), py::arg("locks") = std::vector<std::string>(), py::arg("front") = py::none(),
           py::arg("rear") = py::none(), py::arg("odometry") = py::none(), py::arg("key_height_m") = 0.35,
           py::arg("imu") = py::none(),
           "Velocity of this tick; front and rear are the newest sweeps, the same again until there is a new one.");
}

}  // namespace mtr_drive_control
