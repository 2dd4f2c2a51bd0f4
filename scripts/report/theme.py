"""Pictures as SVG in data URIs, which follow the page's light or dark colours.

Matplotlib writes a few marker colours; they become variables of the SVG's own style sheet. The
hues are Okabe and Ito's, told apart by colour-blind readers too.
"""
import base64
import html
import io
import re

import matplotlib
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.colors import LinearSegmentedColormap, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import blended_transform_factory

INK, SOFT, GRID = "#123451", "#123452", "#123453"
PLAIN, BEFORE, AFTER, STRONG = "#123454", "#123455", "#123456", "#c51b7d"
GREEN, PURPLE = "#123457", "#123458"
COLOURS = {  # marker: variable, light, dark
    INK: ("ink", "#1c2430", "#e6e9ee"),
    SOFT: ("soft", "#5a6472", "#a3adba"),
    GRID: ("grid", "#d9dee5", "#333c48"),
    PLAIN: ("plain", "#8b93a0", "#7d8794"),
    BEFORE: ("before", "#c75000", "#ff9d4d"),
    AFTER: ("after", "#0068ad", "#56b4f9"),
    GREEN: ("green", "#00805c", "#33c99b"),
    PURPLE: ("purple", "#a0457e", "#e493c0"),
}
SERIES = (AFTER, BEFORE, GREEN, PURPLE, PLAIN)         # of things that have no colour of their own
STYLE = {
    "svg.fonttype": "none", "svg.hashsalt": "bemcal", "text.parse_math": False, "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "sans-serif"],      # stands at every word
    "font.size": 8,
    "axes.edgecolor": GRID, "axes.labelcolor": SOFT, "axes.titlecolor": INK, "axes.titlesize": 8.5,
    "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "xtick.color": GRID, "ytick.color": GRID, "xtick.labelcolor": SOFT, "ytick.labelcolor": SOFT,
    "text.color": INK, "legend.frameon": False, "legend.fontsize": 8,
    "legend.handlelength": 1.4, "lines.linewidth": 1.3,
    "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none",
}
WIDTH = 4.1                    # [in] as a phone shows it
# Of a path a hundredth of a point is enough; the rest is a third of a page's bytes.
PATH, DECIMALS = re.compile(r' d="[^"]*"'), re.compile(r"(\.\d\d)\d+")
LINE, SIGN = 60, 4             # characters in a line of a legend; that a sign beside its words takes
DPI = 144                      # of what is drawn as an image

matplotlib.rcParams.update(STYLE)


def diverging():
    """Blue where the model is too low, orange where too high, paler the less."""
    return LinearSegmentedColormap.from_list("residual", [
        (0, to_rgba("#1f6fc4", 1)), (0.5, to_rgba("#1f6fc4", 0)), (0.5, to_rgba("#e06000", 0)),
        (1, to_rgba("#e06000", 1))])


def rising():
    return LinearSegmentedColormap.from_list("strong", [to_rgba(STRONG, 0), to_rgba(STRONG, 0.9)])


def figure(height, **grid):
    """Figure and axes, in the page's style."""
    drawn = Figure(figsize=(WIDTH, height), dpi=DPI, layout="constrained")
    return drawn, drawn.subplots(**grid)


