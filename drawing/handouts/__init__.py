"""Handouts: a sheet with its answers left out, begun, or whole, and marks that prove the print."""
