"""Involute spur gear pairs: their sizes, checks, profiles and meshing."""
