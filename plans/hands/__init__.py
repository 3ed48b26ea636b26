"""Drawing by hand: what a hand misses, what that makes of each quantity, what may be let pass."""
