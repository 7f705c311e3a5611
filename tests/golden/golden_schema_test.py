"""Are the committed golden sets what data/golden/schema.json says, complete, small, and those of SHA256SUMS? In each
set the first line of each shape is held against the schema, and every eighth line; with --all every line.
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
    if header["count"] and {*used} | {"needs-judge"} != {*header["tags"]} | {"needs-judge"}:
        yield f"{path.name}: tags explained and tags used differ: {sorted({*used} ^ {*header['tags']})}"


def is_indexed(path, said, digest):
    lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    records, header = [line for line in lines if "expect" in line], lines[0]["golden"]
    scenes = [line["scene"] for line in lines if "scene" in line]
    atoms = [atom for scene in scenes for lattice in scene["lattices"] for atom in lattice["atoms"]]
    asked = "".join(json.dumps({key: line[key] for key in ("x", "v", "from", "expect", "scene") if key in line}) for line in lines)
    facts = {
        "sha256": digest, "name": header["name"], "count": len(records), "tags": header["tags"],
        "dimensions": sorted({scene["dimension"] for scene in scenes}),
        **{outcome: sum(r["expect"]["outcome"] == outcome for r in records) for outcome in ("hit", "never", "inside", "error")},
        "with_acceptable": sum("acceptable" in r for r in records),
        "needs_judge": sum("needs-judge" in r["tags"] for r in records),
    }
    kinds = {"ellipsoids": any("semiaxes" in atom for atom in atoms), "balls": any("radius" in atom for atom in atoms),
             "several lattices": any(len(scene["lattices"]) > 1 for scene in scenes)}
    return (said is not None and all(said[key] == fact for key, fact in facts.items())
            and all((kind in said["scenes"]) == is_there for kind, is_there in kinds.items())
            and ("hexadecimal" in said["notations"]) == ("0x" in asked))


def main():
    validator_class = jsonschema.Draft202012Validator
    schema = json.loads((FOLDER / "schema.json").read_text())
    validator_class.check_schema(schema)
    every = 1 if "--all" in sys.argv[1:] else EVERY
    sets = sorted([*FOLDER.glob("*.ndjson"), *FOLDER.glob("smoke/*.ndjson")])
    flaws = [flaw for path in sets for flaw in flaws_of(path, validator_class(schema), every)]
    flaws += flaws_of_folder(sets)
    print(*flaws[:40], sep="\n")
    print(f"{len(sets)} sets, {len(flaws)} flaws")
    return 1 if flaws or len(sets) < 18 else 0


def flaws_of_folder(sets):
    sums = dict(reversed(line.split("  ")) for line in (FOLDER / "SHA256SUMS").read_text().splitlines())
    index = {one["file"]: one for one in json.loads((FOLDER / "index.json").read_text())["sets"]}
    files = [path for path in FOLDER.rglob("*") if path.is_file() and path != FOLDER / "SHA256SUMS"]
    for path in [path for path in files if path.relative_to(FOLDER).parts[0] != "itineraries"]:  # has its own
        name, digest = str(path.relative_to(FOLDER)), hashlib.sha256(path.read_bytes()).hexdigest()
        if sums.pop(name, None) != digest:
            yield f"{name}: not what SHA256SUMS says"
        if path in sets and not is_indexed(path, index.pop(name, None), digest):
            yield f"{name}: not what index.json says"
    for name in index:
        yield f"index.json: {name} is not there"
    for name in sums:
        yield f"SHA256SUMS: {name} is not there"


if __name__ == "__main__":
    sys.exit(main())
