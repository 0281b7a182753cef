#!/usr/bin/env python3
"""Interrupts a study: it must end soon, keep the runs that were finished, and use them when it is started again.

Usage: interrupt_study.py PROGRAM
"""

import json
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASE = """
format = 1
[body]
size = ["10 mm", "10 mm"]
cells = [20, 20]
material = "steel"
[materials.steel]
conductivity = 16
density = 7900
specific_heat = 500
[nonlocality]
horizon_ratio = 3
[initial]
temperature = "100*(x < 0.005)"
[time]
end = "0.1 s"
integrator = { type = "euler", step = "1 ms" }
"""

# The first two steps take no time, the last one takes for ever.
STUDY = """
format = 1
case = "case.toml"
reference = "finest"
[vary]
time_step = ["1 ms", "0.5 ms", "1 ns"]
"""

START_LIMIT = 60  # seconds until the first runs are there, on a busy machine
END_LIMIT = 30    # seconds from the interrupt to the end


def start(program, folder):
    return subprocess.Popen([program, "study", "study.toml", "--output", "out", "--threads", "1"], cwd=folder, text=True,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def interrupt(program, folder):
    """Lets the short runs finish, interrupts, and returns what was printed."""
    process = start(program, folder)
    try:
        heading = process.stdout.readline()  # From here on the program knows what to do with a signal.
        assert "3 runs" in heading, heading + process.stderr.read()
        deadline = time.monotonic() + START_LIMIT
        while len(list(folder.glob("out/runs/*.run"))) < 2:
            assert process.poll() is None, "the study ended by itself: " + process.stderr.read()
            assert time.monotonic() < deadline, "no run was finished in time"
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=END_LIMIT)
    finally:
        process.kill()
    assert process.returncode == 130, f"exit code {process.returncode}: {errors}"
    assert errors == "", errors
    return output


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "case.toml").write_text(CASE, encoding="utf-8")
        (folder / "study.toml").write_text(STUDY, encoding="utf-8")
        assert "stopped after" in interrupt(program, folder)
        report = json.loads((folder / "out" / "study.json").read_text(encoding="utf-8"))
        assert report["status"] == "stopped", report["status"]
        assert [run["status"] for run in report["runs"]] == ["completed", "completed", "stopped"], report["runs"]
        assert not list(folder.rglob(".*")), "a temporary file was left behind"
        assert "2 of them from before" in interrupt(program, folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
