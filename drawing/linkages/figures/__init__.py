"""The figures of a linkage's sheet: schemes, plans, force plans, the lever, diagrams."""
