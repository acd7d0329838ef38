# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user has to put right."""


class Mistake(Exception):
    pass
