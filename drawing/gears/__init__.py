"""The sheet of a gear pair: meshing, sliding, tables, checks, blocking contour."""
