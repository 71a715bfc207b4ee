/// @file
/// The robot in Gazebo: ROS interfaces of sensors, wheels and lift as on the real robot, and the simulated clock.
// SPDX-License-Identifier: Apache-2.0
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <cstdint>
#include <exception>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <vector>

#include "mtr_core/names.hpp"
#include "mtr_core/schedule.hpp"
#include "plugin/base.hpp"
#include "plugin/imu.hpp"
#include "plugin/lidar.hpp"
#include "plugin/truth.hpp"
#include "plugin/values.hpp"

namespace mtr_gazebo {
namespace {

constexpr char kNode[] = "gazebo";
constexpr int kClockQueue = 100;

std::int64_t ns_of(const gazebo::common::Time& time) {
  return mtr_core::kSimulationStartNs + std::int64_t{time.sec} * mtr_core::kSecondNs + time.nsec;
}

}  // namespace

/// Drives wheels and lift before each step, and updates the sensors after it.
class RobotPlugin : public gazebo::ModelPlugin {
 public:
  RobotPlugin() = default;
  RobotPlugin(const RobotPlugin&) = delete;
  RobotPlugin& operator=(const RobotPlugin&) = delete;
  RobotPlugin(RobotPlugin&&) = delete;
  RobotPlugin& operator=(RobotPlugin&&) = delete;

  ~RobotPlugin() override {
    before_.reset();
    after_.reset();
    ros::shutdown();
  }

  void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr element) override {
    try {
      load(model, element);
    } catch (const std::exception& error) {
      gzerr << "The robot does not work. " << error.what() << "\n";
    }
  }

 private:
  void load(const gazebo::physics::ModelPtr& model, const sdf::ElementPtr& element) {
    start_ros();
    world_ = model->GetWorld();
    clock_slot_ = {mtr_gazebo::ns_of(element, "clock_period_ms"), 0};
    const auto seed = static_cast<std::uint64_t>(value_of<int>(element, "seed"));
    // Separate random streams per sensor.
    std::uint64_t stream = seed << 8U;
    const gazebo::physics::LinkPtr base_link = model->GetLink(mtr_core::names::kBase);
    base_ = std::make_unique<Base>(element->GetElement("base"), model, *ros_);
    truth_ = std::make_unique<Truth>(element, model, *ros_);
    imu_ = std::make_unique<Imu>(element->GetElement("imu"), base_link, ++stream, *ros_);
    for (sdf::ElementPtr each = element->GetElement("lidar"); each; each = each->GetNextElement("lidar")) {
      lidars_.push_back(std::make_unique<Lidar>(each, base_link, ++stream, *ros_));
    }
    clock_publisher_ = ros_->advertise<rosgraph_msgs::Clock>("/clock", kClockQueue);
    last_ns_ = ns_of(world_->SimTime());
    before_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) { before(); });
    after_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { after(); });
    ROS_INFO("The robot stands in Gazebo with %zu LiDARs.", lidars_.size());
  }

  void start_ros() {
    if (!ros::isInitialized()) {
      int count = 0;
      // The server handles its signals itself.
      ros::init(count, nullptr, kNode, ros::init_options::NoSigintHandler);
    }
    ros_ = std::make_unique<ros::NodeHandle>();
    ros_->setCallbackQueue(&queue_);
  }

  void before() {
    queue_.callAvailable();
    const double step_s = world_->Physics()->GetMaxStepSize();
    base_->drive(step_s);
    truth_->drive();
  }

  void after() {
    const Step step{last_ns_, ns_of(world_->SimTime())};
    if (step.now_ns == step.before_ns) {
      return;
    }
    last_ns_ = step.now_ns;
    for (const std::unique_ptr<Lidar>& lidar : lidars_) {
      lidar->update(step);
    }
    imu_->update(step);
    base_->update(step);
    truth_->update(step);
    if (step.has_tick(clock_slot_)) {
      rosgraph_msgs::Clock clock;
      clock.clock.fromNSec(static_cast<std::uint64_t>(step.now_ns));
      clock_publisher_.publish(clock);
    }
  }

  ros::CallbackQueue queue_;
  std::unique_ptr<ros::NodeHandle> ros_;
  gazebo::physics::WorldPtr world_;
  mtr_core::Slot clock_slot_{1, 0};
  std::int64_t last_ns_{0};
  std::unique_ptr<Base> base_;
  std::unique_ptr<Truth> truth_;
  std::unique_ptr<Imu> imu_;
  std::vector<std::unique_ptr<Lidar>> lidars_;
  ros::Publisher clock_publisher_;
  gazebo::event::ConnectionPtr before_;
  gazebo::event::ConnectionPtr after_;
};

GZ_REGISTER_MODEL_PLUGIN(RobotPlugin)

}  // namespace mtr_gazebo
