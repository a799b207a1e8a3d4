"""Runs a program and says what it cost: processor time, wall time, memory."""

import os
import subprocess
import threading
import time
from dataclasses import asdict, dataclass


@dataclass
class Cost:
    cpu: float            # user + system [s]
    wall: float           # [s]
    memory: float         # largest resident set [MB]
    status: int           # exit status, negative: the signal
    timed_out: bool

    def as_dict(self):
        return asdict(self)


def run(command, folder, log, timeout, environment=None):
    """Runs `command` in `folder` with output to the file `log`; stops it after `timeout` seconds."""
    stopped = threading.Event()
    with open(log, "w", encoding="utf-8") as out:
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT, env={**os.environ, **(environment or {})})

        def stop():
            stopped.set()
            process.kill()

        timer = threading.Timer(timeout, stop)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
    return Cost(usage.ru_utime + usage.ru_stime, time.monotonic() - start, usage.ru_maxrss / 1024,
                process.returncode, stopped.is_set())
