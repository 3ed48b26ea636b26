"""Mistakes: constructions with one rule broken, and which of them explain a student's answers.

`rules.MISTAKES` has the rules by their numbers, `M01` ...; `data`, `motion` and `forces` enter those of linkages,
`cams` and `gears` those of these. Whether one concerns a task follows from the steps of its program alone.
`rules.broken` goes through every way in which a construction can go wrong, `book.book` keeps what each of them gives
with an answer key, and `explaining.explain` finds the candidates that explain an answer, the simplest first.
"""
