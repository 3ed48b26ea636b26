"""Marking: are a student's answers right, and where they are not, at which step did it go wrong?

The construction is run again with what the student has said. No files, no languages, no marks out of a hundred: those
who read forms and write reports build on the functions here.

    >>> from kulman import solve
    >>> from kulman.plans.hands.shaky import paper_of, preset
    >>> from kulman.plans.marking.answers import Answer
    >>> from kulman.plans.marking.key import answer_key
    >>> from kulman.plans.marking.verdicts import mark
    >>> from kulman.plans.mistakes.book import book
    >>> from kulman.plans.mistakes.explaining import explain
    >>> solution = solve("nau-slider-crank", "example")
    >>> paper = paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})
    >>> key = answer_key(paper, preset("normal").tolerance)
    >>> marking = mark(key, [Answer("V_B", value=2.76), Answer("a_BA_n", value=34.7), Answer("a_B", value=295.0)])
    >>> [(line.name, str(line.verdict)) for line in marking.lines if line.answer], marking.first_wrong
    ([('V_B', 'right'), ('a_BA_n', 'right'), ('a_B', 'wrong')], 'a_B')
    >>> sorted(explain(book(key), marking).candidates[0].ids)  # in sizes, a_A outward and a_BA_n away from A are one
    ['M37', 'M38']

`answers.Answer` is one line of a student's form, SI; any part of it may be left out. `key.answer_key` makes the key of
one task and variant, to be kept for a class: it costs more than to mark with it. `verdicts.mark` holds the answers of
one student against it, and says of each line (`answers.Line`) what it is (`answers.Verdict`), which is the first one
that is wrong by itself, and which step to look at again. `student.StudentBoard` takes quantities from a student.

Why it is wrong is the matter of `kulman.plans.mistakes`.
"""
