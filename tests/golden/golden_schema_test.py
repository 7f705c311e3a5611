"""Are the committed golden sets what data/golden/schema.json says, complete, small, and those of SHA256SUMS?"""
import collections
import hashlib
import json
import pathlib
import sys

import jsonschema

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "data/golden"
LARGEST = 2_000_000


def flaws_of(path, validator):
    lines = path.read_text(encoding="utf-8").splitlines()
    if path.stat().st_size >= LARGEST:
        yield f"{path.name}: {path.stat().st_size} bytes; a committed set stays below {LARGEST}"
    header, used = json.loads(lines[0]).get("golden"), collections.Counter()
    if not header or header["name"] != path.stem:
        yield f"{path.name}:1: no header of that name"
        return
    for number, line in enumerate(lines, 1):
        box = json.loads(line)
        for error in validator.iter_errors(box):
            yield f"{path.name}:{number}: {error.message[:200]}"
        used.update(box.get("tags", []))
    if {*used} != {*header["tags"]}:
        yield f"{path.name}: tags explained and tags used differ: {sorted({*used} ^ {*header['tags']})}"


def main():
    validator_class = jsonschema.Draft202012Validator
    schema = json.loads((FOLDER / "schema.json").read_text())
    validator_class.check_schema(schema)
    sets = sorted(FOLDER.glob("*.ndjson"))
    flaws = [flaw for path in sets for flaw in flaws_of(path, validator_class(schema))]
    sums = dict(reversed(line.split("  ")) for line in (FOLDER / "SHA256SUMS").read_text().splitlines())
    for path in sets:
        if sums.pop(path.name, None) != hashlib.sha256(path.read_bytes()).hexdigest():
            flaws.append(f"{path.name}: not what SHA256SUMS says")
    flaws += [f"SHA256SUMS: {name} is not there" for name in sums]
    print(*flaws[:40], sep="\n")
    print(f"{len(sets)} sets, {len(flaws)} flaws")
    return 1 if flaws or len(sets) < 18 else 0


if __name__ == "__main__":
    sys.exit(main())
