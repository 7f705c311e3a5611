"""Are the committed golden sets what data/golden/schema.json says, complete, small, and those of SHA256SUMS? Of each set
the first line of each shape is held against the schema, and every eighth line; with --all every line.

With names of files: are these what the schema says?
"""
import collections
import hashlib
import json
import pathlib
import sys

import jsonschema

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "data/golden"
LARGEST = 2_000_000
EVERY = 8


def shape_of(value):
    """Its keys, which values are texts, and a word itself: outcomes differ in form."""
    if isinstance(value, dict):
        return tuple((key, shape_of(one)) for key, one in value.items())
    if isinstance(value, list):
        return frozenset(map(shape_of, value))
    return value if isinstance(value, str) and value.isalpha() else isinstance(value, str)


def flaws_of(path, validator, every):
    lines = path.read_text(encoding="utf-8").splitlines()
    if path.stat().st_size >= LARGEST:
        yield f"{path.name}: {path.stat().st_size} bytes; a committed set stays below {LARGEST}"
    header, used = json.loads(lines[0]).get("golden"), collections.Counter()
    shapes = set()
    if not header or header["name"] != path.stem:
        yield f"{path.name}:1: no header of that name"
        return
    for number, line in enumerate(lines, 1):
        box = json.loads(line)
        shape = shape_of({**box, "tags": []})
        if number % every == 0 or shape not in shapes:
            shapes.add(shape)
            for error in validator.iter_errors(box):
                yield f"{path.name}:{number}: {error.message[:200]}"
        used.update(box.get("tags", []))
    if header["count"] and {*used} != {*header["tags"]}:
        yield f"{path.name}: tags explained and tags used differ: {sorted({*used} ^ {*header['tags']})}"


def main():
    validator_class = jsonschema.Draft202012Validator
    schema = json.loads((FOLDER / "schema.json").read_text())
    validator_class.check_schema(schema)
    others = [pathlib.Path(name) for name in sys.argv[1:] if name != "--all"]
    every = 1 if others or "--all" in sys.argv[1:] else EVERY
    sets = others or sorted(FOLDER.glob("*.ndjson"))
    flaws = [flaw for path in sets for flaw in flaws_of(path, validator_class(schema), every)]
    if not others:
        flaws += flaws_of_folder(sets)
    print(*flaws[:40], sep="\n")
    print(f"{len(sets)} sets, {len(flaws)} flaws")
    return 1 if flaws or len(sets) < (1 if others else 18) else 0


def flaws_of_folder(sets):
    sums = dict(reversed(line.split("  ")) for line in (FOLDER / "SHA256SUMS").read_text().splitlines())
    for path in sets:
        if sums.pop(path.name, None) != hashlib.sha256(path.read_bytes()).hexdigest():
            yield f"{path.name}: not what SHA256SUMS says"
    for name in sums:
        yield f"SHA256SUMS: {name} is not there"


if __name__ == "__main__":
    sys.exit(main())
