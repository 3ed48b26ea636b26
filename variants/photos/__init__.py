"""Photographs of sheets drawn by hand, read back."""
