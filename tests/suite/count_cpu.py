"""Runs a command and appends what it cost to a table: name, seconds of CPU, seconds of wall time, exit code.

usage: count_cpu.py TABLE NAME COMMAND [ARGUMENT...]

All processes that the command leaves behind are waited for, so that daemons that a test starts and ends count, too.
"""

import ctypes
import os
import resource
import sys
import time

PR_SET_CHILD_SUBREAPER = 36  # prctl(2): orphans below this process become its children


def main() -> int:
    table, name, *command = sys.argv[1:]
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    start = time.monotonic()
    child = os.posix_spawnp(command[0], command, os.environ)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    wall = time.monotonic() - start
    try:
        while True:
            os.wait()
    except ChildProcessError:
        pass
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(table, "a") as file:
        file.write(f"{name},{used.ru_utime + used.ru_stime:.3f},{wall:.3f},{status}\n")
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main())
