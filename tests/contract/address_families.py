"""Run a command that opens sockets of some families only, as systemd's RestrictAddressFamilies has it.

Usage: address_families.py "AF_UNIX AF_INET ..." COMMAND [ARGUMENT ...]
"""
# SPDX-License-Identifier: Apache-2.0
import ctypes
import os
import platform
import socket
import struct
import sys
from typing import List

# Number of the system call socket(), by machine; linux/seccomp.h, linux/filter.h and linux/prctl.h have the others.
SOCKET_CALL = {"x86_64": 41, "aarch64": 198}
LOAD_WORD, JUMP_IF_EQUAL, RETURN = 0x20, 0x15, 0x06
ALLOW, FAIL = 0x7FFF0000, 0x00050000
NUMBER_OFFSET, FIRST_ARGUMENT_OFFSET = 0, 16
NO_NEW_PRIVILEGES, SET_SECCOMP, MODE_FILTER = 38, 22, 2
EAFNOSUPPORT = 97


def main(names: str, *command: str) -> None:
    """Become the command, within the bound."""
    bound([int(getattr(socket, name)) for name in names.split()])
    os.execvp(command[0], command)


def bound(families: List[int]) -> None:
    """From here on socket() fails in this process and its children for other families."""
    lines = [(LOAD_WORD, 0, 0, NUMBER_OFFSET),
             (JUMP_IF_EQUAL, 0, len(families) + 2, SOCKET_CALL[platform.machine()]),
             (LOAD_WORD, 0, 0, FIRST_ARGUMENT_OFFSET)]
    # Each comparison jumps over those that are left and the refusal.
    lines += [(JUMP_IF_EQUAL, len(families) - index, 0, family) for index, family in enumerate(families)]
    lines += [(RETURN, 0, 0, FAIL | EAFNOSUPPORT), (RETURN, 0, 0, ALLOW)]
    code = b"".join(struct.pack("HBBI", *line) for line in lines)
    buffer = ctypes.create_string_buffer(code, len(code))
    # struct sock_fprog: the number of lines, then where they are.
    program = struct.pack("HxxxxxxQ", len(lines), ctypes.addressof(buffer))
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0) or libc.prctl(SET_SECCOMP, MODE_FILTER, program, 0, 0):
        raise OSError(ctypes.get_errno(), "this machine takes no filter")


if __name__ == "__main__":
    main(*sys.argv[1:])
