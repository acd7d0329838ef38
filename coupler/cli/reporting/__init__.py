# SPDX-License-Identifier: GPL-3.0-or-later
"""What report.py is made of: run.py reads a run, fields.py its fields, figures.py draws, space.py and
view.py do both in three dimensions, explained.py looks warnings up, page.py assembles."""
