# SPDX-License-Identifier: GPL-3.0-or-later
"""The 3D view of the report: surface and particles at the picture times, drawn by the reader's browser.

view.js draws, with three.js, which is read from the distribution's package when the report is made and becomes part of
it: the page needs nothing else. Coordinates are 16-bit numbers over the box's longest side, so that 0.2 m are drawn to
3 um; what is more than the limits below is thinned, and the page says so.
"""
import base64
import json
import pathlib
from html import escape

import numpy

from reporting import figures, space

LIBRARY = pathlib.Path("/usr/share/javascript/three")
PACKAGE = "libjs-three"
NOTICE = """three.js, which draws the 3D view, is under the MIT licence: Copyright 2010-2019 three.js authors.
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation
files (the "Software"), to deal in the Software without restriction, including without limitation the rights to use, copy,
modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
Software is furnished to do so, subject to the following conditions: The above copyright notice and this permission notice
shall be included in all copies or substantial portions of the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT
WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A
PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION
WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE."""

# In all views of a page together, and in one picture: the page stays below 6 MB beside its other pictures.
ALL_TRIANGLES, TRIANGLES = 120000, 20000   # of surface and of wetted walls each; a corner's number has 16 bits
ALL_PARTICLES, PARTICLES = 120000, 20000
LINES = 20000                              # of the domain's edges; a boundary that has more is shown as its box

HINT = ("Drag: turn; with the right button: move; wheel after a click into the view: zoom. Blue: where the liquid fraction is "
        "0.5; paler: walls that the liquid wets; grey: surfaces of the script. "
        "Particles have their diameters, or 1.5 px.")
STYLE = """
.view { --stage: #ffffff; --edge: #8a949e; max-width: 900px; }
@media (prefers-color-scheme: dark) { .view { --stage: #2b3238; --edge: #9aa5af; } }
.view .stage { position: relative; height: min(62vh, 560px); border: 1px solid var(--line); overflow: hidden; }
.view .stage > canvas { width: 100%; height: 100%; display: block; cursor: grab; }
.view .label { position: absolute; transform: translate(-50%, -50%); font-size: .75rem; white-space: nowrap;
               color: var(--quiet); pointer-events: none; }
.view .controls { display: flex; flex-wrap: wrap; gap: .4rem 1.4rem; margin: .5rem 0; align-items: center; font-size: .9rem; }
.view .group { display: inline-flex; flex-wrap: wrap; gap: .2rem .6rem; align-items: center; }
.view button { font: inherit; padding: .1rem .5rem; }
.view output { min-width: 6.5rem; font-variant-numeric: tabular-nums; }
.view .colours { position: absolute; left: .6rem; top: .4rem; display: flex; gap: .5rem; align-items: center;
                 font-size: .8rem; pointer-events: none; }
.view .colours canvas { width: 7rem; height: .7rem; }
"""


def html(run, views):
    """The figure of a run, one of so many on the page. Throws RuntimeError when it cannot be made."""
    if not (LIBRARY / "three.min.js").is_file():
        raise RuntimeError(f"three.js is not installed (Debian: {PACKAGE})")
    spaces, reasons = read_spaces(run, views)
    notes = "".join(f"<p class=\"quiet\">{escape(text)}</p>" for text in [HINT, *reasons])
    return figure(spaces) + "<noscript><p class=\"quiet\">The 3D view needs JavaScript.</p></noscript>" + notes


def figure(spaces):
    data = json.dumps(encoded(spaces), separators=(",", ":"))
    return f"<figure class=\"view\"><script type=\"application/json\">{data}</script></figure>"


def scripts():
    """What draws the figures of a page, once, at its end."""
    parts = [LIBRARY / "three.min.js", LIBRARY / "examples" / "js" / "controls" / "OrbitControls.js",
             pathlib.Path(__file__).with_name("view.js")]
    code = "".join("<script>" + part.read_text(encoding="utf-8").replace("</script", "<\\/script") + "</script>\n"
                   for part in parts)
    return f"<style>{STYLE}</style>\n<!-- {NOTICE} -->\n{code}"


def read_spaces(run, views):
    """Time -> Space, and why some cannot be shown."""
    times = figures.shown_times(run)
    share = views * len(times)
    spaces, reasons = {}, []
    for time in times:
        try:
            spaces[time] = space.read(run.folder, time, min(TRIANGLES, ALL_TRIANGLES // share),
                                      min(PARTICLES, ALL_PARTICLES // share))
        except RuntimeError as error:  # a time folder that the run did not finish
            reasons.append(str(error))
    if not spaces:
        raise RuntimeError("; ".join(reasons))
    return spaces, reasons


def encoded(spaces):
    """What view.js reads."""
    everything = list(spaces.values())
    places = [points for s in everything for points in (s.lower[None], s.upper[None], s.positions, s.walls[0]) if len(points)]
    lower = numpy.min([points.min(axis=0) for points in places], axis=0).astype(float)
    upper = numpy.max([points.max(axis=0) for points in places], axis=0).astype(float)
    size = (upper - lower).max()
    largest = max((s.radii.max() for s in everything if s.particles), default=None)
    fastest = max((s.speeds.max() for s in everything if s.particles), default=None)

    def points(array):
        return packed((array - lower) / size, "<u2", 65535)

    def cells(part):
        return {"points": points(part[0]), "cells": packed(part[1], "<u2")} if len(part[1]) else None

    shapes = []  # most stay from time to time: a moment names them by their place here

    def shape(part):
        packed_cells = cells(part)
        if packed_cells and packed_cells not in shapes:
            shapes.append(packed_cells)
        return shapes.index(packed_cells) if packed_cells else None

    def moment(time, here):
        particles = {"positions": points(here.positions), "radii": packed(here.radii / largest, "<u2", 65535),
                     "speeds": packed(here.speeds / max(fastest, 1e-12), "<u1", 255)} if here.particles else None
        edges = here.edges if 0 < len(here.edges[1]) <= LINES else box(here.lower, here.upper)
        return {"time": time, "edges": shape(edges), "walls": shape(here.walls), "surface": cells(here.surface),
                "wetted": cells(here.wetted), "particles": particles, "note": note(here)}

    # Without the ends of the colours, which would not be seen on black or white.
    moments = [moment(time, here) for time, here in spaces.items()]
    palette = (255 * figures.SPEED(numpy.linspace(0.1, 0.95, 256))[:, :3]).round()
    return {"lower": lower.tolist(), "upper": upper.tolist(), "vertical": everything[0].vertical,
            "largest": largest, "fastest": fastest, "colours": packed(palette, "<u1"),
            "shapes": shapes, "times": moments}


def packed(array, kind, steps=1):
    """Base64 of whole numbers; array: of 0 to 1 in so many steps."""
    return base64.b64encode(numpy.rint(numpy.asarray(array) * steps).astype(kind).tobytes()).decode()


def box(lower, upper):
    """Corners and the twelve edges between them."""
    ends = numpy.array([[i >> axis & 1 for axis in range(3)] for i in range(8)])
    lines = [(i, i | 1 << axis) for i in range(8) for axis in range(3) if not i >> axis & 1]
    return lower + ends * (upper - lower), numpy.array(lines)


def note(here):
    """What of it is drawn."""
    parts = []
    for one, more, drawn, there in (("particle", "particles", len(here.radii), here.particles),
                                    ("triangle of the surface", "triangles of the surface", len(here.surface[1]),
                                     here.surface_triangles)):
        if there:
            parts.append(f"{there} {one if there == 1 else more}" + (f", thinned to {drawn}" if drawn < there else ""))
    return "; ".join(parts) + "." if parts else "No surface and no particles at this time."
