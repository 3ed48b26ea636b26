"""Groups of class II: the five dyads, each with its plans of position, velocity, acceleration and forces."""
