# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's own error."""


class Refused(Exception):
    """A request that cannot be met; the text is one sentence that says why and what to change."""
