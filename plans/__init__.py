"""Constructions: the board, and what is built on it."""
