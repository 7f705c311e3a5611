"""docs/examples/ray_ball.py: its formulas go wrong where docs/ray_and_ball.md says so, and the one that does not, does not."""

import pathlib
import sys

lorentz, source = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(source / "docs" / "examples"))
import ray_ball  # noqa: E402


def shares(kind):
    engines = ray_ball.judged(lorentz, kind, 200)
    if [one["queries"] for one in engines] != [200] * 4:
        sys.exit(f"{kind}: not all were asked: {engines}")
    return {name: (one["wrong"], one["wrong_time"]) for name, one in zip(ray_ball.FORMULAS, engines)}


def check(kind, holds):
    found = shares(kind)
    if not holds(found):
        sys.exit(f"{kind}: {found}")


check("plain", lambda of: all(wrong == 0 for wrong, _ in of.values()) and of["projection"][1] == 0)
check("grazing", lambda of: of["projection"] == (0, 0) and of["textbook"][1] > 20 and of["nearest-point"][1] > 20)
check("far", lambda of: of["projection"] == (0, 0) and all(of[name][0] > 5 for name in of if name != "projection"))
check("long and short v", lambda of: all(wrong > 80 for wrong, _ in of.values()))
# Powers of ten, as in the chart.
check(12, lambda of: of["projection"] == (0, 0) and all(of[name][0] > 50 for name in ("textbook", "q-form")))
check(1, lambda of: all(wrong == 0 for wrong, _ in of.values()))
page = ray_ball.PAGE.read_text(encoding="utf-8")
table = page.split(ray_ball.BEGIN)[1].split(ray_ball.END)[0]
if [line.split(" | ")[0] for line in table.splitlines()[2:]] != [f"| {kind}" for kind in ray_ball.KINDS]:
    sys.exit("the table of docs/ray_and_ball.md has other rows; docs/examples/ray_ball.py table --write")
