#!/usr/bin/env python3
"""Interrupts a long run: it must end at the next step, with every file whole and openable.

Usage: interrupt.py PROGRAM
"""

import csv
import json
import signal
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from interrupting import interrupt

CASE = """
format = 1
title = "A run that nobody waits for"
[body]
size = ["10 mm", "10 mm"]
cells = [100, 100]
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
end = "1e4 s"
integrator = { type = "rk4" }
[[output]]
type = "vtk"
every = "20 ms"
[[output]]
type = "picture"
every = "20 ms"
[[output]]
type = "energy"
every = "20 ms"
[[output]]
type = "probe"
name = "centre"
at = ["5 mm", "5 mm"]
every = "20 ms"
"""


def check_tables(folder):
    for name in ("probes.csv", "energy.csv"):
        with open(folder / name, encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        assert len(rows) >= 3, f"{name} has {len(rows)} rows"
        assert all(len(row) == len(rows[0]) for row in rows), f"{name} has rows of different length"
        times = [float(row[0]) for row in rows[1:]]
        assert times == sorted(times), f"the times of {name} are not in order"


def check_fields(folder):
    collection = ElementTree.parse(folder / "fields.pvd").getroot()
    named = [entry.get("file") for entry in collection.iter("DataSet")]
    assert len(named) >= 3, f"fields.pvd names {len(named)} files"
    for name in named:
        content = (folder / name).read_bytes()
        assert content.rstrip().endswith(b"</VTKFile>"), f"{name} is not complete"


def check_pictures(folder):
    pictures = list(folder.glob("pictures/*.png"))
    assert pictures, "there is no picture"
    for picture in pictures:
        content = picture.read_bytes()
        assert content.startswith(b"\x89PNG") and content[-8:-4] == b"IEND", f"{picture.name} is not complete"


def check_rest(folder):
    known = {".toml", ".json", ".csv", ".pvd", ".vti", ".vtu", ".png"}
    strange = [str(file) for file in folder.rglob("*") if file.is_file() and file.suffix not in known]
    assert not strange, f"left behind: {strange}"


def interrupt_and_check(program, signal_number, folder):
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    output = interrupt([program, "run", "case.toml", "--output", "out"], folder,
                       lambda: len(list(folder.glob("out/fields/*.vt*"))) >= 3, signal_number)
    assert "stopped" in output, output
    summary = json.loads((folder / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "stopped", summary
    assert 0.0 < summary["end_time_s"] < 1e4, summary
    check_tables(folder / "out")
    check_fields(folder / "out")
    check_pictures(folder / "out")
    check_rest(folder / "out")


def main(program):
    for signal_number in (signal.SIGINT, signal.SIGTERM):
        with tempfile.TemporaryDirectory() as folder:
            interrupt_and_check(program, signal_number, Path(folder))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
