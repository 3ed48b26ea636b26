"""Sheets of linkages: the views of a solved mechanism in the order in which a student draws them."""
