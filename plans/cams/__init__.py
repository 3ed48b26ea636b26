"""Cams: their laws of motion, smallest sizes and profiles."""
