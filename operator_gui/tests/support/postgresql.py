"""A PostgreSQL server of Debian's on loopback, for as long as some tests want it."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile

PASSWORD = "of the test"
# The server refuses to be root's; its package makes this user.
USER = "postgres"


@contextlib.contextmanager
def server():
    """Context with the URL of a server without databases of its own, with {} for a database's name."""
    folders = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin"))
    assert folders, "PostgreSQL is missing; make setup installs it."
    folder = pathlib.Path(tempfile.mkdtemp(prefix="mtr-postgresql-"))
    owner = USER if os.geteuid() == 0 else getpass.getuser()
    (folder / "password").write_text(PASSWORD, encoding="utf-8")
    if os.geteuid() == 0:
        for path in (folder, folder / "password"):
            shutil.chown(path, USER, USER)
    data, port = folder / "data", free_port()
    options = f"-c listen_addresses=127.0.0.1 -p {port} -c unix_socket_directories='' -c fsync=off"
    try:
        run(folders[-1] / "initdb", "-D", data, "-U", "tester", "-A", "scram-sha-256", "--pwfile", folder / "password",
            "--no-sync", "--locale=C", "-E", "UTF8", owner=owner)
        run(folders[-1] / "pg_ctl", "-D", data, "-w", "-s", "-l", folder / "log", "-o", options, "start", owner=owner)
        try:
            yield f"postgresql://tester:{PASSWORD.replace(' ', '%20')}@127.0.0.1:{port}/{{}}"
        finally:
            run(folders[-1] / "pg_ctl", "-D", data, "-w", "-s", "-m", "immediate", "stop", owner=owner)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def run(*command, owner):
    """As the owner; what it says is seen when it fails."""
    as_owner = {"user": owner, "group": owner, "extra_groups": []} if os.geteuid() == 0 else {}
    done = subprocess.run(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, cwd="/", check=False, **as_owner)
    assert done.returncode == 0, done.stdout


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]
