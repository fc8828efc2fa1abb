"""The add-on in the Blender of this system, if there is one. Usage: installed_blender_test.py LIBPETZVAL.SO"""
import sys
import tempfile

import zips
import blender_test  # of tools/

with tempfile.TemporaryDirectory() as folder:
    sys.exit(blender_test.main(*map(str, zips.made(folder, sys.argv[1])), "debian"))
