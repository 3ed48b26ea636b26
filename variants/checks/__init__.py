"""Checks of a task file, each of which finds every fault of its kind."""
