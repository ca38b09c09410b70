"""What the plots share: where data are, sizes that are readable in a page, colours, SVG without dates."""
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks" / "page"))
sys.dont_write_bytecode = True

plt.rcParams.update({"font.size": 11, "axes.grid": True, "grid.color": "0.88", "axes.axisbelow": True, "svg.hashsalt": "jawari",
                     "legend.frameon": False, "figure.facecolor": "white", "lines.markersize": 4})
OURS = {"signorini": "#08519c", "newton": "#3182bd", "passive": "#41ae76", "paoli-schatzman": "#7b6ccf"}
RIVALS = {"uniform": "#000000", "theta=0.5": "#d95f02", "theta=1.0": "#fdae61", "penalty": "#e7298a", "ieq-modal": "#a6761d",
          "ieq": "#b30000", "sav": "#999999"}


def save(figure, name):
    path = ROOT / "docs" / "images" / "benchmarks" / f"{name}.svg"
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)
