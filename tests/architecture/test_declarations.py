"""What code imports, includes, launches or reads as a message is what its package.xml or pyproject.toml declares."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
from typing import Any, Dict, Iterator, Set
from xml.etree import ElementTree

import pytest
import yaml
from project import TOP, imports, is_standard, package_folders, package_name, tracked

OWN = {package_name(folder) for folder in package_folders()}

# Module -> rosdep key, where they differ; ROS names its Python packages after the key. None: no package of ROS's kind.
KEYS = {
    "can": "python3-can", "cantools": "python3-cantools-pip", "catkin_pkg": "catkin", "evdev": "python3-evdev",
    "google": "python3-protobuf", "hypothesis": "python3-hypothesis",
    "matplotlib": "python3-matplotlib", "mtr_drive_control_core": "mtr_drive_control",
    "mtr_localization_core": "mtr_localization",
    "mujoco": "python3-mujoco-pip", "numpy": "python3-numpy", "pytest": "python3-pytest", "rospkg": "python3-rospkg",
    # The laptop's application, which CI tests with the robot, and the firmware's emulator.
    "mtr_campaign": None, "mtr_operator": None, "mtr_results": None, "PyQt5": None, "mtr_emulator": None,
    # Of `make mutants` and `make bench-range`, which install them.
    "cosmic_ray": None, "senpy": None,
    "scipy": "python3-scipy", "serial": "python3-serial", "setuptools": "python3-setuptools",
    "shapely": "python3-shapely", "tqdm": "python3-tqdm", "transitions": "python3-transitions",
    "urdf_parser_py": "urdfdom_py", "yaml": "python3-yaml", "zmq": "python3-zmq",
}
# First folder or whole name of a header -> rosdep key, where they differ.
HEADER_KEYS = {
    "ceres": "libceres-dev", "Eigen": "eigen", "gazebo": "gazebo_dev", "gtest": "gtest", "ignition": "gazebo_dev",
    "nlohmann": "nlohmann-json-dev", "pybind11": "pybind11-dev", "ros": "roscpp", "rosbag": "rosbag_storage",
    "sdf": "gazebo_dev", "urdf_model": "urdf", "urdf_parser": "urdf", "XmlRpcValue.h": "xmlrpcpp",
}
# Headers of C, C++ and POSIX have no folder of their own but these.
SYSTEM_FOLDERS = {"sys", "bits", "netinet", "arpa", "linux"}

# Declared for another reason than a line of code.
WITHOUT_CODE = {
    "catkin": "builds every package",
    "lms1xx": "jackal.launch starts a LiDAR's driver by its kind", "sick_tim": "the same", "urg_node": "the same",
    "mtr_bringup": "mtr_simulation.stack starts its sim.launch",
    "message_generation": "makes the messages", "message_runtime": "runs them",
    "protobuf-dev": "protoc makes the module",
    "qtbase5-dev": "headers of Qt have no folder",
    "gtest": "tests in C++ are linked with it",
    "rostest": "runs the package's *.test files",
    "python3-pytest": "runs the package's unit tests",
    "python3-protobuf": "the generated module imports it",
}


def python_files(folder: pathlib.Path) -> Iterator[pathlib.Path]:
    """Python files of a package, with suffix or not; what only builds it (setup.py) excluded."""
    inside = tracked(f"{folder.relative_to(TOP)}/*.py", f"{folder.relative_to(TOP)}/scripts/*")
    yield from (path for path in inside if path != folder / "setup.py" and is_python(path))


def is_python(path: pathlib.Path) -> bool:
    """By suffix, or by the first line of a program."""
    if path.suffix:
        return path.suffix == ".py"
    return path.read_text(encoding="utf-8").partition("\n")[0].endswith("python3")


def is_test(path: pathlib.Path, folder: pathlib.Path) -> bool:
    """Part of the package's tests; all of mtr_tests is."""
    return folder.name == "tests" or "tests" in path.relative_to(folder).parts


def python_keys(path: pathlib.Path, siblings: Set[str]) -> Set[str]:
    """Keys that a Python file needs."""
    modules = {name for name in imports(path) if not is_standard(name)} - siblings - optional(path)
    return {key for key in (KEYS.get(name, name) for name in modules) if key}


def optional(path: pathlib.Path) -> Set[str]:
    """Modules that a Python file can do without: it catches their ImportError."""
    tries = [node for node in nodes(path) if isinstance(node, ast.Try)
             and any(isinstance(caught.type, ast.Name) and caught.type.id == "ImportError" for caught in node.handlers)]
    return {(inner.module or "").split(".")[0] for node in tries for statement in node.body
            for inner in ast.walk(statement) if isinstance(inner, ast.ImportFrom)}


