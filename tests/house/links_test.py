"""What the documents point to is there: links to files and to headings, and the paths of trust.md.

usage: links_test.py SOURCE [LEAST]; it also fails if there are fewer than LEAST documents (default: 20)
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()


def documents():
    """All Markdown and notebooks that git knows, or that are there if this is not a clone."""
    listed = subprocess.run(["git", "ls-files", "*.md", "*.ipynb"], cwd=ROOT, stdout=subprocess.PIPE, text=True)
    names = listed.stdout.split()
    return [ROOT / name for name in names] or [
        f for end in ("md", "ipynb") for f in ROOT.rglob(f"*.{end}") if "node_modules" not in f.parts]


def text_of(document):
    """A notebook's text is that of its cells of Markdown."""
    text = document.read_text()
    if document.suffix != ".ipynb":
        return text
    return "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "markdown")


def prose_of(document):
    """Without code blocks."""
    return re.sub(r"^```.*?^```", "", text_of(document), flags=re.M | re.S)


def anchors_of(document):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", prose_of(document), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(document):
    for target in re.findall(r"\]\(([^)\s]+)\)", prose_of(document)):
        if re.match(r"\w+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (document.parent / path).resolve() if path else document
        if not file.exists():
            yield f"{document.relative_to(ROOT)}: no {path}"
        elif anchor and file.suffix in (".md", ".ipynb") and anchor not in anchors_of(file):
            yield f"{document.relative_to(ROOT)}: {path} has no heading #{anchor}"


def missing_paths(document):
    """What stands in backticks and has a folder of this project in front."""
    for path in re.findall(r"`((?:tests|data|fuzz|src|oracle|docs|judge|report|question|statistics|packaging|cli)/[\w./-]+)`", document.read_text()):
        if path != "oracle/proof/check" and not (ROOT / path).exists():  # which is made by ./run proof
            yield f"{document.relative_to(ROOT)}: no {path}"


def main():
    found = documents()
    broken = [link for document in found for link in broken_links(document)]
    trust, least = ROOT / "docs/trust.md", int([*sys.argv, 20][2])
    broken += missing_paths(trust) if trust.exists() else []
    print("\n".join(broken))
    print(f"{len(found)} documents, {len(broken)} broken links")
    sys.exit(1 if broken or len(found) < least else 0)


main()
