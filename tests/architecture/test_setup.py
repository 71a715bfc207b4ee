"""Every program that the project starts, every module that it imports: from a package that the set-up installs."""
# SPDX-License-Identifier: Apache-2.0
import ast
import os
import pathlib
import re
import shutil
from typing import Dict, Iterator, List, Set, Tuple

import pytest
from project import TOP, imports, is_standard, package_folders, package_name, tracked

# Packages that Debian 12 has before the set-up begins: git, make and sudo are asked for, the others are essential.
FROM_THE_START = {"git", "make", "sudo", "apt", "bash", "coreutils", "dpkg", "findutils", "grep", "mawk", "mount",
                  "passwd", "sed", "util-linux"}
# What root, and who does not call `make bare-root`, can do without; the scripts say when it is missing.
BY_HAND = {"chrony", "debootstrap", "docker.io", "podman", "sudo"}

# Lists of packages that single make targets install; `make setup` does not.
OF_TARGETS = ("debian-bench-packages.txt", "debian-browser-packages.txt", "debian-docs-packages.txt",
              "debian-range-packages.txt")

# What the shell does itself.
SHELL_WORDS = set(re.findall(r"\S+", """
if then else elif fi for while until do done case esac in function select time . : alias break cd command continue
declare echo eval exec exit export false let local mapfile printf pwd read readonly return set shift shopt source test
times trap true type ulimit umask unset wait"""))


def programs() -> Dict[str, str]:
    """The table: program -> package. `pip:` begins a Python package, `project` is what the project installs itself."""
    lines = (TOP / "setup" / "programs.txt").read_text(encoding="utf-8").splitlines()
    return dict(line.split() for line in lines if line and not line.startswith("#"))


def listed(name: str) -> Set[str]:
    """Debian packages in a list of setup/."""
    lines = (TOP / "setup" / name).read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def installed() -> Set[str]:
    """Packages that the set-up installs, and that targets install which need more."""
    found = set().union(*(listed(path.name) for path in (TOP / "setup").glob("debian-*packages.txt")))
    # The second one is installed by `make mutants` alone, the third by `make bench-range`.
    for path in (TOP / "setup" / "python-requirements.txt", TOP / "tests" / "mutation" / "requirements.txt",
                 TOP / "setup" / "range-requirements.txt"):
        required = path.read_text(encoding="utf-8")
        found |= {f"pip:{name}" for name in re.findall(r"^([\w-]+)==", required, re.MULTILINE)}
    return found


def started_by_python(path: pathlib.Path) -> Set[str]:
    """Programs in a Python file: first words of its commands, and of any list that begins like one."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    calls = [node for node in nodes if isinstance(node, ast.Call)]
    starting = [call for call in calls if module_of(call) in ("subprocess", "shutil.which")]
    if not starting:
        return set()
    lists = [node for node in nodes if isinstance(node, ast.List)]
    return ({word for call in starting for word in first_words(call.args[:1])}
            | {word for word in first_words(lists) if shutil.which(word)})


def module_of(call: ast.Call) -> str:
    """subprocess for every function of it, else module.function."""
    function = call.func
    if not isinstance(function, ast.Attribute) or not isinstance(function.value, ast.Name):
        return ""
    return function.value.id if function.value.id == "subprocess" else f"{function.value.id}.{function.attr}"


def first_words(arguments: List[ast.expr]) -> Iterator[str]:
    """First words of lists and plain strings of a call."""
    for argument in arguments:
        first = argument.elts[0] if isinstance(argument, ast.List) and argument.elts else argument
        if isinstance(first, ast.Constant) and isinstance(first.value, str):
            yield first.value


def started_by_shell(text: str) -> Set[str]:
    """Programs in a shell script, or in the recipes of a Makefile: the first word of every command."""
    text = re.sub(r"(^|\s)#.*", "", text.replace("\\\n", " "))
    text = re.sub(r"'[^']*'", "''", text)
    text = re.sub(r"\$\([A-Z_]+\)", ";", text)
    text = re.sub(r'"([^"]*)"', lambda quoted: "; ".join(re.findall(r"\$\([^()]*\)", quoted.group(1))), text)
    own = functions_of(text)
    commands = re.split(r"\n|&&|\|\|?|;|\$?\(|\b(?:if|then|else|elif|do|while|until|sudo|exec|xargs|env)\b|!", text)
    found = [re.match(r"\s*@?(?:[A-Z_]+=\S*\s+)*([a-z][a-z0-9_.+-]*)(?=\s|$)", command) for command in commands]
    return {first.group(1) for first in found if first} - SHELL_WORDS - own


def functions_of(text: str) -> Set[str]:
    """Functions that a shell script defines."""
    return set(re.findall(r"^([a-z_]+)\(\)", text, re.MULTILINE))


def started_by_script(path: pathlib.Path) -> Set[str]:
    """Programs in a shell script; functions of the file beside it that it sources are none."""
    text = path.read_text(encoding="utf-8")
    sourced = [path.parent / name for name in re.findall(r"^source .*/([\w-]+\.bash)\"$", text, re.MULTILINE)]
    theirs = [functions_of(each.read_text(encoding="utf-8")) for each in sourced]
    return started_by_shell(text) - set().union(*theirs)


def recipes(path: pathlib.Path) -> str:
    """What a Makefile gives to the shell."""
    text = path.read_text(encoding="utf-8").replace("\\\n", " ")
    return "\n".join(re.findall(r"^(?:\t| {2})(.*)$", text, re.MULTILINE))


def started_by_launch_file(path: pathlib.Path) -> Set[str]:
    """Programs that roslaunch starts, of other packages than the project's: package/program, and commands."""
    text = path.read_text(encoding="utf-8")
    nodes = re.findall(r'<(?:node|test) [^>]*?pkg="(\w+)" type="([\w.]+)"', text)
    own = {package_name(folder) for folder in package_folders()}
    return ({f"{package}/{program}" for package, program in nodes if package not in own}
            | set(re.findall(r'<param [^>]*command="(\w+) ', text)))