def nodes(path: pathlib.Path) -> Iterator[ast.AST]:
    """The syntax tree of a Python file."""
    return ast.walk(ast.parse(path.read_text(encoding="utf-8")))


def header_keys(path: pathlib.Path) -> Set[str]:
    """Keys that a C++ file needs; a header in quotes that lies in the package itself is its own."""
    keys = set()
    for quote, name in re.findall(r'^#include ([<"])([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE):
        first = name.split("/")[0]
        own = quote == '"' and any((folder / name).is_file() for folder in surroundings(path))
        if not own and (first in HEADER_KEYS or ("/" in name and first not in SYSTEM_FOLDERS)):
            keys.add(HEADER_KEYS.get(first, first))
            # Its headers include Python's, and on Ubuntu and Debian it does not depend on them.
            keys |= {"python3-dev"} if first == "pybind11" else set()
    return keys


def surroundings(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """Folders in which a header in quotes may lie: the file's, those above it in the package, and their src."""
    for folder in path.relative_to(TOP).parents:
        yield TOP / folder
        yield TOP / folder / "src"
        if (TOP / folder / "package.xml").is_file():
            return


def launch_keys(path: pathlib.Path) -> Set[str]:
    """Packages that a launch file or rostest names."""
    text = path.read_text(encoding="utf-8")
    return set(re.findall(r'\bpkg="([a-z0-9_]+)"', text)) | set(re.findall(r"\$\(find ([a-z0-9_]+)\)", text))


def moved_keys(path: pathlib.Path) -> Set[str]:
    """Packages whose programs a package runs under their former names, by rosrun."""
    moved = set(re.findall(r"^moved\((\w+) ", path.read_text(encoding="utf-8"), re.MULTILINE))
    return moved | ({"rosbash"} if moved else set())


# Programs of ROS that Python starts -> rosdep key of the package that has them; not every robot has the whole of ROS.
PROGRAM_KEYS = {"roslaunch": "roslaunch", "rosmaster": "rosmaster", "rosnode": "rosnode", "rosrun": "rosbash",
                "rostopic": "rostopic"}


def program_keys(path: pathlib.Path) -> Set[str]:
    """Packages of the programs with which lists in a Python file, commands, begin."""
    firsts = [node.elts[0] for node in nodes(path) if isinstance(node, ast.List) and node.elts]
    words = {first.value for first in firsts if isinstance(first, ast.Constant) and isinstance(first.value, str)}
    return {PROGRAM_KEYS[word] for word in words & set(PROGRAM_KEYS)}


def message_keys(path: pathlib.Path) -> Set[str]:
    """Packages whose messages a message contains."""
    found = set(re.findall(r"^([a-z0-9_]+)/\w+", path.read_text(encoding="utf-8"), re.MULTILINE))
    header = re.search(r"^Header ", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found | ({"std_msgs"} if header else set())


def needed(folder: pathlib.Path) -> Dict[str, bool]:
    """Keys that a package needs, each with: is it needed apart from tests?"""
    found: Dict[str, bool] = {}
    under = folder.relative_to(TOP)
    python = list(python_files(folder))
    siblings = {path.stem for path in python if is_test(path, folder)} | {"project"}
    uses = [(path, python_keys(path, siblings) | program_keys(path)) for path in python]
    uses += [(path, header_keys(path)) for path in tracked(f"{under}/*.cpp", f"{under}/*.hpp")
             if "mrpt_icp_slam" not in path.parts]
    uses += [(path, launch_keys(path)) for path in tracked(f"{under}/*.launch", f"{under}/*.test")]
    uses += [(path, moved_keys(path)) for path in tracked(f"{under}/CMakeLists.txt")]
    uses += [(path, message_keys(path)) for path in tracked(f"{under}/*.msg", f"{under}/*.srv")]
    for path, keys in uses:
        for key in keys - {package_name(folder)}:
            found[key] = found.get(key, False) or not is_test(path, folder)
    return found


def declared(folder: pathlib.Path) -> Dict[str, Set[str]]:
    """Keys of a package.xml, each with its kinds of dependence."""
    found: Dict[str, Set[str]] = {}
    for element in ElementTree.parse(folder / "package.xml").getroot():
        if element.tag.endswith("depend"):
            found.setdefault(element.text or "", set()).add(element.tag)
    return found


def named(folder: pathlib.Path) -> Set[str]:
    """Every string in the package's Python, every one-word string in its C++: a program or package may be asked for by
    its name."""
    words = {word for path in tracked(f"{folder.relative_to(TOP)}/*.cpp")
             for word in re.findall(r'"(\w+)"', path.read_text(encoding="utf-8"))}
    return words | {PROGRAM_KEYS[word] for word in words & set(PROGRAM_KEYS)} | {
        node.value for path in python_files(folder) for node in nodes(path)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)}


@pytest.mark.parametrize("folder", package_folders(), ids=package_name)
def test_a_package_declares_what_its_code_needs(folder):
    present = declared(folder)
    missing = {key for key, always in needed(folder).items()
               if not present.get(key, set()) - ({"test_depend"} if always else set())}
    assert sorted(missing) == []


@pytest.mark.parametrize("folder", package_folders(), ids=package_name)
def test_a_package_uses_what_it_declares(folder):
    used = set(needed(folder)) | named(folder) | set(WITHOUT_CODE)
    assert sorted(set(declared(folder)) - used) == []


@pytest.mark.parametrize("folder", package_folders(), ids=package_name)
def test_what_only_tests_need_is_declared_for_tests(folder):
    only_tests = {key for key, always in needed(folder).items() if not always} - named(folder) - set(WITHOUT_CODE)
    assert sorted(key for key in only_tests if declared(folder).get(key) == {"exec_depend"}) == []


def noetic_keys() -> Set[str]:
    """The keys that rosdep knows for Noetic."""
    text = (TOP / "tests" / "architecture" / "noetic_keys.txt").read_text(encoding="utf-8")
    return {line.split()[0] for line in text.splitlines() if line and not line.startswith("#")}


@pytest.mark.parametrize("folder", package_folders(), ids=package_name)
def test_rosdep_knows_every_key_for_noetic(folder):
    assert sorted(set(declared(folder)) - OWN - noetic_keys()) == []


def test_no_noetic_key_is_listed_in_vain():
    assert sorted(noetic_keys() - {key for folder in package_folders() for key in declared(folder)}) == []


def debian_11() -> Dict[str, Dict[str, Any]]:
    """rosdep's list for Debian 11, by which `make noetic-root` installs: key -> system -> packages."""
    text = (TOP / "setup" / "debian11-rosdep.yaml").read_text(encoding="utf-8")
    table: Dict[str, Dict[str, Any]] = yaml.safe_load(text)
    return table


def test_the_list_for_debian_11_has_the_keys_of_noetic_and_no_other():
    assert sorted(debian_11()) == sorted(noetic_keys())


@pytest.mark.parametrize("key", sorted(debian_11()))
def test_a_key_names_debian_packages_or_packages_of_the_index(key):
    packages = debian_11()[key]["debian"]
    if isinstance(packages, dict):
        packages = packages["pip"]["packages"]
    assert all(re.fullmatch(r"[a-z0-9][a-z0-9.+-]*", name) for name in packages)


# Module -> name of the distribution on the package index, where they differ.
DISTRIBUTIONS = {"can": "python-can", "isotp": "can-isotp", "google": "protobuf",
                 "nacl": "pynacl", "serial": "pyserial", "yaml": "pyyaml", "zmq": "pyzmq"}
# What writes tables of a bundle where it is installed.
PARQUET = {"duckdb"}


def test_the_application_declares_exactly_what_it_imports():
    # Beside what it does without, see tests/architecture/test_layers.py.
    assert declared_by_the_application("dependencies") == used_by("mtr_operator") - PARQUET
    assert declared_by_the_application("parquet") == PARQUET


def test_the_store_of_results_declares_exactly_what_it_imports_beside_the_application():
    # SQLAlchemy loads the driver by its name in an address.
    used = used_by("mtr_results") - (used_by("mtr_operator") - PARQUET) | {"pg8000"}
    assert declared_by_the_application("results") == used


def test_campaigns_declare_exactly_what_they_import_beside_the_application():
    assert declared_by_the_application("campaign") == used_by("mtr_campaign") - used_by("mtr_operator")


def used_by(package: str) -> Set[str]:
    """Distributions that a package of the application imports."""
    modules = {name for path in tracked(f"operator_gui/src/{package}/*.py") for name in imports(path)
               if not is_standard(name)}
    return {DISTRIBUTIONS.get(name, name) for name in modules if not name.startswith("mtr_") or name == "mtr_proto"}


def declared_by_the_application(name: str) -> Set[str]:
    """Distributions in a list of its pyproject.toml."""
    text = (TOP / "operator_gui" / "pyproject.toml").read_text(encoding="utf-8")
    block = re.search(rf"^{name} = \[(.*?)^\]", text, re.MULTILINE | re.DOTALL)
    assert block
    return set(re.findall(r'"([\w-]+)', block.group(1)))
