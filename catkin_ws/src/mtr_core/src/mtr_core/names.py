"""Names of topics and frames that more than one package uses."""
# SPDX-License-Identifier: Apache-2.0

# Frames (REP-103, REP-105)
MAP = "map"
ODOM = "odom"
BASE = "base_link"
CAR = "car"
KEY = "key"
FRONT_LIDAR = "front_lidar"
REAR_LIDAR = "rear_lidar"
IMU = "imu"

# Parameter of the whole robot: its URDF
ROBOT_DESCRIPTION = "/robot_description"
# Robot parameter by node name: why the node cannot start; deleted when it has started
START_FAILURES = "/start_failures"
# Robot parameter: topics of sensors and base, by the arguments of robot.launch
ROBOT_TOPICS = "/robot_topics"
# Robot parameter: frames of the sensors' messages, by the corresponding links of the description
ROBOT_FRAMES = "/robot_frames"
# Robot parameter: revolutions per second of its LiDARs from the data sheet, if the model is specified
LIDAR_TURN_RATE = "/robot_lidar/turn_rate_hz"
# Robot parameter: node_parameters of robot.launch by node
NODE_PARAMETERS = "/robot_node_parameters"
# Robot parameter: folders that its nodes write to by themselves, such as logs
WRITTEN_FOLDERS = "/robot_written_folders"
# Robot parameter: identifier of this start of robot.launch, unique on the ROS master and constant for restarted nodes
ROBOT_RUN = "/robot_run"
# Robot parameter: report of the last preflight since the robot's start, see mtr_dispatcher's preflight_report
PREFLIGHT_REPORT = "/preflight_report"
# Findings in motion of the last preflight with --drive, for preflights without it
PREFLIGHT_MOTION = "/preflight_motion"

# Test area in force in this robot run, for a restarted dispatcher
TEST_AREA_IN_FORCE = "/test_area_in_force"

# Service mode in force of a simulated robot; a real one stores it in a file
SERVICE_MODE_IN_FORCE = "/service_mode_in_force"
# Owner of the motion lock of service mode, and the dispatcher's service that orders it
SERVICE_MODE = "service_mode"
SERVICE_MODE_REQUEST = "/dispatcher/service_mode"

# Sensors and wheels, with the names of a Jackal
FRONT_SCAN = "/front/scan"
REAR_SCAN = "/rear/scan"
IMU_DATA = "/imu/data"
NAVSAT_FIX = "/navsat/fix"
WHEEL_ODOMETRY = "/jackal_velocity_controller/odom"
WHEEL_COMMAND = "/jackal_velocity_controller/cmd_vel"
# Guard in front of a base that cannot be configured, see mtr_drive_control's base_guard
BASE_GUARD = "/base_guard"
GUARDED_WHEEL_COMMAND = "/base_guard/cmd_vel"
BATTERY = "/battery"

# Between the robot's nodes
DESIRED_STATE = "/dispatcher/desired"
TEST_AREA = "/dispatcher/test_area"
ROBOT_MODE = "/state_machine/mode"
CAR_ESTIMATE = "/car_locator/car"
CAR_MARKERS = "/car_locator/markers"
CAR_CHECK = "/car_locator/check"
MAPPING_ORDER = "/car_locator/mapping_order"
LOCALIZED_POSE = "/localization/pose"
SURFACE_MAP = "/localization/surfaces"
MAP_GRID = "/map"
LOCALIZATION_MARKERS = "/localization/markers"
MOTION_STATUS = "/motion_planner/status"
MOTION_PATH = "/motion_planner/path"
MOTION_MARKERS = "/motion_planner/markers"
PLANNER_VELOCITY = "/drive/command/planner"
MANUAL_VELOCITY = "/drive/command/manual"
MANUAL_LIFT = "/lift/command/manual"
MOTION_LOCK = "/drive/lock"
DRIVE_STATUS = "/drive/status"
DRIVE_MARKERS = "/drive/markers"
PERIPHERALS_STATE = "/peripherals/state"
JOINT_STATES = "/joint_states"
JOY = "/joy"

# Host to firmware and back
FIRMWARE_COMMAND = "/firmware/command"
FIRMWARE_PRESS = "/firmware/press"
FIRMWARE_CALIBRATE = "/firmware/calibrate"
FIRMWARE_ECHO = "/firmware/echo"
FIRMWARE_STATE = "/firmware/state"
FIRMWARE_HEALTH = "/firmware/health"
FIRMWARE_SIGNALS = "/firmware/signals"
FIRMWARE_INPUTS = "/firmware/inputs"
# Stop input of the board, std_msgs/Bool: one of drive control's e_stop_topics on a robot with a stop chain
STOP_INPUT = "/peripherals/stop_input"

# Orders that move wheels, lift or servos; each has one publisher. Drive control watches the base's own topic.
# /drive/lock is not included, because every owner of a lock publishes on it.
MOTION_INPUTS = (JOY, DESIRED_STATE, ROBOT_MODE, PLANNER_VELOCITY, MANUAL_VELOCITY, MANUAL_LIFT, FIRMWARE_COMMAND,
                 FIRMWARE_PRESS, FIRMWARE_CALIBRATE, FIRMWARE_SIGNALS)
# Messages on which these orders depend
MOTION_STATES = (TEST_AREA, LOCALIZED_POSE, CAR_ESTIMATE, CAR_CHECK, MAPPING_ORDER, SURFACE_MAP, MOTION_STATUS,
                 DRIVE_STATUS, PERIPHERALS_STATE, FIRMWARE_STATE, FIRMWARE_INPUTS, STOP_INPUT)

# Names of the fault injection node; the first is also the prefix of the topics that it relays
FAULT_INJECTION = "/fault_injection"
INJECT_FAULT = "/fault_injection/inject"
ACTIVE_FAULTS = "/fault_injection/active"
# Parameter with the kinds of fault by part, for user interfaces
FAULT_CATALOGUE = "/fault_catalogue"

# Simulation
SIM_HOLD = "/sim/hold"
SIM_TRUTH = "/sim/truth"
SIM_HANDLE_REQUEST = "/sim/handle_request"
SIM_KIDNAP = "/sim/kidnap"
SIM_IGNITION = "/sim/ignition"
SIM_CAR_SPEED = "/sim/car_speed"
# With physics in another process: pose of the key in frame car, and its height above ground from the firmware
SIM_KEY = "/sim/key"
SIM_LIFT = "/sim/lift"
