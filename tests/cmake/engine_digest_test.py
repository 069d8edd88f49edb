"""What the digest in the program's name notices, and what not. Usage: engine_digest_test.py"""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / 'cmake'))
from write_version import digest  # noqa: E402

SOURCE = """#include "engine/a.h"

/// Twice.
double twice(double x) {
  return 2.0 * x;  // exact
}
"""


def digest_of(**files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name.replace('__', '/') + '.cpp')
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, 'utf-8')
        return digest(folder)


class EngineDigest(unittest.TestCase):
    def same(self, old, new):
        self.assertEqual(digest_of(a=SOURCE), digest_of(a=SOURCE.replace(old, new)))

    def other(self, before, after):
        self.assertNotEqual(digest_of(a=before), digest_of(a=after))

    def test_comments_layout_and_includes_do_not_count(self):
        self.same('/// Twice.', '/* Two\n * times. */')
        self.same('  // exact', '')
        self.same('double twice(double x) {', 'double twice(\n    double x)\n{')
        self.same('engine/a.h', 'engine/core/a.h')

    def test_code_counts(self):
        self.assertNotEqual(digest_of(a=SOURCE), digest_of(a=SOURCE.replace('2.0', '2.5')))
        self.other('auto s = "a // b";', 'auto s = "a // c";')
        self.other('auto s = "a  b";', 'auto s = "a b";')
        self.other("int n = 1'000; f('/', \"x\");", "int n = 1'001; f('/', \"x\");")
        self.other('#define A 1\nint b;', '#define A 1 int b;')
        self.other('return a - -b;', 'return a-- - b;')
        self.other('auto s = R"(one " // two)";', 'auto s = R"(one " // three)";')

    def test_a_file_may_move(self):
        self.assertEqual(digest_of(a=SOURCE, b='int b;'), digest_of(core__b=SOURCE, a='int b;'))

    def test_a_file_more_counts(self):
        self.assertNotEqual(digest_of(a=SOURCE), digest_of(a=SOURCE, b='int b;'))


if __name__ == '__main__':
    unittest.main()
