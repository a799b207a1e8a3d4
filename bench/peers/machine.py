"""What the timings were taken on: processor, cores, memory, and the kernels of the BLAS."""

import ctypes
import ctypes.util
import os
import platform


def describe():
    return {"processor": processor(), "cores": str(os.cpu_count()), "memory": memory(),
            "system": system(), "BLAS": blas(), "load at the start": f"{os.getloadavg()[0]:.1f}"}


def processor():
    """The model's name, and its numbers where the name says little."""
    found = read_table("/proc/cpuinfo")
    numbers = "family {cpu family} model {model}".format_map(Missing(found))
    return f"{found.get('model name', platform.processor())} ({numbers})"


class Missing(dict):
    def __missing__(self, key):
        return "?"


def memory():
    kilobytes = int(read_table("/proc/meminfo").get("MemTotal", "0 kB").split()[0])
    return f"{kilobytes / 1024 / 1024:.0f} GiB"


def system():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except OSError:
        return platform.platform()


def blas():
    """OpenBLAS picks its kernels when it is loaded; an unknown processor gets slow ones."""
    name = ctypes.util.find_library("openblas")
    if not name:
        return "unknown"
    library = ctypes.CDLL(name)
    library.openblas_get_corename.restype = ctypes.c_char_p
    core = library.openblas_get_corename().decode()
    asked = os.environ.get("OPENBLAS_CORETYPE", "its own choice")
    return f"OpenBLAS, kernels {core} ({asked}; billet chooses anew at its start)"


def read_table(path):
    table = {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            key, _, value = line.partition(":")
            table.setdefault(key.strip(), value.strip())
    return table
