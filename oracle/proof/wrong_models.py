"""Wrong models: each is a small change of the model of the engine, or of what is proved on the way to `fly_right`. Coq
must refuse a proof of each. What does not end, or is refused outside of a proof, is an error of its own. `make` first.

python3 oracle/proof/wrong_models.py [--count N --seed S | NAME..]
exit status: 0 all refused, 1 one was not, 2 bad usage, 3 one could not be tried"""
import pathlib, shutil, sys, tempfile
from planting import main, plant
from wrong_specs import FOLDER, compiles

FILES = ["Doubles", "Euclid", "Rows", "Discs", "Model", "Certain", "Roundings", "Errors", "ErrorsStart", "ErrorsRows",
         "Engine"]  # each needs some of those before it
WRONG = {  # name: file, what is there once, what is written instead
    "ties to odd": ("Doubles", "(cond_incr (round_N (negb (Z.even m)) l) m)) e.",
                    "(cond_incr (round_N (Z.even m) l) m)) e."),
    "remainders not negative": ("Euclid", "(1 <= k)%Z /\\ - b <= r < b.", "(1 <= k)%Z /\\ 0 <= r < b."),
    "any quotient": ("Euclid", "0 < b <= a -> a < IZR (2 ^ 53) * b ->\n  let k", "0 < b <= a ->\n  let k"),
    "area with a minus": ("Euclid", "along_of R * val (height L) + along_of L", "along_of R * val (height L) - along_of L"),
    "rows in order from rho": ("Rows", "2 * rho <= D_R -> in_strip n m -> in_strip n' m'",
                               "rho <= D_R -> in_strip n m -> in_strip n' m'"),
    "steps as high as the strip": ("Rows", "0 < D_L < 2 * rho ->", "0 < D_L <= 2 * rho ->"),
    "no row before the start": ("Rows", "ahead n m -> beside - reach < IZR n.", "ahead n m -> beside < IZR n."),
    "discs overlap": ("Discs", "radius_small : 2 * r <= 1", "radius_small : r <= 1"),
    "without spread": ("Model", "below (plus (size_of value) spread) limit", "below (size_of value) limit"),
    "behind or not": ("Model", "if below error at_s && is_before at_s error best", "if is_before at_s error best"),
    "doubtful is behind": ("Model", "if below at_s (neg error) then", "if below at_s error then"),
    "order from rho": ("Model", "below (times (times (whole 2) (rho to)) more_than_one)",
                       "below (times (rho to) more_than_one)"),
    "an eighth of the error": ("Model", "eight_roundoffs : num := power (-50)", "eight_roundoffs : num := power (-53)"),
    "rows start too late": ("Model", "n (ceiling (minus m unsure))", "n (ceiling (plus m unsure) + 1)"),
    "doubtful is outside": ("Model", "| Doubtful => Undecided\n", "| Doubtful => fly_outside home d0 d1 v0 v1 r leaving\n"),
    "turned back the wrong way": ("Model", "HitAt (fst home + sign0 * fst here)", "HitAt (fst home - sign0 * fst here)"),
}

def refused_by(change):
    """The first file that Coq refuses; None, if it accepts all."""
    changed, old, new = change
    with tempfile.TemporaryDirectory() as folder:
        for path in FOLDER.glob("*.vo"): shutil.copy(path, folder)
        for name in FILES: shutil.copy(FOLDER / f"{name}.v", folder)
        plant(pathlib.Path(folder) / f"{changed}.v", old, new)
        return next((f"{name}.v" for name in FILES[FILES.index(changed):] if not compiles(name, folder)), None)

if __name__ == "__main__":
    sys.exit(main(__doc__, WRONG, refused_by, unchanged=("Engine", "Local Open Scope", "Local Open Scope")))
