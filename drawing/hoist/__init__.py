"""The sheet of a hoist."""
