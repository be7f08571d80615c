"""Peak memory of one solution, measured in a process of its own.

What was freed before is handed back first, and memory that is asked for but never touched, which
a tracer of allocations would count, is not in the figure. Linux with glibc only.
"""

import ctypes
from collections.abc import Callable
from multiprocessing import get_context
from pathlib import Path


def peak_memory(prepare: Callable[[], Callable[[], object]]) -> int:
    """Most bytes that the work which `prepare` returns adds to what the process holds."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_added, (prepare,))


def _added(prepare: Callable[[], Callable[[], object]]) -> int:
    work = prepare()
    ctypes.CDLL(None).malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
    before = _highest()
    work()
    return _highest() - before


def _highest() -> int:
    """Bytes; getrusage would count what the parent held before this program was loaded."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(status.split("VmHWM:")[1].split()[0])
