"""tools/c_api.py reads the headers right: a small header by hand, and the layout of every struct beside a compiler's."""
import ctypes
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.path.insert(0, str(ROOT / "python/petzval"))

import c_api_table  # noqa: E402
import c_api_written  # noqa: E402
import _declared  # noqa: E402

HEADER = """/* Title: a preface. - One. */
extern "C" {
/* --- Lamps
 * ------- */
typedef enum kind { ROUND = 0, /* no corners */ SQUARE } kind;
typedef struct lamp lamp;
/* A box of light. */
typedef struct box {
    size_t size;
    int width, height; /* in cells */
    /* Called once. */
    int (*lit)(void* host, double share);
    void *r, *g;
    int holes_per_px;
    double rim_px;
} box;
/* Opens a lamp. Errors: unsupported. */
PETZVAL_C_API petzval_status petzval_lamp_open(const box* from, double reach_mm, lamp** made);
PETZVAL_C_API void petzval_lamp_close(lamp* made); /* null is fine */
}
"""


def table_of(text):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "lamp.h"
        path.write_text(text)
        return c_api_table.read([path])


class ATable(unittest.TestCase):
    def test_every_kind_of_declaration_is_read(self):
        api = table_of(HEADER)
        self.assertEqual(api.enums[0].values, [("ROUND", 0, "no corners"), ("SQUARE", 1, "")])
        self.assertEqual(api.handles[0].name, "lamp")
        fields = [(f.name, f.type, f.doc) for f in api.structs[0].fields]
        self.assertEqual(fields, [("size", "size_t", ""), ("width", "int", "in cells"), ("height", "int", "in cells"),
                                  ("lit", "function", "Called once."), ("r", "void*", ""), ("g", "void*", ""),
                                  ("holes_per_px", "int", ""), ("rim_px", "double", "")])
        opened, closed = api.functions
        self.assertEqual([a.type for a in opened.arguments], ["const box*", "double", "lamp**"])
        self.assertEqual(closed.doc, "null is fine")

    def test_the_page_names_units_and_errors(self):
        page = c_api_written.page(table_of(HEADER))
        self.assertIn("Units: `reach_mm` in mm.", page)
        self.assertIn("| `rim_px` | `double` | pixels |", page)
        self.assertIn("| `holes_per_px` | `int` |  |", page)
        self.assertIn("Errors: invalid_argument, out_of_memory, internal, unsupported.", page)

    def test_a_declaration_of_another_form_is_refused(self):
        with self.assertRaises(c_api_table.Unreadable):
            table_of(HEADER + "PETZVAL_C_API int petzval_other(void) {}\n")


class Declarations(unittest.TestCase):
    def test_ctypes_lays_every_struct_out_as_the_compiler_does(self):
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder) / "layout.c", pathlib.Path(folder) / "layout"
            source.write_text(subprocess.run([sys.executable, ROOT / "tools/c_api.py", "--layout"], check=True,
                                             capture_output=True, text=True).stdout)
            subprocess.run(["cc", "-I", ROOT / "include", source, "-o", program], check=True)
            lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
        self.assertGreater(len(lines), 60)
        for line in lines:
            name, number = line.split()
            struct, _, member = name.partition(".")
            declared = getattr(_declared, struct)
            found = getattr(declared, member).offset if member else ctypes.sizeof(declared)
            self.assertEqual(found, int(number), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
