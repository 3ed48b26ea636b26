"""Drawings that are handed in, read back."""
