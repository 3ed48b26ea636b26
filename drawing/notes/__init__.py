"""The explanatory note: the work told step by step, with the figures, equations and tables of the sheet."""
