# SPDX-License-Identifier: GPL-3.0-or-later
"""What report.py is made of: run.py reads a run, fields.py its fields, figures.py draws, page.py assembles."""
