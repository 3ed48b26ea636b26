"""Mistakes: constructions with one rule broken, and which of them explain a student's answers.

`rules.MISTAKES`
    All `Mistake(id, chapter, breaks)` by id, `M01` ...; `chapter` is `inputs`, `reading`, `velocity`, `acceleration`,
    `forces` or `lever`. Whether one concerns a task follows from the steps of its program alone.
`rules.Broken(mistake, at, program, givens)`
    One rule broken at one place: `at` names the step or the given.
`rules.broken(paper, values) -> tuple[Broken, ...]`
    Every way in which a construction can go wrong.
`explaining.Book`
    The signatures of all of them for one answer key, to be kept with it: `book(key)`.
`explaining.Candidate(mistakes, same, explained, left, misses)`
    An explanation: one or two `Broken`; `same` are others that give the same values in all lines that were answered,
    to be reported with it; `explained` names the lines that are wrong without it and right with it, `left` those that
    stay wrong; `misses` is the mean miss in tolerances of the lines it changes.
`explaining.explain(book, marking) -> Explanation`
    `Explanation(candidates, marking)`: candidates, the simplest first; none for answers without an error. The marking
    is the one given, but for lines that the first candidate explains: all but the first wrong one are `carried`.
"""
