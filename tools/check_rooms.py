#!/usr/bin/env python3
"""Checks that the rooms of src/peritherm look down only, and that files and functions stay small.

Usage: check_rooms.py [--quiet] [ROOT]
"""

import re
import sys
from pathlib import Path

ROOMS = ["base", "geometry", "physics", "solutions", "discretisation", "operators", "system", "integrators", "reduction",
         "two_field", "output", "simulation", "studies", "papers"]
SEES_ONLY = {"output": {"base", "solutions", "discretisation", "output"}}
MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
NOTED_FUNCTION_LINES = 40

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]peritherm/([^/">]+)/')
MARK = re.compile(r"\b(to" r"do|fix" r"me|x" r"xx)\b", re.IGNORECASE)
MACHINE_PATH = re.compile(r'(?<![\w.)])/(?:home|root|tmp|work|Users|mnt|var)/')
FUNCTION_HEAD = re.compile(r"\)\s*(?:const|noexcept|override|final|mutable|&&?|->[^;{}]*|requires[^;{}]*|:[^;]*|\s)*$")
OTHER_HEAD = re.compile(r"^\s*(?:\}?\s*else\b\s*)?(?:if|for|while|switch|catch|do|namespace|extern)\b")
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)


def allowed_rooms(room):
    """The rooms that a file of this room may include."""
    if room in SEES_ONLY:
        return SEES_ONLY[room]
    return set(ROOMS[:ROOMS.index(room) + 1])


def blank(match):
    """Comments and literals become spaces, so that their braces do not count and lines keep their numbers."""
    return re.sub(r"[^\n]", " ", match.group(0))


def functions(text):
    """Yields (first line, number of lines) of every outermost function."""
    code = re.sub(r"(?m)^[ \t]*#(?:[^\n\\]|\\\n|\\.)*", blank, TOKEN.sub(blank, text))
    depth_of_function = None
    depth = 0
    head_start = 0
    first_line = 0
    for place, character in enumerate(code):
        if character == "{":
            head = code[head_start:place]
            if depth_of_function is None and FUNCTION_HEAD.search(head) and not OTHER_HEAD.search(head):
                depth_of_function = depth
                skipped = len(head) - len(head.lstrip())
                first_line = code.count("\n", 0, head_start + skipped) + 1
            depth += 1
        elif character == "}":
            depth -= 1
            if depth == depth_of_function:
                depth_of_function = None
                yield first_line, code.count("\n", 0, place) + 2 - first_line
        if character in "{};":
            head_start = place + 1


def check_includes(path, room, lines):
    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        if not include:
            continue
        other = include.group(1)
        if other not in ROOMS:
            yield f"{path}:{number}: '{other}' is no room. Rooms are: {', '.join(ROOMS)}"
        elif other not in allowed_rooms(room):
            seen = ", ".join(name for name in ROOMS if name in allowed_rooms(room))
            yield f"{path}:{number}: room '{room}' must not include '{other}'. It may see: {seen}"


def check_text(path, lines):
    for number, line in enumerate(lines, 1):
        if MARK.search(line):
            yield f"{path}:{number}: a mark of unfinished work. Finish it, or open an issue"
        if MACHINE_PATH.search(line):
            yield f"{path}:{number}: an absolute path of one machine. Name it relative to the repository"


def check_sizes(path, text, notes):
    length = text.count("\n")
    if length > MAX_FILE_LINES:
        yield f"{path}:1: {length} lines, more than {MAX_FILE_LINES}. Split the file"
    for first, count in functions(text):
        if count > MAX_FUNCTION_LINES:
            yield f"{path}:{first}: a function of {count} lines, more than {MAX_FUNCTION_LINES}. Split it"
        elif count > NOTED_FUNCTION_LINES:
            notes.append(f"{path}:{first}: note: a function of {count} lines; {NOTED_FUNCTION_LINES} are the aim")


def check(root):
    """Returns (problems, notes), each a list of "file:line: text"."""
    problems, notes = [], []
    for folder in ("src", "app", "tests"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in {".cpp", ".hpp", ".in", ".py", ".cmake", ".toml"} or not file.is_file():
                continue
            path = file.relative_to(root)
            text = file.read_text(encoding="utf-8")
            lines = text.splitlines()
            problems.extend(check_text(path, lines))
            if file.suffix not in {".cpp", ".hpp"}:
                continue
            if folder != "tests":
                problems.extend(check_sizes(path, text, notes))
            if path.parts[:2] == ("src", "peritherm") and len(path.parts) > 3:
                room = path.parts[2]
                if room in ROOMS:
                    problems.extend(check_includes(path, room, lines))
                else:
                    problems.append(f"{path}:1: '{room}' is no room. Rooms are: {', '.join(ROOMS)}")
    return problems, notes


def main(arguments):
    quiet = "--quiet" in arguments
    roots = [argument for argument in arguments if not argument.startswith("--")]
    problems, notes = check(Path(roots[0] if roots else "."))
    for line in ([] if quiet else notes) + problems:
        print(line)
    if not problems and not quiet:
        print("Rooms: nothing wrong.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
