"""The available memory."""

from __future__ import annotations

import os
import re
from pathlib import Path


def free_memory() -> int:
    """The bytes that this process may still allocate: the system's available memory, within a container's
    limit."""
    return min(_of_system(), _of_container())


def _of_system() -> int:
    try:
        if known := re.search(r"^MemAvailable:\s+(\d+) kB", Path("/proc/meminfo").read_text(), re.M):
            return int(known[1]) * 1024
    except OSError:
        pass
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def _of_container() -> int:
    folder = Path("/sys/fs/cgroup")
    try:
        return int((folder / "memory.max").read_text()) - int((folder / "memory.current").read_text())
    except (OSError, ValueError):  # no such file, or "max": no limit
        return 2**63
