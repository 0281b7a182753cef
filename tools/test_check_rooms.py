#!/usr/bin/env python3
"""Tests of check_rooms.py: it must find what it promises, with file and line."""

import tempfile
import unittest
from pathlib import Path

from check_rooms import ROOMS, allowed_rooms, check, functions


class CheckRooms(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def problems_of(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return check(self.root)[0]

    def assert_one(self, problems, start):
        self.assertEqual(len(problems), 1, problems)
        self.assertTrue(problems[0].startswith(start), problems[0])

    def test_a_room_may_look_down(self):
        text = '#include "peritherm/base/error.hpp"\n#include "peritherm/physics/kernel.hpp"\n'
        self.assertEqual(self.problems_of("src/peritherm/physics/kernel.cpp", text), [])

    def test_a_room_must_not_look_up(self):
        text = '#pragma once\n#include "peritherm/system/thermal_system.hpp"\n'
        self.assert_one(self.problems_of("src/peritherm/physics/kernel.hpp", text), "src/peritherm/physics/kernel.hpp:2:")

    def test_output_sees_only_three_rooms(self):
        self.assertEqual(allowed_rooms("output"), {"base", "solutions", "discretisation", "output"})
        text = '#include "peritherm/geometry/face.hpp"\n'
        self.assert_one(self.problems_of("src/peritherm/output/vtk.cpp", text), "src/peritherm/output/vtk.cpp:1:")

    def test_the_last_room_sees_all(self):
        self.assertEqual(allowed_rooms("papers"), set(ROOMS))

    def test_a_folder_that_is_no_room_is_named(self):
        self.assert_one(self.problems_of("src/peritherm/utils/list.hpp", "\n"), "src/peritherm/utils/list.hpp:1:")

    def test_marks_and_machine_paths_are_found(self):
        self.assert_one(self.problems_of("app/main.cpp", "\n// TO" "DO: later\n"), "app/main.cpp:2:")
        self.assert_one(self.problems_of("app/main.cpp", 'open("/ho' 'me/someone/file");\n'), "app/main.cpp:1:")

    def test_relative_paths_and_words_are_left_alone(self):
        self.assertEqual(self.problems_of("app/main.cpp", '"results/tmp/x"; int todos; // <sys/var/x>\n'), [])

    def test_long_files_are_found(self):
        self.assertEqual(self.problems_of("app/main.cpp", "\n" * 400), [])
        self.assert_one(self.problems_of("app/main.cpp", "\n" * 401), "app/main.cpp:1:")

    def test_long_functions_are_found_and_middling_ones_noted(self):
        self.assert_one(self.problems_of("app/main.cpp", "\nint f() {\n" + "g();\n" * 59 + "}\n"), "app/main.cpp:2:")
        self.assertEqual(self.problems_of("app/main.cpp", "\nint f() {\n" + "g();\n" * 58 + "}\n"), [])
        self.assertEqual(len(check(self.root)[1]), 1)

    def test_functions_are_told_from_other_blocks(self):
        text = """namespace a {
struct S {
  S(int x) : y(x) {}
  int get() const noexcept {
    if (y) { return '{'; }  // }
    return f([](int i) { return i; });
  }
  int y{1};
};
enum class E { one };
auto g() -> int
{
  return 0;
}
}
"""
        self.assertEqual(list(functions(text)), [(3, 1), (4, 4), (11, 4)])


if __name__ == "__main__":
    unittest.main()
