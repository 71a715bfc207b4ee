"""Environment and command line of Gazebo's server."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shlex
import shutil
from typing import Dict, List, Mapping

from mtr_core.errors import ConfigurationError
from mtr_gazebo.world.plugin_element import PLUGIN


def server_command(command: str, world: pathlib.Path) -> List[str]:
    """Return the command line of the server; ConfigurationError if the program does not exist."""
    words = shlex.split(command)
    if not words or shutil.which(words[0]) is None:
        raise ConfigurationError(f"Parameter command is '{command}', which is not installed; allowed is the command of "
                                 "a server of Gazebo 11, which Debian 11 and Ubuntu 20.04 have.")
    return [*words, str(world)]


def server_environment(given: Mapping[str, str]) -> Dict[str, str]:
    """Return the environment with the path of the plugin, and without a search for models.

    Raises:
        ConfigurationError: the plugin was not built.
    """
    prefixes = given.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    folders = [pathlib.Path(prefix) / "lib" for prefix in prefixes if prefix]
    found = [str(folder) for folder in folders if (folder / PLUGIN).exists()]
    known = [folder for folder in given.get("GAZEBO_PLUGIN_PATH", "").split(os.pathsep) if folder]
    if not found and not any((pathlib.Path(folder) / PLUGIN).exists() for folder in known):
        raise ConfigurationError(f"The plugin {PLUGIN} is not there; build the workspace where Gazebo 11 is installed "
                                 "with its headers (Debian 11: libgazebo-dev), and source it.")
    # With an empty address, the server does not download models.
    return {**given, "GAZEBO_PLUGIN_PATH": os.pathsep.join([*found, *known]), "GAZEBO_MODEL_DATABASE_URI": ""}
