"""Marking of answers: the form, what comes back in it, roster, rubric, and reports for students and teachers."""
