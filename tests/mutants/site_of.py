"""A mutant: one small mistake, and where it stands."""

import dataclasses
import hashlib


@dataclasses.dataclass(frozen=True)
class Site:
    path: str  # from the root
    operator: str
    begin: int  # bytes of the file that are replaced
    end: int
    text: str  # by what
    body: tuple  # bytes of the smallest whole that is written twice: a function's body, between its braces
    here: int  # where the statement begins that holds it
    line: int
    before: str  # the line, and what becomes of it
    after: str
    nth: int = 0  # of those with the same words in the file

    @property
    def words(self):
        return (self.path, self.before, self.after)

    def rank(self, seed):
        """A number drawn from what the mutant says: it stays when lines above it come or go."""
        return hashlib.sha256(repr((seed, self.words, self.nth)).encode()).hexdigest()


def site(path, source, operator, begin, end, text, body, here):
    """With its line as people read it: source is bytes; a statement of many lines is cut to its first."""
    start = source.rfind(b"\n", 0, begin) + 1
    stop = source.find(b"\n", end)
    stop = len(source) if stop < 0 else stop
    if isinstance(text, str):
        text = text.encode()
    before = source[start:stop].decode()
    after = (source[start:begin] + text + source[end:stop]).decode()
    return Site(path, operator, begin, end, text.decode(), body, here, source.count(b"\n", 0, begin) + 1,
                " ".join(before.split()), " ".join(after.split()))


def numbered(sites):
    """Those of equal words in a file told apart, in their order; the same change twice is one."""
    seen, result, spans = {}, [], set()
    for one in sorted(sites, key=lambda s: (s.begin, s.end, s.text)):
        if (one.begin, one.end, one.text) in spans:
            continue
        spans.add((one.begin, one.end, one.text))
        nth = seen.get(one.words, 0)
        seen[one.words] = nth + 1
        result.append(dataclasses.replace(one, nth=nth))
    return result
