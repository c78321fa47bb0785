#!/usr/bin/python3
"""Tests that check_layering.py finds each kind of offence and nothing else."""
import tempfile
import unittest
from pathlib import Path

import check_layering


class CheckLayering(unittest.TestCase):
    def problems(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            house = {
                "src/CMakeLists.txt": "add_subdirectory(util)\nadd_subdirectory(map)\nadd_subdirectory(slam)\n",
                "src/map/map.h": '#include "util/log.h"\n#include "cpslam/types.h"\n#include "map/key_frame.h"\n#include <map>\n',
                "include/cpslam/system.h": '#include <memory>\n#include <opencv2/core.hpp>\n#include "cpslam/types.h"\n',
                "Examples/main.cpp": 'int main() { return 0; }\n',
            }
            for name, text in {**house, **files}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return check_layering.check(root)

    def expect(self, files, *parts):
        problems = self.problems(files)
        self.assertEqual(len(problems), 1, problems)
        for part in parts:
            self.assertIn(part, problems[0])

    def test_a_clean_house(self):
        self.assertEqual(self.problems({}), [])

    def test_an_include_upwards(self):
        self.expect({"src/map/a.cpp": '\n#include "slam/system.h"\n'}, "src/map/a.cpp:2", "slam/system.h")

    def test_an_include_of_no_room(self):
        self.expect({"src/map/a.cpp": '#include "key_frame.h"\n'}, "src/map/a.cpp:1", "key_frame.h")
        self.expect({"src/map/a.cpp": '#include <util/log.h>\n'}, "src/map/a.cpp:1", "quotes")

    def test_a_room_that_is_not_listed(self):
        self.expect({"src/attic/a.cpp": ""}, "attic")

    def test_a_public_header_that_shows_the_inside(self):
        self.expect({"include/cpslam/a.h": "#include <Eigen/Core>\n"}, "include/cpslam/a.h:1", "Eigen/Core")
        self.expect({"include/cpslam/a.h": '#include "map/map.h"\n'}, "map/map.h")
        self.expect({"include/cpslam/a.h": "#include <opencv2/imgproc.hpp>\n"}, "opencv2/imgproc.hpp")

    def test_graphics_outside_the_viewer(self):
        self.expect({"src/slam/a.cpp": "#include <GLFW/glfw3.h>\n"}, "src/slam/a.cpp:1", "viewer")
        self.expect({"Examples/a.cpp": "#include <imgui.h>\n"}, "Examples/a.cpp:1", "viewer")
        viewer = {"src/CMakeLists.txt": "add_subdirectory(util)\nadd_subdirectory(map)\nadd_subdirectory(viewer)\n"}
        self.assertEqual(self.problems({**viewer, "src/viewer/a.cpp": "#include <epoxy/gl.h>\n"}), [])

    def test_forbidden_words(self):
        for code in ("usleep(5);", "sleep(1);", "std::this_thread::sleep_for(x);", "exit(1);", "std::exit(1);",
                     "t.detach();"):
            with self.subTest(code):
                self.expect({"src/map/a.cpp": f"void f() {{\n  {code}\n}}\n"}, "src/map/a.cpp:2")

    def test_words_in_comments_and_strings_do_not_count(self):
        self.assertEqual(self.problems({"src/map/a.cpp": '// usleep(1)\n/* exit(1)\n */ auto s = "exit(1)"; on_exit(); app.exit(e); p->exit(e);\n'}), [])

    def test_native_builds(self):
        self.expect({"cmake/Flags.cmake": "add_compile_options(-march=native)\n"}, "cmake/Flags.cmake")


if __name__ == "__main__":
    unittest.main()
