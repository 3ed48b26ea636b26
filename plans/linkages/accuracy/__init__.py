"""How accurate plans are: conditions, stability, other methods beside them, what a model needs."""
