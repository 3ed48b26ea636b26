"""Scale factors mu, units, and the errors everybody raises."""
