#!/usr/bin/env python3
"""Runs the program on a folder of tests/cli and compares with its expect.toml.

Usage: run_cases.py PROGRAM FOLDER

Each [[step]] of expect.toml runs in the same empty folder, into which the case file was copied:
  command            arguments of the program
  exit               expected exit code
  stdout, stderr     texts that must occur there
  not_stdout, not_stderr   texts that must not occur
  silent             true: nothing at all on standard output
  error_count        number of lines that begin with "error: "
  files, no_files    files that must be there afterwards, and that must not
  memory_limit_gib   address space that the program may use
  tables             for the name of a CSV file: its columns, its number of rows, and zero_at_end: expressions of the
                     columns that are 0 in its last row, but for 1e-12
"""

import csv
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

KEYS = {"command", "exit", "stdout", "stderr", "not_stdout", "not_stderr", "silent", "error_count", "files", "no_files",
        "memory_limit_gib", "tables"}


def run(program, step, folder):
    limit = step.get("memory_limit_gib")

    def limit_memory():
        size = int(limit * 2**30)
        resource.setrlimit(resource.RLIMIT_AS, (size, size))

    return subprocess.run([program, *step["command"]], cwd=folder, text=True, capture_output=True, timeout=100,
                          stdin=subprocess.DEVNULL, check=False, preexec_fn=limit_memory if limit else None)


def faults_of(step, result, folder):
    """What differs from the expectation, as texts."""
    for key in step.keys() - KEYS:
        yield f"expect.toml: unknown key '{key}'"
    if result.returncode != step["exit"]:
        yield f"exit code is {result.returncode}, expected {step['exit']}"
    for name, text in (("stdout", result.stdout), ("stderr", result.stderr)):
        for part in step.get(name, []):
            if part not in text:
                yield f"{name} lacks: {part}"
        for part in step.get("not_" + name, []):
            if part in text:
                yield f"{name} must not hold: {part}"
    if step.get("silent") and result.stdout:
        yield "stdout is not empty"
    errors = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
    if "error_count" in step and len(errors) != step["error_count"]:
        yield f"{len(errors)} errors, expected {step['error_count']}"
    if result.returncode in (1, 2, 3) and len(errors) != len(result.stderr.splitlines()):
        yield "a line of stderr does not begin with 'error: '"
    for name in step.get("files", []):
        if not (folder / name).is_file():
            yield f"there is no file {name}"
    for name in step.get("no_files", []):
        if (folder / name).exists():
            yield f"there is {name}"
    for name, table in step.get("tables", {}).items():
        yield from table_faults(name, table, folder / name)


def table_faults(name, expected, file):
    if not file.is_file():
        yield f"there is no table {name}"
        return
    columns, *rows = list(csv.reader(file.read_text(encoding="utf-8").splitlines()))
    if columns != expected["columns"]:
        yield f"{name} has the columns {columns}"
        return
    if len(rows) != expected["rows"]:
        yield f"{name} has {len(rows)} rows"
    last = dict(zip(columns, map(float, rows[-1])))
    for expression in expected["zero_at_end"]:
        value = eval(expression, {"__builtins__": {}}, last)
        if not abs(value) < 1e-12:
            yield f"{name}: {expression} is {value} in the last row"


def main(program, case_folder):
    expectation = tomllib.loads((case_folder / "expect.toml").read_text(encoding="utf-8"))
    failed = False
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in case_folder.iterdir():
            if file.name != "expect.toml":
                shutil.copy(file, folder)
        for step in expectation["step"]:
            result = run(program, step, folder)
            faults = list(faults_of(step, result, folder))
            if faults:
                failed = True
                print("peritherm", *step["command"])
                print(*faults, sep="\n")
                print(f"--- stdout\n{result.stdout}--- stderr\n{result.stderr}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2])))
