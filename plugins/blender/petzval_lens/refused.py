# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's own error."""


class Refused(Exception):
    """A request that cannot be met; the text is one sentence that says why and what to change."""


def reason(error):
    """One line of what Blender says of a failed operator, and what to change where that is known."""
    said = next(iter(str(error).strip().splitlines()), "Blender gives no reason").removeprefix("Error: ")
    if "OpenImageDenoise" in said:
        return f"{said}; switch off Denoise in the panel Sampling"
    return said
