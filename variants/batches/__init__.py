"""A whole class: a sheet for every student of a roster, the key for the teacher, and a list of all files."""
