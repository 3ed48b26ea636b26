"""Marking: are a student's answers right, and where they are not, at which step did it go wrong?

The construction is run again with what the student has said. No files, no languages, no marks out of a hundred: those
who read forms and write reports build on the functions here.

    >>> from kulman import solve
    >>> from kulman.plans.hands.hand import preset
    >>> from kulman.plans.hands.shaky import paper_of
    >>> from kulman.plans.marking.answers import Answer
    >>> from kulman.plans.marking.key import answer_key
    >>> from kulman.plans.marking.verdicts import Verdict, mark
    >>> solution = solve("nau-slider-crank", "example")
    >>> paper = paper_of(solution.solved, {symbol: scale.mu for symbol, scale in solution.scales.items()})
    >>> key = answer_key(paper, preset("normal").tolerance)
    >>> marking = mark(key, [Answer("V_B", value=2.76), Answer("omega_2", value=-16.3), Answer("a_B", value=295.0)])
    >>> [(line.name, str(line.verdict)) for line in marking.lines if line.answer]
    [('V_B', 'right'), ('omega_2', 'right'), ('a_B', 'wrong')]
    >>> marking.first_wrong
    'a_B'

`answers.Answer(name, mm=None, mu=None, value=None, direction=None, sense=None)`
    One line of a student's form, SI: `mm` of paper, `mu` as the student writes it (value per mm, or mm per unit),
    `value`, `direction` in radians from the x axis, `sense` +1 counter-clockwise or -1. Each may be left out.
`key.Question(name, plan, vector, unit)`
    One line that may be asked, in order of construction: `plan` is where the value is shown or on whose way it is
    calculated (a name of `Program.plans`), `vector` whether it has a direction.
`key.Key`
    The answer key of one task and variant: `paper`, `tolerance` (a `hand.Tolerance`), `values` and `sines` of the exact
    run, `allowed` (SI, by name), `questions`; `key["V_B"]` is the right value, a float or complex. To be kept for a
    class: it costs more than to mark with it.
`key.answer_key(paper, tolerance, limits=None, wanted=None) -> Key`
    `limits` are one's own tolerances of single quantities, SI; `wanted` the names that are asked, all when left out.
`verdicts.Verdict`
    `right`, `carried` (right given the earlier error), `wrong`, `uncounted` (follows from wrong numbers), `arithmetic`
    (mm times mu is not the value), `scale` (scale factor or unit), `missing`; `.passed` for the first two.
`verdicts.Line(name, plan, verdict, answer, said, right, follows, allowed, off, about, way)`
    `said` is what the answer says, in SI; `right` the right value; `follows` what follows from the earlier answers;
    `allowed` the tolerance, SI; `off` by how many tolerances it misses the best of what it is held against; `about` is
    what is wrong with a line that does not pass: "size", "direction" or ""; `way` how the answer was taken.
`verdicts.Marking(key, lines, first_wrong, step)`
    `key` is drawn to the student's scales; `first_wrong` is the name of the first line that is wrong by itself, or
    None; `step` the `board.Step` that it reads or calculates, whose plan and letters say what to look at again.
    `marking["V_B"]` is a line, `marking.answered` those that are not missing.
`verdicts.mark(key, answers) -> Marking`
    Mark the answers of one student, of two to one question the first. Raises `InputError` (`quantity-unknown`) for a
    name that is not in the key.
`student.StudentBoard`
    The board that takes quantities from a student.

Why it is wrong is the matter of `kulman.plans.mistakes`.
"""
