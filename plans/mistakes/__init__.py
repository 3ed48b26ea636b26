"""Mistakes: constructions with one rule broken, and which of them explain a student's answers.

    >>> from kulman import solve
    >>> from kulman.plans.hands.shaky import preset
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

`book.MISTAKES` has all by id, `M01` ...; `data`, `motion` and `forces` hold the rules of linkages, `cams` and `gears`
those of these. Whether one concerns a task follows from the steps of its program alone. `book.broken` goes through
every way in which a construction can go wrong, `book.book` keeps what each of them gives with an answer key, and
`explaining.explain` finds the candidates that explain one student's answers, the simplest first.
"""
