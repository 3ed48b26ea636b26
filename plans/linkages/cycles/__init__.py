"""The cycle of a mechanism: where it assembles, strokes, dead positions, diagrams of motion."""
