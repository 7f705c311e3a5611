"""Which keys of a golden record are required, and which are optional: one table, docs/formats.md's, for data/check.py,
`lorentz golden verify`, the schema, the runners of docs/examples/golden, and oracle/proof/check where it was built.

golden_keys_test.py PROGRAM WORK"""
import contextlib
import io
import json
import pathlib
import subprocess
import sys
import unittest

import golden_forms_test as forms
import runners_test

try:
    import jsonschema
except ImportError:
    jsonschema = None

ROOT = forms.ROOT
REQUIRED = {
    "hit": {"id", "tags", "x", "v", "expect", "time_decimal", "certificate"},
    "inside": {"id", "tags", "x", "v", "expect", "certificate"},
    "never": {"id", "tags", "x", "v", "expect", "certificate"},
    "error": {"id", "tags", "expect"},
}
OPTIONAL = {
    "hit": {"margin", "condition", "time_change", "comment", "source_id"},
    "inside": {"margin", "comment", "source_id"},
    "never": {"source_id"},
    "error": {"source_id", "x", "v"},
}
CASES = {
    "hit": forms.sample("grazing", '"outcome":"hit"', '"comment"', '"margin"', '"condition"', '"time_change"'),
    "inside": forms.sample("boundary-starts", '"expect":{"outcome":"inside"', '"comment"', '"margin"'),
    "never": forms.NEVER,
    "error": forms.ERROR,
}
PROGRAM, WORK = "", None


def golden_set(kind, without):
    """A set of one record, which lacks a key."""
    scene, line = CASES[kind]
    record = json.loads(line)
    record = {key: value for key, value in (record | {"source_id": "mine"}).items() if key != without}
    tags = record.get("tags", json.loads(line)["tags"])
    header = {"format": 2, "name": "keys", "description": "one record", "generator": "lorentz golden make --set keys",
              "version": "0.1.0", "count": 1, "tags": {tag: "a word" for tag in tags}}
    written = json.dumps(record, separators=(",", ":")).encode()
    with contextlib.suppress(ValueError):
        written = forms.with_id(scene.encode(), written)
    return b"\n".join((json.dumps({"golden": header}, separators=(",", ":")).encode(), scene.encode(), written, b""))


def opinions(path):
    """For each checker: does it take the set?"""
    with contextlib.redirect_stdout(io.StringIO()):
        found = {"check.py": forms.check.check(str(path)) == 0}
    found["golden verify"] = subprocess.run([PROGRAM, "golden", "verify", path], capture_output=True).returncode == 0
    if (proved := ROOT / "oracle/proof/check").exists():
        found["oracle/proof/check"] = subprocess.run([proved, path], capture_output=True).returncode == 0
    if jsonschema:
        validator = jsonschema.Draft202012Validator(json.loads((ROOT / "data/golden/schema.json").read_text()))
        found["schema"] = all(validator.is_valid(json.loads(line)) for line in path.read_text().splitlines())
    return found


class Keys(unittest.TestCase):
    def test_every_checker_keeps_to_the_table(self):
        for kind in CASES:
            for key in {"", *REQUIRED[kind], *OPTIONAL[kind]} - {"from"}:
                path = WORK / f"{kind}-{key}.ndjson"
                path.write_bytes(golden_set(kind, key))
                for checker, takes in opinions(path).items():
                    with self.subTest(kind=kind, without=key, checker=checker):
                        self.assertEqual(takes, key not in REQUIRED[kind])

    def test_every_key_of_the_committed_records_is_in_the_table(self):
        for kind, (_, line) in CASES.items():
            self.assertLessEqual({*json.loads(line)} - {"from", "acceptable"}, REQUIRED[kind] | OPTIONAL[kind])

    def test_runners_need_no_optional_key(self):
        runners = runners_test.runners(WORK)
        for kind in CASES:
            for key in OPTIONAL[kind]:
                path, answers = WORK / f"{kind}-{key}.ndjson", WORK / "answers.ndjson"
                path.write_bytes(golden_set(kind, key))
                record = json.loads(path.read_text().splitlines()[2])
                answers.write_text(json.dumps({"id": record["id"]} | record["expect"]) + "\n")
                for language, command in runners.items():
                    with self.subTest(kind=kind, without=key, runner=language):
                        run = subprocess.run([*command, path, answers], capture_output=True, text=True)
                        self.assertEqual((run.returncode, run.stdout.split()), (0, [record["id"], "agree"]), run.stderr)


if __name__ == "__main__":
    WORK = pathlib.Path(sys.argv.pop())
    PROGRAM = sys.argv.pop()
    WORK.mkdir(parents=True, exist_ok=True)
    unittest.main()