def all_started() -> Iterator[Tuple[pathlib.Path, Set[str]]]:
    """Every file that starts programs, with them."""
    for path in tracked("*.sh", "*.bash", ".ci/run"):
        yield path, started_by_script(path)
    for path in tracked("Makefile", "*/Makefile"):
        yield path, started_by_shell(recipes(path))
    for path in tracked("*.launch", "*.test"):
        yield path, started_by_launch_file(path)
    for path in tracked("*.py"):
        yield path, started_by_python(path)


# Helpers of tests and programs, found beside the file that imports them.
OWN_MODULES = {path.stem for path in tracked("*.py")}
STARTED = {str(path.relative_to(TOP)): found for path, found in all_started() if found}


@pytest.mark.parametrize("path", STARTED)
def test_every_program_that_is_started_is_in_the_table(path):
    assert sorted({pathlib.PurePath(name).name if name.startswith("/") else name for name in STARTED[path]}
                  - set(programs())) == []


@pytest.mark.parametrize("program, package", programs().items())
def test_the_set_up_installs_the_program(program, package):
    assert package in installed() | FROM_THE_START | BY_HAND | {"project", "noetic"}


@pytest.mark.parametrize("program", [name for name, package in programs().items()
                                     if "/" not in name
                                     and package not in BY_HAND.union({"noetic"}, *map(listed, OF_TARGETS))])
def test_the_program_is_here_after_the_set_up(program):
    # A Makefile of root's finds what lies in sbin; the virtual environment is first, as in setup/env.bash.
    assert shutil.which(program, path=f"{TOP}/.venv/bin:{os.environ['PATH']}:/usr/sbin:/sbin")


# Module -> package that has it, where that is not python3-<module>.
MODULE_PACKAGES = {
    "PyQt5": "python3-pyqt5", "can": "pip:python-can", "cantools": "pip:cantools", "catkin_pkg": "catkin",
    "cosmic_ray": "pip:cosmic-ray", "google": "python3-protobuf", "mujoco": "pip:mujoco",
    "SALib": "pip:SALib", "alembic": "pip:alembic", "dask": "pip:dask", "distributed": "pip:distributed",
    "duckdb": "pip:duckdb", "jinja2": "pip:jinja2", "optuna": "pip:optuna",
    "isotp": "pip:can-isotp", "udsoncan": "pip:udsoncan", "mcap": "pip:mcap",
    "markupsafe": "pip:markupsafe", "sqlalchemy": "pip:sqlalchemy", "starlette": "pip:starlette",
    "uvicorn": "pip:uvicorn",
    "roscpp": "python3-roscpp-msg", "senpy": "pip:senpy-sensei", "urdf_parser_py": "pip:urdf-parser-py",
    "xacro": "pip:xacro",
}


def test_the_set_up_installs_every_module():
    # A package's setup.py is read by catkin alone.
    files = [path for path in tracked("*.py") if path.name != "setup.py"]
    found = {module for path in files for module in imports(path) if not is_standard(module)}
    outside = {module for module in found if not module.startswith("mtr_")} - OWN_MODULES
    packages = {MODULE_PACKAGES.get(module, f"python3-{module.lower().replace('_', '-')}") for module in outside}
    assert sorted(packages - installed()) == []
