# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package petzval: beside this file, in a wheel of the extension, or of the system."""
try:
    from . import petzval
except ImportError:
    import petzval

__all__ = ["petzval"]
