"""What the sheet of a linkage says in equations, numbers and tables."""