def panels(n, columns, row_height, **more):
    """Figure and n axes in rows; what is left of the last row is empty."""
    rows = -(-n // columns)
    drawn, axes = figure(row_height * rows, nrows=rows, ncols=columns, squeeze=False, **more)
    for axis in axes.flat[n:]:
        axis.set_visible(False)
    return drawn, list(axes.flat[:n])


def dots(axis, x, y, colour, size=2.5, alpha=0.7, label=None):
    """Points as one path of lines without length, a tenth of the bytes that markers take. NaN is left out."""
    places = np.column_stack([np.asarray(x, float), np.asarray(y, float)])
    places = places[np.isfinite(places).all(axis=1)]
    if not len(places):
        return
    path = Path(np.repeat(places, 2, axis=0), np.tile([Path.MOVETO, Path.LINETO], len(places)))
    path.should_simplify = False
    axis.add_patch(PathPatch(path, fill=False, edgecolor=colour, linewidth=size, capstyle="round", alpha=alpha))
    axis.update_datalim(places)
    axis.autoscale_view()
    if label:                  # a marker that stands nowhere
        axis.plot([], [], "o", color=colour, markersize=4, label=label)


def thousands(value, _=None):
    """"260k" of a large number, so that those of an axis do not touch."""
    size, letter = (1e6, "M") if abs(value) >= 1e6 else (1e3, "k") if abs(value) >= 1e4 else (1, "")
    return f"{value / size:g}{letter}".replace("-", "−")


def compact(axis):
    axis.xaxis.set_major_formatter(thousands)


def legend_above(axis):
    """Above the axes, where nothing is drawn, from the picture's left edge on; in two lines where one is too short."""
    _, words = axis.get_legend_handles_labels()
    is_long = sum(map(len, words)) + SIGN * len(words) > LINE
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=-(-len(words) // 2) if is_long else len(words),
                bbox_transform=blended_transform_factory(axis.figure.transFigure, axis.transAxes), borderaxespad=0.2,
                columnspacing=0.9, handlelength=1.2, handletextpad=0.5)


def legend_on_top(drawn, rows, marker=None):
    """One legend for all panels, in a line of its own. rows: (words, colour)."""
    drawn.suptitle(" ", fontsize=9)            # keeps the line free
    style = {"marker": marker, "linestyle": "", "markersize": 4} if marker else {}
    drawn.legend([Line2D([], [], color=colour, **style) for _, colour in rows], [words for words, _ in rows],
                 loc="upper left", bbox_to_anchor=(0, 1), ncols=len(rows), borderaxespad=0.1, columnspacing=0.9,
                 handlelength=1.2, handletextpad=0.4)


def variables(column):
    return "".join(f"--{row[0]}:{row[column]};" for row in COLOURS.values())


def svg_of(drawn):
    """The SVG of a figure, with marker colours. `savefig` would draw it once more, for nothing but its layout."""
    out, canvas = io.StringIO(), FigureCanvasSVG(drawn)
    drawn.get_layout_engine().execute(drawn)
    drawn.set_layout_engine("none")
    drawn.set_dpi(DPI)         # which asking for the text's size has changed
    canvas.print_svg(out, metadata={"Date": None, "Creator": None})
    svg = out.getvalue()
    return PATH.sub(lambda path: DECIMALS.sub(r"\1", path.group()), svg[svg.index("<svg"):])


def coloured(svg, colour_of):
    for marker, row in COLOURS.items():
        svg = svg.replace(marker, colour_of(*row))
    return svg


def with_head(svg, inside):
    """Something more at the begin of an SVG."""
    head = svg.index(">") + 1
    return svg[:head] + inside + svg[head:]


def of_the_page(svg):
    """It follows the reader's light or dark."""
    style = f"<style>svg{{{variables(1)}font-family:sans-serif}}" \
            f"@media(prefers-color-scheme:dark){{svg{{{variables(2)}}}}}</style>"
    return with_head(coloured(svg, lambda name, *_: f"var(--{name})"), style)


def by_itself(svg, alt):
    """Light, on white, with its words: for a file that any program may show."""
    words = f"<title>{html.escape(alt)}</title><style>svg{{font-family:sans-serif}}</style>" \
            '<rect width="100%" height="100%" fill="#ffffff"/>'
    return '<?xml version="1.0" encoding="utf-8"?>\n' + with_head(coloured(svg, lambda _, light, __: light), words)


def data_uri(drawn):
    return uri_of(svg_of(drawn))


def uri_of(svg):
    return "data:image/svg+xml;base64," + base64.b64encode(of_the_page(svg).encode()).decode()
