"""Pictures as SVG in data URIs, which follow the page's light or dark colours.

Matplotlib writes a few marker colours; they become variables of the SVG's own style sheet. The
hues are Okabe and Ito's, told apart by colour-blind readers too.
"""
import base64
import io

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.colors import LinearSegmentedColormap, to_rgba
from matplotlib.figure import Figure

INK, SOFT, GRID = "#123451", "#123452", "#123453"
PLAIN, BEFORE, AFTER, STRONG = "#123454", "#123455", "#123456", "#c51b7d"
COLOURS = {  # marker: variable, light, dark
    INK: ("ink", "#1c2430", "#e6e9ee"),
    SOFT: ("soft", "#5a6472", "#a3adba"),
    GRID: ("grid", "#d9dee5", "#333c48"),
    PLAIN: ("plain", "#8b93a0", "#7d8794"),
    BEFORE: ("before", "#c75000", "#ff9d4d"),
    AFTER: ("after", "#0068ad", "#56b4f9"),
}
STYLE = {
    "svg.fonttype": "none", "svg.hashsalt": "bemcal", "font.family": "sans-serif", "font.size": 8,
    "axes.edgecolor": GRID, "axes.labelcolor": SOFT, "axes.titlecolor": INK, "axes.titlesize": 8.5,
    "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "xtick.color": GRID, "ytick.color": GRID, "xtick.labelcolor": SOFT, "ytick.labelcolor": SOFT,
    "text.color": INK, "legend.frameon": False, "legend.fontsize": 8,
    "legend.handlelength": 1.4, "lines.linewidth": 1.3,
    "figure.facecolor": "none", "axes.facecolor": "none", "savefig.facecolor": "none",
}
WIDTH = 4.1                    # [in] as a phone shows it
DPI = 144                      # of what is drawn as an image

matplotlib.rcParams.update(STYLE)


def diverging():
    """Blue where the model is too low, orange where too high, nothing in between."""
    return LinearSegmentedColormap.from_list("residual", [
        to_rgba("#1f6fc4", 1), to_rgba("#1f6fc4", 0), to_rgba("#e06000", 0),
        to_rgba("#e06000", 1)])


def rising():
    return LinearSegmentedColormap.from_list("strong", [to_rgba(STRONG, 0), to_rgba(STRONG, 0.9)])


def figure(height, **grid):
    """Figure and axes, in the page's style."""
    drawn = Figure(figsize=(WIDTH, height), dpi=DPI, layout="constrained")
    return drawn, drawn.subplots(**grid)


def variables(column):
    return "".join(f"--{row[0]}:{row[column]};" for row in COLOURS.values())


def data_uri(drawn):
    """The SVG of a figure. `savefig` would draw it once more, for nothing but its layout."""
    out, canvas = io.StringIO(), FigureCanvasSVG(drawn)
    drawn.get_layout_engine().execute(drawn)
    drawn.set_layout_engine("none")
    drawn.set_dpi(DPI)         # which asking for the text's size has changed
    canvas.print_svg(out, metadata={"Date": None, "Creator": None})
    svg = out.getvalue()
    for marker, (name, *_) in COLOURS.items():
        svg = svg.replace(marker, f"var(--{name})")
    style = f"<style>svg{{{variables(1)}font-family:sans-serif}}" \
            f"@media(prefers-color-scheme:dark){{svg{{{variables(2)}}}}}</style>"
    head = svg.index(">", svg.index("<svg")) + 1
    svg = svg[svg.index("<svg"):head] + style + svg[head:]
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()
