"""Wrong formulas and wrong constants: each is a small change of the engine's files. Coq must refuse what is claimed of
the formulas then: the theorem of the claim, or the comparison with its constant, no longer holds. What does not
compile is an error of its own. `make` first.

python3 oracle/proof/bounds/wrong.py [NAME..]
exit status: 0 all refused, 1 one was not, 2 bad usage, 3 one could not be tried"""
import os, pathlib, re, shutil, subprocess, sys, tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from planting import NotTried, main, plant  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
ENGINE = ROOT / "src/engines"
LONGEST = 300  # seconds for what takes ten

WRONG = {}

def wrong(file, old, **changes):
    """Each of these is the file with `old`, which is there once, as the change says."""
    for name, new in changes.items():
        assert name not in WRONG, name
        WRONG[name] = (file, old, new)

# ---- Formulas.
FORMULAS = "reduction/formulas-inl.hpp"
wrong(FORMULAS, "return (y + n * D_R) - m * D_L;",
      height_with_a_wrong_sign="return (y + n * D_R) + m * D_L;",
      height_without_the_anchor="return n * D_R - m * D_L;")
wrong(FORMULAS, "return (s + n * S_R) + m * S_L;",
      along_by_the_wrong_arm="return (s + n * S_R) + m * S_R;",
      along_rounded_more_often="return ((s + n * S_R) - m * S_L) + (m * S_L + m * S_L);")
wrong(FORMULAS, "return a0 * b0 - a1 * b1;",
      difference_is_a_sum="return a0 * b0 + a1 * b1;")
wrong(FORMULAS, "T sum = d[0] * d[0];\n  for (int k = 1;",
      square_without_a_term="T sum = d[0] * d[0];\n  for (int k = 2;")
wrong(FORMULAS, "return -(S_L * y + D_L * s) * inverse_A;",
      row_number_without_its_sign="return (S_L * y + D_L * s) * inverse_A;")
wrong(FORMULAS, "return r * sqrt(v2);",
      width_of_another_root="return sqrt(r) * v2;")
wrong(FORMULAS, "for (int k = i == 0; k < D; ++k) sum",
      form_without_its_first_column="for (int k = 1; k < D; ++k) sum")
wrong(FORMULAS, "return one / (across * r);",
      scale_multiplied_by_the_radius="return one / across * r;")
wrong(FORMULAS, "return (s - q) / v2;",
      time_of_leaving="return (s + q) / v2;")
wrong(FORMULAS, "T low = (a.lo + b.lo) + (ab.lo + all.lo) + h.lo;",
      low_part_forgotten="T low = (a.lo + b.lo) + (ab.lo + all.lo);")
wrong(FORMULAS, "Pair::product(n[1], H[1].hi)",
      height_of_one_form_twice="Pair::product(n[1], H[0].hi)")
wrong(FORMULAS, "  return sum + offset;",
      place_without_the_offset="  return sum;")
wrong(FORMULAS, "det = det + adjugate[0][k] * a[0][k];",
      determinant_by_columns="det = det + adjugate[0][k] * a[k][0];")

# ---- Constants: below what is proved.
BOUNDS = "reduction/bounds.hpp"
wrong(BOUNDS, "kHeight = 8;", height_of_4="kHeight = 4;")
wrong(BOUNDS, "kRho = 6;", width_of_3="kRho = 3;")
wrong(BOUNDS, "kInside = 6;", inside_of_5="kInside = 5;")
wrong(BOUNDS, "kSparse = 10, kSparseOfShape = 16;",
      rows_of_9="kSparse = 9, kSparseOfShape = 16;",
      shapes_of_10="kSparse = 10, kSparseOfShape = 10;")
wrong(BOUNDS, "kLayer = 8;", layers_of_7="kLayer = 7;")
wrong(BOUNDS, "kPlace = 0x1p-102;", places_of_half="kPlace = 0x1p-103;")
wrong(BOUNDS, "kAnchor = 3, kAnchorTerms = 0x1p-100;", anchors_of_a_quarter="kAnchor = 3, kAnchorTerms = 0x1p-102;")
wrong(BOUNDS, "kAlong = 9,", along_of_8="kAlong = 8,")
wrong(BOUNDS, "kRowNumber = 18;", rows_of_16="kRowNumber = 16;")

def run(*command, folder):
    try: return subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired: raise NotTried(f"{command[0]} did not end in {LONGEST} seconds") from None

def set_up(folder):
    """A copy of what the claims are made of."""
    for part in ("reduction", "base"): shutil.copytree(ENGINE / part, folder / "src/engines" / part)
    shutil.copytree(ROOT / "oracle/proof/bounds", folder / "oracle/proof/bounds", ignore=shutil.ignore_patterns("made"))

def refused_by(change):
    """The theorem that Coq refuses; None, if it accepts all."""
    file, old, new = change
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        set_up(folder)
        plant(folder / "src/engines" / file, old, new)
        compiler = os.environ.get("CXX", "c++")
        done = run(compiler, "-std=c++20", "-I.", f"-I{ROOT / 'include'}", "oracle/proof/bounds/write.cpp", "-o", "write", folder=folder)
        if done.returncode: raise NotTried(f"it does not compile: {done.stderr[-300:]}")
        if run("./write", ".", folder=folder).returncode: raise NotTried("nothing is written")
        done = run("coqc", "-q", "-Q", "oracle/proof", "Lorentz", "Formulas.v", folder=folder)
        if not done.returncode: return None
        place = re.search(r'File "\./Formulas\.v", line ([0-9]+)', done.stderr)
        if done.returncode != 1 or not place: raise NotTried(f"coqc ended with {done.returncode}: {done.stderr[-300:]}")
        before = "\n".join((folder / "Formulas.v").read_text().split("\n")[:int(place[1])])
        if not before.split("\n")[-1].startswith("Proof."): raise NotTried(f"refused, but not in a proof: {done.stderr[-300:]}")
        return re.findall(r"^Theorem (\w+)", before, re.M)[-1]

if __name__ == "__main__":
    sys.exit(main(__doc__, WRONG, refused_by, unchanged=(BOUNDS, "kHeight = 8;", "kHeight = 8;")))
