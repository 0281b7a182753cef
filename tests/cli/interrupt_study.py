#!/usr/bin/env python3
"""Interrupts a study: it must end soon, keep the runs that were finished, and use them when it is started again.

Usage: interrupt_study.py PROGRAM
"""

import json
import sys
import tempfile
from pathlib import Path

from interrupting import interrupt

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


def interrupt_study(program, folder):
    """Lets the short runs finish, interrupts, and returns what was printed."""
    return interrupt([program, "study", "study.toml", "--output", "out", "--threads", "1"], folder,
                     lambda: len(list(folder.glob("out/runs/*.run"))) >= 2, after_line="3 runs")


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "case.toml").write_text(CASE, encoding="utf-8")
        (folder / "study.toml").write_text(STUDY, encoding="utf-8")
        assert "stopped after" in interrupt_study(program, folder)
        report = json.loads((folder / "out" / "study.json").read_text(encoding="utf-8"))
        assert report["status"] == "stopped", report["status"]
        assert [run["status"] for run in report["runs"]] == ["completed", "completed", "stopped"], report["runs"]
        assert not list(folder.rglob(".*")), "a temporary file was left behind"
        assert "2 of them from before" in interrupt_study(program, folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
