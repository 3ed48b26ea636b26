"""Mistakes: constructions with one rule broken, and which of them explain a student's answers.

`book.MISTAKES` has all by id, `M01` ...; `data`, `motion` and `forces` hold the rules of linkages, `cams` and `gears`
those of these. Whether one concerns a task follows from the steps of its program alone. `book.broken` goes through
every way in which a construction can go wrong, `book.book` keeps what each of them gives with an answer key, and
`explaining.explain` finds the candidates that explain one student's answers, the simplest first.
"""
