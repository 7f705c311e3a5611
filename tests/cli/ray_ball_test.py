"""docs/examples/ray_ball.py: its formulas go wrong where docs/ray_and_ball.md says so, and the one that does not, does not."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

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

# In binary32: what the page says of two distances, and its remedy in C at all of them.
for distance, least, most in ((1000, 3, 60), (10_000, 400, 700)):
    engines = ray_ball.judged(lorentz, ray_ball.math.log10(distance), 1000, "binary32")
    wrong = {name: one["wrong"] for name, one in zip(ray_ball.FORMULAS, engines)}
    if wrong["projection"] != 0 or not least <= wrong["textbook"] <= most:
        sys.exit(f"in binary32, from {distance} radii: {wrong}")
MAIN = """
int main(void) {
  float x[3], v[3];
  while (scanf("%f %f %f %f %f %f", x, x + 1, x + 2, v, v + 1, v + 2) == 6) printf("%.9g\\n", enters(x, v, 1));
}
"""
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (code,) = re.findall(r"```c\n(.*?)```", ray_ball.PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (folder / "enters.c").write_text("#include <math.h>\n#include <stdio.h>\n" + code + MAIN)
    subprocess.run(["cc", "-std=c11", "-Wall", "-Werror", "-O2", "enters.c", "-o", "enters", "-lm"], cwd=folder, check=True)
    for distance in ray_ball.DISTANCES:
        scene, *asked = ray_ball.questions(ray_ball.math.log10(distance), 1000, ray_ball.Single)
        rays = "".join(" ".join(map(repr, map(float, one["x"] + one["v"]))) + "\n" for one in asked)
        times = subprocess.run([folder / "enters"], input=rays, capture_output=True, text=True, check=True).stdout.split()
        hit = {"outcome": "hit", "lattice": 0, "atom": 0, "cell": []}
        answers = [{"id": one["id"], **({**hit, "time": float(time)} if float(time) >= 0 else {"outcome": "never"})}
                   for one, time in zip(asked, times)]
        for file, lines in (("queries", [scene, *asked]), ("answers", answers)):
            (folder / file).write_text("".join(json.dumps(line) + "\n" for line in lines))
        done = subprocess.run([lorentz, "compare", "--precision", "binary32", "--json", "--queries", folder / "queries",
                               "--answers", f"C={folder / 'answers'}"], capture_output=True, text=True, check=False)
        said = json.loads(done.stdout)["engines"][0]
        if (said["queries"], said["wrong"], said["wrong_time"]) != (1000, 0, 0):
            sys.exit(f"the page's C from {distance} radii: {said}")
page = ray_ball.PAGE.read_text(encoding="utf-8")
table = page.split(ray_ball.BEGIN)[1].split(ray_ball.END)[0]
if [line.split(" | ")[0] for line in table.splitlines()[2:]] != [f"| {kind}" for kind in ray_ball.KINDS]:
    sys.exit("the table of docs/ray_and_ball.md has other rows; docs/examples/ray_ball.py table --write")
