# SPDX-License-Identifier: GPL-3.0-or-later
"""The look that all figures share."""

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
from PIL import Image

from run_data import shorten

INK = "#22303c"
FAINT = "#8a97a3"
ACCENT = "#c0392b"
WATER = "#1f6fb2"
SLIP = 0  # of a joint, beside the modes of breaking
MODE_COLORS = {1: "#111111", 2: "#d7263d", 3: "#e08e00", SLIP: "#2a7f62"}  # tensile, shear, mixed
MODE_MARKERS = {1: "o", 2: "^", 3: "s", SLIP: "D"}

matplotlib.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 150, "savefig.facecolor": "white",
    "font.family": "DejaVu Sans", "font.size": 9.5,
    "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": FAINT, "axes.linewidth": 0.8,
    "xtick.color": INK, "ytick.color": INK, "xtick.direction": "out", "ytick.direction": "out",
    "axes.grid": True, "grid.color": "#e4e8ec", "grid.linewidth": 0.7, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False,
    "legend.frameon": False, "legend.fontsize": 8.5,
})


def plain(text):
    """Text of a user, not to be read as mathematics."""
    return text.replace("$", r"\$")


def set_titles(figure, run, what):
    """Title, and a line that says what is drawn and of which run, left, above everything."""
    height = figure.get_size_inches()[1]
    lines = [figure.text(0.02, 1.0 - 0.12 / height, plain(shorten(run.title, 120)), fontsize=12.5, weight="bold",
                         va="top"),
             figure.text(0.02, 1.0 - 0.40 / height, plain(" · ".join(filter(None, [what, run.remarks()]))), fontsize=9,
                         color="#5b6873", va="top")]
    for line in lines:
        width = line.get_window_extent(figure.canvas.get_renderer()).width / figure.bbox.width
        line.set_fontsize(line.get_fontsize() * min(1.0, 0.96 / width) if width > 0.0 else line.get_fontsize())


def below_titles(figure):
    """Top of the room left for the axes, as a share of the figure."""
    return 1.0 - 0.70 / figure.get_size_inches()[1]


def name_axes(axes, title, x, y):
    axes.set_title(title, loc="left", fontsize=10)
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def say_empty(axes, text):
    axes.set_xticks([])
    axes.set_yticks([])
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color=FAINT, fontsize=11)


def draw_wellbore(axes, radius):
    """The wall; radius [mm], 0 for none."""
    if radius > 0.0:
        axes.add_patch(plt.Circle((0.0, 0.0), radius, fill=False, edgecolor=INK, linewidth=0.8, zorder=3))


def time_unit(end):
    """(name, length [s]) of the unit of time that suits a run which lasts so long [s]"""
    for unit, seconds in (("d", 86400.0), ("h", 3600.0), ("min", 60.0), ("s", 1.0)):
        if end > 3.0 * seconds:
            return unit, seconds
    return ("s", 1.0) if end > 0.5 else ("ms", 1e-3)


def time_unit_of(run):
    times = run.history.get("time_s", ())
    return time_unit(times[-1] if len(times) else 0.0)


def save(figure, path):
    figure.savefig(path)
    plt.close(figure)
    print(path)


def make_small():
    """Figures for a repository: saved at 120 dots an inch from now on; shrink() them after."""
    matplotlib.rcParams["savefig.dpi"] = 120


def shrink(path):
    """A palette in place of true colour. The lines' colours and their ramps to white are kept: few pixels have
    them, and a palette made from the image alone merges red with orange."""
    steps, white = 8, [255, 255, 255]
    lines = [ACCENT, WATER, INK, *MODE_COLORS.values()]
    ramps = white + [round(255.0 * (1.0 - (1.0 - channel) * (k + 1) / steps))
                     for line in lines for k in range(steps) for channel in matplotlib.colors.to_rgb(line)]
    free = 256 - len(ramps) // 3
    image = Image.open(path).convert("RGB")
    palette = Image.new("P", (1, 1))
    palette.putpalette((image.quantize(free).getpalette()[:3 * free] + ramps)[:768])
    image = image.quantize(palette=palette, dither=Image.Dither.NONE)
    # the search for the nearest colour is coarse: nearly white is white
    colors = image.getpalette()
    image.putpalette([255 if min(colors[i - i % 3:i - i % 3 + 3]) >= 248 else colors[i] for i in range(len(colors))])
    image.save(path, optimize=True)
