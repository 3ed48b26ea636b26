"""The sheet of a cam: diagrams, smallest sizes, profiles, pressure angles."""
