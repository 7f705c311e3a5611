"""Small wrong specifications: each is planted in Spec.v, and Sanity.v, which says what is meant, must fail;
or, where that says nothing of it, the proof.

python3 proof/wrong_specs.py [NAME..]    exit status: 0 all caught, 1 not"""
import concurrent.futures, os, pathlib, shutil, subprocess, sys, tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
SANITY = ["Spec", "Time", "Rounding", "Number", "Sanity"]
PROOF = ["Vectors", "Steps", "Search", "Space", "View", "Quadratic", "Windows", "Claims", "Reading", "Check",
         "Main"]

WRONG = {
    "entry at the far side": (
        "within o t' -> t <= t') /\\\n    (forall later, t < later -> exists t', within o t' /\\ t' < later)",
        "within o t' -> t' <= t) /\\ (forall later, later < t -> exists t', within o t' /\\ later < t')"),
    "closed balls": ("norm (along q (-1) centre) < value r", "norm (along q (-1) centre) <= value r"),
    "closed ellipsoids": ("norm y < 1 /\\ q", "norm y <= 1 /\\ q"),
    "ties the other way": ("t = t' /\\ not_after o o')", "t = t' /\\ not_after o' o)"),
    "x in `from` counts": (
        "(forall o', from <> Some o' -> ~ within o' 0) /\\",
        "(forall o', ~ within o' 0) /\\"),
    "`from` may be hit": (
        "first_hit (o : obstacle) (t : R) : Prop :=\n    from <> Some o /\\",
        "first_hit (o : obstacle) (t : R) : Prop :="),
    "`from` may contain x": (
        "first_inside (o : obstacle) : Prop :=\n    from <> Some o /\\",
        "first_inside (o : obstacle) : Prop :="),
    "also backwards": ("    0 <= t /\\ (forall t', within", "    (forall t', within"),
    "not from the surface": ("    0 <= t /\\ (forall t', within", "    0 < t /\\ (forall t', within"),
    "x may be inside others": (" (forall o', from <> Some o' -> ~ within o' 0) /\\\n", "\n"),
    "never means no start inside": ("~ within o 0 /\\ forall t, ~ enters o t.", "~ within o 0."),
    "never may start inside": (
        "from <> Some o -> ~ within o 0 /\\ forall t, ~ enters o t.",
        "from <> Some o -> forall t, ~ enters o t."),
    "the atom before the lattice": (
        "of_lattice o :: of_atom o :: cell o",
        "of_atom o :: of_lattice o :: cell o"),
    "cells are not compared": ("of_lattice o :: of_atom o :: cell o", "of_lattice o :: of_atom o :: []"),
    "cells counted the other way": ("(map IZR (cell o))", "(map (fun n => - IZR n) (cell o))"),
    "without the atom's position": (
        "combination (point (position A)) (map",
        "combination (map (fun _ => 0) (point (position A))) (map"),
    "the radius squared": ("< value r\n", "< value r * value r\n"),
    "numbers cut off": ("(FLT_exp (-1074) 53) ZnearestE x", "(FLT_exp (-1074) 53) Ztrunc x"),
    "no gradual underflow": ("(FLT_exp (-1074) 53) ZnearestE x", "(FLT_exp (-1022) 53) ZnearestE x"),
    "numbers not rounded": (
        "value (n : numeral) : R := nearest64 (written n)",
        "value (n : numeral) : R := written n"),
    "hexadecimal in base 16": (
        "| Hexadecimal m e => IZR m * bpow radix2 e",
        "| Hexadecimal m e => IZR m * bpow radix2 (4 * e)"),
    "39 digits": ("(FLX_exp 40)", "(FLX_exp 39)"),
    "times where v has length 1": (
        "within o t := occupied sc o (along (point (start q)) t",
        "within o t := occupied sc o (along (point (start q)) (t / norm (point (velocity q)))"),
    "inf from half the range on": (
        "None => bpow radix2 1024 <= nearest64 t",
        "None => bpow radix2 1025 <= nearest64 t"),
}

def compiles(name, folder):
    command = ["timeout", "120", "coqc", "-q", "-Q", ".", "Lorentz", f"{name}.v"]
    return subprocess.run(command, cwd=folder, capture_output=True).returncode == 0

def caught_by(wrong):
    """The first file that fails; None, if none does."""
    old, new = WRONG[wrong]
    with tempfile.TemporaryDirectory() as folder:
        for path in FOLDER.glob("*.v"): shutil.copy(path, folder)
        spec = pathlib.Path(folder) / "Spec.v"
        text = spec.read_text()
        assert text.count(old) == 1, f"{wrong}: {text.count(old)} places to plant it"
        spec.write_text(text.replace(old, new))
        assert compiles("Spec", folder), f"{wrong}: no specification at all"
        return next((name for name in SANITY[1:] + PROOF if not compiles(name, folder)), None)

def main(names):
    results = {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, by in zip(names, pool.map(caught_by, names)):
            results[name] = by
            print(f"{name:28} {'NOT CAUGHT' if by is None else 'caught by ' + by + '.v'}", flush=True)
    return 1 if None in results.values() else 0

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [*WRONG]))
