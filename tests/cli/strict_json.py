"""Reads JSON as strictly as its standard says: no NaN, no key twice, no text that is not UTF-8."""

import json


def _refuse(word):
    raise ValueError(f"{word} is not JSON")


def _once(pairs):
    members = dict(pairs)
    if len(members) != len(pairs):
        raise ValueError(f"a key comes twice: {[key for key, _ in pairs]}")
    return members


def read(data):
    """What a text, or its UTF-8, means. ValueError if it is not JSON."""
    text = data.decode("utf-8") if isinstance(data, bytes) else data
    return json.loads(text, parse_constant=_refuse, object_pairs_hook=_once)


def read_lines(data):
    """The same for lines, each of which ends."""
    text = data.decode("utf-8") if isinstance(data, bytes) else data
    if text and not text.endswith("\n"):
        raise ValueError("the last line has no end")
    return [read(line) for line in text.split("\n")[:-1]]


def read_page(data):
    """The report that a page holds."""
    text = data.decode("utf-8")
    start = text.index(">", text.index('type="application/json"')) + 1
    return read(text[start:text.index("</script>", start)])
