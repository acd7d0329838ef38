# SPDX-License-Identifier: GPL-3.0-or-later
"""What study.py is made of: plan.py reads the study, runs.py makes the runs, errors.py measures, result.py shows."""
