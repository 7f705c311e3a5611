// Verdicts on an answer or an engine: the word, a sign that needs no colour, the colour.
export const VERDICTS = {
  right: { word: "right", sign: "✓", colour: "var(--right)" },
  agree: { word: "agree", sign: "✓", colour: "var(--right)" },
  exact: { word: "exact", sign: "✓", colour: "var(--right)", symbol: "star" },
  wrong: { word: "wrong", sign: "✗", colour: "var(--wrong)", symbol: "circle" },
  broken: { word: "broken", sign: "✗", colour: "var(--wrong)", symbol: "circle" },
  "ill-posed": { word: "ill-posed", sign: "≈", colour: "var(--ill-posed)", symbol: "diamond" },
  "wrong-time": { word: "wrong time", sign: "◷", colour: "var(--wrong-time)", symbol: "triangle" },
  undecided: { word: "undecided", sign: "?", colour: "var(--undecided)", symbol: "square" },
  error: { word: "error", sign: "!", colour: "var(--wrong)", symbol: "wye" },
  missing: { word: "missing", sign: "–", colour: "var(--undecided)", symbol: "cross" },
  nonsense: { word: "nonsense", sign: "–", colour: "var(--undecided)", symbol: "cross" },
};

export const MEANINGS = {
  wrong: "another obstacle or outcome than the exact one, and no rounding of the input explains it",
  "ill-posed": "another answer than the exact one, but a change of the input by its last bits gives it",
  "wrong-time": "the right obstacle, at a time that is off by more than the input's condition explains",
  undecided: "the engine says that it cannot know",
  error: "a valid question was answered with error, and not because the engine does not support it",
  missing: "asked, and no answer came: the program died, fell silent, or wrote something that is not an answer",
  nonsense: "an invalid question was answered, where error is right; counted apart from the queries",
};

export const verdictOf = (name) =>
  VERDICTS[name] ?? { word: String(name), sign: "•", colour: "var(--undecided)", symbol: "cross" };

// Keys of counts in the JSON, with their verdicts.
export const FAULTS = [
  ["wrong", "wrong"],
  ["ill_posed", "ill-posed"],
  ["wrong_time", "wrong-time"],
  ["undecided", "undecided"],
  ["error", "error"],
  ["missing", "missing"],
];
