"""`lorentz golden verify --walk` passes the committed sets. Two whose margins take long are cut to every eighth record;
with --all none is left out.

python3 tests/golden/golden_verify_test.py PROGRAM [--all]"""
import json, pathlib, subprocess, sys, tempfile

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "data" / "golden"
SLOW = {"long-flight", "axis-and-diagonal"}  # together a third of the time of all sets
EVERY = 8


def thinned(path, folder):
    """A copy with every eighth record, and all scenes."""
    header, *lines = path.read_text().splitlines()
    records = [line for line in lines if line.startswith('{"id"')][::EVERY]
    kept = set(records)
    box = json.loads(header)
    tags = {tag for record in records for tag in json.loads(record)["tags"]}
    if tags != set(box["golden"]["tags"]):
        sys.exit(f"{path.name}: of every {EVERY} records one has not all tags")
    box["golden"]["count"] = len(records)
    copy = pathlib.Path(folder) / path.name
    copy.write_text("\n".join([json.dumps(box, separators=(",", ":"))] +
                              [line for line in lines if not line.startswith('{"id"') or line in kept]) + "\n")
    return copy


def main():
    program, whole = sys.argv[1], "--all" in sys.argv[2:]
    sets = sorted(FOLDER.glob("*.ndjson"))
    with tempfile.TemporaryDirectory() as folder:
        files = [path if whole or path.stem not in SLOW else thinned(path, folder) for path in sets]
        done = subprocess.run([program, "golden", "verify", "--walk", *files], capture_output=True, text=True)
    print(done.stdout, done.stderr)
    return 0 if done.returncode == 0 and done.stdout.count(", all verified") == len(sets) >= 33 else 1


if __name__ == "__main__":
    sys.exit(main())
