"""Mistakes: constructions with one rule broken, and which of them explain a student's answers.

    >>> from kulman import solve
    >>> from kulman.plans.hands.hand import preset
    >>> from kulman.plans.hands.shaky import paper_of
    >>> from kulman.plans.marking.answers import Answer
    >>> from kulman.plans.marking.key import answer_key
    >>> from kulman.plans.marking.verdicts import mark
    >>> from kulman.plans.mistakes.book import book
    >>> from kulman.plans.mistakes.explaining import explain
    >>> solution = solve("nau-slider-crank", "example")
    >>> paper = paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})
    >>> key = answer_key(paper, preset("normal").tolerance)
    >>> marking = mark(key, [Answer("V_B", value=2.76), Answer("a_BA_n", value=34.7), Answer("a_B", value=295.0)])
    >>> explanation = explain(book(key), marking)
    >>> sorted(explanation.candidates[0].ids)  # in sizes, a_A outward and a_BA_n away from A are one
    ['M37', 'M38']

`book.MISTAKES`
    All `Mistake(id, rules, by_scale)` by id, `M01` ...; `data`, `motion` and `forces` hold the rules of linkages,
    `cams` and `gears` those of these. Whether one concerns a task follows from the steps of its program alone.
`rules.Broken(mistake, paper, change)`
    One rule broken at one place: `at` names the step, the quantity or the given; `program` and `givens` are those of
    the construction with the rule broken.
`book.broken(paper, values, ids=()) -> iterator of Broken`
    Every way in which a construction can go wrong.
`book.book(key) -> Book`
    The signatures of all of them for one answer key, to be kept with it.
`explaining.explain(book, marking) -> Explanation(candidates, marking)`
    Candidates, the simplest first; none for answers without an error. The marking is the one given, but for lines that
    the first candidate explains: all but the first wrong one are `carried`.
`explaining.Candidate(mistakes, same, explained, left, misses)`
    An explanation by one or two `Broken`; `same` are others that these answers cannot tell from it, to be reported with
    it; `explained` names the lines that are wrong without it and right with it, `left` those that stay wrong; `misses`
    is the root mean square of the misses of all answers, in tolerances; `ids` are the numbers of all.
"""
